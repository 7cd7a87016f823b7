/* streams.c - writes the streams of a cache's slot: all parts of a caster's volume, for any camera. */
#include "gni_plan.h"

/* One chunk. */
static uint32_t put_chunk(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, int kind, const gni_walk *walk,
                          uint16_t *out, gni_stream *stream)
{
    const uint32_t light = gni_put_light_cap(mesh, chunk, c, 1, out);
    uint16_t *const sides = out + light;
    const uint32_t side_count = gni_put_sides(mesh, chunk, c, kind == GNI_STREAM_CONVERGING, sides);
    uint16_t *const dark = sides + side_count;
    uint32_t dark_count = 0, near = 0, turned;

    if (kind == GNI_STREAM_FAN) {
        near = dark_count = gni_put_fan(mesh, chunk, sides, side_count, 6, walk, dark);
        gni_put_near_fan(dark, near, dark + near);
    } else if (kind == GNI_STREAM_CAP) {
        dark_count = gni_put_dark_cap(mesh, chunk, c, dark);
    }
    turned = gni_put_light_cap(mesh, chunk, c, -1, dark + dark_count + near);
    stream->parts[chunk].light_cap = light;
    stream->parts[chunk].sides = side_count;
    stream->parts[chunk].dark_cap = dark_count;
    stream->parts[chunk].near_cap = near;
    stream->parts[chunk].turned_cap = turned;
    return light + side_count + dark_count + near + turned;
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
    out = gni_take_room(d->scene->cache, stream, GNI_MOST_INDICES * mesh->info.triangle_count + GNI_SLACK);
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
                gni_runs_round_hub(mesh, 0, out + first + stream->parts[0].light_cap, stream->parts[0].sides,
                                   kind == GNI_STREAM_CONVERGING ? 3 : 6, identity, slot->light);
    }
    stream->count = count;
    slot->is_made = 1;
    gni_note_change(d->scene->cache, stream);
    return stream;
}
