/* frame.c - see frame.h. */
#include "frame.h"

#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"

gn_result test_frame_make(test_frame *f, gn_context *context, gn_gles *gl, gn_target target)
{
    static const float low[2][3] = {{-1, 0.5f, -1}, {-9, -0.5f, -9}}, high[2][3] = {{1, 2, 1}, {9, 0, 9}};
    static test_mesh m;

    memset(f, 0, sizeof *f);
    for (int i = 0; i < 2; i++) {
        gn_mesh_desc desc;
        gn_result result;

        m.vertex_count = m.triangle_count = 0;
        test_add_box(&m, low[i], high[i], 0);
        desc = test_desc(&m);
        result = gn_mesh_create(context, &desc, &f->meshes[i]);
        if (result == GN_OK && gl)
            result = gn_gles_upload(gl, f->meshes[i]);
        if (result != GN_OK)
            return result;
        f->objects[i].mesh = f->meshes[i];
        gn_mat4_identity(f->objects[i].model);
        f->objects[i].flags = GN_CASTS | GN_RECEIVES | GN_DRAWN | GN_DRAWN_BACKS;
    }
    f->lights[0] = (gn_light){.kind = GN_LIGHT_POINT, .position = {2, 5, 3}};
    f->lights[1] = (gn_light){.kind = GN_LIGHT_DIRECTIONAL, .towards = {0.3, 1, 0.2}};
    gn_mat4_identity(f->scene.camera.world);
    f->scene.camera.world[13] = 3;
    f->scene.camera.world[14] = 8;
    f->scene.camera.left = f->scene.camera.bottom = -0.6;
    f->scene.camera.right = f->scene.camera.top = 0.6;
    f->scene.camera.znear = 0.1;
    f->scene.camera.zfar = 40;
    f->scene.lights = f->lights;
    f->scene.light_count = 2;
    f->scene.objects = f->objects;
    f->scene.object_count = 2;
    f->scene.target = target;
    f->size = gn_plan_bound(&f->scene);
    f->memory = malloc(f->size);
    return f->memory ? gn_plan_make(context, &f->scene, f->memory, f->size, &f->plan) : GN_E_MEMORY;
}

void test_frame_drop(test_frame *f, gn_gles *gl)
{
    for (int i = 0; i < 2; i++) {
        if (gl && f->meshes[i])
            gn_gles_unload(gl, f->meshes[i]);
        gn_mesh_destroy(f->meshes[i]);
    }
    free(f->memory);
}
