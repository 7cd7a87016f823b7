/* small_program.c - see small_program.h. */
#include "small_program.h"

#include "command.h"

static GLuint compile(const gn_gl *gl, GLenum type, const char *text)
{
    const char *const parts[2] = {"#version 100\n", text};
    const GLuint shader = gl->glCreateShader(type);
    GLint ok = 0;

    gl->glShaderSource(shader, 2, parts, NULL);
    gl->glCompileShader(shader);
    gl->glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[512] = "";

        gl->glGetShaderInfoLog(shader, sizeof log, NULL, log);
        say("shader: %s", log);
    }
    return shader;
}

GLuint small_program(const gn_gl *gl, const char *vertex, const char *fragment, const char *const *attributes)
{
    const GLuint v = compile(gl, GL_VERTEX_SHADER, vertex), f = compile(gl, GL_FRAGMENT_SHADER, fragment);
    GLuint program = gl->glCreateProgram();
    GLint ok = 0;

    gl->glAttachShader(program, v);
    gl->glAttachShader(program, f);
    for (GLuint i = 0; attributes[i]; i++)
        gl->glBindAttribLocation(program, i, attributes[i]);
    gl->glLinkProgram(program);
    gl->glGetProgramiv(program, GL_LINK_STATUS, &ok);
    gl->glDeleteShader(v);
    gl->glDeleteShader(f);
    if (!ok) {
        say("shader: a program of the viewer does not link");
        gl->glDeleteProgram(program);
        program = 0;
    }
    return program;
}
