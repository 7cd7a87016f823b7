/* stage_program.c - the stage's shaders, compiled when first used: one text, a program for each kind of surface. */
#include "stage.h"

#include <stdio.h>
#include <string.h>

#include "shaders/line.frag.h"
#include "shaders/line.vert.h"
#include "shaders/surface.frag.h"
#include "shaders/surface.vert.h"

static GLuint compile(const gn_gl *gl, GLenum type, const char *defines, const char *text)
{
    const char *const parts[4] = {"#version 100\n", defines,
                                  type == GL_VERTEX_SHADER
                                      ? "precision highp float;\n" GN_GLSL_POSITION GN_GLSL_MASK_VERTEX
                                      : GN_GLSL_MASK_FRAGMENT,
                                  text};
    const GLuint shader = gl->glCreateShader(type);
    GLint ok = 0;

    gl->glShaderSource(shader, 4, parts, NULL);
    gl->glCompileShader(shader);
    gl->glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[1024] = "";

        gl->glGetShaderInfoLog(shader, sizeof log, NULL, log);
        fprintf(stderr, "gnomon: shader: %s\n", log);
        gl->glDeleteShader(shader);
        return 0;
    }
    return shader;
}

static GLuint link(const gn_gl *gl, const char *defines, const char *vertex, const char *fragment)
{
    const GLuint v = compile(gl, GL_VERTEX_SHADER, defines, vertex),
                 f = compile(gl, GL_FRAGMENT_SHADER, defines, fragment);
    GLuint program = v && f ? gl->glCreateProgram() : 0;
    GLint ok = 0;

    if (program) {
        static const char *const attributes[] = {"a_position", "a_normal", "a_uv", "a_color"};

        gl->glAttachShader(program, v);
        gl->glAttachShader(program, f);
        for (GLuint i = 0; i < 4; i++)
            gl->glBindAttribLocation(program, i, attributes[i]);
        gl->glLinkProgram(program);
        gl->glGetProgramiv(program, GL_LINK_STATUS, &ok);
        if (!ok) {
            char log[1024] = "";

            gl->glGetProgramInfoLog(program, sizeof log, NULL, log);
            fprintf(stderr, "gnomon: shader: %s\n", log);
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

static void locate(const gn_gl *gl, stage_program *p)
{
    const struct {
        GLint *at;
        const char *name;
    } uniforms[] = {
        {&p->clip, "u_clip"},
        {&p->world, "u_world"},
        {&p->normal, "u_normal"},
        {&p->base, "u_base"},
        {&p->flat, "u_flat"},
        {&p->ambient, "u_ambient"},
        {&p->emits, "u_emits"},
        {&p->emissive, "u_emissive"},
        {&p->cutoff, "u_cutoff"},
        {&p->shininess, "u_shininess"},
        {&p->specular, "u_specular"},
        {&p->metallic, "u_metallic"},
        {&p->two_sided, "u_two_sided"},
        {&p->texture, "u_texture"},
        {&p->light_position, "u_light_position"},
        {&p->light_color, "u_light_color"},
        {&p->light_axis, "u_light_axis"},
        {&p->light_cone, "u_light_cone"},
        {&p->mask, "gn_mask_texture"},
        {&p->channels, "u_channels"},
        {&p->mask_size, "gn_mask_size"},
        {&p->mask_depth, "gn_mask_depth"},
        {&p->mask_sharpness, "gn_mask_sharpness"},
    };

    for (size_t i = 0; i < sizeof uniforms / sizeof uniforms[0]; i++)
        *uniforms[i].at = gl->glGetUniformLocation(p->name, uniforms[i].name);
}

stage_program *stage_use(stage *s, unsigned kind)
{
    stage_program *p = &s->programs[kind];

    if (!p->name) {
        char defines[512];

        snprintf(defines, sizeof defines,
                 "#define LIGHTS %u\n#define TEXTURED %d\n#define CUT %d\n#define FLAT %d\n#define FROM_BEHIND %s\n"
                 "#define PRECISION %s\n%s%s%s%s%s",
                 kind >> STAGE_LIGHT_SHIFT, !!(kind & STAGE_TEXTURED), !!(kind & STAGE_CUT), !!(kind & STAGE_FLAT),
                 gn_target_can(&s->target, GN_CAN_FRONT_FACING) ? "!gl_FrontFacing" : "(dot(n, v) < 0.0)",
                 kind & STAGE_MEDIUMP ? "mediump" : "highp", kind & STAGE_MASKED ? "#define GN_MASKED\n" : "",
                 kind & STAGE_MEDIUMP ? "#define GN_MEDIUMP\n" : "",
                 kind & STAGE_UPSAMPLED ? "#define GN_UPSAMPLED\n" : "",
                 kind & STAGE_SHARPENED ? "#define GN_SHARPENED\n" : "",
                 kind & STAGE_DEPTH ? "#define GN_DEPTH_COLOR\n" : "");
        p->name = link(s->gl, defines, gni_shader_surface_vert, gni_shader_surface_frag);
        if (!p->name)
            return NULL;
        locate(s->gl, p);
    }
    s->gl->glUseProgram(p->name);
    return p;
}

stage_program *stage_use_lines(stage *s)
{
    if (!s->lines.name) {
        s->lines.name = link(s->gl, "", gni_shader_line_vert, gni_shader_line_frag);
        if (!s->lines.name)
            return NULL;
        locate(s->gl, &s->lines);
    }
    s->gl->glUseProgram(s->lines.name);
    return &s->lines;
}
