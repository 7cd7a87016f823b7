/* bench_rebuild.c - one step of rebuilding volumes, so many times: rebuild.sh counts its instructions under callgrind,
 * and lanes.sh compares what it finds.
 *
 *     bench_rebuild WHAT TRIANGLES TIMES     a lump of about so many triangles; WHAT:
 *         build     makes the mesh
 *         scan      facing of every triangle
 *         tree      facing by clusters and cones
 *         sides     by the tree, with the stream of sides
 *         caps      and of both caps
 *         all-sides all-caps    the same, of every triangle
 *         streams   caps, and a hash of all that is found
 *     bench_rebuild WHAT MODEL.obj|MODEL.3ds TIMES     the same of a model's triangles
 *
 * Prints triangles, how many of them were looked at in the last light, silhouette edges, and the hash. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gni.h"
#include "pile.h"

static const char *const steps[] = {"build", "scan", "tree", "sides", "caps", "all-sides", "all-caps", "streams"};
enum { BUILD, SCAN, TREE, SIDES, CAPS, ALL_SIDES, ALL_CAPS, STREAMS, STEPS };

/* Room for one more vertex or triangle. */
static void add_vertex(pile_mesh *m, const float p[3])
{
    if (m->vertex_count % 4096 == 0)
        m->positions = realloc(m->positions, (m->vertex_count + 4096) * 3 * sizeof(float));
    memcpy(m->positions + 3 * m->vertex_count++, p, 3 * sizeof *p);
}

static void add_triangle(pile_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t corners[3] = {a, b, c};

    if (m->triangle_count % 4096 == 0)
        m->indices = realloc(m->indices, (m->triangle_count + 4096) * 3 * sizeof(uint32_t));
    memcpy(m->indices + 3 * m->triangle_count++, corners, sizeof corners);
}

/* Vertices and faces; polygons as fans. */
static void read_obj(pile_mesh *m, FILE *f)
{
    char line[4096];

    while (fgets(line, sizeof line, f)) {
        float p[3];
        uint32_t corners[64];
        uint32_t n = 0;

        if (sscanf(line, "v %f %f %f", &p[0], &p[1], &p[2]) == 3)
            add_vertex(m, p);
        if (line[0] != 'f' || line[1] != ' ')
            continue;
        for (char *at = strtok(line + 2, " \t\r\n"); at && n < 64; at = strtok(NULL, " \t\r\n")) {
            const long corner = strtol(at, NULL, 10);

            corners[n++] = (uint32_t)(corner < 0 ? (long)m->vertex_count + corner : corner - 1);
        }
        for (uint32_t i = 2; i < n; i++)
            add_triangle(m, corners[0], corners[i - 1], corners[i]);
    }
}

static uint32_t word(const unsigned char *at)
{
    return at[0] | (uint32_t)at[1] << 8;
}

/* Chunks: a number of 16 bits, a length of 32. Vertices and faces of all meshes together. */
static void read_3ds(pile_mesh *m, const unsigned char *at, const unsigned char *end)
{
    uint32_t first = (uint32_t)m->vertex_count;

    while (end - at >= 8) {
        const uint32_t kind = word(at), length = word(at + 2) | word(at + 4) << 16, n = word(at + 6);
        const unsigned char *inside = at + 6;

        if (length < 6 || length > (size_t)(end - at))
            return;
        if (kind == 0x4d4d || kind == 0x3d3d || kind == 0x4100)
            read_3ds(m, inside, at + length);
        if (kind == 0x4000) /* a name first */
            read_3ds(m, inside + strlen((const char *)inside) + 1, at + length);
        if (kind == 0x4110) {
            first = (uint32_t)m->vertex_count;
            for (uint32_t i = 0; i < n && 8 + 12 * i + 12 <= length; i++) {
                float p[3];

                memcpy(p, at + 8 + 12 * i, sizeof p);
                add_vertex(m, p);
            }
        }
        for (uint32_t i = 0; kind == 0x4120 && i < n && 8 + 8 * i + 8 <= length; i++)
            add_triangle(m, first + word(at + 8 + 8 * i), first + word(at + 10 + 8 * i), first + word(at + 12 + 8 * i));
        at += length;
    }
}

static int read_model(pile_mesh *m, gn_context *context, const char *path)
{
    FILE *f = fopen(path, "rb");
    gn_mesh_desc desc;

    memset(m, 0, sizeof *m);
    if (f && strstr(path, ".obj")) {
        read_obj(m, f);
    } else if (f) {
        static unsigned char bytes[1 << 24];
        const size_t size = fread(bytes, 1, sizeof bytes, f);

        read_3ds(m, bytes, bytes + size);
    }
    if (f)
        fclose(f);
    desc = (gn_mesh_desc){m->positions, m->vertex_count, 0, m->indices, m->triangle_count, 0.0};
    return m->triangle_count && gn_mesh_create(context, &desc, &m->mesh) == GN_OK;
}

static uint64_t hash(uint64_t h, const void *data, size_t size)
{
    const unsigned char *bytes = data;

    for (size_t i = 0; i < size; i++)
        h = (h ^ bytes[i]) * 1099511628211u;
    return h;
}

static int make_walk(gni_walk *w, size_t triangles)
{
    w->first = malloc(GN_CHUNK_VERTICES * sizeof *w->first);
    w->next = malloc(3 * triangles * sizeof *w->next);
    w->loop = malloc((3 * triangles + 1) * sizeof *w->loop);
    if (w->first)
        memset(w->first, 0xff, GN_CHUNK_VERTICES * sizeof *w->first);
    return w->first && w->next && w->loop;
}

int main(int count, char **arguments)
{
    gn_context *context;
    pile_mesh m;
    int step = 0, times;
    uint16_t *out;
    gni_casting *c;
    gni_walk walk;
    uint64_t sum = 14695981039346656037u;
    uint32_t looked_at = 0, edges = 0;

    while (count == 4 && step < STEPS && strcmp(arguments[1], steps[step]) != 0)
        step++;
    if (count != 4 || step == STEPS)
        return fprintf(stderr, "usage: bench_rebuild WHAT TRIANGLES|MODEL.obj TIMES\n"), 2;
    times = atoi(arguments[3]);
    if (gn_context_create(NULL, &context) != GN_OK)
        return 1;
    if (strchr(arguments[2], '.')) {
        if (!read_model(&m, context, arguments[2]))
            return fprintf(stderr, "bench_rebuild: %s cannot be read\n", arguments[2]), 1;
    } else {
        const uint32_t side = (uint32_t)(sqrt(atof(arguments[2]) / 2.0) + 0.5);

        if (!pile_make_lump(&m, context, side, side + 1))
            return 1;
    }
    c = &m.mesh->scratch;
    out = malloc((GNI_MOST_INDICES * m.triangle_count + GNI_SLACK) * sizeof *out);
    if (!out || !make_walk(&walk, m.triangle_count))
        return 1;
    for (int i = 0; i < times; i++) {
        const float *low = m.mesh->info.box_min, *high = m.mesh->info.box_max;
        double light[4] = {0, 0, 0, 1};

        if (step == BUILD) {
            const gn_mesh_desc desc = {m.positions, m.vertex_count, 0, m.indices, m.triangle_count, 0.0};
            gn_mesh *mesh;

            if (gn_mesh_create(context, &desc, &mesh) == GN_OK)
                gn_mesh_destroy(mesh);
            continue;
        }
        for (int k = 0; k < 3; k++) /* around the mesh, some sizes away */
            light[k] = 0.5 * (double)(low[k] + high[k]) + 3.0 * (double)(high[k] - low[k]) *
                                                              (k == 1   ? 0.8
                                                               : k == 0 ? cos(0.3 * i)
                                                                        : sin(0.3 * i));
        looked_at = step == SCAN || step == ALL_SIDES || step == ALL_CAPS
                        ? gni_scan_facing(m.mesh, light, c->bits, c->spare)
                        : gni_find_facing(m.mesh, light, c->bits, c->spare);
        if (step <= TREE)
            continue;
        gni_cast(m.mesh, light, c);
        edges = 0;
        for (uint32_t chunk = 0; chunk < m.mesh->info.chunk_count; chunk++) {
            uint32_t n = gni_put_sides(m.mesh, chunk, c, 0, out);

            edges += n / 6;
            if (step == CAPS || step == ALL_CAPS || step == STREAMS) {
                n += m.mesh->info.solid_part_count == m.mesh->info.part_count
                         ? gni_put_fan(m.mesh, chunk, out, n, 6, &walk, out + n)
                         : gni_put_dark_cap(m.mesh, chunk, c, out + n);
                n += gni_put_light_cap(m.mesh, chunk, c, 1, out + n);
                n += gni_put_light_cap(m.mesh, chunk, c, -1, out + n);
            }
            if (step == STREAMS)
                sum = hash(sum, out, n * sizeof *out);
        }
    }
    printf("%lu,%lu,%lu,%016llx\n", (unsigned long)m.triangle_count, (unsigned long)looked_at, (unsigned long)edges,
           (unsigned long long)sum);
    free(out);
    free(walk.first);
    free(walk.next);
    free(walk.loop);
    pile_drop(&m);
    gn_context_destroy(context);
    return 0;
}
