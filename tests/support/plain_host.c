/* plain_host.c - see plain_host.h. */
#include "plain_host.h"

#include <stdlib.h>
#include <string.h>

static const char vertex_source[] = "attribute highp vec3 a_position;\n"
                                    "uniform highp mat4 u_clip;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    gl_Position = gn_position(u_clip, a_position);\n"
                                    "    gn_mask_place(gl_Position);\n"
                                    "}\n";
static const char fragment_source[] = "uniform mediump vec4 u_color;\n"
                                      "uniform mediump vec4 u_channels;\n"
                                      "void main()\n"
                                      "{\n"
                                      "#ifdef GN_DEPTH_COLOR\n"
                                      "    gl_FragColor = gn_mask_depth_color();\n"
                                      "#else\n"
                                      "    gl_FragColor = u_color * dot(gn_mask(), u_channels);\n"
                                      "#endif\n"
                                      "}\n";

/* Programs of a host. */
enum { BARE, MASKED, DEPTH };

static GLuint compile(const gn_gl *gl, GLenum kind, int program)
{
    static const char *const defines[] = {"", "#define GN_MASKED\n", "#define GN_DEPTH_COLOR\n"};
    const char *const parts[4] = {"#version 100\n", defines[program],
                                  kind == GL_VERTEX_SHADER ? GN_GLSL_POSITION GN_GLSL_MASK_VERTEX
                                                           : GN_GLSL_MASK_FRAGMENT,
                                  kind == GL_VERTEX_SHADER ? vertex_source : fragment_source};
    const GLuint shader = gl->glCreateShader(kind);
    GLint ok = 0;

    gl->glShaderSource(shader, 4, parts, NULL);
    gl->glCompileShader(shader);
    gl->glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    return ok ? shader : 0;
}

int plain_host_open(plain_host *h, gn_gles *gles)
{
    const gn_gl *gl = gn_gles_functions(gles);
    GLint ok = 1;

    memset(h, 0, sizeof *h);
    h->gles = gles;
    h->gl = gl;
    for (int i = BARE; i <= DEPTH && ok; i++) {
        const GLuint vertex = compile(gl, GL_VERTEX_SHADER, i), fragment = compile(gl, GL_FRAGMENT_SHADER, i);

        h->programs[i].name = gl->glCreateProgram();
        gl->glAttachShader(h->programs[i].name, vertex);
        gl->glAttachShader(h->programs[i].name, fragment);
        gl->glBindAttribLocation(h->programs[i].name, 0, "a_position");
        gl->glLinkProgram(h->programs[i].name);
        gl->glGetProgramiv(h->programs[i].name, GL_LINK_STATUS, &ok);
        gl->glDeleteShader(vertex);
        gl->glDeleteShader(fragment);
        h->programs[i].clip = gl->glGetUniformLocation(h->programs[i].name, "u_clip");
        h->programs[i].color = gl->glGetUniformLocation(h->programs[i].name, "u_color");
        h->programs[i].channels = gl->glGetUniformLocation(h->programs[i].name, "u_channels");
        h->programs[i].mask = gl->glGetUniformLocation(h->programs[i].name, "gn_mask_texture");
        h->programs[i].depth = gl->glGetUniformLocation(h->programs[i].name, "gn_mask_depth");
    }
    return ok;
}

void plain_host_close(plain_host *h)
{
    for (int i = BARE; i <= DEPTH; i++)
        h->gl->glDeleteProgram(h->programs[i].name);
}

/* From the mesh's own arrays, in client memory: slow, and simple. */
static void draw_objects(plain_host *h, const gn_plan *plan, int program)
{
    const gn_gl *gl = h->gl;

    gl->glEnableVertexAttribArray(0);
    for (uint32_t o = 0; o < plan->object_count; o++) {
        const gn_mesh_info *info = gn_mesh_get_info(plan->objects[o].mesh);

        gl->glUniformMatrix4fv(h->programs[program].clip, 1, GL_FALSE, plan->objects[o].matrix);
        for (uint32_t t = 0; t < info->triangle_count; t++) {
            float corners[9];

            for (int k = 0; k < 3; k++)
                memcpy(corners + 3 * k, info->positions + 3 * (size_t)info->triangles[3 * t + (uint32_t)k],
                       3 * sizeof(float));
            gl->glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, corners);
            gl->glDrawArrays(GL_TRIANGLES, 0, 3);
        }
    }
}

static void draw(plain_host *h, const gn_plan *plan, int program, uint32_t mask, uint32_t channel, float share)
{
    const gn_gl *gl = h->gl;
    const float color[4] = {share, share, share, share > 0.0f ? 0.0f : 1.0f};
    float channels[4] = {0, 0, 0, 0};

    channels[channel] = 1.0f;
    if (share > 0.0f) /* backs that meet a front at an edge have its depth there, and would be lit too */
        gl->glEnable(GL_CULL_FACE);
    gl->glUseProgram(h->programs[program].name);
    gl->glUniform4fv(h->programs[program].color, 1, color);
    gl->glUniform4fv(h->programs[program].channels, 1, channels);
    if (program == DEPTH) {
        const float depth[2] = {(float)plan->mask_depth[0], (float)plan->mask_depth[1]};

        gl->glUniform2fv(h->programs[program].depth, 1, depth);
    }
    if (program == MASKED) {
        gl->glActiveTexture(GL_TEXTURE1);
        gl->glBindTexture(GL_TEXTURE_2D, mask);
        gl->glUniform1i(h->programs[program].mask, 1);
    }
    draw_objects(h, plan, program);
}

int plain_host_draw(plain_host *h, const gn_plan *plan, float share)
{
    gn_step step;

    if (gn_gles_begin(h->gles, plan) != GN_OK)
        return 0;
    while (gn_gles_next(h->gles, &step)) {
        const int is_masked = plan->mask == GN_MASK_TEXTURE && step.receivers && step.mask != GN_NO_MASK;

        if (step.draw == GN_DRAW_DEPTH || step.draw == GN_DRAW_AMBIENT)
            draw(h, plan, step.draw == GN_DRAW_DEPTH && plan->carries_depth ? DEPTH : BARE, 0, 0, 0.0f);
        for (uint32_t i = 0; i < step.light_count; i++)
            draw(h, plan, is_masked ? MASKED : BARE, is_masked ? gn_gles_mask(h->gles, step.mask) : 0, i, share);
    }
    return 1;
}
