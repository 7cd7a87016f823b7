/* bench_ranges.c - how far each count without a stencil reaches in each format of colour, measured: one row of a CSV for
 * each driver, format and channel.
 *
 *     bench_ranges
 *
 * A pixel of a framebuffer object is counted up n times and down n times, or n - 1, by the blending of
 * gles/fallback/color.c, for growing n: the range is the last n for which all down gives the level at the start again, and
 * one less does not. count: the last n that adds one level each. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device.h"

enum { SIZE = 16, MOST = 300 };

static const gn_gl *gl;
static GLint color;

static GLuint compile(GLenum kind, const char *text)
{
    const GLuint shader = gl->glCreateShader(kind);

    gl->glShaderSource(shader, 1, &text, NULL);
    gl->glCompileShader(shader);
    return shader;
}

static int make_program(void)
{
    const GLuint program = gl->glCreateProgram();
    GLint ok = 0;

    gl->glAttachShader(program, compile(GL_VERTEX_SHADER, "#version 100\nattribute highp vec4 a_position;\n"
                                                          "void main() { gl_Position = a_position; }\n"));
    gl->glAttachShader(program, compile(GL_FRAGMENT_SHADER, "#version 100\nuniform mediump vec4 u_color;\n"
                                                            "void main() { gl_FragColor = u_color; }\n"));
    gl->glBindAttribLocation(program, 0, "a_position");
    gl->glLinkProgram(program);
    gl->glGetProgramiv(program, GL_LINK_STATUS, &ok);
    gl->glUseProgram(program);
    color = gl->glGetUniformLocation(program, "u_color");
    return ok;
}

static void blend(GLenum equation, GLenum source, GLenum destination, float value)
{
    const float rgba[4] = {value, value, value, value};

    gl->glBlendEquation(equation);
    gl->glBlendFunc(source, destination);
    gl->glUniform4fv(color, 1, rgba);
    gl->glDrawArrays(GL_TRIANGLES, 0, 3);
}

static int read_level(int channel, int top)
{
    uint8_t rgba[4];

    gl->glReadPixels(SIZE / 2, SIZE / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    return (rgba[channel] * top + 127) / 255;
}

static void count(int is_halving, int top, int up)
{
    const float half = (float)((top + 1) / 2) / (float)top;

    if (is_halving)
        blend(GL_FUNC_ADD, up ? GL_ZERO : GL_DST_COLOR, up ? GL_SRC_COLOR : GL_ONE, up ? half : 1.0f);
    else
        blend(up ? GL_FUNC_ADD : GL_FUNC_REVERSE_SUBTRACT, GL_ONE, GL_ONE, 1.0f / (float)top);
}

/* The level after so many up and down. */
static int level_after(int is_halving, int start, int top, int channel, int ups, int downs)
{
    blend(GL_FUNC_ADD, GL_ONE, GL_ZERO, (float)start / (float)top);
    for (int i = 0; i < ups; i++)
        count(is_halving, top, 1);
    for (int i = 0; i < downs; i++)
        count(is_halving, top, 0);
    return read_level(channel, top);
}

static int range_of(int is_halving, int start, int top, int channel)
{
    int n = 1;

    while (n < MOST && level_after(is_halving, start, top, channel, n, n) == start &&
           level_after(is_halving, start, top, channel, n, n - 1) != start)
        n++;
    return n - 1;
}

static int range_of_count(int top, int channel)
{
    int n = 1;

    while (n < MOST && level_after(0, 0, top, channel, n, 0) == n)
        n++;
    return n - 1;
}

static int run(const char *platform_name)
{
    static const char *const channels[] = {"red", "green", "blue", "alpha"};
    static const float corners[] = {-1, -1, 3, -1, -1, 3};
    test_device device;
    GLuint buffer;

    if (test_open_device(&device, platform_name, SIZE))
        return 0;
    gl = device.gl;
    if (!make_program())
        return fprintf(stderr, "bench_ranges: the GL refuses a shader\n"), 0;
    gl->glGenBuffers(1, &buffer);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffer);
    gl->glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    gl->glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, NULL);
    gl->glEnableVertexAttribArray(0);
    gl->glViewport(0, 0, SIZE, SIZE);
    gl->glDisable(GL_DITHER);
    gl->glEnable(GL_BLEND);
    for (int f = 0; f < TEST_FORMATS; f++) {
        const test_format *format = &test_formats[f];
        const GLuint texture = test_make_texture(gl, format, SIZE);
        GLuint framebuffer;

        gl->glGenFramebuffers(1, &framebuffer);
        gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        for (int c = 0; c < 4; c++) {
            const int top = (1 << format->bits[c]) - 1;

            if (format->bits[c] >= 4)
                printf("%s,%s,%s,%d,%d,%d,%d\n", (const char *)gl->glGetString(GL_RENDERER), format->name, channels[c],
                       format->bits[c], range_of_count(top, c), range_of(0, (top + 1) / 2, top, c),
                       range_of(1, top, top, c));
        }
    }
    test_close_device(&device);
    return 1;
}

int main(void)
{
    printf("renderer,format,channel,bits,count,signed,halved\n");
    return !run("egl");
}
