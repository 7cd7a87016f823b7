/* bench_frames.c - what shadows cost in a frame: one row of a CSV for each number of triangles, casters, lights and
 * size.
 *
 *     bench_frames [--quick]
 *
 * The scene of pile.h, everything moving, untextured Lambert. Each frame is drawn three ways in turn: in one pass with
 * all lights and no shadows; in the plan's passes without volumes; and with them. Times are the process's, all threads
 * (a driver that rasterises on the processor), medians: a remark, of use as ratios within a row. shadow_part is what
 * the volumes add, in one-pass frames; wall_part the same by the wall's clock. Fragments of volumes are counted, per
 * pixel of a mask; the columns that follow are the same without each measure of gn_scene.without, and without all.
 * --quick: three rows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gnomon_gles.h"
#include "pile.h"
#include "platform.h"
#include "spread.h"

enum { FRAMES = 25, WAYS = 3, MEASURES = 6 };
static const unsigned measures[MEASURES] = {
    0, GN_MEASURE_ENDS, GN_MEASURE_SCISSORS, GN_MEASURE_PATCHES, GN_MEASURE_INTERVALS, ~0u};

static const char vertex_source[] = "attribute highp vec3 a_position;\n"
                                    "attribute highp vec3 a_normal;\n"
                                    "uniform highp mat4 u_clip;\n"
                                    "uniform highp mat4 u_world;\n" GN_GLSL_POSITION "varying highp vec3 v_position;\n"
                                    "varying highp vec3 v_normal;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    gl_Position = gn_position(u_clip, a_position);\n"
                                    "    v_position = (u_world * vec4(a_position, 1.0)).xyz;\n"
                                    "    v_normal = (u_world * vec4(a_normal, 0.0)).xyz;\n"
                                    "}\n";
static const char fragment_source[] = "precision highp float;\n"
                                      "uniform vec3 u_ambient;\n"
                                      "uniform vec3 u_color;\n"
                                      "#if LIGHTS\n"
                                      "uniform vec3 u_light[LIGHTS];\n"
                                      "#endif\n"
                                      "varying vec3 v_position;\n"
                                      "varying vec3 v_normal;\n"
                                      "void main()\n"
                                      "{\n"
                                      "    vec3 sum = u_ambient;\n"
                                      "#if LIGHTS\n"
                                      "    vec3 n = normalize(v_normal);\n"
                                      "    for (int i = 0; i < LIGHTS; i++)\n"
                                      "        sum += max(dot(n, normalize(u_light[i] - v_position)), 0.0) * u_color;\n"
                                      "#endif\n"
                                      "    gl_FragColor = vec4(sum, 1.0);\n"
                                      "}\n";

typedef struct program {
    GLuint name;
    GLint clip, world, ambient, color, light;
} program;

typedef struct host {
    platform *platform;
    gn_context *context;
    gn_gles *gles;
    const gn_gl *gl;
    gn_target target;
    program programs[PILE_MOST_LIGHTS + 1]; /* by number of lights */
    pile_mesh lump, floor;
    GLuint buffers[2][3]; /* of lump and floor: positions, normals, indices */
    pile pile;
    gn_scene scene;
    void *memory;
    size_t size;
    const gn_plan *plan;
} host;

static int fail(const char *what)
{
    fprintf(stderr, "bench_frames: %s\n", what);
    return 0;
}

static GLuint compile(const gn_gl *gl, GLenum kind, const char *defines, const char *source)
{
    const char *const parts[2] = {defines, source};
    const GLuint shader = gl->glCreateShader(kind);
    GLint ok = 0;

    gl->glShaderSource(shader, 2, parts, NULL);
    gl->glCompileShader(shader);
    gl->glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    return ok ? shader : 0;
}

static int make_program(host *h, uint32_t lights)
{
    const gn_gl *gl = h->gl;
    program *p = &h->programs[lights];
    char defines[32];
    GLuint vertex, fragment;
    GLint ok = 0;

    snprintf(defines, sizeof defines, "#define LIGHTS %u\n", (unsigned)lights);
    vertex = compile(gl, GL_VERTEX_SHADER, "", vertex_source);
    fragment = compile(gl, GL_FRAGMENT_SHADER, defines, fragment_source);
    p->name = gl->glCreateProgram();
    gl->glAttachShader(p->name, vertex);
    gl->glAttachShader(p->name, fragment);
    gl->glBindAttribLocation(p->name, 0, "a_position");
    gl->glBindAttribLocation(p->name, 1, "a_normal");
    gl->glLinkProgram(p->name);
    gl->glGetProgramiv(p->name, GL_LINK_STATUS, &ok);
    p->clip = gl->glGetUniformLocation(p->name, "u_clip");
    p->world = gl->glGetUniformLocation(p->name, "u_world");
    p->ambient = gl->glGetUniformLocation(p->name, "u_ambient");
    p->color = gl->glGetUniformLocation(p->name, "u_color");
    p->light = gl->glGetUniformLocation(p->name, "u_light");
    return vertex && fragment && ok;
}

/* The host's own buffers: positions less the mesh's centre, 16-bit indices. */
static int send(host *h, int which, const pile_mesh *m)
{
    const gn_gl *gl = h->gl;
    const float *centre = gn_mesh_get_info(m->mesh)->centre;
    const size_t bytes = m->vertex_count * 3 * sizeof(float);
    float *moved = malloc(bytes);
    uint16_t *indices = malloc(m->triangle_count * 3 * sizeof *indices);

    if (!moved || !indices || m->vertex_count > 65536)
        return 0;
    for (size_t i = 0; i < 3 * m->vertex_count; i++)
        moved[i] = m->positions[i] - centre[i % 3];
    for (size_t i = 0; i < 3 * m->triangle_count; i++)
        indices[i] = (uint16_t)m->indices[i];
    gl->glGenBuffers(3, h->buffers[which]);
    gl->glBindBuffer(GL_ARRAY_BUFFER, h->buffers[which][0]);
    gl->glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, moved, GL_STATIC_DRAW);
    gl->glBindBuffer(GL_ARRAY_BUFFER, h->buffers[which][1]);
    gl->glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, m->normals, GL_STATIC_DRAW);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, h->buffers[which][2]);
    gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(m->triangle_count * 3 * sizeof *indices), indices,
                     GL_STATIC_DRAW);
    free(moved);
    free(indices);
    return gn_gles_upload(h->gles, m->mesh) == GN_OK;
}

static void draw_object(host *h, const program *p, uint32_t index)
{
    const gn_gl *gl = h->gl;
    const gn_object *object = &h->pile.objects[index];
    const int which = index + 1 == h->pile.object_count;
    const pile_mesh *m = h->pile.meshes[which];
    const float *centre = gn_mesh_get_info(m->mesh)->centre;
    float world[16];

    for (int i = 0; i < 16; i++)
        world[i] = (float)object->model[i];
    for (int i = 0; i < 3; i++)
        world[12 + i] += world[i] * centre[0] + world[4 + i] * centre[1] + world[8 + i] * centre[2];
    gl->glUniformMatrix4fv(p->clip, 1, GL_FALSE, h->plan->objects[index].matrix);
    gl->glUniformMatrix4fv(p->world, 1, GL_FALSE, world);
    for (GLuint a = 0; a < 2; a++) {
        gl->glBindBuffer(GL_ARRAY_BUFFER, h->buffers[which][a]);
        gl->glVertexAttribPointer(a, 3, GL_FLOAT, GL_FALSE, 12, NULL);
    }
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, h->buffers[which][2]);
    gl->glDrawElements(GL_TRIANGLES, (GLsizei)(3 * m->triangle_count), GL_UNSIGNED_SHORT, NULL);
}

static void draw_objects(host *h, uint32_t first_light, uint32_t light_count, float ambient, const gn_plan_caster *lit)
{
    const gn_gl *gl = h->gl;
    const program *p = &h->programs[light_count];
    const float a[3] = {ambient, ambient, ambient};
    float light[PILE_MOST_LIGHTS][3], color[3];

    gl->glUseProgram(p->name);
    gl->glEnableVertexAttribArray(0);
    gl->glEnableVertexAttribArray(1);
    gl->glUniform3fv(p->ambient, 1, a);
    for (uint32_t i = 0; i < light_count; i++)
        for (int axis = 0; axis < 3; axis++)
            light[i][axis] = (float)h->pile.lights[first_light + i].position[axis];
    for (int c = 0; c < 3; c++)
        color[c] = 0.9f / (float)h->pile.light_count;
    if (light_count) {
        gl->glUniform3fv(p->light, (GLsizei)light_count, light[0]);
        gl->glUniform3fv(p->color, 1, color);
    }
    gl->glEnable(GL_CULL_FACE);
    for (uint32_t i = 0; i < h->pile.object_count; i++)
        if (!lit || lit[i].is_lit)
            draw_object(h, p, i);
}

static int plan(host *h, int casting)
{
    size_t size;

    for (uint32_t i = 0; i < h->pile.object_count; i++) {
        h->pile.objects[i].flags &= ~(unsigned)GN_CASTS;
        h->pile.objects[i].flags |= casting ? GN_CASTS : 0u;
    }
    h->scene.camera = h->pile.camera;
    h->scene.lights = h->pile.lights;
    h->scene.light_count = h->pile.light_count;
    h->scene.objects = h->pile.objects;
    h->scene.object_count = h->pile.object_count;
    h->scene.target = h->target;
    h->scene.method = GN_METHOD_STENCIL;
    size = gn_plan_bound(&h->scene);
    if (size > h->size) {
        free(h->memory);
        h->memory = malloc(size);
        h->size = h->memory ? size : 0;
    }
    if (!h->memory || gn_plan_make(h->context, &h->scene, h->memory, h->size, &h->plan) != GN_OK)
        return fail(gn_message(h->context));
    return 1;
}

static void draw_plain(host *h)
{
    const gn_gl *gl = h->gl;

    gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl->glEnable(GL_DEPTH_TEST);
    draw_objects(h, 0, h->pile.light_count, 0.1f, NULL);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDisable(GL_CULL_FACE);
}

static int draw_passes(host *h)
{
    gn_step step;

    if (gn_gles_begin(h->gles, h->plan) != GN_OK)
        return fail(gn_message(h->context));
    while (gn_gles_next(h->gles, &step)) {
        if (step.draw == GN_DRAW_AMBIENT)
            draw_objects(h, 0, 0, 0.1f, NULL);
        else if (step.draw == GN_DRAW_LIGHT)
            draw_objects(h, step.light, 1, 0.0f, h->plan->casters + step.light * h->plan->object_count);
    }
    return 1;
}

typedef struct moment {
    double processor, wall; /* ms */
} moment;

static double read_clock(clockid_t id)
{
    struct timespec t;

    clock_gettime(id, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static moment start_watch(void)
{
    const moment now = {read_clock(CLOCK_PROCESS_CPUTIME_ID), read_clock(CLOCK_MONOTONIC)};

    return now;
}

static void stop_watch(moment start, double *processor, double *wall)
{
    const moment now = start_watch();

    *processor = now.processor - start.processor;
    *wall = now.wall - start.wall;
}

/* Sums fragments of volumes over the frame just drawn; and pixels where a surface is. */
static uint64_t count_fragments(host *h)
{
    static const float one[4] = {1.0f / 255.0f, 0, 0, 0};
    const gn_gl *gl = h->gl;
    const size_t pixels = (size_t)h->target.width * h->target.height;
    uint8_t *rgba = malloc(4 * pixels);
    uint64_t sum = 0;

    gl->glClearColor(0, 0, 0, 0);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glEnable(GL_BLEND);
    gl->glBlendFunc(GL_ONE, GL_ONE);
    gl->glDepthMask(GL_FALSE);
    gn_gles_draw_volumes(h->gles, h->plan, 0, h->plan->record_count, one);
    gl->glDepthMask(GL_TRUE);
    gl->glDisable(GL_BLEND);
    if (rgba)
        gl->glReadPixels(0, 0, (GLsizei)h->target.width, (GLsizei)h->target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    for (size_t i = 0; rgba && i < pixels; i++)
        sum += rgba[4 * i];
    free(rgba);
    return sum;
}

static int measure(host *h)
{
    const double aspect = (double)h->target.width / h->target.height;
    const uint32_t work = (uint32_t)h->lump.triangle_count * h->pile.side * h->pile.side * h->pile.side;
    const uint32_t frames = work * h->pile.light_count > 1000000 ? 7 : FRAMES;
    double ms[WAYS][FRAMES], wall[WAYS][FRAMES], planning[2][FRAMES], fragments[MEASURES], mask_pixels;
    size_t draws = 0, indices;

    for (uint32_t f = 0; f < frames + 2; f++) {
        const uint32_t at = f < 2 ? 0 : f - 2; /* the first two warm up */
        moment start;

        pile_pose(&h->pile, f, aspect);
        start = start_watch();
        if (!plan(h, 0) || !draw_passes(h))
            return 0;
        h->gl->glFinish();
        stop_watch(start, &ms[1][at], &wall[1][at]);
        start = start_watch();
        draw_plain(h);
        h->gl->glFinish();
        stop_watch(start, &ms[0][at], &wall[0][at]);
        start = start_watch();
        if (!plan(h, 1))
            return 0;
        stop_watch(start, &planning[0][at], &planning[1][at]);
        if (!draw_passes(h))
            return 0;
        h->gl->glFinish();
        stop_watch(start, &ms[2][at], &wall[2][at]);
    }
    for (uint32_t r = 0; r < h->plan->record_count; r++)
        draws += 1u + (h->plan->records[r].turned_cap_count > 0);
    indices = h->plan->index_count;
    mask_pixels = (double)h->target.width * h->target.height * h->pile.light_count;
    for (int i = 0; i < MEASURES; i++) {
        h->scene.without = measures[i];
        if (!plan(h, 1) || !draw_passes(h))
            return 0;
        fragments[i] = (double)count_fragments(h) / mask_pixels;
    }
    h->scene.without = 0;
    for (int way = 0; way < WAYS; way++) {
        qsort(ms[way], frames, sizeof(double), by_value);
        qsort(wall[way], frames, sizeof(double), by_value);
    }
    qsort(planning[0], frames, sizeof(double), by_value);
    printf("%lu,%u,%u,%ux%u,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%lu,%lu", (unsigned long)h->lump.triangle_count,
           (unsigned)(h->pile.object_count - 1), (unsigned)h->pile.light_count, (unsigned)h->target.width,
           (unsigned)h->target.height, ms[0][frames / 2], ms[1][frames / 2], ms[2][frames / 2], planning[0][frames / 2],
           (ms[2][frames / 2] - ms[1][frames / 2]) / ms[0][frames / 2],
           (wall[2][frames / 2] - wall[1][frames / 2]) / wall[0][frames / 2], (unsigned long)draws,
           (unsigned long)indices);
    for (int i = 0; i < MEASURES; i++)
        printf(",%.2f", fragments[i]);
    printf("\n");
    fflush(stdout);
    return h->gl->glGetError() == GL_NO_ERROR ? 1 : fail("the GL reports an error");
}

static void close_host(host *h)
{
    free(h->memory);
    pile_drop(&h->lump);
    pile_drop(&h->floor);
    gn_gles_destroy(h->gles);
    gn_context_destroy(h->context);
    platform_close(h->platform);
}

static int run(uint32_t rings, uint32_t sectors, uint32_t side, uint32_t lights, uint32_t width, uint32_t height)
{
    const platform_desc wanted = {width, height, 8, 8, 8, 8, 24, 8};
    gn_gles_desc desc = {platform_get_proc, NULL, NULL};
    char why[PLATFORM_MESSAGE];
    static host h;
    int ok;

    memset(&h, 0, sizeof h);
    h.platform = platform_open("egl", &wanted, why);
    if (!h.platform)
        return fail(why);
    desc.user = h.platform;
    ok = gn_context_create(NULL, &h.context) == GN_OK && gn_gles_create(h.context, &desc, &h.gles) == GN_OK &&
         gn_gles_describe_target(h.gles, width, height, NULL, &h.target) == GN_OK;
    h.gl = ok ? gn_gles_functions(h.gles) : NULL;
    ok = ok && make_program(&h, 0) && make_program(&h, 1) && make_program(&h, lights) &&
         pile_make_lump(&h.lump, h.context, rings, sectors) &&
         pile_make_floor(&h.floor, h.context, 32, (float)pile_floor_half(side)) && send(&h, 0, &h.lump) &&
         send(&h, 1, &h.floor);
    h.pile.meshes[0] = &h.lump;
    h.pile.meshes[1] = &h.floor;
    h.pile.side = side;
    h.pile.light_count = lights;
    ok = ok ? measure(&h) : fail("the scene cannot be made");
    close_host(&h);
    return ok;
}

int main(int argument_count, char **arguments)
{
    static const uint32_t meshes[3][2] = {{16, 16}, {43, 44}, {155, 156}}, sides[3] = {1, 2, 3}, lights[3] = {1, 2, 4};
    static const uint32_t sizes[3][2] = {{320, 240}, {640, 480}, {1024, 768}};
    const int quick = argument_count > 1 && strcmp(arguments[1], "--quick") == 0;

    printf("triangles,casters,lights,size,one_pass_ms,same_passes_ms,shadows_ms,planning_ms,shadow_part,wall_part,"
           "draws,indices,"
           "fragments,without_ends,without_scissors,without_patches,without_intervals,without_all\n");
    if (quick)
        return !run(43, 44, 1, 1, 640, 480) || !run(43, 44, 2, 2, 640, 480) || !run(16, 16, 3, 4, 640, 480);
    for (int m = 0; m < 3; m++)
        for (int s = 0; s < 3; s++)
            for (int l = 0; l < 3; l++)
                for (int z = 0; z < 3; z++)
                    if (!run(meshes[m][0], meshes[m][1], sides[s], lights[l], sizes[z][0], sizes[z][1]))
                        return 1;
    return 0;
}
