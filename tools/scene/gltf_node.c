/* gltf_node.c - the node hierarchy: read, proven to be a forest, and walked.
 *
 * First every node that is somebody's child gets its parent: a second parent is refused there and then. A chain of
 * parents that never ends is then the only other way not to be a forest, and all of those nodes are missing from the
 * walks that start at nodes without parent. Walks follow child, sibling and parent links, so that no depth of nesting
 * costs stack.
 *
 * The scene's walk numbers its nodes, parents before children; instances, the first camera and lights come out in
 * that order. */
#include "gltf.h"

#include "gn_matrix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int read_transform(gltf *g, const char *where, const cJSON *json, scene_node *n)
{
    static const double last_row[4] = {0, 0, 0, 1};
    double length;

    n->has_matrix = gltf_get(json, "matrix") != NULL;
    if (!gltf_get_numbers(g, where, json, "matrix", 16, n->local) ||
        !gltf_get_numbers(g, where, json, "translation", 3, n->translation) ||
        !gltf_get_numbers(g, where, json, "rotation", 4, n->rotation) ||
        !gltf_get_numbers(g, where, json, "scale", 3, n->scale))
        return 0;
    for (int i = 0; n->has_matrix && i < 4; i++) {
        if (fabs(n->local[4 * i + 3] - last_row[i]) > 1e-6)
            return gltf_fail(g, "%s: element %d of its matrix is %g, not %g", where, 4 * i + 3, n->local[4 * i + 3],
                             last_row[i]);
        n->local[4 * i + 3] = last_row[i];
    }
    length = sqrt(n->rotation[0] * n->rotation[0] + n->rotation[1] * n->rotation[1] + n->rotation[2] * n->rotation[2] +
                  n->rotation[3] * n->rotation[3]);
    if (!(length > 1e-6 && length < 1e6))
        return gltf_fail(g, "%s: its rotation has length %g", where, length);
    return 1;
}

static int read_extras(gltf *g, const char *where, const cJSON *json, scene_node *n)
{
    const cJSON *extras = gltf_get(gltf_get(json, "extras"), "gnomon");
    char place[GLTF_WHERE];

    snprintf(place, sizeof place, "%.40s: extras.gnomon", where);
    return gltf_get_bool(g, place, extras, "casts", &n->casts) &&
           gltf_get_bool(g, place, extras, "receives", &n->receives) &&
           gltf_get_bool(g, place, extras, "static", &n->is_static);
}

static int read_node(gltf *g, int index, scene_node *n)
{
    const cJSON *json = g->lists[GLTF_NODE].items[index];
    const cJSON *light = gltf_get_extension(json, "KHR_lights_punctual");
    char where[GLTF_WHERE];

    snprintf(where, sizeof where, "node %d", index);
    if (gltf_get(json, "skin"))
        return gltf_fail(g, "%s: skins are not supported", where);
    return read_transform(g, where, json, n) && read_extras(g, where, json, n) &&
           gltf_get_index(g, where, json, "mesh", GLTF_MESH, &n->mesh) &&
           gltf_get_index(g, where, json, "camera", GLTF_CAMERA, &n->camera) &&
           gltf_get_index(g, where, light, "light", GLTF_LIGHT, &n->light);
}

/* Hangs a node's children under it, in their order. */
static int read_children(gltf *g, scene *s, int parent)
{
    const cJSON *array, *item;
    int *link = &s->nodes[parent].first_child;
    char where[GLTF_WHERE];

    snprintf(where, sizeof where, "node %d", parent);
    if (!gltf_get_array(g, where, g->lists[GLTF_NODE].items[parent], "children", &array))
        return 0;
    cJSON_ArrayForEach (item, array) {
        int child;

        if (!gltf_index(g, where, "children", item, GLTF_NODE, &child))
            return 0;
        if (child == parent)
            return gltf_fail(g, "%s is its own child", where);
        if (s->nodes[child].parent != SCENE_NONE)
            return gltf_fail(g, "node %d has two parents, nodes %d and %d", child, s->nodes[child].parent, parent);
        s->nodes[child].parent = parent;
        *link = child;
        link = &s->nodes[child].next_sibling;
    }
    return 1;
}

/* The node after `node` in the depth-first walk of the tree under `root`, or SCENE_NONE at its end. */
static int next_in_tree(const scene *s, int root, int node)
{
    if (s->nodes[node].first_child != SCENE_NONE)
        return s->nodes[node].first_child;
    while (node != root && s->nodes[node].next_sibling == SCENE_NONE)
        node = s->nodes[node].parent;
    return node == root ? SCENE_NONE : s->nodes[node].next_sibling;
}

static int check_forest(gltf *g, const scene *s)
{
    size_t met = 0;
    uint8_t *seen = gltf_alloc_zeroed(g, s->node_count, 1);

    if (!seen)
        return 0;
    for (int root = 0; root < (int)s->node_count; root++)
        for (int n = s->nodes[root].parent == SCENE_NONE ? root : SCENE_NONE; n != SCENE_NONE;
             n = next_in_tree(s, root, n)) {
            seen[n] = 1;
            met++;
        }
    for (size_t n = 0; met < s->node_count && n < s->node_count; n++)
        if (!seen[n]) {
            gltf_fail(g, "node %lu is its own ancestor, or under one that is", (unsigned long)n);
            break;
        }
    free(seen);
    return met == s->node_count;
}

/* Appends the tree under a root to the scene's walk. */
static void add_to_walk(scene *s, int root, size_t *walked)
{
    for (int n = root; n != SCENE_NONE; n = next_in_tree(s, root, n))
        s->nodes[(*walked)++].order = n;
}

/* The roots are those of the default scene, or of the first, or all nodes without parent. */
static int make_walk(gltf *g, scene *s, size_t *walked)
{
    const size_t scenes = g->lists[GLTF_SCENE].count;
    const cJSON *array, *item;
    uint8_t *taken;
    int index = 0, ok = 1;
    char where[GLTF_WHERE];

    *walked = 0;
    if (!gltf_get_index(g, "the document", g->root, "scene", GLTF_SCENE, &index))
        return 0;
    if (scenes == 0) {
        for (int n = 0; n < (int)s->node_count; n++)
            if (s->nodes[n].parent == SCENE_NONE)
                add_to_walk(s, n, walked);
        return 1;
    }
    snprintf(where, sizeof where, "scene %d", index);
    if (!gltf_get_array(g, where, g->lists[GLTF_SCENE].items[index], "nodes", &array))
        return 0;
    taken = gltf_alloc_zeroed(g, s->node_count, 1);
    if (!taken)
        return 0;
    cJSON_ArrayForEach (item, array) {
        int root;

        ok = gltf_index(g, where, "nodes", item, GLTF_NODE, &root);
        if (ok && s->nodes[root].parent != SCENE_NONE)
            ok = gltf_fail(g, "%s: node %d is no root, node %d is its parent", where, root, s->nodes[root].parent);
        else if (ok && taken[root])
            ok = gltf_fail(g, "%s: node %d is named twice", where, root);
        if (!ok)
            break;
        taken[root] = 1;
        add_to_walk(s, root, walked);
    }
    free(taken);
    return ok;
}

static void add_instance(const gltf *g, scene *s, int node)
{
    scene_node *n = &s->nodes[node];
    scene_instance *instance = &s->instances[s->instance_count++];

    memcpy(n->box, g->boxes[n->mesh], sizeof n->box);
    instance->node = node;
    instance->mesh = n->mesh;
    instance->casts = n->casts;
    instance->receives = n->receives;
    instance->is_static = n->is_static;
    gn_mat4_identity(instance->world);
}

static int collect(gltf *g, scene *s, size_t walked)
{
    size_t instances = 0, lights = 0;

    for (size_t k = 0; k < walked; k++) {
        const scene_node *n = &s->nodes[s->nodes[k].order];

        instances += n->mesh != SCENE_NONE && s->meshes[n->mesh].triangle_count > 0;
        lights += n->light != SCENE_NONE;
    }
    s->instances = gltf_alloc(g, instances, sizeof *s->instances);
    s->lights = gltf_alloc(g, lights, sizeof *s->lights);
    if (!s->instances || !s->lights)
        return 0;
    for (size_t k = 0; k < walked; k++) {
        const int node = s->nodes[k].order;
        const scene_node *n = &s->nodes[node];

        if (n->mesh != SCENE_NONE && s->meshes[n->mesh].triangle_count > 0)
            add_instance(g, s, node);
        if (n->camera != SCENE_NONE && !s->has_camera) {
            if (!gltf_read_camera(g, n->camera, &s->camera))
                return 0;
            s->camera.node = node;
            s->has_camera = 1;
        }
        if (n->light != SCENE_NONE) {
            if (!gltf_read_light(g, n->light, &s->lights[s->light_count]))
                return 0;
            s->lights[s->light_count++].node = node;
        }
    }
    return 1;
}

/* Whether a node is another or under it. */
static int is_under(const scene *s, int node, int other)
{
    while (node != SCENE_NONE && node != other)
        node = s->nodes[node].parent;
    return node == other;
}

/* extras.gnomon.exempt of a light's node: nodes that do not cast in it, with all that is under them. */
static int read_exempt(gltf *g, scene *s, scene_light *l)
{
    const cJSON *extras = gltf_get(gltf_get(g->lists[GLTF_NODE].items[l->node], "extras"), "gnomon");
    const cJSON *array, *item;
    char where[GLTF_WHERE];

    snprintf(where, sizeof where, "node %d: extras.gnomon", l->node);
    if (!gltf_get_array(g, where, extras, "exempt", &array))
        return 0;
    if (!array || !cJSON_GetArraySize(array))
        return 1;
    l->exempt = gltf_alloc(g, s->instance_count, sizeof *l->exempt);
    if (!l->exempt)
        return 0;
    for (size_t i = 0; i < s->instance_count; i++) {
        int is_exempt = 0;

        cJSON_ArrayForEach (item, array) {
            int node;

            if (!gltf_index(g, where, "exempt", item, GLTF_NODE, &node))
                return 0;
            is_exempt |= is_under(s, s->instances[i].node, node);
        }
        if (is_exempt)
            l->exempt[l->exempt_count++] = (uint32_t)i;
    }
    return 1;
}

static int read_exempts(gltf *g, scene *s)
{
    for (size_t i = 0; i < s->light_count; i++)
        if (!read_exempt(g, s, &s->lights[i]))
            return 0;
    return 1;
}

int gltf_read_nodes(gltf *g, scene *s)
{
    const scene_node plain = {.parent = SCENE_NONE,
                              .first_child = SCENE_NONE,
                              .next_sibling = SCENE_NONE,
                              .order = SCENE_NONE,
                              .mesh = SCENE_NONE,
                              .camera = SCENE_NONE,
                              .light = SCENE_NONE,
                              .casts = 1,
                              .receives = 1,
                              .rotation = {0, 0, 0, 1},
                              .scale = {1, 1, 1}};
    const size_t count = g->lists[GLTF_NODE].count;
    size_t walked;

    s->nodes = gltf_alloc(g, count, sizeof *s->nodes);
    if (!s->nodes)
        return 0;
    for (size_t i = 0; i < count; i++) {
        s->nodes[i] = plain;
        gn_mat4_identity(s->nodes[i].world);
    }
    s->node_count = count;
    for (size_t i = 0; i < count; i++)
        if (!read_node(g, (int)i, &s->nodes[i]))
            return 0;
    for (size_t i = 0; i < count; i++)
        if (!read_children(g, s, (int)i))
            return 0;
    return check_forest(g, s) && make_walk(g, s, &walked) && collect(g, s, walked) && read_exempts(g, s);
}
