/* frame.h - a small frame for tests of the walk: a box over a floor, a point light and a sun, uploaded and planned. */
#ifndef FRAME_H
#define FRAME_H
#include "gn_test.h"
#include "gnomon_gles.h"

typedef struct test_frame {
    gn_mesh *meshes[2]; /* box, floor */
    gn_object objects[2];
    gn_light lights[2];
    gn_scene scene;
    void *memory;
    size_t size;
    const gn_plan *plan;
} test_frame;

/* Returns the first result that is not GN_OK; what was made is dropped by test_frame_drop() all the same. */
gn_result test_frame_make(test_frame *f, gn_context *context, gn_gles *gl, gn_target target);
void test_frame_drop(test_frame *f, gn_gles *gl);
#endif
