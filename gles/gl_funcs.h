/* gl_funcs.h - every OpenGL ES 2.0 function that gnomon and the hosts in this tree call, once. Define
 * GN_GL_PROC(name, parameters, arguments) for those that return nothing and GN_GL_FUNC(type, name, parameters,
 * arguments) for the others, then include this file: it makes the struct of pointers, its loader, and the tests'
 * null and recording GL. GN_GL_OPTIONAL(name, desktop's name, parameters, arguments) is for extensions' functions,
 * which return nothing; without it they are as by GN_GL_PROC. No include guard. */
GN_GL_PROC(glActiveTexture, (GLenum texture), (texture))
GN_GL_PROC(glAttachShader, (GLuint program, GLuint shader), (program, shader))
GN_GL_PROC(glBindAttribLocation, (GLuint program, GLuint index, const GLchar *name), (program, index, name))
GN_GL_PROC(glBindBuffer, (GLenum target, GLuint buffer), (target, buffer))
GN_GL_PROC(glBindFramebuffer, (GLenum target, GLuint framebuffer), (target, framebuffer))
GN_GL_PROC(glBindRenderbuffer, (GLenum target, GLuint renderbuffer), (target, renderbuffer))
GN_GL_PROC(glBindTexture, (GLenum target, GLuint texture), (target, texture))
GN_GL_PROC(glBlendEquation, (GLenum mode), (mode))
GN_GL_PROC(glBlendEquationSeparate, (GLenum rgb, GLenum alpha), (rgb, alpha))
GN_GL_PROC(glBlendFunc, (GLenum sfactor, GLenum dfactor), (sfactor, dfactor))
GN_GL_PROC(glBlendFuncSeparate,
           (GLenum source_rgb, GLenum destination_rgb, GLenum source_alpha, GLenum destination_alpha),
           (source_rgb, destination_rgb, source_alpha, destination_alpha))
GN_GL_PROC(glBufferData, (GLenum target, GLsizeiptr size, const void *data, GLenum usage), (target, size, data, usage))
GN_GL_PROC(glBufferSubData, (GLenum target, GLintptr offset, GLsizeiptr size, const void *data),
           (target, offset, size, data))
GN_GL_FUNC(GLenum, glCheckFramebufferStatus, (GLenum target), (target))
GN_GL_PROC(glClear, (GLbitfield mask), (mask))
GN_GL_PROC(glClearColor, (GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha), (red, green, blue, alpha))
GN_GL_PROC(glClearDepthf, (GLfloat depth), (depth))
GN_GL_PROC(glClearStencil, (GLint s), (s))
GN_GL_PROC(glColorMask, (GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha), (red, green, blue, alpha))
GN_GL_PROC(glCompileShader, (GLuint shader), (shader))
GN_GL_PROC(glCopyTexSubImage2D,
           (GLenum target, GLint level, GLint to_x, GLint to_y, GLint x, GLint y, GLsizei width, GLsizei height),
           (target, level, to_x, to_y, x, y, width, height))
GN_GL_FUNC(GLuint, glCreateProgram, (void), ())
GN_GL_FUNC(GLuint, glCreateShader, (GLenum type), (type))
GN_GL_PROC(glCullFace, (GLenum mode), (mode))
GN_GL_PROC(glDeleteBuffers, (GLsizei n, const GLuint *buffers), (n, buffers))
GN_GL_PROC(glDeleteFramebuffers, (GLsizei n, const GLuint *framebuffers), (n, framebuffers))
GN_GL_PROC(glDeleteProgram, (GLuint program), (program))
GN_GL_PROC(glDeleteRenderbuffers, (GLsizei n, const GLuint *renderbuffers), (n, renderbuffers))
GN_GL_PROC(glDeleteShader, (GLuint shader), (shader))
GN_GL_PROC(glDeleteTextures, (GLsizei n, const GLuint *textures), (n, textures))
GN_GL_PROC(glDepthFunc, (GLenum func), (func))
GN_GL_PROC(glDepthMask, (GLboolean flag), (flag))
GN_GL_PROC(glDepthRangef, (GLfloat near, GLfloat far), (near, far))
GN_GL_PROC(glDisable, (GLenum cap), (cap))
GN_GL_PROC(glDisableVertexAttribArray, (GLuint index), (index))
GN_GL_PROC(glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
GN_GL_PROC(glDrawElements, (GLenum mode, GLsizei count, GLenum type, const void *indices), (mode, count, type, indices))
GN_GL_PROC(glEnable, (GLenum cap), (cap))
GN_GL_PROC(glEnableVertexAttribArray, (GLuint index), (index))
GN_GL_PROC(glFinish, (void), ())
GN_GL_PROC(glFramebufferRenderbuffer,
           (GLenum target, GLenum attachment, GLenum renderbuffer_target, GLuint renderbuffer),
           (target, attachment, renderbuffer_target, renderbuffer))
GN_GL_PROC(glFramebufferTexture2D,
           (GLenum target, GLenum attachment, GLenum texture_target, GLuint texture, GLint level),
           (target, attachment, texture_target, texture, level))
GN_GL_PROC(glFrontFace, (GLenum mode), (mode))
GN_GL_PROC(glGenBuffers, (GLsizei n, GLuint *buffers), (n, buffers))
GN_GL_PROC(glGenFramebuffers, (GLsizei n, GLuint *framebuffers), (n, framebuffers))
GN_GL_PROC(glGenRenderbuffers, (GLsizei n, GLuint *renderbuffers), (n, renderbuffers))
GN_GL_PROC(glGenTextures, (GLsizei n, GLuint *textures), (n, textures))
GN_GL_PROC(glGenerateMipmap, (GLenum target), (target))
GN_GL_FUNC(GLenum, glGetError, (void), ())
GN_GL_PROC(glGetFloatv, (GLenum pname, GLfloat *data), (pname, data))
GN_GL_PROC(glGetFramebufferAttachmentParameteriv,
           (GLenum target, GLenum attachment, GLenum pname, GLint *params), (target, attachment, pname, params))
GN_GL_PROC(glGetIntegerv, (GLenum pname, GLint *data), (pname, data))
GN_GL_PROC(glGetProgramInfoLog, (GLuint program, GLsizei size, GLsizei *length, GLchar *log),
           (program, size, length, log))
GN_GL_PROC(glGetProgramiv, (GLuint program, GLenum pname, GLint *params), (program, pname, params))
GN_GL_PROC(glGetShaderInfoLog, (GLuint shader, GLsizei size, GLsizei *length, GLchar *log), (shader, size, length, log))
GN_GL_PROC(glGetShaderPrecisionFormat, (GLenum shader_type, GLenum precision_type, GLint *range, GLint *precision),
           (shader_type, precision_type, range, precision))
GN_GL_PROC(glGetShaderiv, (GLuint shader, GLenum pname, GLint *params), (shader, pname, params))
GN_GL_FUNC(const GLubyte *, glGetString, (GLenum name), (name))
GN_GL_FUNC(GLint, glGetUniformLocation, (GLuint program, const GLchar *name), (program, name))
GN_GL_PROC(glGetVertexAttribPointerv, (GLuint index, GLenum pname, void **pointer), (index, pname, pointer))
GN_GL_PROC(glGetVertexAttribiv, (GLuint index, GLenum pname, GLint *params), (index, pname, params))
GN_GL_PROC(glLinkProgram, (GLuint program), (program))
GN_GL_PROC(glPixelStorei, (GLenum pname, GLint param), (pname, param))
GN_GL_PROC(glPolygonOffset, (GLfloat factor, GLfloat units), (factor, units))
GN_GL_PROC(glReadPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void *pixels),
           (x, y, width, height, format, type, pixels))
GN_GL_PROC(glRenderbufferStorage, (GLenum target, GLenum internal_format, GLsizei width, GLsizei height),
           (target, internal_format, width, height))
GN_GL_PROC(glScissor, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))
GN_GL_PROC(glShaderSource, (GLuint shader, GLsizei count, const GLchar *const *string, const GLint *length),
           (shader, count, string, length))
GN_GL_PROC(glStencilFunc, (GLenum func, GLint ref, GLuint mask), (func, ref, mask))
GN_GL_PROC(glStencilFuncSeparate, (GLenum face, GLenum func, GLint ref, GLuint mask), (face, func, ref, mask))
GN_GL_PROC(glStencilMask, (GLuint mask), (mask))
GN_GL_PROC(glStencilMaskSeparate, (GLenum face, GLuint mask), (face, mask))
GN_GL_PROC(glStencilOp, (GLenum sfail, GLenum dpfail, GLenum dppass), (sfail, dpfail, dppass))
GN_GL_PROC(glStencilOpSeparate, (GLenum face, GLenum sfail, GLenum dpfail, GLenum dppass),
           (face, sfail, dpfail, dppass))
GN_GL_PROC(glTexImage2D,
           (GLenum target, GLint level, GLint internal_format, GLsizei width, GLsizei height, GLint border,
            GLenum format, GLenum type, const void *pixels),
           (target, level, internal_format, width, height, border, format, type, pixels))
GN_GL_PROC(glTexParameteri, (GLenum target, GLenum pname, GLint param), (target, pname, param))
GN_GL_PROC(glUniform1f, (GLint location, GLfloat v0), (location, v0))
GN_GL_PROC(glUniform1i, (GLint location, GLint v0), (location, v0))
GN_GL_PROC(glUniform2fv, (GLint location, GLsizei count, const GLfloat *value), (location, count, value))
GN_GL_PROC(glUniform3fv, (GLint location, GLsizei count, const GLfloat *value), (location, count, value))
GN_GL_PROC(glUniform4fv, (GLint location, GLsizei count, const GLfloat *value), (location, count, value))
GN_GL_PROC(glUniformMatrix3fv, (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value),
           (location, count, transpose, value))
GN_GL_PROC(glUniformMatrix4fv, (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value),
           (location, count, transpose, value))
GN_GL_PROC(glUseProgram, (GLuint program), (program))
GN_GL_PROC(glVertexAttribPointer,
           (GLuint index, GLint size, GLenum type, GLboolean normalized, GLsizei stride, const void *pointer),
           (index, size, type, normalized, stride, pointer))
GN_GL_PROC(glViewport, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))

/* Of extensions: may be NULL, and a pointer alone proves nothing. The second name is desktop OpenGL's. */
#ifndef GN_GL_OPTIONAL
#define GN_GL_OPTIONAL(name, other, parameters, arguments) GN_GL_PROC(name, parameters, arguments)
#define GN_GL_OPTIONAL_IS_PROC
#endif
GN_GL_OPTIONAL(glBeginQueryEXT, glBeginQuery, (GLenum target, GLuint query), (target, query))
GN_GL_OPTIONAL(glDeleteQueriesEXT, glDeleteQueries, (GLsizei n, const GLuint *queries), (n, queries))
GN_GL_OPTIONAL(glDepthBoundsEXT, glDepthBoundsEXT, (double least, double most), (least, most))
GN_GL_OPTIONAL(glDiscardFramebufferEXT, glInvalidateFramebuffer, (GLenum target, GLsizei n, const GLenum *attachments),
               (target, n, attachments))
GN_GL_OPTIONAL(glEndQueryEXT, glEndQuery, (GLenum target), (target))
GN_GL_OPTIONAL(glGenQueriesEXT, glGenQueries, (GLsizei n, GLuint *queries), (n, queries))
GN_GL_OPTIONAL(glGetQueryObjectuivEXT, glGetQueryObjectuiv, (GLuint query, GLenum pname, GLuint *params),
               (query, pname, params))
#ifdef GN_GL_OPTIONAL_IS_PROC
#undef GN_GL_OPTIONAL_IS_PROC
#undef GN_GL_OPTIONAL
#endif
