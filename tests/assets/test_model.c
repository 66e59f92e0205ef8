// Tests loading models: compares the scene descriptions with the content of the model files.
#include "assets/model_parts.h"
#include "renderer/scene/renderer.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static DipModel *load(const char *path, DipPool *pool, DipErrorList *warnings) {
    DipError err = {0};
    DipModel *model = dip_model_load(&path, 1, pool, warnings, &err);
    if (!model) {
        fail_msg("%s: %s", err.file, err.message);
    }
    return model;
}

static const DipMeshDef *mesh_of(const DipSceneDef *def, int object) {
    return &def->meshes[def->objects[object].mesh];
}

static const DipMaterialDef *material_of(const DipSceneDef *def, int object) {
    return &def->materials[mesh_of(def, object)->material];
}

static int find_object(const DipSceneDef *def, const char *name) {
    for (int i = 0; i < def->object_count; ++i) {
        if (strcmp(def->objects[i].name, name) == 0) {
            return i;
        }
    }
    fail_msg("no object %s", name);
    return -1;
}

// Three of the courtyard's 21 pictures are normal maps. Their files are named *_n.*.
static void normal_maps_are_loaded_only_on_request(void **state) {
    (void)state;
    DipModel *model = load(DIP_ASSETS_DIR "/courtyard/court.gltf", NULL, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->texture_count, 18);
    for (int i = 0; i < def->material_count; ++i) {
        assert_int_equal(def->materials[i].normal_map, DIP_NO_TEXTURE);
    }
    for (int i = 0; i < def->texture_count; ++i) {
        assert_null(strstr(def->textures[i].name, "_n."));
    }
    dip_model_destroy(&model);
}

// Computes the world position of a corner of one of an object's triangles.
static void corner_world(const DipSceneDef *def, int object, uint32_t corner, double to[3]) {
    const DipMeshDef *mesh = mesh_of(def, object);
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[corner];
    const float *m = def->objects[object].transform;
    for (int row = 0; row < 3; ++row) {
        to[row] = (double)m[4 * row] * p[0] + (double)m[4 * row + 1] * p[1] +
                  (double)m[4 * row + 2] * p[2] + m[4 * row + 3];
    }
}

// Returns the z component of the world normal of the object's first triangle. The normal follows
// from the winding of its corners.
static double winding_z(const DipSceneDef *def, int object) {
    double a[3], b[3], c[3];
    corner_world(def, object, 0, a);
    corner_world(def, object, 1, b);
    corner_world(def, object, 2, c);
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Returns true if a camera in front of the object's first corner sees the object when all surfaces
// are single-sided.
static bool faces_forward(const DipSceneDef *def, int object) {
    DipMaterialDef materials[8];
    DipSceneDef alone = *def;
    double corner[3];
    assert_true(def->material_count <= 8);
    memcpy(materials, def->materials, (size_t)def->material_count * sizeof *materials);
    for (int i = 0; i < def->material_count; i++) {
        materials[i].double_sided = false;
        materials[i].surface = DIP_SURFACE_OPAQUE;
    }
    alone.materials = materials;
    alone.objects = &def->objects[object];
    alone.object_count = 1;
    corner_world(def, object, 0, corner);
    const DipPose pose = {.position_world = {corner[0], corner[1], corner[2] + 4.0},
                          .orientation = {0.0, 0.0, 0.0, 1.0},
                          .fov_y_deg = 60.0};
    DipRendererDef renderer_def = dip_renderer_default_def();
    renderer_def.pool = dip_pool_create(1, NULL);
    DipScene *scene = dip_scene_create(&alone, NULL, NULL);
    DipRenderer *renderer = dip_renderer_create(&renderer_def, NULL);
    DipFrame frame;
    assert_true(dip_renderer_draw(renderer, scene, &pose, 0, &frame, NULL));
    const bool seen = frame.counters.triangles_drawn > 0;
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&scene);
    dip_pool_destroy(&renderer_def.pool);
    return seen;
}

// Returns the first material with the name.
static const DipMaterialDef *find_material(const DipSceneDef *def, const char *name) {
    for (int i = 0; i < def->material_count; ++i) {
        if (strcmp(def->materials[i].name, name) == 0) {
            return &def->materials[i];
        }
    }
    fail_msg("no material %s", name);
    return NULL;
}

static void the_courtyard_is_loaded_completely(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipPool *pool = dip_pool_create(2, NULL);
    const char *path = DIP_ASSETS_DIR "/courtyard/court.gltf";
    DipModel *model = dip_model_load_with_normals(&path, 1, pool, &warnings, NULL);
    assert_non_null(model);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(warnings.count, 0);
    // These are the numbers that assets/author/gltf.py prints. Each primitive of a glTF mesh is a
    // mesh of the scene.
    assert_int_equal(def->mesh_count, 182);
    assert_int_equal(def->object_count, 541);
    uint64_t triangles = 0;
    uint64_t stored = 0;
    for (int i = 0; i < def->object_count; ++i) {
        triangles += mesh_of(def, i)->index_count / 3;
    }
    for (int i = 0; i < def->mesh_count; ++i) {
        stored += def->meshes[i].index_count / 3;
    }
    assert_int_equal(triangles, 35783);
    assert_int_equal(stored, 15417);
    // The folder has 21 pictures, and each is one texture.
    assert_int_equal(def->texture_count, 21);
    static const struct {
        const char *name;
        DipSurface surface;
        bool light_mapped;
        bool double_sided;
        bool lit;
    } expected[] = {
        {"paving", DIP_SURFACE_OPAQUE, true, false, false},
        {"iron", DIP_SURFACE_OPAQUE, true, false, false},
        {"glass", DIP_SURFACE_OPAQUE, true, false, false},
        {"water", DIP_SURFACE_WATER, true, false, false},
        {"fence", DIP_SURFACE_CLIPPED, false, true, true},
        {"leaf", DIP_SURFACE_CLIPPED, false, true, true},
        {"flower", DIP_SURFACE_CLIPPED, false, true, true},
        {"sky", DIP_SURFACE_SKY, false, false, false},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i) {
        const DipMaterialDef *material = find_material(def, expected[i].name);
        assert_int_equal(material->surface, expected[i].surface);
        assert_int_equal(material->light_map >= 0, expected[i].light_mapped);
        assert_int_equal(material->double_sided, expected[i].double_sided);
        assert_int_equal(material->lit, expected[i].lit);
        if (expected[i].light_mapped) {
            assert_true(material->light_map_scale == 2.0f);
            assert_non_null(strstr(def->textures[material->light_map].name, "light.jpg"));
        }
    }
    for (int i = 0; i < def->mesh_count; ++i) {
        const bool light_mapped = def->materials[def->meshes[i].material].light_map >= 0;
        assert_int_equal(def->meshes[i].uv1 != NULL, light_mapped);
    }
    const DipMaterialDef *iron = find_material(def, "iron");
    assert_int_equal(iron->colour_texture, DIP_NO_TEXTURE);
    assert_true(fabsf(iron->base_colour_lin[2] - 0.026f) < 1e-6f);
    const DipMaterialDef *water = find_material(def, "water");
    assert_true(fabsf(water->transmission - 0.7f) < 1e-6f);
    assert_true(water->opacity == 1.0f && iron->transmission == 0.0f);
    const DipMaterialDef *setts = find_material(def, "setts");
    assert_int_equal(def->textures[setts->normal_map].encoding, DIP_ENCODING_LINEAR);
    assert_int_equal(def->textures[setts->colour_texture].encoding, DIP_ENCODING_SRGB);
    dip_model_destroy(&model);
    assert_null(model);
    dip_pool_destroy(&pool);
    dip_error_list_free(&warnings);
}

// Columns in the same light share a mesh. So do the panels of the fence.
static void repeated_parts_of_the_courtyard_share_meshes(void **state) {
    (void)state;
    DipModel *model = load(DIP_ASSETS_DIR "/courtyard/court.gltf", NULL, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    static const struct {
        const char *name;
        int count;
    } repeated[] = {
        {"column_near_east", 4}, {"fence_panel", 4}, {"pier", 4}, {"belfry_baluster", 28}};
    for (size_t r = 0; r < sizeof repeated / sizeof repeated[0]; ++r) {
        const int mesh = def->objects[find_object(def, repeated[r].name)].mesh;
        int count = 0;
        for (int i = 0; i < def->object_count; ++i) {
            count += def->objects[i].mesh == mesh;
        }
        assert_int_equal(count, repeated[r].count);
    }
    dip_model_destroy(&model);
}

// The file's corner (0, 0, 0) has texture coordinate (0, 1), the picture's lower edge.
static void assert_square_is_upright(const DipMeshDef *mesh) {
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->index_count, 6);
    for (uint32_t i = 0; i < 4; ++i) {
        assert_true(fabsf(mesh->uv0[2 * i] - mesh->positions[3 * i]) < 1e-6f);
        assert_true(fabsf(mesh->uv0[2 * i + 1] - (1.0f - mesh->positions[3 * i + 1])) < 1e-6f);
        assert_true(mesh->normals[3 * i + 2] == 1.0f);
    }
}

static void assert_square_material(const DipSceneDef *def) {
    assert_square_is_upright(mesh_of(def, 0));
    const DipMaterialDef *material = material_of(def, 0);
    assert_int_equal(material->surface, DIP_SURFACE_CLIPPED);
    assert_true(material->alpha_cutoff == 0.25f);
    assert_true(material->double_sided);
    assert_true(material->lit); // Without extras the occlusion picture is not a light map.
    assert_int_equal(material->light_map, DIP_NO_TEXTURE);
    assert_true(material->base_colour_lin[1] == 0.25f);
    const DipTextureDef *texture = &def->textures[material->colour_texture];
    const uint8_t first[8] = {255, 0, 0, 255, 0, 255, 0, 255};
    assert_memory_equal(texture->rgba8, first, sizeof first);
    assert_int_equal(texture->width * texture->height, 4);
    assert_int_equal(texture->wrap_u, DIP_WRAP_CLAMP);
    assert_int_equal(texture->wrap_v, DIP_WRAP_REPEAT);
}

static void a_gltf_file_with_an_embedded_picture_loads(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("square.gltf"), NULL, NULL);
    assert_square_material(dip_model_scene_def(model));
    dip_model_destroy(&model);
}

static void put_u32(uint8_t *to, size_t value) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

// The square of square.gltf as one binary file: a JSON chunk, and a binary chunk with the arrays
// and the PNG.
static const char glb_json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"mesh\":0,\"name\":\"square\"}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},"
    "\"material\":0}]}],"
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.25,1,1],"
    "\"baseColorTexture\":{\"index\":0}},\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25,"
    "\"doubleSided\":true}],"
    "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"wrapS\":33071}],"
    "\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":2}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":6,\"type\":\"VEC2\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":72},"
    "{\"buffer\":0,\"byteOffset\":72,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":120,\"byteLength\":76}],"
    "\"buffers\":[{\"byteLength\":196}]}";

static void a_glb_file_with_an_embedded_picture_loads(void **state) {
    (void)state;
    static const float positions[18] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    static const float uv[12] = {0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0};
    const size_t json_bytes = (sizeof glb_json - 1 + 3) / 4 * 4;
    const size_t size_bytes = 20 + json_bytes + 8 + 196;
    uint8_t glb[2048];
    assert_true(size_bytes <= sizeof glb);
    memset(glb, ' ', sizeof glb);
    memcpy(glb, "glTF", 4);
    put_u32(glb + 4, 2);
    put_u32(glb + 8, size_bytes);
    put_u32(glb + 12, json_bytes);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, glb_json, sizeof glb_json - 1);
    uint8_t *binary = glb + 20 + json_bytes;
    put_u32(binary, 196);
    memcpy(binary + 4, "BIN", 4);
    memcpy(binary + 8, positions, sizeof positions);
    memcpy(binary + 80, uv, sizeof uv);
    memcpy(binary + 128, fixture_png, sizeof fixture_png);
    fixture_write("square.glb", glb, size_bytes);
    DipModel *model = load(fixture_path("square.glb"), NULL, NULL);
    assert_square_material(dip_model_scene_def(model));
    dip_model_destroy(&model);
}

// An FBX file names its embedded pictures by their paths on another machine.
static void embedded_pictures_are_found_by_name(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_data("embedded.fbx"), NULL, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    // assimp's warnings say what the small file leaves out.
    for (size_t i = 0; i < warnings.count; ++i) {
        const bool last = i == warnings.count - 1; // Counts the warnings that are left out.
        assert_non_null(strstr(warnings.items[i].message, last ? "more warnings" : "FBX-DOM"));
    }
    dip_error_list_free(&warnings);
    assert_int_equal(def->texture_count, 2);
    static const struct {
        const char *object;
        uint8_t rgba8[4];
    } expected[2] = {{"first", {10, 20, 30, 255}}, {"second", {40, 50, 60, 255}}};
    for (size_t i = 0; i < 2; ++i) {
        const DipMaterialDef *material = material_of(def, find_object(def, expected[i].object));
        assert_in_range(material->colour_texture, 0, 1);
        assert_memory_equal(def->textures[material->colour_texture].rgba8, expected[i].rgba8, 4);
    }
    dip_model_destroy(&model);
}

// Two triangles have a common edge but separate areas of the light map. Their vertices at this edge
// have equal positions and different second texture coordinates, so they must not be merged.
static void seams_of_light_maps_are_kept(void **state) {
    (void)state;
    static const float uv1[6][2] = {{0.125f, 0.25f}, {0.25f, 0.25f},  {0.25f, 0.125f},
                                    {0.625f, 0.75f}, {0.75f, 0.625f}, {0.625f, 0.625f}};
    DipModel *model = load(fixture_data("seam.gltf"), NULL, NULL);
    const DipMeshDef *mesh = mesh_of(dip_model_scene_def(model), 0);
    assert_int_equal(mesh->vertex_count, 6);
    for (uint32_t corner = 0; corner < 6; ++corner) {
        const float *at = mesh->uv1 + 2 * (size_t)mesh->indices[corner];
        assert_true(at[0] == uv1[corner][0] && at[1] == uv1[corner][1]);
    }
    dip_model_destroy(&model);
}

static void every_node_with_a_mesh_becomes_an_object(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("instances.gltf"), NULL, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 4);
    const int plain = find_object(def, "plain");
    const int moved = find_object(def, "moved");
    const int mirrored = find_object(def, "mirrored");
    const int child = find_object(def, "child");
    assert_int_equal(def->objects[plain].mesh, def->objects[moved].mesh);
    const float *m = def->objects[moved].transform;
    assert_true(m[3] == 2.0f && m[7] == 3.0f && m[11] == 4.0f);
    // The mirrored node shares the mesh. glTF says that mirroring reverses the winding in world
    // space. The renderer reverses the winding again (docs/picture.md, Coverage).
    assert_int_equal(def->objects[mirrored].mesh, def->objects[plain].mesh);
    assert_true(winding_z(def, plain) > 0.0);
    assert_true(winding_z(def, mirrored) < 0.0);
    assert_true(faces_forward(def, plain) && faces_forward(def, mirrored));
    // A child inherits the transform and the tag of its parent.
    const float *c = def->objects[child].transform;
    assert_true(c[0] == 2.0f && c[3] == 10.0f && c[7] == 1.0f);
    assert_int_equal(material_of(def, child)->surface, DIP_SURFACE_SKY);
    dip_model_destroy(&model);
}

static void extras_choose_the_kind_of_surface(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_data("tags.gltf"), NULL, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    static const struct {
        const char *name;
        DipSurface surface;
        bool light_mapped;
        bool lit;
    } expected[] = {
        {"solid", DIP_SURFACE_OPAQUE, true, false},  {"mask", DIP_SURFACE_CLIPPED, false, true},
        {"glass", DIP_SURFACE_OPAQUE, false, false}, {"water", DIP_SURFACE_WATER, false, false},
        {"sky", DIP_SURFACE_SKY, false, false},      {"odd", DIP_SURFACE_OPAQUE, false, true},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i) {
        const DipMaterialDef *material = material_of(def, find_object(def, expected[i].name));
        assert_int_equal(material->surface, expected[i].surface);
        assert_int_equal(material->light_map >= 0, expected[i].light_mapped);
        assert_int_equal(material->lit, expected[i].lit);
    }
    const DipMeshDef *solid = mesh_of(def, find_object(def, "solid"));
    assert_true(fabsf(solid->uv1[1] - 0.75f) < 1e-6f && solid->uv1[0] == 0.25f);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].key, "odd");
    assert_non_null(strstr(warnings.items[0].message, "jelly"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void a_required_material_extension_gives_a_warning(void **state) {
    (void)state;
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("square.gltf"), &size_bytes);
    static const char required[] = "{\"extensionsRequired\":[\"KHR_materials_anisotropy\"],";
    char *text = malloc(sizeof required + size_bytes);
    memcpy(text, required, sizeof required - 1);
    memcpy(text + sizeof required - 1, bytes + 1, size_bytes - 1); // without the first brace
    fixture_write("anisotropy.gltf", text, sizeof required - 1 + size_bytes - 1);
    free(text);
    free(bytes);
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_path("anisotropy.gltf"), NULL, &warnings);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].key, "extensionsRequired");
    assert_string_equal(warnings.items[0].message,
                        "the effect of the glTF extension KHR_materials_anisotropy is not drawn");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void an_opacity_picture_becomes_alpha(void **state) {
    (void)state;
    fixture_copy("square.obj");
    fixture_copy("square.mtl");
    fixture_write_tga("colour.tga", 2, 2, 100);
    fixture_write_tga("opacity.tga", 1, 1, 0);
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_path("square.obj"), NULL, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_square_is_upright(mesh_of(def, 0)); // In OBJ, v starts at the lower edge.
    const DipMaterialDef *material = material_of(def, 0);
    assert_int_equal(material->surface, DIP_SURFACE_CLIPPED);
    assert_true(material->double_sided);
    // A black base colour under a texture counts as white.
    assert_true(material->base_colour_lin[0] == 1.0f);
    const uint8_t texel[4] = {100, 100, 100, 0};
    assert_memory_equal(def->textures[material->colour_texture].rgba8, texel, 4);
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

static void a_missing_picture_gives_a_warning(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_data("square.obj"), NULL, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(material_of(def, 0)->colour_texture, DIP_NO_TEXTURE);
    assert_int_equal(material_of(def, 0)->surface, DIP_SURFACE_OPAQUE);
    assert_int_equal(warnings.count, 2);
    assert_int_equal(warnings.error_count, 0);
    assert_non_null(strstr(warnings.items[0].message, "colour.tga"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// The materials of an X file may stand at its top, before or after the meshes that name them.
static void materials_of_x_files_may_be_named_by_reference(void **state) {
    (void)state;
    static const char red[] = "Material Red {\n1;0;0;1;;\n0;\n0;0;0;;\n0;0;0;;\n}\n";
    static const char mesh[] = "Mesh m {\n3;\n0;0;0;,\n1;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\n"
                               "MeshMaterialList {\n1;\n1;\n0;;\n{ Red }\n}\n}\n";
    for (int after = 0; after < 2; ++after) {
        char text[512];
        snprintf(text, sizeof text, "xof 0303txt 0032\n%s%s", after ? mesh : red,
                 after ? red : mesh);
        fixture_write_text("reference.x", text);
        const DipMaterialRule rule = {.mark = DIP_MARK_GLASS, .pattern = "Red"};
        const DipModelOptions options = {.rules = &rule, .rule_count = 1};
        const char *path = fixture_path("reference.x");
        DipErrorList warnings = {0};
        DipModel *model = dip_model_load_with(&path, 1, &options, NULL, &warnings, NULL);
        assert_non_null(model);
        const DipMaterialDef *material = material_of(dip_model_scene_def(model), 0);
        assert_string_equal(material->name, "Red");
        assert_true(material->base_colour_lin[0] == 1.0f && material->base_colour_lin[1] == 0.0f);
        assert_false(material->lit); // The rule makes it glass.
        assert_int_equal(warnings.count, 0);
        dip_model_destroy(&model);
    }
}

// A rule that only marks what nobody sees is probably a mistake.
static void a_rule_that_no_surface_uses_gives_a_warning(void **state) {
    (void)state;
    static const char text[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"materials\":[{\"name\":\"seen\"},{\"name\":\"spare\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}";
    fixture_write_text("spare.gltf", text);
    const DipMaterialRule rules[] = {{.mark = DIP_MARK_GLASS,
                                      .pattern = "se*",
                                      .file = "a.ini",
                                      .line = 3,
                                      .key = "MATERIAL_GLASS"},
                                     {.mark = DIP_MARK_WATER,
                                      .pattern = "spare",
                                      .file = "a.ini",
                                      .line = 4,
                                      .key = "MATERIAL_WATER"}};
    const DipModelOptions options = {.rules = rules, .rule_count = 2};
    const char *path = fixture_path("spare.gltf");
    DipErrorList warnings = {0};
    DipModel *model = dip_model_load_with(&path, 1, &options, NULL, &warnings, NULL);
    assert_non_null(model);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.items[0].file, "a.ini");
    assert_int_equal(warnings.items[0].line, 4);
    assert_string_equal(warnings.items[0].message,
                        "'spare' fits only materials that no surface uses");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// A file may give any number of warnings. Those that are left out are counted.
static void many_warnings_of_assimp_are_counted(void **state) {
    (void)state;
    static const int materials[] = {8, 9, 12};
    fixture_write_text("many.mtl", "newmtl paint\n");
    for (int i = 0; i < 3; ++i) {
        char text[1024] = "mtllib many.mtl\no made\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", last[64];
        for (int m = 0; m < materials[i]; ++m) {
            snprintf(text + strlen(text), sizeof text - strlen(text), "usemtl u%d\nf 1 2 3\n", m);
        }
        fixture_write_text("many.obj", text);
        DipErrorList warnings = {0};
        DipModel *model = load(fixture_path("many.obj"), NULL, &warnings);
        assert_int_equal(warnings.count, materials[i] > 8 ? 9 : 8);
        snprintf(last, sizeof last, "assimp gives %d more warnings", materials[i] - 8);
        assert_int_equal(strstr(warnings.items[warnings.count - 1].message, last) != NULL,
                         materials[i] > 8);
        dip_error_list_free(&warnings);
        dip_model_destroy(&model);
    }
}

// Writes a triangle that lists a number of unknown extensions. Returns the name of its file.
static const char *write_extensions(const char *list, const char *first, int count) {
    char text[4096];
    size_t length = (size_t)snprintf(
        text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"%s\":[\"%s\"", list, first);
    for (int i = 1; i < count; ++i) {
        length += (size_t)snprintf(text + length, sizeof text - length, ",\"KHR_materials_%d\"", i);
    }
    snprintf(text + length, sizeof text - length,
             "],\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
             "\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}");
    fixture_write_text("extensions.gltf", text);
    return fixture_path("extensions.gltf");
}

// Any number of extensions may be listed, but only some are named. A file that needs more than can
// be checked is refused.
static void too_many_extensions_are_told(void **state) {
    (void)state;
    for (int count = 64; count <= 65; ++count) {
        DipErrorList warnings = {0};
        DipModel *model =
            load(write_extensions("extensionsUsed", "KHR_materials_0", count), NULL, &warnings);
        assert_int_equal(warnings.count, count);
        assert_int_equal(strstr(warnings.items[count - 1].message, "more than 64") != NULL,
                         count > 64);
        dip_error_list_free(&warnings);
        dip_model_destroy(&model);
        const char *path = write_extensions("extensionsRequired", "KHR_materials_0", count);
        DipError err = {0};
        model = dip_model_load(&path, 1, NULL, NULL, &err);
        assert_int_equal(model != NULL, count == 64);
        assert_true(model || (err.code == DIP_ERROR_UNSUPPORTED &&
                              strcmp(err.key, "extensionsRequired") == 0));
        dip_model_destroy(&model);
    }
}

static void points_and_lines_give_a_warning_with_their_number(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load(fixture_data("lines.obj"), NULL, &warnings);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 1);
    assert_int_equal(mesh_of(def, 0)->index_count, 3);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.items[0].message, "2 points and lines"));
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void ply_colours_become_linear(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("square.ply"), NULL, NULL);
    const DipMeshDef *mesh = mesh_of(dip_model_scene_def(model), 0);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        const float *p = mesh->positions + 3 * i;
        // The sRGB value 188 / 255 stands for the light 0.5029 (IEC 61966-2-1).
        const float red = p[0] == 0.0f && p[1] == 1.0f ? 0.5029f : 1.0f;
        assert_true(fabsf(mesh->colours_lin[3 * i] - red) < 1e-3f);
        assert_true(mesh->colours_lin[3 * i + 1] == 0.0f);
    }
    dip_model_destroy(&model);
}

static void stl_and_x_files_load_together(void **state) {
    (void)state;
    const char *files[2] = {fixture_data("triangle.stl"), fixture_data("square.x")};
    DipModel *model = dip_model_load(files, 2, NULL, NULL, NULL);
    assert_non_null(model);
    const DipSceneDef *def = dip_model_scene_def(model);
    assert_int_equal(def->object_count, 2);
    assert_int_equal(mesh_of(def, 0)->index_count, 3);
    assert_int_equal(mesh_of(def, 1)->index_count, 6);
    // The frame in the X file has a matrix that moves the square to x = 5..6.
    double corner[3];
    corner_world(def, 1, 0, corner);
    assert_true(corner[0] >= 5.0 && corner[0] <= 6.0);
    dip_model_destroy(&model);
}

static const char cube_ply[] =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
    "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 -1\n-1 -1 1\n-1 1 -1\n-1 1 1\n1 -1 -1\n1 -1 1\n1 1 -1\n1 1 1\n"
    "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n";

// A roof. Each half slopes by 20 degrees, so the angle between their normals is 40 degrees.
static const char roof_ply[] =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 1 0\n0 1 1\n1 0.63603 0\n1 0.63603 1\n-1 0.63603 0\n-1 0.63603 1\n"
    "4 0 1 3 2\n4 0 4 5 1\n";

// In both files, faces share vertices, and there are no normals. The cube's edges must stay sharp.
// The roof is so flat that its ridge must become smooth.
static void missing_normals_are_computed(void **state) {
    (void)state;
    fixture_write_text("cube.ply", cube_ply);
    DipModel *model = load(fixture_path("cube.ply"), NULL, NULL);
    const DipMeshDef *mesh = mesh_of(dip_model_scene_def(model), 0);
    assert_int_equal(mesh->vertex_count, 24);
    for (uint32_t i = 0; i < mesh->index_count; ++i) {
        const uint32_t *face = mesh->indices + i / 3 * 3;
        for (int axis = 0; axis < 3; ++axis) {
            // Each face is perpendicular to one axis. On this axis, its corners have the same
            // coordinate, -1 or 1, and the normal has the same component.
            const float at = mesh->positions[3 * face[0] + axis];
            const bool own = at == mesh->positions[3 * face[1] + axis] &&
                             at == mesh->positions[3 * face[2] + axis];
            assert_true(mesh->normals[3 * mesh->indices[i] + axis] == (own ? at : 0.0f));
        }
    }
    dip_model_destroy(&model);
    fixture_write_text("roof.ply", roof_ply);
    model = load(fixture_path("roof.ply"), NULL, NULL);
    mesh = mesh_of(dip_model_scene_def(model), 0);
    assert_int_equal(mesh->vertex_count, 6);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        const float x = mesh->positions[3 * i];
        assert_true(fabsf(mesh->normals[3 * i] - x * 0.34202f) < 1e-5f); // sin 20 degrees
        assert_true(x != 0.0f || mesh->normals[3 * i + 1] == 1.0f);
    }
    dip_model_destroy(&model);
}

// assimp reads these files, but its later processing steps fail. The STL file has an empty solid.
// For the RAW file, assimp 5.2 creates a root node with two children and leaves one child unset.
static void files_load_even_if_assimp_cannot_process_them(void **state) {
    (void)state;
    fixture_write_text("gap.stl", "solid full\nfacet normal 0 0 1\nouter loop\nvertex 1 1 0\n"
                                  "vertex -1 1 0\nvertex 0 -1 0\nendloop\nendfacet\nendsolid\n"
                                  "solid empty\nendsolid\n");
    fixture_write_text("gap.raw", "Hans\n0.5 0.5 0.5 0 0 0 0 1 0 1 0 0\n"
                                  "0.1 0 0 0 0 3 0 1 3 1 0 3\n");
    const char *const names[2] = {"gap.stl", "gap.raw"};
    for (int i = 0; i < 2; ++i) {
        DipModel *model = load(fixture_path(names[i]), NULL, NULL);
        const DipSceneDef *def = dip_model_scene_def(model);
        assert_int_equal(def->object_count, 1);
        assert_int_equal(mesh_of(def, 0)->index_count, 3 * (i + 1));
        dip_model_destroy(&model);
    }
}

// Models of no size or of an enormous size get a near plane that a scene accepts.
static void near_distances_are_those_that_scenes_accept(void **state) {
    (void)state;
    DipModelBounds bounds = {.diagonal = 0.0};
    assert_true(dip_model_near_distance(&bounds) == DIP_MIN_NEAR_M);
    bounds.diagonal = 1e30;
    assert_true(dip_model_near_distance(&bounds) == DIP_MAX_NEAR_M);
    bounds.diagonal = 1e3;
    const float near_m = dip_model_near_distance(&bounds);
    assert_true(near_m > DIP_MIN_NEAR_M && near_m < 1e3f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_courtyard_is_loaded_completely),
        cmocka_unit_test(normal_maps_are_loaded_only_on_request),
        cmocka_unit_test(repeated_parts_of_the_courtyard_share_meshes),
        cmocka_unit_test(a_gltf_file_with_an_embedded_picture_loads),
        cmocka_unit_test(a_glb_file_with_an_embedded_picture_loads),
        cmocka_unit_test(embedded_pictures_are_found_by_name),
        cmocka_unit_test(seams_of_light_maps_are_kept),
        cmocka_unit_test(every_node_with_a_mesh_becomes_an_object),
        cmocka_unit_test(extras_choose_the_kind_of_surface),
        cmocka_unit_test(a_required_material_extension_gives_a_warning),
        cmocka_unit_test(an_opacity_picture_becomes_alpha),
        cmocka_unit_test(a_missing_picture_gives_a_warning),
        cmocka_unit_test(materials_of_x_files_may_be_named_by_reference),
        cmocka_unit_test(a_rule_that_no_surface_uses_gives_a_warning),
        cmocka_unit_test(many_warnings_of_assimp_are_counted),
        cmocka_unit_test(too_many_extensions_are_told),
        cmocka_unit_test(points_and_lines_give_a_warning_with_their_number),
        cmocka_unit_test(ply_colours_become_linear),
        cmocka_unit_test(stl_and_x_files_load_together),
        cmocka_unit_test(files_load_even_if_assimp_cannot_process_them),
        cmocka_unit_test(missing_normals_are_computed),
        cmocka_unit_test(near_distances_are_those_that_scenes_accept),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
