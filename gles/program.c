/* program.c - compiles and links; what the driver says of a failure goes to the port's log with the shader's name. */
#include "gni_gles.h"

#include "shaders/counted.frag.h"
#include "shaders/flat.frag.h"
#include "shaders/quad.vert.h"
#include "shaders/volume.vert.h"

#include <stdio.h>

/* get_log: of a shader, or of a program. */
static void complain(const gn_gles *g, const char *name,
                     void(GL_APIENTRY *get_log)(GLuint, GLsizei, GLsizei *, GLchar *), GLuint of)
{
    char log[512] = "", line[640];

    if (!g->port.log)
        return;
    get_log(of, sizeof log, NULL, log);
    snprintf(line, sizeof line, "%s: %s", name, log[0] ? log : "refused without a word");
    g->port.log(g->port.user, GN_LOG_ERROR, line);
}

static GLuint compile(gn_gles *g, GLenum type, const char *name, const char *defines, const char *source)
{
    const gn_gl *gl = &g->gl;
    const char *const text[4] = {
        "#version 100\n", defines,
        type == GL_VERTEX_SHADER ? "precision highp float;\n" GN_GLSL_POSITION : "precision mediump float;\n", source};
    const GLuint shader = gl->glCreateShader(type);
    GLint ok = 0;

    if (!shader)
        return 0;
    gl->glShaderSource(shader, 4, text, NULL);
    gl->glCompileShader(shader);
    gl->glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        if (GNI_HAS_MESSAGES)
            complain(g, name, gl->glGetShaderInfoLog, shader);
        gl->glDeleteShader(shader);
        return 0;
    }
    return shader;
}

GLuint gni_make_program(gn_gles *g, const char *name, const char *defines, const char *vertex, const char *fragment)
{
    const gn_gl *gl = &g->gl;
    const GLuint v = compile(g, GL_VERTEX_SHADER, name, defines, vertex);
    const GLuint f = compile(g, GL_FRAGMENT_SHADER, name, defines, fragment);
    GLuint program = v && f ? gl->glCreateProgram() : 0;
    GLint ok = 0;

    if (program) {
        gl->glAttachShader(program, v);
        gl->glAttachShader(program, f);
        gl->glBindAttribLocation(program, 0, "a_position");
        gl->glLinkProgram(program);
        gl->glGetProgramiv(program, GL_LINK_STATUS, &ok);
        if (!ok) {
            if (GNI_HAS_MESSAGES)
                complain(g, name, gl->glGetProgramInfoLog, program);
            gl->glDeleteProgram(program);
            program = 0;
        }
    }
    if (v)
        gl->glDeleteShader(v);
    if (f)
        gl->glDeleteShader(f);
    return program;
}

int gni_make_flat_program(gn_gles *g, gni_program *out, const char *name, const char *defines)
{
    const gn_gl *gl = &g->gl;
    const int is_flat = (GNI_HAS_FALLBACK || GNI_HAS_PROOFS) && defines;

    out->name = gni_make_program(g, name, is_flat ? defines : "", gni_shader_volume_vert,
                                 is_flat ? gni_shader_flat_frag : gni_shader_counted_frag);
    if (!out->name)
        return 0;
    out->near_matrix = gl->glGetUniformLocation(out->name, "u_near");
    out->far_matrix = gl->glGetUniformLocation(out->name, "u_far");
    if (!is_flat)
        return 1;
    out->color = gl->glGetUniformLocation(out->name, "u_color");
    out->side = gl->glGetUniformLocation(out->name, "u_side");
    out->back = gl->glGetUniformLocation(out->name, "u_back");
    return 1;
}

int gni_make_reader(gn_gles *g, gni_reader *out, const char *name, const char *defines, const char *fragment)
{
    const gn_gl *gl = &g->gl;

    if (out->name)
        return 1;
    out->name = gni_make_program(g, name, defines, gni_shader_quad_vert, fragment);
    if (!out->name)
        return 0;
    out->texture = gl->glGetUniformLocation(out->name, "u_texture");
    out->weights = gl->glGetUniformLocation(out->name, "u_weights");
    out->level = gl->glGetUniformLocation(out->name, "u_level");
    out->unused = gl->glGetUniformLocation(out->name, "u_unused");
    out->dimmed = gl->glGetUniformLocation(out->name, "u_dimmed");
    out->step = gl->glGetUniformLocation(out->name, "u_step");
    return 1;
}
