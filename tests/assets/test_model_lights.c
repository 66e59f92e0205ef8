// Tests the lights and highlights that the loader reads. The expected numbers are computed here
// from the content of the files, without the loader's formulas.
#include "assets/model.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const double ambient = 0.09989873; // sRGB code 89 (IEC 61966-2-1)

static DipModel *load_with(const char *path, const DipModelOptions *options,
                           DipErrorList *warnings) {
    DipError err = {0};
    DipModel *model = dip_model_load_with(&path, 1, options, NULL, warnings, &err);
    if (!model) {
        fail_msg("%s: %s", path, err.message);
    }
    return model;
}

static DipModel *load(const char *path, DipErrorList *warnings) {
    const DipModelOptions options = {.normal_maps = true};
    return load_with(path, &options, warnings);
}

static DipModel *load_as_given(const char *path, DipErrorList *warnings) {
    const DipModelOptions options = {.has_light_scale = true, .light_scale = 1.0};
    return load_with(path, &options, warnings);
}

static const DipLightingDef *lighting_of(const DipModel *model) {
    const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
    assert_non_null(lighting);
    return lighting;
}

static void assert_near(const float *found, double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        if (!(fabs((double)found[i] - expected[i]) <= 1e-5 * fmax(1.0, fabs(expected[i])))) {
            fail_msg("component %d is %.9g, not %.9g", i, (double)found[i], expected[i]);
        }
    }
}

static void assert_close(double found, double expected) {
    if (!(fabs(found - expected) <= 1e-5 * fmax(1.0, fabs(expected)))) {
        fail_msg("%.9g is not %.9g", found, expected);
    }
}

static void assert_warned(const DipErrorList *warnings, const char *key, const char *text) {
    for (size_t i = 0; i < warnings->count; i++) {
        if (strcmp(warnings->items[i].key, key) == 0 && strstr(warnings->items[i].message, text)) {
            return;
        }
    }
    fail_msg("no warning of %s says '%s'", key, text);
}

// --- places, directions and cones ----------------------------------------------------------------

// The node "turned" of lights.gltf turns by 90 degrees around y, which takes x to -z and z to x,
// scales by 2 and moves by (1, 2, 3). The lights stand below it; a light looks along its -z.
static void lights_of_gltf_follow_their_nodes(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load_as_given(fixture_data("lights.gltf"), &warnings);
    const DipLightingDef *lighting = lighting_of(model);
    assert_int_equal(warnings.count, 0);
    assert_int_equal(lighting->light_count, 3);
    assert_int_equal(lighting->shading, DIP_SHADING_PHONG);
    assert_near(lighting->ambient_lin, ambient, ambient, ambient);
    assert_near(lighting->sky_lin, 0.0, 0.0, 0.0);
    const DipLightDef *sun = &lighting->lights[0];
    assert_string_equal(sun->name, "sun");
    assert_int_equal(sun->kind, DIP_LIGHT_DIRECTIONAL);
    assert_near(sun->colour_lin, 4.0, 2.0, 1.0);
    assert_near(sun->direction_world, 0.0, -1.0, 0.0);
    const DipLightDef *bulb = &lighting->lights[1];
    assert_int_equal(bulb->kind, DIP_LIGHT_POINT);
    assert_near(bulb->colour_lin, 100.0, 100.0, 100.0);
    assert_near(bulb->position_world, 1.0, 2.0, 1.0);
    assert_near(bulb->attenuation, 0.0, 0.0, 1.0);
    assert_close(bulb->range_m, 12.0);
    const DipLightDef *cone = &lighting->lights[2];
    assert_int_equal(cone->kind, DIP_LIGHT_SPOT);
    assert_near(cone->colour_lin, 0.0, 50.0, 0.0);
    assert_near(cone->position_world, 3.0, 2.0, 3.0);
    assert_near(cone->direction_world, -1.0, 0.0, 0.0);
    assert_near(cone->attenuation, 0.0, 0.0, 1.0);
    assert_close(cone->range_m, 0.0);
    assert_close(cone->inner_deg, 15.0); // glTF gives the half angles, in radians.
    assert_close(cone->outer_deg, 30.0);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// --up z takes y to -z and z to y.
static void lights_turn_with_their_model(void **state) {
    (void)state;
    const DipModelOptions options = {.up = DIP_UP_z, .has_light_scale = true, .light_scale = 0.5};
    DipModel *model = load_with(fixture_data("lights.gltf"), &options, NULL);
    const DipLightingDef *lighting = lighting_of(model);
    assert_near(lighting->lights[0].direction_world, 0.0, 0.0, 1.0);
    assert_near(lighting->lights[0].colour_lin, 2.0, 1.0, 0.5);
    assert_near(lighting->lights[1].position_world, 1.0, 1.0, -2.0);
    assert_near(lighting->lights[2].direction_world, -1.0, 0.0, 0.0);
    dip_model_destroy(&model);
}

static const char collada[] =
    "<?xml version=\"1.0\"?>\n"
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
    "<asset><up_axis>Y_UP</up_axis></asset>\n"
    "<library_lights>\n"
    "<light id=\"glow\"><technique_common><ambient><color>0.2 0.2 0.2</color></ambient>"
    "</technique_common></light>\n"
    "<light id=\"beam\"><technique_common><spot><color>1 0.5 0</color>"
    "<constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation>"
    "<quadratic_attenuation>0.25</quadratic_attenuation><falloff_angle>40</falloff_angle>"
    "</spot></technique_common><extra><technique profile=\"MAX3D\"><decay_falloff>60"
    "</decay_falloff></technique></extra></light>\n"
    "</library_lights>\n"
    "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" "
    "count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source=\"#a\" "
    "count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
    "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
    "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p>"
    "</triangles></mesh></geometry></library_geometries>\n"
    "<library_visual_scenes><visual_scene id=\"s\">"
    "<node id=\"n\" name=\"n\"><instance_geometry url=\"#g\"/></node>"
    "<node id=\"l\" name=\"l\"><translate>0 3 0</translate><rotate>1 0 0 -90</rotate>"
    "<instance_light url=\"#beam\"/></node>"
    "<node id=\"k\" name=\"k\"><instance_light url=\"#glow\"/></node>"
    "</visual_scene></library_visual_scenes>\n"
    "<scene><instance_visual_scene url=\"#s\"/></scene>\n"
    "</COLLADA>\n";

static double srgb_to_linear(double v) {
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

// COLLADA gives full angles in degrees, and colours as sRGB.
static void lights_of_collada_have_full_angles_and_srgb_colours(void **state) {
    (void)state;
    fixture_write_text("beam.dae", collada);
    DipModel *model = load_as_given(fixture_path("beam.dae"), NULL);
    const DipLightingDef *lighting = lighting_of(model);
    assert_int_equal(lighting->light_count, 1);
    const DipLightDef *beam = &lighting->lights[0];
    assert_int_equal(beam->kind, DIP_LIGHT_SPOT);
    assert_near(beam->colour_lin, 1.0, srgb_to_linear(0.5), 0.0);
    assert_near(beam->position_world, 0.0, 3.0, 0.0);
    assert_near(beam->direction_world, 0.0, -1.0, 0.0);
    assert_near(beam->attenuation, 1.0, 0.0, 0.25);
    assert_close(beam->inner_deg, 20.0);
    assert_true(beam->outer_deg >= beam->inner_deg && beam->outer_deg <= 90.0f);
    const double all = ambient + 0.2; // The greatest channel of a colour is its strength.
    assert_near(lighting->ambient_lin, all, all, all);
    dip_model_destroy(&model);
}

// --- strength ------------------------------------------------------------------------------------

// The floor's bounds are (-3, 0, -2) to (3, 0, 2), so the centre is the origin. The bulb stands at
// (1, 2, 1), and the cone at (3, 2, 3).
static void the_lights_of_files_sum_to_1_at_the_centre(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("lights.gltf"), NULL);
    const DipLightingDef *lighting = lighting_of(model);
    const double sun = 0.2126 * 4.0 + 0.7152 * 2.0 + 0.0722 * 1.0;
    const double bulb = 100.0 / (1.0 + 4.0 + 1.0);
    const double cone = 0.7152 * 50.0 / (9.0 + 4.0 + 9.0);
    const double scale = 1.0 / (sun + bulb + cone);
    assert_near(lighting->lights[0].colour_lin, 4.0 * scale, 2.0 * scale, scale);
    assert_near(lighting->lights[1].colour_lin, 100.0 * scale, 100.0 * scale, 100.0 * scale);
    assert_near(lighting->lights[2].colour_lin, 0.0, 50.0 * scale, 0.0);
    assert_near(lighting->ambient_lin, ambient, ambient, ambient);
    dip_model_destroy(&model);
}

// Writes lights.gltf with its nodes and lights replaced.
static const char *write_gltf(const char *name, const char *lights, const char *nodes) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data("lights.gltf"), &size_bytes);
    bytes[size_bytes] = '\0';
    const char *rest = strstr((const char *)bytes, "\"meshes\":");
    assert_non_null(rest);
    char *text = malloc(strlen(lights) + strlen(nodes) + size_bytes + 400);
    assert_non_null(text);
    sprintf(text,
            "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],"
            "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[%s]}},\"scene\":0,%s,\n%s",
            lights, nodes, rest);
    fixture_write_text(name, text);
    free(text);
    free(bytes);
    return fixture_path(name);
}

static const char one_light[] =
    "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"name\":\"floor\",\"mesh\":0},{\"name\":\"a\","
    "\"translation\":[0,1,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]";

// A quarter of the diagonal is sqrt(36 + 16) / 4 = 1.80, so the light counts as 1.80 m away.
static void a_light_inside_the_models_counts_as_if_it_were_farther_away(void **state) {
    (void)state;
    const char *path = write_gltf("inside.gltf", "{\"type\":\"point\",\"intensity\":7}", one_light);
    DipModel *model = load(path, NULL);
    const double colour = 52.0 / 16.0;
    assert_near(lighting_of(model)->lights[0].colour_lin, colour, colour, colour);
    dip_model_destroy(&model);
}

// Beyond a strength of a million, the attenuation shrinks instead, so that numbers stay in range.
static void a_light_far_away_can_be_as_strong_as_any(void **state) {
    (void)state;
    static const char nodes[] =
        "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"name\":\"floor\",\"mesh\":0},{\"name\":\"a\","
        "\"translation\":[0,1e8,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]";
    const char *path = write_gltf("far.gltf", "{\"type\":\"point\",\"intensity\":7}", nodes);
    DipModel *model = load(path, NULL);
    const DipLightDef *light = &lighting_of(model)->lights[0];
    assert_close(light->colour_lin[0], 1e6);
    assert_close((double)light->colour_lin[0] / ((double)light->attenuation[2] * 1e16), 1.0);
    dip_model_destroy(&model);
}

static void a_scale_of_0_ignores_the_lights_of_files(void **state) {
    (void)state;
    const DipModelOptions options = {.has_light_scale = true};
    DipModel *model = load_with(fixture_data("lights.gltf"), &options, NULL);
    assert_null(dip_model_scene_def(model)->lighting);
    dip_model_destroy(&model);
}

// --- lights that cannot be drawn -----------------------------------------------------------------

static void bad_lights_are_left_out_with_a_warning(void **state) {
    (void)state;
    static const struct {
        const char *light;
        const char *warning;
    } bad[] = {
        {"{\"type\":\"point\",\"intensity\":-1}", "negative"},
        {"{\"type\":\"point\",\"intensity\":1e30}", "too large"},
        {"{\"type\":\"point\",\"color\":[1,-1,1]}", "negative"},
        {"{\"type\":\"spot\",\"spot\":{\"outerConeAngle\":-1}}", "cone"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        DipErrorList warnings = {0};
        DipModel *model = load(write_gltf("bad_light.gltf", bad[i].light, one_light), &warnings);
        assert_null(dip_model_scene_def(model)->lighting);
        assert_warned(&warnings, "a", "the light is left out");
        assert_warned(&warnings, "a", bad[i].warning);
        dip_error_list_free(&warnings);
        dip_model_destroy(&model);
    }
}

// glTF limits the angles to a right angle.
static void a_cone_is_at_most_a_half_space(void **state) {
    (void)state;
    static const char light[] =
        "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":2,\"outerConeAngle\":3}}";
    DipModel *model = load(write_gltf("wide.gltf", light, one_light), NULL);
    assert_true(lighting_of(model)->lights[0].inner_deg == 90.0f);
    assert_true(lighting_of(model)->lights[0].outer_deg == 90.0f);
    dip_model_destroy(&model);
}

static void a_flattened_direction_is_left_out_with_a_warning(void **state) {
    (void)state;
    static const char nodes[] =
        "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"name\":\"floor\",\"mesh\":0},{\"name\":\"a\","
        "\"scale\":[1,1,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]";
    DipErrorList warnings = {0};
    DipModel *model =
        load(write_gltf("flattened.gltf", "{\"type\":\"directional\"}", nodes), &warnings);
    assert_null(dip_model_scene_def(model)->lighting);
    assert_warned(&warnings, "a", "its direction is zero");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void a_black_light_does_not_count(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load(
        write_gltf("black.gltf", "{\"type\":\"point\",\"intensity\":0}", one_light), &warnings);
    assert_null(dip_model_scene_def(model)->lighting);
    assert_int_equal(warnings.count, 0);
    dip_model_destroy(&model);
}

// Writes a file with many lights in a row.
static const char *write_many(int count) {
    char *lights = calloc((size_t)count, 64);
    char *nodes = calloc((size_t)count + 4, 128);
    assert_true(lights && nodes);
    strcat(nodes, "\"nodes\":[{\"name\":\"floor\",\"mesh\":0}");
    for (int i = 0; i < count; i++) {
        sprintf(lights + strlen(lights), "%s{\"type\":\"point\",\"intensity\":%d}", i ? "," : "",
                i + 1);
        sprintf(nodes + strlen(nodes),
                ",{\"name\":\"n%d\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":%d}}}", i,
                i);
    }
    strcat(nodes, "],\"scenes\":[{\"nodes\":[0");
    for (int i = 0; i < count; i++) {
        sprintf(nodes + strlen(nodes), ",%d", i + 1);
    }
    strcat(nodes, "]}]");
    const char *path = write_gltf("many.gltf", lights, nodes);
    free(lights);
    free(nodes);
    return path;
}

static void lights_beyond_64_are_counted_in_a_warning(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipModel *model = load_as_given(write_many(67), &warnings);
    assert_int_equal(lighting_of(model)->light_count, 64);
    assert_close(lighting_of(model)->lights[63].colour_lin[0], 64.0);
    assert_warned(&warnings, "", "3 lights are left out, accepted 64 in a scene");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

// --- lights of the caller ------------------------------------------------------------------------

static const DipLightDef lamp = {.name = "lamp",
                                 .kind = DIP_LIGHT_POINT,
                                 .colour_lin = {5, 6, 7},
                                 .position_world = {1, 2, 3},
                                 .attenuation = {0, 0, 1},
                                 .range_m = 9};

static void lights_of_the_caller_are_taken_as_they_are(void **state) {
    (void)state;
    const float grey[3] = {0.25f, 0.5f, 0.75f};
    const DipModelOptions options = {.lights = &lamp,
                                     .light_count = 1,
                                     .ambient_lin = grey,
                                     .shading = DIP_MODEL_SHADING_gouraud};
    DipModel *model = load_with(fixture_data("square.ply"), &options, NULL);
    const DipLightingDef *lighting = lighting_of(model);
    assert_int_equal(lighting->light_count, 1);
    assert_string_equal(lighting->lights[0].name, "lamp");
    assert_near(lighting->lights[0].colour_lin, 5.0, 6.0, 7.0);
    assert_near(lighting->ambient_lin, 0.25, 0.5, 0.75);
    assert_int_equal(lighting->shading, DIP_SHADING_GOURAUD);
    dip_model_destroy(&model);
    model = load_with(fixture_data("lights.gltf"), &options, NULL);
    lighting = lighting_of(model);
    assert_int_equal(lighting->light_count, 4);
    assert_string_equal(lighting->lights[0].name, "lamp");
    assert_string_equal(lighting->lights[3].name, "cone");
    dip_model_destroy(&model);
}

static void lights_of_the_caller_come_before_those_of_files(void **state) {
    (void)state;
    DipLightDef lights[2] = {lamp, lamp};
    const DipModelOptions options = {.lights = lights, .light_count = 2};
    DipErrorList warnings = {0};
    DipModel *model = load_with(write_many(64), &options, &warnings);
    assert_int_equal(lighting_of(model)->light_count, 64);
    assert_string_equal(lighting_of(model)->lights[1].name, "lamp");
    assert_string_equal(lighting_of(model)->lights[63].name, "n61");
    assert_warned(&warnings, "", "2 lights of the models are left out");
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void bad_options_are_refused(void **state) {
    (void)state;
    const float negative[3] = {0, -1, 0};
    DipLightDef dark = lamp;
    dark.attenuation[2] = 0.0f;
    const DipModelOptions bad[] = {
        {.lights = &dark, .light_count = 1},
        {.lights = &lamp, .light_count = 65},
        {.lights = &lamp, .light_count = -1},
        {.ambient_lin = negative},
        {.has_light_scale = true, .light_scale = -1.0},
        {.has_light_scale = true, .light_scale = NAN},
        {.shading = DIP_MODEL_SHADING_COUNT},
    };
    const char *path = fixture_data("square.ply");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        DipError err = {0};
        assert_null(dip_model_load_with(&path, 1, &bad[i], NULL, NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
    }
}

// Without lights, a shading shades the fixed light; nothing else changes without a shading.
static void a_shading_without_lights_shades_the_fixed_light(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("square.ply"), NULL);
    assert_null(dip_model_scene_def(model)->lighting);
    dip_model_destroy(&model);
    static const DipShading expected[] = {[DIP_MODEL_SHADING_flat] = DIP_SHADING_GOURAUD,
                                          [DIP_MODEL_SHADING_gouraud] = DIP_SHADING_GOURAUD,
                                          [DIP_MODEL_SHADING_phong] = DIP_SHADING_PHONG};
    for (int i = DIP_MODEL_SHADING_flat; i < DIP_MODEL_SHADING_COUNT; i++) {
        const DipModelOptions options = {.shading = (DipModelShading)i};
        model = load_with(fixture_data("square.ply"), &options, NULL);
        const DipLightingDef *lighting = lighting_of(model);
        const DipLightingDef *fixed = dip_lighting_fixed();
        assert_int_equal(lighting->shading, expected[i]);
        assert_int_equal(lighting->light_count, fixed->light_count);
        assert_memory_equal(lighting->ambient_lin, fixed->ambient_lin, sizeof fixed->ambient_lin);
        assert_memory_equal(lighting->sky_lin, fixed->sky_lin, sizeof fixed->sky_lin);
        dip_model_destroy(&model);
    }
}

// --- flat shading --------------------------------------------------------------------------------

// Two faces of a roof share smooth normals. Their own normals are (1, 1, 0) and (-1, 1, 0) over the
// square root of 2. The second face is wound the other way round.
static void flat_shading_gives_each_face_its_normal(void **state) {
    (void)state;
    fixture_write_text("roof.obj", "v 0 1 0\nv 0 1 1\nv 1 0 0\nv -1 0 0\n"
                                   "vn 0 1 0\nf 1//1 2//1 3//1\nf 1//1 2//1 4//1\n");
    const DipModelOptions options = {.shading = DIP_MODEL_SHADING_flat};
    DipModel *model = load_with(fixture_path("roof.obj"), &options, NULL);
    const DipSceneDef *def = dip_model_scene_def(model);
    const DipMeshDef *mesh = &def->meshes[0];
    assert_int_equal(def->mesh_count, 1);
    assert_int_equal(mesh->vertex_count, 6);
    const double half = sqrt(0.5);
    for (uint32_t i = 0; i < 6; i++) {
        const float *p = mesh->positions + 3 * (size_t)mesh->indices[i / 3 * 3 + 2];
        assert_near(mesh->normals + 3 * (size_t)mesh->indices[i], p[0] > 0 ? half : -half, half, 0);
    }
    dip_model_destroy(&model);
}

// --- highlights ----------------------------------------------------------------------------------

static const DipMaterialDef *material_named(const DipModel *model, const char *name) {
    const DipSceneDef *def = dip_model_scene_def(model);
    for (int i = 0; i < def->material_count; i++) {
        if (strcmp(def->materials[i].name, name) == 0) {
            return &def->materials[i];
        }
    }
    fail_msg("no material %s", name);
    return NULL;
}

static void highlights_of_mtl(void **state) {
    (void)state;
    fixture_write_text("shine.mtl", "newmtl steel\nKd 1 1 1\nKs 1 0.5 0\nNs 96\n"
                                    "newmtl chalk\nKd 1 1 1\nKs 1 1 1\n"
                                    "newmtl glassy\nKd 1 1 1\nKs 1 1 1\nNs 5000\n");
    fixture_write_text("shine.obj", "mtllib shine.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl steel\n"
                                    "f 1 2 3\nusemtl chalk\nf 1 2 3\nusemtl glassy\nf 1 2 3\n");
    DipModel *model = load(fixture_path("shine.obj"), NULL);
    const DipMaterialDef *steel = material_named(model, "steel");
    assert_close(steel->shininess, 96.0);
    assert_near(steel->specular_lin, 1.0, srgb_to_linear(0.5), 0.0);
    const DipMaterialDef *chalk = material_named(model, "chalk");
    assert_near(chalk->specular_lin, 0.0, 0.0, 0.0);
    assert_close(material_named(model, "glassy")->shininess, 1024.0);
    dip_model_destroy(&model);
}

static void highlights_of_x(void **state) {
    (void)state;
    fixture_write_text("shine.x", "xof 0303txt 0032\nMesh m {\n3;\n0;0;0;,\n1;0;0;,\n0;1;0;;\n1;\n"
                                  "3;0,1,2;;\nMeshMaterialList {\n1;\n1;\n0;;\n"
                                  "Material steel {\n1;1;1;1;;\n32;\n0.5;0.5;1;;\n0;0;0;;\n}\n}\n"
                                  "}\n");
    DipModel *model = load(fixture_path("shine.x"), NULL);
    const DipMaterialDef *steel = material_named(model, "steel");
    assert_close(steel->shininess, 32.0);
    assert_near(steel->specular_lin, srgb_to_linear(0.5), srgb_to_linear(0.5), 1.0);
    dip_model_destroy(&model);
}

// Roughness 0.5: alpha = 0.25, so n = 2 / 0.0625 - 2 = 30 and the colour is 0.04 * 38 / 8 = 0.19.
static void highlights_of_gltf_follow_the_roughness(void **state) {
    (void)state;
    DipModel *model = load(fixture_data("lights.gltf"), NULL);
    const DipMaterialDef *floor = material_named(model, "floor");
    assert_close(floor->shininess, 30.0);
    assert_near(floor->specular_lin, 0.19, 0.19, 0.19);
    dip_model_destroy(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_of_gltf_follow_their_nodes),
        cmocka_unit_test(lights_turn_with_their_model),
        cmocka_unit_test(lights_of_collada_have_full_angles_and_srgb_colours),
        cmocka_unit_test(the_lights_of_files_sum_to_1_at_the_centre),
        cmocka_unit_test(a_light_inside_the_models_counts_as_if_it_were_farther_away),
        cmocka_unit_test(a_light_far_away_can_be_as_strong_as_any),
        cmocka_unit_test(a_scale_of_0_ignores_the_lights_of_files),
        cmocka_unit_test(bad_lights_are_left_out_with_a_warning),
        cmocka_unit_test(a_cone_is_at_most_a_half_space),
        cmocka_unit_test(a_flattened_direction_is_left_out_with_a_warning),
        cmocka_unit_test(a_black_light_does_not_count),
        cmocka_unit_test(lights_beyond_64_are_counted_in_a_warning),
        cmocka_unit_test(lights_of_the_caller_are_taken_as_they_are),
        cmocka_unit_test(lights_of_the_caller_come_before_those_of_files),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(a_shading_without_lights_shades_the_fixed_light),
        cmocka_unit_test(flat_shading_gives_each_face_its_normal),
        cmocka_unit_test(highlights_of_mtl),
        cmocka_unit_test(highlights_of_x),
        cmocka_unit_test(highlights_of_gltf_follow_the_roughness),
    };
    return cmocka_run_group_tests_name("lights of models", tests, fixture_open, fixture_close);
}
