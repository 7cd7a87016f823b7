/* test_gltf_scene.c - what the glTF reader makes of nodes, lights, cameras, animations and materials, and
 * the view that is placed where a scene has none. */
#include "gltf_maker.h"

/* --- nodes, lights, cameras --- */

static void matrices_and_trs_agree(void **state)
{
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    /* a turn by 90 degrees about Y under scales: X goes to -Z */
    load_members(&s, "'scenes':[{'nodes':[0,2]}],"
                     "'nodes':["
                     "{'translation':[1,2,3],'rotation':[0,0.70710678118654752,0,0.70710678118654752],"
                     "'scale':[2,3,-4],'children':[1]},{'mesh':0,'translation':[10,0,0]},"
                     "{'matrix':[0,0,-2,0,0,3,0,0,-4,0,0,0,1,2,3,1],'children':[3]},{'mesh':0,'translation':[10,0,0]}],"
                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}],"
                     "'bufferViews':[{'buffer':0,'byteLength':36}],'buffers':[{'uri':'data.bin','byteLength':36}]");
    assert_int_equal(s.instance_count, 2);
    assert_int_equal(s.instances[0].node, 1);
    assert_int_equal(s.instances[1].node, 3);
    DOUBLES(s.instances[1].world, 0, 0, -2, 0, 0, 3, 0, 0, -4, 0, 0, 0, 1, 2, -17, 1);
    expect_doubles(s.instances[0].world, s.instances[1].world, 16);
    DOUBLES(s.bounds_min, 1, 2, -19);
    DOUBLES(s.bounds_max, 1, 5, -17);
    scene_free(&s);
}

static void which_scene_is_taken(void **state)
{
    static const struct {
        const char *scenes;
        size_t instances;
        int first;
    } cases[] = {
        {"'scene':1,'scenes':[{'nodes':[0]},{'nodes':[3,2]}],", 2, 3},
        {"'scenes':[{'nodes':[2]},{'nodes':[0,3]}],", 1, 2},
        {"'scenes':[{}],", 0, 0},
        {"", 3, 1},
    };

    (void)state;
    FLOATS(TRIANGLE);
    for (size_t i = 0; i < COUNT(cases); i++) {
        char members[1024];
        scene s;

        snprintf(members, sizeof members,
                 "%s'nodes':[{'children':[1]},{'mesh':0},{'mesh':0},{'mesh':0}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}],"
                 "'bufferViews':[{'buffer':0,'byteLength':36}],'buffers':[{'uri':'data.bin','byteLength':36}]",
                 cases[i].scenes);
        load_members(&s, members);
        assert_int_equal(s.instance_count, cases[i].instances);
        if (s.instance_count)
            assert_int_equal(s.instances[0].node, cases[i].first);
        scene_free(&s);
    }
}

static void extras_of_nodes(void **state)
{
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    load_members(&s, "'nodes':[{'mesh':0,'extras':{'gnomon':{'casts':false}}},"
                     "{'mesh':0,'extras':{'gnomon':{'receives':false,'static':true},'other':1}},"
                     "{'mesh':0,'extras':7}],"
                     "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}],"
                     "'bufferViews':[{'buffer':0,'byteLength':36}],'buffers':[{'uri':'data.bin','byteLength':36}]");
    assert_true(!s.instances[0].casts && s.instances[0].receives && !s.instances[0].is_static);
    assert_true(s.instances[1].casts && !s.instances[1].receives && s.instances[1].is_static);
    assert_true(s.instances[2].casts && s.instances[2].receives && !s.instances[2].is_static);
    scene_free(&s);
}

static void lights_of_nodes(void **state)
{
    scene s;

    (void)state;
    load_members(
        &s, "'extensionsRequired':['KHR_lights_punctual'],'extensionsUsed':['KHR_lights_punctual','VENDOR_x'],"
            "'extensions':{'KHR_lights_punctual':{'lights':["
            "{'type':'point','color':[1,0.5,0.25],'intensity':7,'range':20},"
            "{'type':'spot','spot':{'innerConeAngle':0.1,'outerConeAngle':0.2}},"
            "{'type':'spot'},{'type':'directional','intensity':3}]}},'scenes':[{'nodes':[4,0,1]}],'nodes':["
            "{'translation':[1,2,3],'scale':[5,5,5],'extensions':{'KHR_lights_punctual':{'light':0}},'children':[2]},"
            "{'rotation':[0.70710678,0,0,0.70710678],'extensions':{'KHR_lights_punctual':{'light':1}}},"
            "{'translation':[1,0,0],'extensions':{'KHR_lights_punctual':{'light':0}},'children':[3]},"
            "{'extensions':{'KHR_lights_punctual':{'light':2}}},"
            "{'translation':[9,9,9],'scale':[1,1,7],'extensions':{'KHR_lights_punctual':{'light':3}}}]");
    assert_int_equal(s.light_count, 5);
    assert_int_equal(s.lights[0].kind, SCENE_DIRECTIONAL);
    DOUBLES(s.lights[0].position, 0, 0, 0);
    DOUBLES(s.lights[0].towards, 0, 0, 1);
    expect_near(s.lights[0].intensity, 3);
    expect_near(s.lights[0].range, 0);
    assert_int_equal(s.lights[1].kind, SCENE_POINT);
    assert_int_equal(s.lights[1].node, 0);
    DOUBLES(s.lights[1].color, 1, 0.5, 0.25);
    DOUBLES(s.lights[1].position, 1, 2, 3);
    expect_near(s.lights[1].intensity, 7);
    expect_near(s.lights[1].range, 20);
    assert_int_equal(s.lights[2].node, 2); /* the same light once more, at another node */
    DOUBLES(s.lights[2].position, 6, 2, 3);
    expect_near(s.lights[2].intensity, 7);
    assert_int_equal(s.lights[3].kind, SCENE_SPOT);
    assert_int_equal(s.lights[3].node, 3);
    expect_near(s.lights[3].inner, 0);
    expect_near(s.lights[3].outer, 0.78539816339744831);
    assert_int_equal(s.lights[4].node, 1);
    expect_near(s.lights[4].inner, 0.1);
    expect_near(s.lights[4].outer, 0.2);
    DOUBLES(s.lights[4].towards, 0, -1, 0); /* +Z turned by 90 degrees about X */
    scene_free(&s);
}

static void cameras_of_nodes(void **state)
{
    scene s;

    (void)state;
    load_members(&s, "'cameras':[{'type':'orthographic','orthographic':{'xmag':2,'ymag':-3,'znear':0,'zfar':9}},"
                     "{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1,'aspectRatio':2}},"
                     "{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1,'zfar':50}}],"
                     "'scenes':[{'nodes':[1,0]}],'nodes':[{'camera':0},{'children':[2,3]},{'scale':[2,3,5],"
                     "'rotation':[0,0.70710678118654752,0,0.70710678118654752],'translation':[4,5,6],'camera':1},"
                     "{'camera':2}]");
    assert_true(s.has_camera && !s.camera.orthographic);
    assert_int_equal(s.camera.node, 2);
    expect_near(s.camera.yfov, 0.5);
    expect_near(s.camera.znear, 0.1);
    assert_true(s.camera.zfar == 0.0);
    DOUBLES(s.camera.world, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 4, 5, 6, 1);
    scene_free(&s);

    /* shear under a parent's scale: z keeps its direction, y only its half plane */
    load_members(&s, "'cameras':[{'type':'orthographic','orthographic':{'xmag':2,'ymag':-3,'znear':0,'zfar':9}}],"
                     "'nodes':[{'matrix':[1,0,0,0, 0,2,2,0, 0,0,4,0, 0,0,0,1],'camera':0}]");
    assert_true(s.camera.orthographic);
    expect_near(s.camera.xmag, 2);
    expect_near(s.camera.ymag, -3);
    expect_near(s.camera.zfar, 9);
    DOUBLES(s.camera.world, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    scene_free(&s);

    /* no direction at all must give some orthonormal one */
    load_members(&s, "'cameras':[{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1,'zfar':50}}],"
                     "'nodes':[{'scale':[0,0,0],'translation':[1,0,0],'camera':0}]");
    expect_near(s.camera.zfar, 50);
    DOUBLES(s.camera.world, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1);
    scene_free(&s);

    /* nor may a second axis along the third, even where that is the first substitute for it */
    load_members(&s, "'cameras':[{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1,'zfar':50}}],"
                     "'nodes':[{'matrix':[1,0,0,0, 0,1,0,0, 0,1,0,0, 0,0,0,1],'camera':0}]");
    DOUBLES(s.camera.world, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    scene_free(&s);
}

/* --- animation --- */

static void expect_world_position(scene *s, double seconds, size_t instance, double x, double y, double z)
{
    scene_pose(s, seconds);
    DOUBLES(s->instances[instance].world + 12, x, y, z);
}

static void animations(void **state)
{
    const double h = 0.70710678118654752, c = 0.92387953251128674, d = 0.38268343236508977;
    scene s;

    (void)state;
    FLOATS(TRIANGLE);
    FLOATS(1, 2, 4);                                                /* 36: times */
    FLOATS(0, 0, 0, 10, 0, 0, 10, 20, 0);                           /* 48: translations */
    FLOATS(1, 1, 1, 2, 2, 2, 3, 3, 3);                              /* 84: scales */
    FLOATS(0, 0, 0, 0, 0, 0, 6, 0, 0, 3, 0, 0, 8, 0, 0, 0, 0, 0);   /* 120: two cubic keys */
    INTEGERS(2, 0, 0, 0, 32767, 0, -23170, 0, -23170);              /* 192: rotations, the long way round */
    FLOATS(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0);                     /* 208: cubic rotations */
    FLOATS(0, 0, 0, 0, 0, 0.70710678f, 0, 0.70710678f, 0, 0, 0, 0); /* 256 */
    write_gltf("'nodes':[{'mesh':0},{'mesh':0},{'mesh':0,'extras':{'gnomon':{'static':true}}},{'children':[4]},"
               "{'mesh':0,'translation':[1,0,0],'extras':{'gnomon':{'static':true}}},{'mesh':0}],"
               "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'animations':[{'samplers':["
               "{'input':1,'output':3},{'input':1,'output':4,'interpolation':'STEP'},"
               "{'input':2,'output':5,'interpolation':'CUBICSPLINE'}],'channels':["
               "{'sampler':0,'target':{'node':0,'path':'translation'}},"
               "{'sampler':1,'target':{'node':1,'path':'scale'}},{'sampler':0,'target':{'path':'translation'}},"
               "{'sampler':2,'target':{'node':2,'path':'translation'}}]},"
               "{'samplers':[{'input':2,'output':6},{'input':2,'output':7,'interpolation':'CUBICSPLINE'}],"
               "'channels':[{'sampler':0,'target':{'node':3,'path':'rotation'}},"
               "{'sampler':1,'target':{'node':5,'path':'rotation'}}]}],"
               "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
               "{'bufferView':0,'byteOffset':36,'componentType':5126,'count':3,'type':'SCALAR'},"
               "{'bufferView':0,'byteOffset':40,'componentType':5126,'count':2,'type':'SCALAR'},"
               "{'bufferView':0,'byteOffset':48,'componentType':5126,'count':3,'type':'VEC3'},"
               "{'bufferView':0,'byteOffset':84,'componentType':5126,'count':3,'type':'VEC3'},"
               "{'bufferView':0,'byteOffset':120,'componentType':5126,'count':6,'type':'VEC3'},"
               "{'bufferView':0,'byteOffset':192,'componentType':5122,'count':2,'type':'VEC4','normalized':true},"
               "{'bufferView':0,'byteOffset':208,'componentType':5126,'count':6,'type':'VEC4'}],"
               "'bufferViews':[{'buffer':0,'byteLength':304}],'buffers':[{'uri':'data.bin','byteLength':304}]");
    load_named(&s, "scene.gltf");
    expect_near(s.duration, 4);
    DOUBLES(s.instances[0].world + 12, 0, 0, 0);
    /* linear: held, on keys, between them, held; and back again in time */
    expect_world_position(&s, -5, 0, 0, 0, 0);
    expect_world_position(&s, 1.25, 0, 2.5, 0, 0);
    expect_world_position(&s, 2, 0, 10, 0, 0);
    expect_world_position(&s, 3, 0, 10, 10, 0);
    expect_world_position(&s, 4, 0, 10, 20, 0);
    expect_world_position(&s, 1e9, 0, 10, 20, 0);
    expect_world_position(&s, 1.5, 0, 5, 0, 0);
    DOUBLES(s.bounds_max, 6, 1, 0);
    /* steps */
    scene_pose(&s, 1.999);
    expect_near(s.instances[1].world[0], 1);
    scene_pose(&s, 2);
    expect_near(s.instances[1].world[0], 2);
    scene_pose(&s, 3.999);
    expect_near(s.instances[1].world[0], 2);
    scene_pose(&s, 4);
    expect_near(s.instances[1].world[0], 3);
    /* cubic: from 0 with tangent 6 to 8 with tangent 3, in 2 s: t = 1/4 and 1/2 */
    expect_world_position(&s, 2.5, 2, 12 * 0.140625 + 8 * 0.15625 + 6 * -0.046875, 0, 0);
    expect_world_position(&s, 3, 2, 12 * 0.125 + 8 * 0.5 - 6 * 0.125, 0, 0);
    expect_world_position(&s, 4, 2, 8, 0, 0);
    expect_world_position(&s, 0, 2, 0, 0, 0);
    /* slerp to 90 degrees about Y given as its negative: 22.5 degrees after a quarter, X towards -Z */
    expect_world_position(&s, 2.5, 3, c, 0, -d);
    expect_world_position(&s, 4, 3, 0, 0, -1);
    /* a cubic rotation without tangents: half way in time is half way round, and of unit length */
    scene_pose(&s, 3);
    DOUBLES(s.instances[4].world, h, 0, -h, 0, 0, 1, 0, 0, h, 0, h, 0, 0, 0, 0, 1);
    /* what is called static and moves is not; the channel without a node is passed over */
    assert_true(!s.instances[2].is_static && !s.instances[3].is_static);
    assert_int_equal(warning_count, 3);
    expect_text(warnings, "animation 0 channel 2: skipped");
    expect_text(warnings, "node 2 is called static, but node 2 is animated");
    expect_text(warnings, "node 4 is called static, but node 3 is animated");
    scene_free(&s);
}

/* --- materials --- */

static double alpha_at(const scene *s, int material, double u, double v)
{
    const double uv[2] = {u, v};

    return 255 * scene_alpha_at(s, material, uv, 1.0);
}

static void materials_and_wraps(void **state)
{
    static const uint8_t alpha[8] = {0, 40, 80, 120, 100, 140, 180, 220};
    const double nowhere[2] = {NAN, -INFINITY}, far[2] = {1e30, -1e300};
    char text[1024], members[4096];
    size_t start;
    scene s;

    (void)state;
    write_png("picture one.png", 4, 2, alpha);
    bytes.size += read_file("picture one.png", bytes.data, sizeof bytes.data);
    base64(text, bytes.data, bytes.size);
    write_file("photo.jpg", "\xff\xd8\xff\xe0 JFIF", 9);
    start = bytes.size;
    snprintf(members, sizeof members,
             "'images':[{'uri':'picture%%20one.png'},{'uri':'data:image/png;base64,%s'},"
             "{'bufferView':0,'mimeType':'image/png'},{'uri':'photo.jpg'}],"
             "'samplers':[{},{'wrapS':33071,'wrapT':33071},{'wrapS':33648,'wrapT':33648},{'magFilter':9728}],"
             "'textures':[{'source':0},{'source':1,'sampler':1},{'source':2,'sampler':2},{'source':0,'sampler':3},"
             "{'source':3},{'source':3,'sampler':1}],'materials':["
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':1}}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':2}}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':3},'baseColorFactor':[1,1,1,0.5],"
             "'metallicFactor':0.25,'roughnessFactor':0.75},'emissiveFactor':[1,2,3],'doubleSided':true,"
             "'alphaMode':'MASK','alphaCutoff':0.3,'normalTexture':{'index':4}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':4},'baseColorFactor':[1,1,1,0.125]}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':5}},'normalTexture':{'index':4}},"
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],"
             "'bufferViews':[{'buffer':0,'byteLength':%lu}],'buffers':[{'uri':'data.bin','byteLength':%lu}]",
             text, (unsigned long)start, (unsigned long)start);
    load_members(&s, members);
    assert_int_equal(s.material_count, 8);
    assert_int_equal(s.texture_count, 4);
    assert_int_equal(s.textures[0].width, 4);
    assert_int_equal(s.textures[0].height, 2);
    assert_memory_equal(s.textures[0].rgba, "\0\x80\x80\0\x0a\x80\x80\x28", 8);
    assert_int_equal(s.materials[6].texture, s.materials[0].texture);
    for (int i = 0; i < 4; i++)
        for (int t = 0; t < 8; t++)
            assert_int_equal(s.textures[i].rgba[4 * t + 3], alpha[t]);
    /* texel centres, then half way between, then over the edge */
    expect_near(alpha_at(&s, 0, 0.375, 0.25), 40);
    expect_near(alpha_at(&s, 0, 0.5, 0.25), 60);
    expect_near(alpha_at(&s, 0, 0.5, 0.5), 110);
    expect_near(alpha_at(&s, 0, 0.0, 0.25), 60);
    expect_near(alpha_at(&s, 0, -2.0, 3.25), 60);
    expect_near(alpha_at(&s, 0, 0.375, 0.0), 90);
    expect_near(alpha_at(&s, 1, 0.0, 0.25), 0);
    expect_near(alpha_at(&s, 1, -7.0, 9.0), 100);
    expect_near(alpha_at(&s, 1, 3.0, -1.0), 120);
    expect_near(alpha_at(&s, 2, 0.0, 0.25), 0);
    expect_near(alpha_at(&s, 2, 1.0 + 0.125, 0.25), 120);
    expect_near(alpha_at(&s, 2, -0.375, 1.25), 140);
    expect_near(alpha_at(&s, 2, 2.375, 0.25), 40);
    expect_near(alpha_at(&s, 3, 0.26, 0.49), 20);
    expect_near(alpha_at(&s, 3, 0.49, 0.51), 70);
    expect_near(alpha_at(&s, 4, 0.5, 0.5), 255 * 0.125);
    assert_true(isfinite(scene_alpha_at(&s, 0, nowhere, 1)) && isfinite(scene_alpha_at(&s, 2, far, 1)));
    expect_near(scene_alpha_at(&s, 4, far, 0.5), 0.0625);
    expect_near(s.materials[3].metallic, 0.25);
    expect_near(s.materials[3].roughness, 0.75);
    DOUBLES(s.materials[3].emissive, 1, 2, 3);
    assert_true(s.materials[3].double_sided && !s.materials[2].double_sided);
    assert_int_equal(s.materials[3].alpha, SCENE_MASK);
    expect_near(s.materials[3].alpha_cutoff, 0.3);
    assert_int_equal(s.materials[4].texture, SCENE_NONE);
    assert_int_equal(s.materials[5].texture, SCENE_NONE);
    assert_int_equal(warning_count, 2);
    expect_text(warnings, "image 3 (photo.jpg) is not a PNG");
    expect_text(warnings, "material 3: of its textures");
    scene_free(&s);
}

/* Three by three texels become four by four, sampled as the sampler says. */
static void other_sizes_are_resampled(void **state)
{
    static const uint8_t alpha[9] = {0, 90, 180, 0, 90, 180, 60, 150, 240};
    scene s;

    (void)state;
    write_png("three.png", 3, 3, alpha);
    load_members(&s, "'images':[{'uri':'three.png'}],'samplers':[{'wrapS':33071,'wrapT':33071},{'magFilter':9728}],"
                     "'textures':[{'source':0,'sampler':0},{'source':0,'sampler':1}],'materials':["
                     "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}},"
                     "{'pbrMetallicRoughness':{'baseColorTexture':{'index':1}}}]");
    for (int i = 0; i < 2; i++) {
        /* columns lie at -1/8, 5/8, 11/8, 17/8 of the old texels' centres; nearest takes texels 0, 1, 1, 2 */
        static const uint8_t wanted[2][4] = {{0, 56, 124, 180}, {0, 90, 90, 180}};

        assert_int_equal(s.textures[i].width, 4);
        assert_int_equal(s.textures[i].height, 4);
        for (int x = 0; x < 4; x++)
            assert_int_equal(s.textures[i].rgba[4 * x + 3], wanted[i][x]);
    }
    assert_int_equal(s.textures[0].rgba[4 * (4 * 3) + 3], 60);
    scene_free(&s);
}

/* The set that the texture names, under its KHR_texture_transform: scaled, turned, moved. */
static void texture_coordinates(void **state)
{
    static const uint8_t alpha[1] = {255};
    scene s;

    (void)state;
    write_png("one.png", 1, 1, alpha);
    FLOATS(TRIANGLE);
    FLOATS(0, 0, 1, 0, 0, 1);                  /* 36 */
    INTEGERS(2, 0, 0, 65535, 0, 13107, 26214); /* 60 */
    load_members(&s, "'nodes':[{'mesh':0}],'extensionsRequired':['KHR_texture_transform'],'meshes':[{'primitives':["
                     "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_2':2},'material':0},"
                     "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_2':2},'material':1},"
                     "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_2':2},'material':2}]}],"
                     "'images':[{'uri':'one.png'}],'textures':[{'source':0}],'materials':["
                     "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}},"
                     "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':2}}},"
                     "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':2,'extensions':{"
                     "'KHR_texture_transform':{'texCoord':0,'offset':[0,1],'rotation':1.57079632679489662,"
                     "'scale':[0.5,0.25]}}}}}],"
                     "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
                     "{'bufferView':0,'byteOffset':36,'componentType':5126,'count':3,'type':'VEC2'},"
                     "{'bufferView':0,'byteOffset':60,'componentType':5123,'count':3,'type':'VEC2','normalized':true}],"
                     "'bufferViews':[{'buffer':0,'byteLength':72}],'buffers':[{'uri':'data.bin','byteLength':72}]");
    EXPECT_FLOATS(s.meshes[0].uvs, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0.2f, 0.4f, 0, 1, 0, 0.5f, 0.25f, 1);
    scene_free(&s);
}

/* --- scene_ensure_view --- */

static void expect_seen(const scene *s, double aspect)
{
    const scene_camera *c = &s->camera;

    for (int corner = 0; corner < 8; corner++) {
        double view[3] = {0, 0, 0}, world[3];

        for (int i = 0; i < 3; i++)
            world[i] = (corner >> i & 1 ? s->bounds_max[i] : s->bounds_min[i]) - c->world[12 + i];
        for (int row = 0; row < 3; row++)
            for (int i = 0; i < 3; i++)
                view[row] += c->world[4 * row + i] * world[i];
        assert_true(-view[2] > c->znear);
        assert_true(fabs(view[1]) <= -view[2] * tan(c->yfov / 2));
        assert_true(fabs(view[0]) <= -view[2] * tan(c->yfov / 2) * aspect);
    }
}

static void expect_orthonormal(const double *m)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            expect_near(m[4 * i] * m[4 * j] + m[4 * i + 1] * m[4 * j + 1] + m[4 * i + 2] * m[4 * j + 2], i == j);
    for (int i = 0; i < 3; i++) /* right-handed */
        expect_near(m[(i + 1) % 3] * m[4 + (i + 2) % 3] - m[(i + 2) % 3] * m[4 + (i + 1) % 3], m[8 + i]);
}

static void views_that_are_placed(void **state)
{
    static const double aspects[] = {1, 4, 0.2, 0, -1, 1e30, NAN};
    scene s;

    (void)state;
    FLOATS(-100, 0, 3, 200, 7, 3, 0, 1, 90);
    for (size_t i = 0; i < COUNT(aspects); i++) {
        load_members(&s, ONE_MESH);
        assert_true(scene_ensure_view(&s, aspects[i], warn));
        assert_int_equal(warning_count, 2);
        expect_text(warnings, "no camera in the scene: placed one at (");
        expect_text(warnings, "no light in the scene: placed one at (");
        expect_orthonormal(s.camera.world);
        expect_seen(&s, aspects[i] > 0.1 && aspects[i] < 10 ? aspects[i] : 1);
        assert_true(s.light_count == 1 && s.lights[0].kind == SCENE_POINT && s.lights[0].intensity > 0);
        assert_true(s.lights[0].position[1] > s.camera.world[13]);
        scene_pose(&s, 1); /* must not move what no node carries */
        expect_seen(&s, aspects[i] > 0.1 && aspects[i] < 10 ? aspects[i] : 1);
        assert_true(scene_ensure_view(&s, 1, warn));
        assert_true(warning_count == 2 && s.light_count == 1);
        scene_free(&s);
    }
    /* nothing to see, and a camera but no light */
    load_members(&s, "'nodes':[]");
    assert_true(scene_ensure_view(&s, 1, NULL));
    expect_orthonormal(s.camera.world);
    assert_true(isfinite(s.camera.world[12]) && s.camera.znear > 0 && isfinite(s.lights[0].position[0]));
    scene_free(&s);
    load_members(&s, "'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':1}}],'nodes':[{'camera':0}]");
    assert_true(scene_ensure_view(&s, 1, warn));
    assert_int_equal(warning_count, 1);
    assert_true(s.lights[0].position[0] > 0 && s.lights[0].position[1] > 0);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(matrices_and_trs_agree, start_test),
        cmocka_unit_test_setup(which_scene_is_taken, start_test),
        cmocka_unit_test_setup(extras_of_nodes, start_test),
        cmocka_unit_test_setup(lights_of_nodes, start_test),
        cmocka_unit_test_setup(cameras_of_nodes, start_test),
        cmocka_unit_test_setup(animations, start_test),
        cmocka_unit_test_setup(materials_and_wraps, start_test),
        cmocka_unit_test_setup(other_sizes_are_resampled, start_test),
        cmocka_unit_test_setup(texture_coordinates, start_test),
        cmocka_unit_test_setup(views_that_are_placed, start_test),
    };

    return cmocka_run_group_tests_name("gltf scene", tests, make_folder, remove_folder);
}
