/* minimal.c - exact shadows through EGL, with shaders of its own: a box over a floor. The steps are those of docs/porting.md.
 *     cc -std=c99 minimal.c $(pkg-config --cflags --libs gnomon) -lEGL -o minimal && EGL_PLATFORM=surfaceless ./minimal frame.ppm
 * A second name is of what `gnomon probe --save` has written here: then nothing is proven by drawing. */
/* clang-format off */
#include <EGL/egl.h>
#include <gn_matrix.h>
#include <gnomon_gles.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240 };

static const float floor_at[] = {-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4};
static const float box_at[] = {-1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1, -1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,
                                     1, 6, 2, 1, 5, 6, 2, 7, 3, 2, 6, 7, 3, 4, 0, 3, 7, 4};
static const float colors[2][3] = {{0.80f, 0.75f, 0.65f}, {0.85f, 0.35f, 0.25f}};

static void fail(const char *what)
{
    fprintf(stderr, "minimal: %s\n", what);
    exit(1);
}

static gn_proc get_proc(void *user, const char *name)
{
    (void)user;
    return (gn_proc)eglGetProcAddress(name);
}

/* 1. A context, with depth and stencil. A board takes its window here. */
static void open_context(void)
{
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT,
                                    EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE},
                        two[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLint count;

    if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API) ||
        !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        fail("no EGL with depth and stencil");
    const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    if (!eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, EGL_NO_CONTEXT, two)))
        fail("no context of OpenGL ES 2.0");
}

/* 2. Shaders of the host's own. Only the position is computed as the library does: passes are compared by equal depth. */
static GLuint make_program(const gn_gl *gl)
{
    static const char *const texts[2][2] = {
        {GN_GLSL_POSITION, "attribute highp vec3 a_at; uniform highp mat4 u_clip;"
                           "void main() { gl_Position = gn_position(u_clip, a_at); }"},
        {"precision mediump float;", "uniform vec3 u_color; void main() { gl_FragColor = vec4(u_color, 1.0); }"}};
    const GLuint program = gl->glCreateProgram();
    GLint ok = 0;

    for (int i = 0; i < 2; i++) {
        const GLuint shader = gl->glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);

        gl->glShaderSource(shader, 2, texts[i], NULL);
        gl->glCompileShader(shader);
        gl->glAttachShader(program, shader);
    }
    gl->glBindAttribLocation(program, 0, "a_at");
    gl->glLinkProgram(program);
    gl->glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok)
        fail("a shader is refused");
    return program;
}

/* 5. What a step asks for: everything, with a share of its colour. The state for it is set. */
static void draw_everything(const gn_gl *gl, GLuint program, const gn_plan *plan, float share)
{
    gl->glUseProgram(program);
    gl->glEnable(GL_CULL_FACE);
    gl->glEnableVertexAttribArray(0);
    for (uint32_t o = 0; o < plan->object_count; o++) {
        const float color[3] = {share * colors[o][0], share * colors[o][1], share * colors[o][2]};
        const gn_mesh_info *info = gn_mesh_get_info(plan->objects[o].mesh);

        gl->glUniformMatrix4fv(gl->glGetUniformLocation(program, "u_clip"), 1, GL_FALSE, plan->objects[o].matrix);
        gl->glUniform3fv(gl->glGetUniformLocation(program, "u_color"), 1, color);
        for (uint32_t t = 0; t < info->triangle_count; t++) { /* a real host has buffers of its own here */
            float triangle[9];

            for (uint32_t i = 0; i < 9; i++)
                triangle[i] = info->positions[3 * info->triangles[3 * t + i / 3] + i % 3];
            gl->glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, triangle);
            gl->glDrawArrays(GL_TRIANGLES, 0, 3);
        }
    }
}

int main(int count, char **arguments)
{
    const gn_mesh_desc desc[2] = {{floor_at, 4, 0, triangles, 2, 0.0}, {box_at, 8, 0, triangles, 12, 0.0}};
    const gn_light light = {.kind = GN_LIGHT_POINT, .position = {1.5, 5.0, 2.0}};
    gn_object objects[2] = {{.flags = GN_RECEIVES}, {.flags = GN_RECEIVES | GN_CASTS}};
    gn_scene scene = {.camera = {.world = {1, 0, 0, 0, 0, 0.92388, -0.382683, 0, 0, 0.382683, 0.92388, 0, 0, 4, 8, 1},
                                 .left = -0.6, .right = 0.6, .bottom = -0.45, .top = 0.45, .znear = 0.1},
                      .lights = &light, .light_count = 1, .objects = objects, .object_count = 2};
    const gn_gles_desc opening = {.get_proc = get_proc};
    static unsigned char pixels[HEIGHT][WIDTH][4];
    static char saved[8192];
    FILE *f = count > 2 ? fopen(arguments[2], "rb") : NULL;
    gn_context *context;
    const gn_plan *plan;
    gn_gles *gles;
    gn_step step;

    if (count > 2 && (!f || fread(saved, 1, sizeof saved - 1, f) == 0 || fclose(f) != 0))
        fail("what was saved cannot be read");
    open_context();
    /* 3. Once: the library, what can be done here, and the meshes. */
    if (gn_context_create(NULL, &context) != GN_OK || gn_gles_create(context, &opening, &gles) != GN_OK ||
        gn_gles_describe_target(gles, WIDTH, HEIGHT, saved, &scene.target) != GN_OK)
        fail(gn_message(context));
    for (int i = 0; i < 2; i++) {
        gn_mesh *mesh;
        if (gn_mesh_create(context, &desc[i], &mesh) != GN_OK || gn_gles_upload(gles, mesh) != GN_OK)
            fail(gn_message(context));
        objects[i].mesh = mesh;
        gn_mat4_identity(objects[i].model);
    }
    const gn_gl *gl = gn_gles_functions(gles);
    const GLuint program = make_program(gl);

    /* 4. Each frame: what moves (here nothing), a plan, and its steps. */
    const size_t size = gn_plan_bound(&scene); /* a host asks once, for the most that it will have */
    if (gn_plan_make(context, &scene, malloc(size), size, &plan) != GN_OK || gn_gles_begin(gles, plan) != GN_OK)
        fail(gn_message(context));
    puts(plan->lights[0].reason); /* which way was taken, and why */
    while (gn_gles_next(gles, &step))
        if (step.draw == GN_DRAW_AMBIENT)
            draw_everything(gl, program, plan, 0.25f);
        else if (step.draw == GN_DRAW_LIGHT && step.receivers)
            draw_everything(gl, program, plan, 0.75f);
    gl->glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    if (!(f = fopen(count > 1 ? arguments[1] : "", "wb")))
        fail("give the name of a picture");
    fprintf(f, "P6 %d %d 255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        fwrite(pixels[HEIGHT - 1 - i / WIDTH][i % WIDTH], 1, 3, f);
    return fclose(f) != 0;
}
