/* bench_proofs.c - what it costs to find out what a target can do: calls counted, and, as a remark, the time of the
 * first time, after the driver's own first draw, and of later ones.
 *
 *     bench_proofs [PLATFORM]
 *
 * A driver that compiles shaders for the processor does so once a state; Mesa keeps them on disk, so run it twice. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gnomon_gles.h"
#include "platform.h"
#include "spread.h"

enum { RUNS = 21 };

static gn_gl real;
static struct {
    long draws, clears, reads, programs;
} counts;

static void GL_APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    counts.draws++;
    real.glDrawArrays(mode, first, count);
}

static void GL_APIENTRY clear(GLbitfield buffers)
{
    counts.clears++;
    real.glClear(buffers);
}

static void GL_APIENTRY read_pixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                                    void *pixels)
{
    counts.reads++;
    real.glReadPixels(x, y, width, height, format, type, pixels);
}

static void GL_APIENTRY link_program(GLuint program)
{
    counts.programs++;
    real.glLinkProgram(program);
}

static gn_proc get_proc(void *user, const char *name)
{
    if (strcmp(name, "glDrawArrays") == 0)
        return (gn_proc)draw_arrays;
    if (strcmp(name, "glClear") == 0)
        return (gn_proc)clear;
    if (strcmp(name, "glReadPixels") == 0)
        return (gn_proc)read_pixels;
    if (strcmp(name, "glLinkProgram") == 0)
        return (gn_proc)link_program;
    return platform_get_proc(user, name);
}

static double now_ms(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* What no proof is to blame for: a driver's first draw of all. */
static double first_draw_ms(const gn_gl *gl)
{
    static const char vertex[] = "attribute vec4 a; void main() { gl_Position = a; }";
    static const char fragment[] = "void main() { gl_FragColor = vec4(1.0); }";
    static const GLfloat corners[3][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
    const char *const texts[2] = {vertex, fragment};
    const double start = now_ms();
    const GLuint program = gl->glCreateProgram();

    for (int i = 0; i < 2; i++) {
        const GLuint shader = gl->glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);

        gl->glShaderSource(shader, 1, &texts[i], NULL);
        gl->glCompileShader(shader);
        gl->glAttachShader(program, shader);
        gl->glDeleteShader(shader);
    }
    gl->glBindAttribLocation(program, 0, "a");
    gl->glLinkProgram(program);
    gl->glUseProgram(program);
    gl->glEnableVertexAttribArray(0);
    gl->glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, corners);
    gl->glDrawArrays(GL_TRIANGLES, 0, 3);
    gl->glDisableVertexAttribArray(0);
    gl->glFinish();
    gl->glUseProgram(0);
    gl->glDeleteProgram(program);
    return now_ms() - start;
}

int main(int count, char **arguments)
{
    const platform_desc wanted = {800, 600, 8, 8, 8, 8, 24, 8};
    char message[PLATFORM_MESSAGE];
    platform *p = platform_open(count > 1 ? arguments[1] : NULL, &wanted, message);
    const gn_gles_desc desc = {get_proc, p, NULL};
    gn_context *context;
    gn_gles *gles;
    gn_target target;
    double ms[RUNS], first;

    if (!p)
        return fprintf(stderr, "bench_proofs: %s\n", message), 1;
    gn_gl_load(&real, platform_get_proc, p);
    if (gn_context_create(NULL, &context) != GN_OK || gn_gles_create(context, &desc, &gles) != GN_OK)
        return 1;
    first = first_draw_ms(&real);
    for (int run = 0; run < RUNS; run++) {
        const double start = now_ms();

        memset(&counts, 0, sizeof counts);
        if (gn_gles_describe_target(gles, wanted.width, wanted.height, NULL, &target) != GN_OK)
            return fprintf(stderr, "bench_proofs: %s\n", gn_message(context)), 1;
        ms[run] = now_ms() - start;
    }
    printf("%s: %ld draws, %ld clears, %ld reads, %ld programs\n",
           (const char *)gn_gles_functions(gles)->glGetString(GL_RENDERER), counts.draws, counts.clears, counts.reads,
           counts.programs);
    printf("remark: the driver's first draw %.1f ms; then all proofs %.1f ms", first, ms[0]);
    qsort(ms + 1, RUNS - 1, sizeof *ms, by_value);
    printf(", and again %.1f ms (median of %d)\n", ms[1 + (RUNS - 1) / 2], RUNS - 1);
    gn_gles_destroy(gles);
    gn_context_destroy(context);
    platform_close(p);
    return 0;
}
