/* streams.c - writes the streams of a cache's slot: all parts of a caster's volume, for any camera. */
#include "gni_plan.h"

#include <string.h>

#define MOST_INDICES 30 /* of a triangle: three sides of two triangles, a dark cap of one for each, a light cap */

static void reverse(uint16_t *indices, uint32_t count)
{
    for (uint32_t i = 0; i < count / 2; i++) {
        const uint16_t first = indices[i];

        indices[i] = indices[count - 1 - i];
        indices[count - 1 - i] = first;
    }
}

/* One chunk. Sides are written first, since a fan is made of them, and change places with the dark cap. */
static uint32_t put_chunk(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, int kind, const gni_walk *walk,
                          uint16_t *out, gni_stream *stream)
{
    const int converging = kind == GNI_STREAM_CONVERGING;
    const uint32_t sides = gni_put_sides(mesh, chunk, c, converging, out);
    uint32_t dark = 0, n = sides;

    if (kind == GNI_STREAM_FAN)
        dark = gni_put_fan(mesh, chunk, out, sides, 6, walk, out + sides);
    else if (kind == GNI_STREAM_CAP)
        dark = gni_put_dark_cap(mesh, chunk, c, out + sides);
    reverse(out, sides);
    reverse(out + sides, dark);
    reverse(out, sides + dark);
    n += dark;
    stream->parts[chunk].dark_cap = dark;
    stream->parts[chunk].sides = sides;
    n += stream->parts[chunk].light_cap = gni_put_light_cap(mesh, chunk, c, 1, out + n);
    n += stream->parts[chunk].turned_cap = gni_put_light_cap(mesh, chunk, c, -1, out + n);
    return n;
}

const gni_stream *gni_make_stream(gni_draft *d, uint32_t object_index, int kind)
{
    const gn_mesh *mesh = d->scene->objects[object_index].mesh;
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    gni_slot *slot = d->slot;
    gni_stream *stream = &slot->streams[kind];
    uint16_t *out;
    uint32_t count = 0;

    if (stream->count)
        return stream;
    if (!d->casting_is_known)
        gni_find_casting(mesh, slot->light, &d->casting); /* which may not be the light's place now */
    out = gni_take_room(d->scene->cache, stream, MOST_INDICES * mesh->info.triangle_count + GNI_SLACK);
    if (!out)
        return NULL;
    slot->triangles = d->casting.count;
    slot->silhouette = 0;
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        const uint32_t first = count;

        count += put_chunk(mesh, c, &d->casting, kind, &d->walk, out + count, stream);
        slot->silhouette += stream->parts[c].sides / (kind == GNI_STREAM_CONVERGING ? 3 : 6);
        if (mesh->info.chunk_count == 1)
            slot->runs_round =
                slot->light[3] != 0.0 &&
                gni_runs_round_hub(mesh, 0, out + first + stream->parts[0].dark_cap, stream->parts[0].sides,
                                   kind == GNI_STREAM_CONVERGING ? 3 : 6, identity, slot->light);
    }
    stream->count = count;
    slot->is_made = 1;
    gni_note_change(d->scene->cache, stream);
    return stream;
}
