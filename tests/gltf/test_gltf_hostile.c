/* test_gltf_hostile.c - bad files are refused with the number that is wrong, and no bytes whatever crash the
 * reader. */
#include "gltf_maker.h"

/* --- refusals --- */

/* clang-format off */
#define MESH_OF(primitive) "'nodes':[{'mesh':0}],'meshes':[{'primitives':[" primitive "]}],"
#define POSITION_ONLY      MESH_OF("{'attributes':{'POSITION':0}}")
#define ACCESSOR(members)  "'accessors':[{'componentType':5126,'type':'VEC3'," members "}],"
#define VIEW(members)      "'bufferViews':[{'buffer':0," members "}],"
#define DATA               "'buffers':[{'uri':'data.bin','byteLength':64}]"
#define ANIMATED(node, times, values)                                                                                  \
    "'nodes':[" node "],'animations':[{'samplers':[{'input':0,'output':1}],'channels':[{'sampler':0,'target':{"        \
    "'node':0,'path':'translation'}}]}],'accessors':[{'bufferView':0,'componentType':5126,'type':'SCALAR'," times      \
    "},{'bufferView':0,'componentType':5126,'type':'VEC3'," values "}]," VIEW("'byteLength':64") DATA

/* data.bin holds 0 1 2 3, infinity, 5, NaN, seven times 0, 5 and 4, as floats. */
static const struct {
    const char *members, *part;
} refusals[] = {
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':36") VIEW("'byteLength':60") DATA,
     "accessor 0: 36 elements of 12 bytes end at 432, buffer view 0 has 60"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'byteOffset':40,'count':2") VIEW("'byteLength':60") DATA,
     "accessor 0: 2 elements of 12 bytes end at 64, buffer view 0 has 60"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60,'byteStride':25") DATA,
     "accessor 0: 3 elements of 12 bytes end at 62, buffer view 0 has 60"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60,'byteStride':8") DATA, "byteStride 8"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60,'byteStride':256") DATA,
     "byteStride is 256"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteOffset':30,'byteLength':40") DATA,
     "buffer view 0: 40 bytes from 30 on, buffer 0 has 64"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteOffset':2000000000,'byteLength':40") DATA,
     "40 bytes from 2000000000 on"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60") "'buffers':[{'byteLength':64}]",
     "buffer 0 has neither"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60")
     "'buffers':[{'uri':'data.bin','byteLength':65}]", "byteLength is 65, its data has 64 bytes"},
    {"'buffers':[{'uri':'gone.bin','byteLength':65}]", "buffer 0: "},
    {"'buffers':[{'uri':'http://example.com/a.bin','byteLength':65}]", "not a relative path"},
    {"'buffers':[{'uri':'/etc/passwd','byteLength':65}]", "not a relative path"},
    {"'buffers':[{'uri':'a%00b','byteLength':65}]", "character 1"},
    {"'buffers':[{'uri':'a%g0b','byteLength':65}]", "character 1"},
    {"'buffers':[{'uri':'.','byteLength':65}]", "not a regular file"},
    {"'buffers':[{'uri':'data:;base64,AA*A','byteLength':1}]", "character 2 of its base64"},
    {"'buffers':[{'uri':'data:;base64,AAAAA','byteLength':1}]", "base64 of 5 characters"},
    {"'buffers':[{'uri':'data:,AAAA','byteLength':1}]", "not base64"},
    {"'buffers':[{'uri':'data.bin'}]", "byteLength is missing"},
    {"'buffers':[{'uri':'data.bin','byteLength':-1}]", "byteLength is -1"},
    {"'buffers':[{'uri':'data.bin','byteLength':1.5}]", "byteLength is 1.5"},
    {POSITION_ONLY ACCESSOR("'count':4000000000") VIEW("'byteLength':60") DATA,
     "accessor 0: count is 4000000000"},
    {POSITION_ONLY ACCESSOR("'count':0") VIEW("'byteLength':60") DATA, "count is 0"},
    {POSITION_ONLY ACCESSOR("'count':1e400") VIEW("'byteLength':60") DATA, "count is inf"},
    {POSITION_ONLY "'accessors':[{'componentType':5126,'type':'VEC2','count':3}]", "accessor 0 has type VEC2"},
    {POSITION_ONLY "'accessors':[{'componentType':5125,'type':'VEC3','count':3}]", "component type 5125"},
    {POSITION_ONLY "'accessors':[{'componentType':9,'type':'VEC3','count':3}]", "component type 9"},
    {POSITION_ONLY ACCESSOR("'bufferView':0,'count':3") VIEW("'byteLength':60") DATA,
     "mesh 0 primitive 0: vertex 1: its position is not finite"},
    {POSITION_ONLY ACCESSOR("'count':3,'sparse':{'count':4,'indices':{'bufferView':0,'componentType':5121},"
                            "'values':{'bufferView':0}}") VIEW("'byteLength':60") DATA, "4 sparse elements of 3"},
    {POSITION_ONLY ACCESSOR("'count':3,'sparse':{'count':2,'indices':{'bufferView':0,'byteOffset':6,"
                            "'componentType':5121},'values':{'bufferView':0}}") VIEW("'byteLength':60") DATA,
     "accessor 0: sparse index 0 is 128, there are 3 elements"},
    {POSITION_ONLY ACCESSOR("'count':3,'sparse':{'count':2,'indices':{'bufferView':0,'componentType':5121},"
                            "'values':{'bufferView':0,'byteOffset':48}}") VIEW("'byteLength':60") DATA,
     "2 elements of 12 bytes end at 72"},
    {POSITION_ONLY ACCESSOR("'count':3,'sparse':{'count':2,'indices':{'bufferView':0,'componentType':5122},"
                            "'values':{'bufferView':0}}") VIEW("'byteLength':60") DATA, "component type 5122"},
    {POSITION_ONLY ACCESSOR("'count':3,'sparse':{'count':2}") VIEW("'byteLength':60") DATA, "lacks a buffer view"},
    {MESH_OF("{'attributes':{'POSITION':0},'indices':1}") "'accessors':[{'componentType':5126,'type':'VEC3','count':3},"
     "{'componentType':5123,'type':'SCALAR','count':3,'bufferView':0,'byteOffset':2}]," VIEW("'byteLength':60") DATA,
     "mesh 0 primitive 0: index 2 is 16256, there are 3 vertices"},
    {MESH_OF("{'attributes':{'POSITION':0,'NORMAL':1}}") "'accessors':[{'componentType':5126,'type':'VEC3','count':3},"
     "{'componentType':5126,'type':'VEC3','count':4}]", "NORMAL has 4 elements, POSITION 3"},
    {MESH_OF("{'attributes':{'POSITION':0,'COLOR_0':1}}") "'accessors':[{'componentType':5126,'type':'VEC3','count':3},"
     "{'componentType':5121,'type':'VEC3','count':3}]", "COLOR_0: accessor 1 has integers that are not normalized"},
    {MESH_OF("{'attributes':{'POSITION':3}}") "'accessors':[{},{}]", "there is no accessor 3 (the file has 2)"},
    {MESH_OF("{'attributes':{'POSITION':0},'mode':7}") ACCESSOR("'count':3") DATA, "mode is 7"},
    {MESH_OF("{'attributes':{'POSITION':0},'material':0}") ACCESSOR("'count':3") DATA, "there is no material 0"},
    {MESH_OF("{'attributes':{'POSITION':0},'targets':[]}") ACCESSOR("'count':3") DATA, "morph targets"},
    {MESH_OF("4") DATA, "mesh 0 primitive 0 is not an object"},
    {"'nodes':[{'skin':0}]", "node 0: skins are not supported"},
    {"'nodes':[{'mesh':0}]", "there is no mesh 0 (the file has 0)"},
    {"'nodes':[{'children':[1]},{},{'children':[1]}]", "node 1 has two parents, nodes 0 and 2"},
    {"'nodes':[{'children':[0]}]", "node 0 is its own child"},
    {"'nodes':[{},{'children':[2]},{'children':[1]}]", "node 1 is its own ancestor"},
    {"'nodes':[{'children':[2]},{}]", "there is no node 2 (the file has 2)"},
    {"'nodes':[{'children':[-1]},{}]", "there is no node -1"},
    {"'nodes':[{'children':[1]},{}],'scenes':[{'nodes':[1]}]", "scene 0: node 1 is no root, node 0 is its parent"},
    {"'nodes':[{},{}],'scenes':[{'nodes':[1,1]}]", "scene 0: node 1 is named twice"},
    {"'nodes':[{}],'scene':1,'scenes':[{}]", "there is no scene 1"},
    {"'nodes':[{'rotation':[0,0,0,0]}]", "node 0: its rotation has length 0"},
    {"'nodes':[{'scale':[1,1]}]", "node 0: scale has 2 numbers, not 3"},
    {"'nodes':[{'scale':[1,1,'a']}]", "scale: element 2 is not a number"},
    {"'nodes':[{'matrix':[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}]", "element 3 of its matrix is 0.5"},
    {"'nodes':[{'scale':[1e300,1,1],'children':[1]},{'scale':[1e300,1,1]}]", "node 1: its place in the world"},
    {"'nodes':[{'extras':{'gnomon':{'casts':1}}}]", "extras.gnomon: casts is neither true nor false"},
    {"'nodes':[7]", "nodes: element 0 is not an object"},
    {"'nodes':{}", "nodes is not an array"},
    {"'extensionsRequired':['KHR_lights_punctual','KHR_draco_mesh_compression']", "KHR_draco_mesh_compression"},
    {"'nodes':[{'camera':0}],'cameras':[{'type':'perspective','perspective':{'yfov':4,'znear':1}}]", "yfov is 4"},
    {"'nodes':[{'camera':0}],'cameras':[{'type':'perspective','perspective':{'yfov':1}}]", "znear is missing"},
    {"'nodes':[{'camera':0}],'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':3,'zfar':2}}]",
     "zfar is 2, not beyond znear 3"},
    {"'nodes':[{'camera':0}],'cameras':[{'type':'orthographic','orthographic':{'xmag':1,'znear':0,'zfar':2}}]",
     "ymag is missing or 0"},
    {"'nodes':[{'camera':0}],'cameras':[{'type':'fish'}]", "camera 0: type is fish"},
    {"'nodes':[{'extensions':{'KHR_lights_punctual':{'light':3}}}]", "there is no light 3"},
    {"'nodes':[{'extensions':{'KHR_lights_punctual':{'light':0}}}],'extensions':{'KHR_lights_punctual':{'lights':["
     "{'type':'area'}]}}", "light 0: type is area"},
    {"'nodes':[{'extensions':{'KHR_lights_punctual':{'light':0}}}],'extensions':{'KHR_lights_punctual':{'lights':["
     "{'type':'spot','spot':{'innerConeAngle':1}}]}}", "innerConeAngle 1 is larger"},
    {"'materials':[{'alphaMode':'DITHER'}]", "material 0: alphaMode is DITHER"},
    {"'materials':[{'pbrMetallicRoughness':{'roughnessFactor':2}}]", "roughnessFactor is 2"},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]", "there is no texture 0"},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{}}}]", "has no index"},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'textures':[{'source':0}],"
     "'images':[{'uri':'wide.png'}]", "image 0: 8193 x 1 texels, the limit is 8192"},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'textures':[{'source':0}],"
     "'images':[{'uri':'cut.png'}]", "image 0: PNG: "},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'textures':[{'source':0,'sampler':0}],"
     "'images':[{'uri':'cut.png'}],'samplers':[{'wrapS':5}]", "sampler 0: wrapS is 5"},
    {ANIMATED("{}", "'count':4", "'count':3"), "animation 0 channel 0: 3 output values for 4 keys, not 4"},
    {ANIMATED("{}", "'count':4,'byteOffset':12", "'count':4"), "channel 0: the time of key 1 is not finite"},
    {ANIMATED("{}", "'count':3,'byteOffset':52", "'count':3"), "channel 0: key 2 at 4 s is before the one at 5 s"},
    {ANIMATED("{}", "'count':2", "'count':2"), "output value 1 is not finite"},
    {ANIMATED("{'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}", "'count':2", "'count':2"),
     "animation 0 channel 0: node 0 has a matrix"},
    {"'nodes':[{}],'animations':[{'samplers':[],'channels':[{'sampler':1,'target':{'node':0,'path':'scale'}}]}]",
     "there is no sampler 1 (the animation has 0)"},
    {"'nodes':[{}],'animations':[{'samplers':[],'channels':[{'sampler':1,'target':{'node':0,'path':'weights'}}]}]",
     "animation 0 channel 0: morph targets (weights)"},
    {"'nodes':[{}],'animations':[{'samplers':[],'channels':[{'sampler':1,'target':{'node':0,'path':'colour'}}]}]",
     "target path is colour"},
    {"'nodes':[{}],'animations':[{'samplers':[{'input':0,'output':1,'interpolation':'SOFT'}],'channels':["
     "{'sampler':0,'target':{'node':0,'path':'scale'}}]}],'accessors':[{},{}]", "interpolation is SOFT"},
    {"'nodes':[{'name':'a'}", "the JSON is wrong at byte"},
    {"'nodes':[]}'", "but more follows"},
};

/* clang-format on */

static void bad_files_are_refused_by_number(void **state)
{
    static const uint8_t alpha[64] = {1, 2, 3};
    uint8_t png[2048];
    size_t size;

    (void)state;
    write_png("whole.png", 8, 8, alpha);
    size = read_file("whole.png", png, sizeof png);
    write_file("cut.png", png, size - 30);
    png[18] = 0x20, png[19] = 0x01, png[23] = 1; /* of IHDR: 8193 wide, 1 high */
    write_file("wide.png", png, size);
    FLOATS(0, 1, 2, 3, INFINITY, 5, NAN, 0, 0, 0, 0, 0, 0, 0, 5, 4);
    for (size_t i = 0; i < COUNT(refusals); i++) {
        write_gltf(refusals[i].members);
        expect_refusal("scene.gltf", refusals[i].part);
    }
    write_file("scene.gltf", "{\"asset\":{\"version\":\"1.0\"}}", 27);
    expect_refusal("scene.gltf", "glTF version 1.0, not 2.x");
    write_file("scene.gltf", "{}", 2);
    expect_refusal("scene.gltf", "asset.version");
    write_file("scene.gltf", "", 0);
    expect_refusal("scene.gltf", "byte 0");
    mkdir(path_of("folder.gltf"), 0700);
    expect_refusal("folder.gltf", "not a regular file");
    rmdir(path_of("folder.gltf"));
}

/* A name from the file cannot make a message of two lines, nor one that does not fit. */
static void names_cannot_break_messages(void **state)
{
    char members[2048] = "'extensionsRequired':['two\\nlines ";

    (void)state;
    memset(members + strlen(members), 'x', 1000);
    strcat(members, "']");
    write_gltf(members);
    expect_refusal("scene.gltf", "two?lines xxx");
}

/* --- hostile bytes --- */

static uint32_t random_next(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

/* Whatever the bytes, all that may follow a load is done, and every number that a user would trust is checked. */
static void survive(const char *name)
{
    char message[SCENE_MESSAGE];
    const double uv[2] = {0.3, 0.7};
    scene s;

    if (!load(&s, name, message)) {
        assert_true(message[0] != '\0');
        assert_null(strchr(message, '\n'));
        return;
    }
    for (int i = -1; i < 4; i++)
        scene_pose(&s, i * 0.7);
    assert_true(scene_ensure_view(&s, 1.5, NULL));
    for (size_t i = 0; i < s.mesh_count; i++) {
        const scene_mesh *m = &s.meshes[i];

        for (size_t k = 0; k < 3 * (size_t)m->triangle_count; k++)
            assert_true(m->indices[k] < m->vertex_count);
        for (size_t k = 0; k < 3 * (size_t)m->vertex_count; k++)
            assert_true(isfinite(m->positions[k]) && isfinite(m->normals[k]));
        for (size_t k = 0; k < m->range_count; k++) {
            assert_true(m->ranges[k].material >= 0 && (size_t)m->ranges[k].material < s.material_count);
            assert_true(m->ranges[k].first_triangle + m->ranges[k].triangle_count <= m->triangle_count);
        }
    }
    for (size_t i = 0; i < s.material_count; i++)
        scene_alpha_at(&s, (int)i, uv, 0.5);
    scene_free(&s);
}

/* Everything at once: sparse, animated, lit, textured. Its data is `bytes`, named by `uri` or in the .glb. */
static void make_everything(char *members, size_t capacity, const char *uri)
{
    static const uint8_t alpha[9] = {9, 8, 7, 6, 5, 4, 3, 2, 1};
    size_t size;

    write_png("any.png", 3, 3, alpha);
    bytes.size = 0;
    FLOATS(TRIANGLE, 0, 0, 1);
    INTEGERS(2, 0, 1, 2, 2, 1, 3);  /* 48 */
    INTEGERS(2, 1, 3);              /* 60 */
    FLOATS(0, 1);                   /* 64 */
    FLOATS(0, 0, 0, 1, 0, 1, 0, 0); /* 72 */
    size = read_file("any.png", bytes.data + 104, sizeof bytes.data - 104);
    bytes.size = 104 + size;
    snprintf(
        members, capacity,
        "'scene':0,'scenes':[{'nodes':[0,3]}],'nodes':[{'children':[1,2],'rotation':[0,0,0,1]},{'mesh':0},"
        "{'camera':0,'translation':[0,1,2]},{'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,3,4,5,1],"
        "'extensions':{'KHR_lights_punctual':{'light':0}},'extras':{'gnomon':{'casts':false}}}],"
        "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'spot','spot':{'innerConeAngle':0.2}}]}},"
        "'cameras':[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':90}}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':3,'TEXCOORD_0':4},'indices':1,'material':0},"
        "{'attributes':{'POSITION':0},'mode':5}]}],'materials':[{'alphaMode':'MASK','pbrMetallicRoughness':{"
        "'baseColorTexture':{'index':0}}}],'textures':[{'source':0,'sampler':0}],'images':[{'bufferView':2}],"
        "'samplers':[{'wrapS':33648}],'animations':[{'samplers':[{'input':5,'output':6}],"
        "'channels':[{'sampler':0,'target':{'node':0,'path':'rotation'}}]}],'accessors':["
        "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"
        "{'bufferView':1,'componentType':5123,'count':6,'type':'SCALAR'},{},"
        "{'componentType':5126,'count':4,'type':'VEC3','sparse':{'count':2,'indices':{'bufferView':1,"
        "'byteOffset':12,'componentType':5123},'values':{'bufferView':0,'byteOffset':12}}},"
        "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC2'},"
        "{'bufferView':1,'byteOffset':16,'componentType':5126,'count':2,'type':'SCALAR'},"
        "{'bufferView':1,'byteOffset':24,'componentType':5126,'count':2,'type':'VEC4'}],"
        "'bufferViews':[{'buffer':0,'byteLength':48},{'buffer':0,'byteOffset':48,'byteLength':56},"
        "{'buffer':0,'byteOffset':104,'byteLength':%lu}],'buffers':[{%s'byteLength':%lu}]",
        (unsigned long)size, uri, (unsigned long)bytes.size);
}

static void mutate(const char *name, const uint8_t *good, size_t size, uint32_t seed, int rounds)
{
    static uint8_t bad[32768];

    for (size_t length = 0; length < size; length++) {
        write_file(name, good, length);
        survive(name);
    }
    for (int i = 0; i < rounds; i++) {
        /* values that mean something in JSON and in lengths are tried as often as all others together */
        static const uint8_t telling[] = "0123456789.-e,[]{}\":\x00\xff\x7f\x80";
        const uint32_t flips = 1 + random_next(&seed) % 3;

        memcpy(bad, good, size);
        for (uint32_t f = 0; f < flips; f++) {
            const uint32_t at = random_next(&seed) % (uint32_t)size, r = random_next(&seed);

            bad[at] = r & 1 ? telling[(r >> 8) % (sizeof telling - 1)] : (uint8_t)(r >> 8);
        }
        write_file(name, bad, size);
        survive(name);
    }
}

static void mutated_files_never_crash(void **state)
{
    static char members[8192], uri[4096], text[16384];
    static uint8_t good[16384];
    size_t size;
    scene s;

    (void)state;
    make_everything(members, sizeof members, "");
    size = make_glb(good, sizeof good, members);
    write_file("scene.glb", good, size);
    load_named(&s, "scene.glb");
    assert_true(s.instance_count == 1 && s.light_count == 1 && s.has_camera && s.texture_count == 1);
    assert_true(s.duration == 1 && s.meshes[0].triangle_count == 4 && s.meshes[0].vertex_count == 4 + 6);
    scene_free(&s);
    mutate("scene.glb", good, size, 0x9e3779b9u, 4000);

    strcpy(uri, "'uri':'data:application/octet-stream;base64,");
    base64(uri + strlen(uri), bytes.data, bytes.size);
    strcat(uri, "',");
    make_everything(members, sizeof members, uri);
    size = make_json(text, sizeof text, members);
    write_file("scene.gltf", text, size);
    load_named(&s, "scene.gltf");
    scene_free(&s);
    mutate("scene.gltf", (const uint8_t *)text, size, 0x85ebca6bu, 4000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(bad_files_are_refused_by_number, start_test),
        cmocka_unit_test_setup(names_cannot_break_messages, start_test),
        cmocka_unit_test_setup(mutated_files_never_crash, start_test),
    };

    return cmocka_run_group_tests_name("gltf hostile", tests, make_folder, remove_folder);
}
