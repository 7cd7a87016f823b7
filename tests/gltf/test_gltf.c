/* test_gltf.c - the glTF reader's triangles: every accessor layout, every kind of primitive, and both
 * containers, each by its values. */
#include "gltf_maker.h"

static void a_triangle_without_anything(void **state)
{
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    load_members(&s, ONE_MESH);
    assert_int_equal(s.mesh_count, 1);
    assert_int_equal(s.instance_count, 1);
    assert_int_equal(s.meshes[0].vertex_count, 3);
    assert_int_equal(s.meshes[0].triangle_count, 1);
    assert_int_equal(s.meshes[0].solid_triangle_count, 1);
    EXPECT_FLOATS(s.meshes[0].positions, TRIANGLE);
    EXPECT_FLOATS(s.meshes[0].normals, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    EXPECT_FLOATS(s.meshes[0].uvs, 0, 0, 0, 0, 0, 0);
    EXPECT_FLOATS(s.meshes[0].colors, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1);
    INDICES(s.meshes[0].indices, 0, 1, 2);
    assert_int_equal(s.material_count, 1);
    assert_int_equal(s.meshes[0].range_count, 1);
    assert_int_equal(s.meshes[0].ranges[0].material, 0);
    DOUBLES(s.materials[0].base_color, 1, 1, 1, 1);
    assert_int_equal(s.materials[0].texture, SCENE_NONE);
    expect_near(s.materials[0].alpha_cutoff, 0.5);
    assert_true(s.instances[0].casts && s.instances[0].receives && !s.instances[0].is_static);
    DOUBLES(s.bounds_min, 0, 0, 0);
    DOUBLES(s.bounds_max, 1, 1, 0);
    assert_true(s.duration == 0.0 && !s.has_camera && s.light_count == 0);
    scene_free(&s);
}

/* Interleaved vertices behind a view and an accessor offset, under indices of each width. */
static void strides_offsets_and_index_widths(void **state)
{
    static const int types[3] = {5121, 5123, 5125};

    (void)state;
    for (int i = 0; i < 3; i++) {
        const size_t width = (size_t)1 << i;
        char members[2048];
        scene s;

        bytes.size = 0;
        INTEGERS(4, 77, 78); /* 8 bytes before the view */
        for (int v = 0; v < 4; v++)
            FLOATS(99, (float)v, (float)(v * v), 0.5f, 0, 0, -3);
        INTEGERS(width, 9, 3, 2, 1, 0, 2, 3);
        snprintf(
            members, sizeof members,
            "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2}]}],"
            "'accessors':[{'bufferView':0,'byteOffset':4,'componentType':5126,'count':4,'type':'VEC3'},"
            "{'bufferView':0,'byteOffset':16,'componentType':5126,'count':4,'type':'VEC3'},"
            "{'bufferView':1,'byteOffset':%lu,'componentType':%d,'count':6,'type':'SCALAR'}],"
            "'bufferViews':[{'buffer':0,'byteOffset':8,'byteLength':112,'byteStride':28},"
            "{'buffer':0,'byteOffset':120,'byteLength':%lu}]," BUFFER,
            (unsigned long)width, types[i], (unsigned long)(7 * width), (unsigned long)bytes.size);
        load_members(&s, members);
        assert_int_equal(s.meshes[0].vertex_count, 4);
        EXPECT_FLOATS(s.meshes[0].positions, 0, 0, 0.5f, 1, 1, 0.5f, 2, 4, 0.5f, 3, 9, 0.5f);
        EXPECT_FLOATS(s.meshes[0].normals, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1);
        INDICES(s.meshes[0].indices, 3, 2, 1, 0, 2, 3);
        scene_free(&s);
    }
}

static void sparse_accessors(void **state)
{
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    INTEGERS(2, 2, 0);         /* at 36 */
    FLOATS(0, 5, 0, -1, 0, 0); /* at 40 */
    INTEGERS(1, 1, 2, 0, 0);   /* at 64: sparse indices of the indices, then their values */
    load_members(&s, "'nodes':[{'mesh':0},{'mesh':1}],"
                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]},"
                     "{'primitives':[{'attributes':{'POSITION':1},'indices':2}]}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3','sparse':{'count':2,"
                     "'indices':{'bufferView':1,'componentType':5123},'values':{'bufferView':2}}},"
                     "{'componentType':5126,'count':3,'type':'VEC3','sparse':{'count':2,"
                     "'indices':{'bufferView':1,'componentType':5123},'values':{'bufferView':2}}},"
                     "{'componentType':5121,'count':3,'type':'SCALAR','sparse':{'count':2,"
                     "'indices':{'bufferView':3,'componentType':5121},'values':{'bufferView':3,'byteOffset':0}}}],"
                     "'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':4},"
                     "{'buffer':0,'byteOffset':40,'byteLength':24},{'buffer':0,'byteOffset':64,'byteLength':4}],"
                     "'buffers':[{'uri':'data.bin','byteLength':68}]");
    EXPECT_FLOATS(s.meshes[0].positions, -1, 0, 0, 1, 0, 0, 0, 5, 0);
    EXPECT_FLOATS(s.meshes[1].positions, -1, 0, 0, 0, 0, 0, 0, 5, 0);
    scene_free(&s);
}

static void normalized_and_quantized_attributes(void **state)
{
    const scene_mesh *m;
    scene s;

    (void)state;
    INTEGERS(2, 0, 0, 0, 0, 300, -300, 7, 0, -32768, 32767, 0, 0); /* 0: short positions in strides of 8 */
    INTEGERS(1, -128, 0, 0, 0, 127, 0, 0, 0, -127, 64, 0, 0);      /* 24: byte positions, or normals, strides of 4 */
    INTEGERS(1, 255, 0, 51, 0, 0, 255, 102, 0, 0, 0, 0, 0);        /* 36: byte colours */
    INTEGERS(2, 65535, 0, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 65535);   /* 48: short colours with alpha */
    load_members(&s,
                 "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':2,'COLOR_0':3}},"
                 "{'attributes':{'POSITION':1,'COLOR_0':4}}]}],'extensionsRequired':['KHR_mesh_quantization'],"
                 "'accessors':[{'bufferView':0,'componentType':5122,'count':3,'type':'VEC3'},"
                 "{'bufferView':1,'componentType':5120,'count':3,'type':'VEC3','normalized':true},"
                 "{'bufferView':1,'componentType':5120,'count':3,'type':'VEC3','normalized':true},"
                 "{'bufferView':2,'componentType':5121,'count':3,'type':'VEC3','normalized':true},"
                 "{'bufferView':3,'componentType':5123,'count':3,'type':'VEC4','normalized':true}],"
                 "'bufferViews':[{'buffer':0,'byteLength':24,'byteStride':8},"
                 "{'buffer':0,'byteOffset':24,'byteLength':12,'byteStride':4},"
                 "{'buffer':0,'byteOffset':36,'byteLength':12,'byteStride':4},"
                 "{'buffer':0,'byteOffset':48,'byteLength':24}],'buffers':[{'uri':'data.bin','byteLength':72}]");
    m = &s.meshes[0];
    EXPECT_FLOATS(m->positions, 0, 0, 0, 300, -300, 7, -32768, 32767, 0, -1, 0, 0, 1, 0, 0, -1, 64.0f / 127, 0);
    EXPECT_FLOATS(m->normals, -1, 0, 0, 1, 0, 0, -0.89301646f, 0.45002404f, 0);
    EXPECT_FLOATS(m->colors, 1, 0, 0.2f, 1, 0, 1, 0.4f, 1, 0, 0, 0, 1, 1, 0, 0, 0.2f, 0, 0, 0, 0, 0, 0, 0, 1);
    scene_free(&s);
}

static void strips_fans_and_what_is_skipped(void **state)
{
    const scene_mesh *m;
    scene s;

    (void)state;
    FLOATS(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0); /* a strip that faces +Z */
    FLOATS(0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 2, 0); /* a fan, also */
    for (int i = 0; i < 10; i++)
        FLOATS(0, 0, 1);
    load_members(&s,
                 "'nodes':[{'mesh':0}],'meshes':[{'primitives':["
                 "{'attributes':{'POSITION':0,'NORMAL':2},'mode':5},{'attributes':{'POSITION':1,'NORMAL':2},'mode':6},"
                 "{'attributes':{'POSITION':0},'mode':5},{'attributes':{'POSITION':1},'mode':6},"
                 "{'attributes':{'POSITION':1},'mode':4},"
                 "{'attributes':{'POSITION':1},'mode':0},{'attributes':{'POSITION':1},'mode':3},"
                 "{'attributes':{}}]}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'count':5,'type':'VEC3'},"
                 "{'bufferView':0,'byteOffset':60,'componentType':5126,'count':5,'type':'VEC3'},"
                 "{'bufferView':0,'byteOffset':120,'componentType':5126,'count':5,'type':'VEC3'}],"
                 "'bufferViews':[{'buffer':0,'byteLength':240}],'buffers':[{'uri':'data.bin','byteLength':240}]");
    m = &s.meshes[0];
    assert_int_equal(m->triangle_count, 13);
    assert_int_equal(m->range_count, 5);
    assert_int_equal(m->ranges[4].first_triangle, 12);
    assert_int_equal(m->ranges[4].triangle_count, 1); /* five corners make one triangle */
    INDICES(m->indices, 0, 1, 2, 1, 3, 2, 2, 3, 4, 6, 7, 5, 7, 8, 5, 8, 9, 5);
    for (uint32_t i = 0; i < m->vertex_count; i++)
        EXPECT_FLOATS(m->normals + 3 * i, 0, 0, 1); /* the flat ones prove the winding */
    assert_int_equal(m->vertex_count, 5 + 5 + 9 + 9 + 3);
    assert_int_equal(warning_count, 3);
    expect_text(warnings, "mesh 0 primitive 5: skipped: points");
    expect_text(warnings, "mesh 0 primitive 6: skipped: lines");
    expect_text(warnings, "mesh 0 primitive 7: skipped: it has no POSITION");
    scene_free(&s);
}

/* Three primitives over one set of accessors, each with its own part of it; the middle one is transparent. */
static void primitives_that_share_accessors(void **state)
{
    const scene_mesh *m;
    scene s;

    (void)state;
    for (int v = 0; v < 6; v++)
        FLOATS((float)v, (float)(v % 2), 0, 0, 1, 0); /* position and normal */
    INTEGERS(2, 5, 3, 1, 0, 1, 2, 2, 4, 5, 2, 5, 3);
    load_members(&s, "'nodes':[{'mesh':0}],'materials':[{},{'alphaMode':'BLEND'},{'alphaMode':'MASK'}],"
                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2,'material':0},"
                     "{'attributes':{'POSITION':0,'NORMAL':1},'indices':3,'material':1},"
                     "{'attributes':{'POSITION':0,'NORMAL':1},'indices':4}]}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':6,'type':'VEC3'},"
                     "{'bufferView':0,'byteOffset':12,'componentType':5126,'count':6,'type':'VEC3'},"
                     "{'bufferView':1,'componentType':5123,'count':3,'type':'SCALAR'},"
                     "{'bufferView':1,'byteOffset':6,'componentType':5123,'count':3,'type':'SCALAR'},"
                     "{'bufferView':1,'byteOffset':12,'componentType':5123,'count':6,'type':'SCALAR'}],"
                     "'bufferViews':[{'buffer':0,'byteLength':144,'byteStride':24},"
                     "{'buffer':0,'byteOffset':144,'byteLength':24}],'buffers':[{'uri':'data.bin','byteLength':168}]");
    m = &s.meshes[0];
    assert_int_equal(m->vertex_count, 3 + 4 + 3);
    EXPECT_FLOATS(m->positions, 1, 1, 0, 3, 1, 0, 5, 1, 0, 2, 0, 0, 3, 1, 0, 4, 0, 0, 5, 1, 0, 0, 0, 0, 1, 1, 0, 2, 0,
                  0);
    INDICES(m->indices, 2, 1, 0, 3, 5, 6, 3, 6, 4, 7, 8, 9);
    assert_int_equal(m->range_count, 3);
    assert_int_equal(m->ranges[0].material, 0);
    assert_int_equal(m->ranges[1].material, 3);
    assert_int_equal(m->ranges[2].material, 1);
    assert_int_equal(m->ranges[1].first_triangle, 1);
    assert_int_equal(m->ranges[1].triangle_count, 2);
    assert_int_equal(m->solid_triangle_count, 3);
    assert_int_equal(m->triangle_count, 4);
    scene_free(&s);
}

/* Normals are made unit, and one of length 0 becomes its triangle's. */
static void normals_of_other_lengths(void **state)
{
    scene s;

    (void)state;
    FLOATS(TRIANGLE, 3, 0, 4, 0, 0, 0, 1e-30f, 0, 0);
    load_members(&s, "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
                     "{'bufferView':0,'byteOffset':36,'componentType':5126,'count':3,'type':'VEC3'}],"
                     "'bufferViews':[{'buffer':0,'byteLength':72}],'buffers':[{'uri':'data.bin','byteLength':72}]");
    EXPECT_FLOATS(s.meshes[0].normals, 0.6f, 0, 0.8f, 0, 0, 1, 1, 0, 0);
    scene_free(&s);
}

/* --- containers --- */

static void containers(void **state)
{
    static uint8_t glb[8192];
    char text[64], members[2048];
    size_t size;
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    base64(text, bytes.data, bytes.size);
    snprintf(members, sizeof members,
             "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
             "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}],"
             "'bufferViews':[{'buffer':0,'byteLength':36}],"
             "'buffers':[{'uri':'data:application/octet-stream;base64,%s','byteLength':36}]",
             text);
    load_members(&s, members);
    EXPECT_FLOATS(s.meshes[0].positions, TRIANGLE);
    scene_free(&s);

    write_file("my data%.bin", bytes.data, bytes.size);
    *strstr(members, "'buffers'") = '\0';
    snprintf(members + strlen(members), 200, "'buffers':[{'uri':'my%%20data%%25.bin','byteLength':36}]");
    load_members(&s, members);
    EXPECT_FLOATS(s.meshes[0].positions, TRIANGLE);
    scene_free(&s);

    *strstr(members, "'buffers'") = '\0';
    strcat(members, "'buffers':[{'byteLength':36}]");
    size = make_glb(glb, sizeof glb, members);
    write_file("scene.glb", glb, size);
    load_named(&s, "scene.glb");
    EXPECT_FLOATS(s.meshes[0].positions, TRIANGLE);
    scene_free(&s);

    write_file("scene.glb", glb, size - 1);
    expect_refusal("scene.glb", "the .glb header says ");
    glb[4] = 1;
    write_file("scene.glb", glb, size);
    expect_refusal("scene.glb", "version 1, not 2");
    glb[4] = 2;
    glb[13]++; /* 256 bytes more JSON than there are */
    write_file("scene.glb", glb, size);
    expect_refusal("scene.glb", "chunk 0: ");
    glb[13]--;
    glb[16] = 'j';
    write_file("scene.glb", glb, size);
    expect_refusal("scene.glb", "chunk 0 has type 0x4e4f536a, not JSON");
    glb[16] = 'J';
    glb[size - 36 - 8]++; /* the length of the binary chunk */
    write_file("scene.glb", glb, size);
    expect_refusal("scene.glb", "chunk 1: 37 bytes");
    write_file("scene.glb", glb, 11);
    expect_refusal("scene.glb", "this file 11");
    expect_refusal("none.gltf", "No such file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_triangle_without_anything, start_test),
        cmocka_unit_test_setup(strides_offsets_and_index_widths, start_test),
        cmocka_unit_test_setup(sparse_accessors, start_test),
        cmocka_unit_test_setup(normalized_and_quantized_attributes, start_test),
        cmocka_unit_test_setup(strips_fans_and_what_is_skipped, start_test),
        cmocka_unit_test_setup(primitives_that_share_accessors, start_test),
        cmocka_unit_test_setup(normals_of_other_lengths, start_test),
        cmocka_unit_test_setup(containers, start_test),
    };

    return cmocka_run_group_tests_name("gltf", tests, make_folder, remove_folder);
}
