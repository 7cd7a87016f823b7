/* casting.c - which triangles cast.
 *
 * Facing is decided once per triangle (facing.c), and every part of a volume follows that one bit: whatever rounding
 * does to the bit, the volume stays a closed chain (DESIGN.md, decision 1).
 *
 * Casting follows DESIGN.md, decision 2. Whether a light is inside a solid part is asked only when it is within the
 * part's box, by the solid angle that the part fills as the light sees it; in doubt (the light on the surface) every
 * triangle casts, which is always right.
 *
 * Solid angle of a triangle: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, IEEE Transactions on
 * Biomedical Engineering 30(2), 1983. */
#include "gni.h"

#include <math.h>
#include <string.h>

/* Of a byte in all eight bytes of a word, one bit each: bit k in the k-th byte of memory. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define PICK_BITS 0x0102040810204080u
#else
#define PICK_BITS 0x8040201008040201u
#endif

/* The winding number of a closed part about a point; a half where the point lies on a triangle, or as good as on it. */
static double winding(const gn_mesh *mesh, const gni_part *part, const double point[4])
{
    double angle = 0.0;

    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)mesh->part_triangles[part->first_triangle + i];
        double v[3][3], length[3], triple, lengths, rest;

        for (int k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++)
                v[k][axis] = (double)mesh->positions[3 * (size_t)c[k] + (size_t)axis] - point[axis];
            length[k] = sqrt(gni_dot(v[k], v[k]));
        }
        triple = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                 v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        lengths = length[0] * length[1] * length[2];
        rest = lengths + gni_dot(v[0], v[1]) * length[2] + gni_dot(v[1], v[2]) * length[0] +
               gni_dot(v[2], v[0]) * length[1];
        if (rest <= 1e-12 * lengths && fabs(triple) <= 1e-12 * lengths)
            return 0.5;
        angle += atan2(triple, rest);
    }
    return angle / 6.283185307179586;
}

/* Only the lit triangles of a part cast when it is solid and the light is surely outside. */
static int only_lit_cast(const gn_mesh *mesh, const gni_part *part, const double light[4])
{
    if (!part->outward)
        return 0;
    if (light[3] == 0.0)
        return 1;
    for (int axis = 0; axis < 3; axis++)
        if (light[axis] < (double)part->box_min[axis] || light[axis] > (double)part->box_max[axis])
            return 1;
    return GNI_HAS_SOLIDS && fabs(winding(mesh, part, light)) < 1e-9; /* far from all whole numbers but 0 */
}

/* Bytes of a whole cluster: `one` where the bit is set, else 0. */
static void put_bytes(int8_t *out, uint64_t bits, uint32_t count, int8_t one)
{
    uint64_t words[8];

    for (int i = 0; i < 8; i++) {
        const uint64_t picked = ((bits >> (8 * i) & 0xff) * 0x0101010101010101u) & PICK_BITS;

        words[i] = (((picked + 0x7f7f7f7f7f7f7f7fu) >> 7) & 0x0101010101010101u) * (uint8_t)one;
    }
    if (count == GNI_CLUSTER)
        memcpy(out, words, sizeof words); /* at once */
    else
        memcpy(out, words, count);
}

static uint32_t size_of(const gn_mesh *mesh, uint32_t cluster)
{
    const uint32_t rest = mesh->info.triangle_count - cluster * GNI_CLUSTER;

    return rest < GNI_CLUSTER ? rest : GNI_CLUSTER;
}

/* 1: all triangles of solid parts whose `outward` is the same, and the light is outside all. */
static int is_plain(const gn_mesh *mesh, const double light[4])
{
    if (mesh->info.solid_part_count < mesh->info.part_count || mesh->info.part_count == 0)
        return 0;
    if (mesh->info.outward_part_count != 0 && mesh->info.outward_part_count != mesh->info.part_count)
        return 0;
    for (uint32_t p = 0; p < mesh->info.part_count; p++)
        if (!only_lit_cast(mesh, &mesh->parts[p], light))
            return 0;
    return 1;
}

/* Triangle by triangle, by the rule of each one's part. c->front and c->back are known. */
static void cast_by_part(const gn_mesh *mesh, const double light[4], gni_casting *c)
{
    if (mesh->part_triangle_count < mesh->info.triangle_count)
        memset(c->of, 0, mesh->info.triangle_count); /* degenerate triangles are in no part */
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        const gni_part *part = &mesh->parts[p];
        const uint32_t *triangle = mesh->part_triangles + part->first_triangle;
        const int8_t unlit = only_lit_cast(mesh, part, light) ? (int8_t)-part->outward : 0;

        for (uint32_t i = 0; i < part->triangle_count; i++) {
            const uint32_t t = triangle[i], word = t / GNI_CLUSTER, bit = t % GNI_CLUSTER;
            const int8_t facing = (int8_t)((int)(c->bits[word] >> bit & 1) - (int)(c->spare[word] >> bit & 1));

            c->of[t] = facing == unlit ? 0 : facing;
        }
    }
}

void gni_find_bits(const gn_mesh *mesh, gni_casting *c)
{
    c->is_plain = 0;
    c->count = 0;
    c->of[mesh->info.triangle_count] = GNI_UNLIKE;
    for (uint32_t cluster = 0; cluster < mesh->cluster_count; cluster++) {
        const int8_t *of = c->of + (size_t)cluster * GNI_CLUSTER;
        uint64_t bits = 0;

        for (uint32_t i = 0; i < size_of(mesh, cluster); i++)
            bits |= (uint64_t)(of[i] != 0) << i;
        c->bits[cluster] = bits;
        c->count += gni_count_bits(bits);
    }
}

void gni_find_casting(const gn_mesh *mesh, const double light[4], gni_casting *c)
{
    c->looked_at = gni_find_facing(mesh, light, c->bits, c->spare);
    gni_cast(mesh, light, c);
}

void gni_cast(const gn_mesh *mesh, const double light[4], gni_casting *c)
{
    const int plain = GNI_HAS_CLUSTERS && is_plain(mesh, light), inward = plain && mesh->info.outward_part_count == 0;

    if (inward)
        memcpy(c->bits, c->spare, mesh->cluster_count * sizeof *c->bits);
    if (!plain) {
        cast_by_part(mesh, light, c);
        gni_find_bits(mesh, c);
        return;
    }
    c->is_plain = 1;
    c->turn = inward ? -1 : 1;
    c->count = 0;
    c->of[mesh->info.triangle_count] = GNI_UNLIKE;
    for (uint32_t cluster = 0; cluster < mesh->cluster_count; cluster++) {
        put_bytes(c->of + (size_t)cluster * GNI_CLUSTER, c->bits[cluster], size_of(mesh, cluster), c->turn);
        c->count += gni_count_bits(c->bits[cluster]);
    }
}

void gni_towards(double out[3], const gn_light *light)
{
    const double *v = light->towards;
    int exponent;

    frexp(fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))), &exponent);
    for (int i = 0; i < 3; i++)
        out[i] = ldexp(v[i], -exponent);
}

int gni_light_in_object(const gn_light *light, const gn_object *object, double out[4])
{
    const float *centre = object->mesh->info.centre;
    const double c[3] = {(double)centre[0], (double)centre[1], (double)centre[2]};
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double inverse[16], origin[3], v[3];

    if (!gn_mat4_invert_affine(inverse, object->model))
        return 0;
    gn_mat4_transform(origin, object->model, c, 1.0);
    gni_towards(v, light);
    for (int i = 0; i < 3 && !is_sun; i++)
        v[i] = light->position[i] - origin[i];
    gn_mat4_transform(out, inverse, v, 0.0);
    out[3] = is_sun ? 0.0 : 1.0;
    return 1;
}

int gni_light_is_outside(const gn_light *light, const gn_object *object)
{
    const gn_mesh_info *info = &object->mesh->info;
    double at[4];

    if (light->kind == GN_LIGHT_DIRECTIONAL)
        return 1;
    if (!gni_light_in_object(light, object, at))
        return 0;
    for (int i = 0; i < 3; i++) {
        const double low = (double)info->box_min[i], high = (double)info->box_max[i];
        const double margin = GNI_MARGIN * (fabs(at[i]) + high - low);

        if (at[i] < low - margin || at[i] > high + margin)
            return 1;
    }
    return 0;
}

static int8_t sign_of(double x)
{
    return (int8_t)((x > 0.0) - (x < 0.0));
}

/* Facing of triangles as they lie flattened in the world. */
static void facing_flattened(const gn_object *object, const gn_light *light, int8_t *facing)
{
    const gn_mesh *mesh = object->mesh;
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double towards[3];

    gni_towards(towards, light);
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        double v[3][3], normal[3], at[3];

        for (int k = 0; k < 3; k++) {
            const float *p = mesh->positions + 3 * (size_t)mesh->triangles[3 * (size_t)t + (size_t)k];
            double x[3];

            for (int axis = 0; axis < 3; axis++)
                x[axis] = (double)p[axis] + (double)mesh->info.centre[axis];
            gn_mat4_transform(v[k], object->model, x, 1.0);
        }
        for (int axis = 0; axis < 3; axis++) {
            const int y = (axis + 1) % 3, z = (axis + 2) % 3;

            normal[axis] = (v[1][y] - v[0][y]) * (v[2][z] - v[0][z]) - (v[1][z] - v[0][z]) * (v[2][y] - v[0][y]);
            at[axis] = is_sun ? towards[axis] : light->position[axis] - v[0][axis];
        }
        facing[t] = sign_of(gni_dot(normal, at));
    }
}

void gni_find_object_casting(const gn_object *object, const gn_light *light, gni_casting *c)
{
    const gn_mesh *mesh = object->mesh;
    double at[4];

    if (gni_light_in_object(light, object, at)) {
        gni_find_casting(mesh, at, c);
        return;
    }
    if (!GNI_HAS_SOLIDS) { /* plans refuse it */
        memset(c->of, 0, mesh->info.triangle_count);
        gni_find_bits(mesh, c);
        return;
    }
    facing_flattened(object, light, c->of);
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        const gni_part *part = &mesh->parts[p];

        /* a flattened solid has two sheets in one place: the lit one is enough, and it is the one that is seen as
         * lit */
        for (uint32_t i = 0; part->outward && i < part->triangle_count; i++) {
            int8_t *o = &c->of[mesh->part_triangles[part->first_triangle + i]];

            *o = *o == part->outward ? *o : 0;
        }
    }
    gni_find_bits(mesh, c);
}

/* What the public functions give is in the order of the description. They are not called every frame. */
static void in_given_order(const gn_mesh *mesh, const gni_casting *c, int8_t *out)
{
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        out[mesh->order[t]] = c->of[t];
}

static void facing_to_bytes(const gn_mesh *mesh, gni_casting *c)
{
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        c->of[t] = (int8_t)((int)(c->bits[t / GNI_CLUSTER] >> t % GNI_CLUSTER & 1) -
                            (int)(c->spare[t / GNI_CLUSTER] >> t % GNI_CLUSTER & 1));
}

void gn_facing(const gn_mesh *mesh, const double light[4], int8_t *facing)
{
    gni_casting c = mesh->scratch;

    gni_find_facing(mesh, light, c.bits, c.spare);
    facing_to_bytes(mesh, &c);
    in_given_order(mesh, &c, facing);
}

void gn_casting(const gn_mesh *mesh, const double light[4], int8_t *casting)
{
    gni_casting c = mesh->scratch;

    gni_find_casting(mesh, light, &c);
    in_given_order(mesh, &c, casting);
}

void gn_object_facing(const gn_object *object, const gn_light *light, int8_t *facing)
{
    const gn_mesh *mesh = object->mesh;
    gni_casting c = mesh->scratch;
    double at[4];

    if (gni_light_in_object(light, object, at)) {
        gn_facing(mesh, at, facing);
        return;
    }
    facing_flattened(object, light, c.of);
    in_given_order(mesh, &c, facing);
}

void gn_object_casting(const gn_object *object, const gn_light *light, int8_t *casting)
{
    gni_casting c = object->mesh->scratch;

    gni_find_object_casting(object, light, &c);
    in_given_order(object->mesh, &c, casting);
}
