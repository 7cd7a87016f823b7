/* bench_memory.c - bytes that the library asks of its port, and that a plan asks of the host, by triangles of a caster. One line of
 * Markdown for each size; docs/footprint.md has them (make footprint). */
#include <stdio.h>
#include <string.h>

#include "gn_select.h"
#include "gn_test.h"
#include "pile.h"

static const gn_target target = {.width = 640,
                                 .height = 480,
                                 .red_bits = 8,
                                 .green_bits = 8,
                                 .blue_bits = 8,
                                 .alpha_bits = 8,
                                 .depth_bits = 24,
                                 .stencil_bits = 8,
                                 .image_depth_bits = 24,
                                 .advertised = (1u << GN_CAPABILITY_COUNT) - 1,
                                 .proven = (1u << GN_CAPABILITY_COUNT) - 1};

/* A lump of so many rings, and a floor, under one light. */
static void measure(uint32_t rings)
{
    test_port counter = {0, 0, 0};
    const gn_port port = test_port_make(&counter);
    gn_scene scene = {0};
    gn_context *context;
    pile_mesh lump, floor;
    size_t before, mesh_bytes;
    static pile p;

    if (gn_context_create(&port, &context) != GN_OK)
        return;
    before = counter.live_bytes;
    pile_make_lump(&lump, context, rings, 2 * rings);
    mesh_bytes = counter.live_bytes - before;
    pile_make_floor(&floor, context, 8, 4.0f);
    memset(&p, 0, sizeof p);
    p.meshes[0] = &lump;
    p.meshes[1] = &floor;
    p.side = p.light_count = 1;
    pile_pose(&p, 0, 4.0 / 3.0);
    scene.camera = p.camera;
    scene.lights = p.lights;
    scene.light_count = 1;
    scene.objects = p.objects;
    scene.object_count = p.object_count;
    scene.target = target;
    printf("| %lu | %.1f | %.1f |\n", (unsigned long)lump.triangle_count,
           (double)mesh_bytes / 1024.0 / ((double)lump.triangle_count / 1000.0),
           (double)gn_plan_bound(&scene) / 1024.0 / ((double)lump.triangle_count / 1000.0));
    pile_drop(&lump);
    pile_drop(&floor);
    gn_context_destroy(context);
}

#ifndef GNI_WITHOUT_selector
static int measure_selector(void)
{
    test_port counter = {0, 0, 0};
    const gn_port port = test_port_make(&counter);
    gn_selector *selector = NULL;
    gn_context *context;
    size_t before;

    if (gn_context_create(&port, &context) != GN_OK)
        return 0;
    before = counter.live_bytes;
    gn_selector_create(context, NULL, NULL, &selector);
    printf("\nA selector holds %.1f KiB, a context %.1f.\n", (double)(counter.live_bytes - before) / 1024.0,
           (double)before / 1024.0);
    gn_selector_destroy(selector);
    gn_context_destroy(context);
    return 1;
}
#endif

int main(void)
{
    printf("| triangles | KiB of mesh a 1,000 | KiB of plan a 1,000, one light |\n| --- | --- | --- |\n");
    for (uint32_t rings = 8; rings <= 128; rings *= 2)
        measure(rings);
#ifndef GNI_WITHOUT_selector
    return measure_selector() ? 0 : 1;
#else
    return 0;
#endif
}
