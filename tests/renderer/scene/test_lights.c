// Tests the lights of a scene: their light against formulas that this file computes in double
// precision from the positions of pixels, the fixed light against the same light made of lights,
// lights that are left out because they are too far away, and descriptions that are refused.
#include "renderer/scene/lights.h"

#include "tests/renderer/scene/stage.h"
#include "tests/renderer/scene/vec.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 64 };

// The wall that the tests light is seen straight on, at this distance.
#define WALL_M 5.0

static DipTestScene scene;

static Stage open_stage(bool force_all) {
    DipRendererDef def = stage_def(SIZE, SIZE, "");
    def.force_all_effects = force_all;
    def.reflection = scene.reflection;
    return stage_open(&scene.def, def, 1);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// Half of the width that the picture shows of the wall.
static double half_width_m(void) {
    return WALL_M * tan(30.0 * acos(-1.0) / 180.0);
}

// Makes a wall with shiny grey paint that faces the eye at the origin and fills the picture. With
// Gouraud shading, it has a vertex at the centre of each pixel. Its normal leans: it is not the
// normal of the wall's plane, so a mistake that takes one for the other shows.
static void make_wall(DipShading shading) {
    const int cells = shading == DIP_SHADING_GOURAUD ? 2 * SIZE : 1;
    const double cell_m = cells > 1 ? 2.0 * half_width_m() / SIZE : 20.0;
    const double first_m = cells > 1 ? (0.5 - SIZE) * cell_m : -0.5 * cell_m;
    dip_test_scene_begin(&scene);
    scene.lighting = (DipLightingDef){.lights = scene.lights, .shading = shading};
    scene.def.lighting = &scene.lighting;
    const int index = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    DipMaterialDef *paint = &scene.materials[index];
    paint->lit = true;
    paint->shininess = 12.0f;
    for (int c = 0; c < 3; c++) {
        paint->base_colour_lin[c] = 0.5f;
        paint->specular_lin[c] = 0.25f;
    }
    const uint32_t across = (uint32_t)cells + 1;
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        &scene, across * across, (uint32_t)(6 * cells * cells), DIP_TEST_NORMALS, index);
    for (uint32_t v = 0; v < across * across; v++) {
        mesh.positions[3 * v] = (float)(first_m + cell_m * (v % across));
        mesh.positions[3 * v + 1] = (float)(first_m + cell_m * (v / across));
        mesh.positions[3 * v + 2] = (float)-WALL_M;
        mesh.normals[3 * v + 1] = 0.28f;
        mesh.normals[3 * v + 2] = 0.96f;
    }
    uint32_t *at = mesh.indices;
    for (uint32_t y = 0; y < (uint32_t)cells; y++) {
        for (uint32_t x = 0; x < (uint32_t)cells; x++) {
            const uint32_t a = y * across + x;
            const uint32_t quad[6] = {a, a + 1, a + across + 1, a, a + across + 1, a + across};
            memcpy(at, quad, sizeof quad);
            at += 6;
        }
    }
}

static void add_light(const DipLightDef *light) {
    scene.lights[scene.lighting.light_count++] = *light;
}

// --- the formulas of docs/picture.md, in other words -------------------------------------------

static double degrees_between(const Vec a, const Vec b) {
    return acos(dot(a, b) / (length(a) * length(b))) * 180.0 / acos(-1.0);
}

// The light that arrives at a point, as a share of the light's colour. away: from the light to the
// point.
static double arriving(const DipLightDef *light, const Vec away) {
    if (light->kind == DIP_LIGHT_DIRECTIONAL) {
        return 1.0;
    }
    const double d = length(away);
    const float *a = light->attenuation;
    double share = 1.0 / (a[0] + a[1] * d + a[2] * d * d);
    if (light->range_m > 0.0f) {
        share *= d < light->range_m ? 1.0 - pow(d / light->range_m, 4.0) : 0.0;
    }
    if (light->kind == DIP_LIGHT_SPOT) {
        const Vec axis = {light->direction_world[0], light->direction_world[1],
                          light->direction_world[2]};
        const double to_degrees = acos(-1.0) / 180.0;
        const double at = cos(degrees_between(away, axis) * to_degrees);
        const double in = cos(light->inner_deg * to_degrees);
        const double out = cos(light->outer_deg * to_degrees);
        const double part = at >= in ? 1.0 : at <= out ? 0.0 : (at - out) / (in - out);
        share *= part * part;
    }
    return share;
}

// The grey level of the wall at (x, y) in metres.
static double expected_grey(double x, double y) {
    const Vec n = {0.0, 0.28, 0.96};
    const Vec to_eye = {-x, -y, WALL_M};
    double diffuse = scene.lighting.ambient_lin[1] + n[1] * scene.lighting.sky_lin[1];
    double highlight = 0.0;
    for (int l = 0; l < scene.lighting.light_count; l++) {
        const DipLightDef *light = &scene.lights[l];
        Vec away;
        for (int i = 0; i < 3; i++) {
            const double place[3] = {x, y, -WALL_M};
            away[i] = light->kind == DIP_LIGHT_DIRECTIONAL ? (double)light->direction_world[i]
                                                           : place[i] - light->position_world[i];
        }
        const double cosine = -dot(n, away) / length(away);
        if (cosine <= 0.0) {
            continue;
        }
        Vec half;
        for (int i = 0; i < 3; i++) {
            half[i] = to_eye[i] / length(to_eye) - away[i] / length(away);
        }
        const double peak = fmax(0.0, dot(n, half) / length(half));
        const double light_lin = light->colour_lin[1] * arriving(light, away);
        diffuse += light_lin * cosine;
        highlight += 0.25 * light_lin * pow(peak, 12.0);
    }
    return fmin(1.0, 0.5 * diffuse + highlight);
}

// Draws the wall and compares all pixels with the formulas. Returns the darkest and the brightest
// level, so that a test can see that the light varies.
static void check_wall(double most_codes, double *darkest, double *brightest) {
    Stage stage = open_stage(false);
    const DipFrame frame = draw(&stage);
    const double half_m = half_width_m();
    double worst = 0.0;
    *darkest = 255.0;
    *brightest = 0.0;
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const double right = ((x + 0.5) / SIZE * 2.0 - 1.0) * half_m;
            const double up = (1.0 - (y + 0.5) / SIZE * 2.0) * half_m;
            const double expected = 255.0 * srgb_encode(expected_grey(right, up));
            worst = fmax(worst, fabs(expected - dip_image_pixel(&frame, x, y)[1]));
            *darkest = fmin(*darkest, expected);
            *brightest = fmax(*brightest, expected);
        }
    }
    if (worst > most_codes) {
        fail_msg("a pixel is %.2f codes from the formula, accepted %.2f", worst, most_codes);
    }
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// Draws the wall with one light, at the fragments and then at the vertices.
static void check_light(const DipLightDef *light, double least_contrast) {
    for (int gouraud = 0; gouraud < 2; gouraud++) {
        double darkest;
        double brightest;
        make_wall(gouraud ? DIP_SHADING_GOURAUD : DIP_SHADING_PHONG);
        scene.lighting.ambient_lin[1] = 0.05f;
        scene.lighting.sky_lin[1] = 0.02f;
        add_light(light);
        check_wall(0.75, &darkest, &brightest);
        assert_true(brightest - darkest >= least_contrast);
    }
}

static void a_directional_light_follows_the_formulas(void **state) {
    (void)state;
    check_light(&(DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                               .colour_lin = {0.5f, 0.5f, 0.5f},
                               .direction_world = {300.0f, -100.0f, -700.0f}},
                5.0);
}

static void a_point_light_follows_the_formulas(void **state) {
    (void)state;
    static const float attenuations[][3] = {{0, 0, 1}, {1, 0, 0}, {0.5f, 0.5f, 0.25f}, {0, 1, 0}};
    for (size_t i = 0; i < sizeof attenuations / sizeof *attenuations; i++) {
        for (int ends = 0; ends < 2; ends++) {
            DipLightDef light = {.kind = DIP_LIGHT_POINT,
                                 .colour_lin = {0.7f, 0.7f, 0.7f},
                                 .position_world = {-0.7f, 0.4f, -3.6f},
                                 .range_m = ends ? 2.2f : 0.0f};
            memcpy(light.attenuation, attenuations[i], sizeof light.attenuation);
            check_light(&light, 15.0);
        }
    }
}

static void a_spot_light_follows_the_formulas(void **state) {
    (void)state;
    static const float cones[][2] = {{10, 25}, {0, 40}, {30, 90}};
    for (size_t i = 0; i < sizeof cones / sizeof *cones; i++) {
        check_light(&(DipLightDef){.kind = DIP_LIGHT_SPOT,
                                   .colour_lin = {4.0f, 4.0f, 4.0f},
                                   .position_world = {0.5f, 1.5f, -2.0f},
                                   .direction_world = {-0.2f, -0.9f, -2.0f},
                                   .attenuation = {0, 0, 1},
                                   .inner_deg = cones[i][0],
                                   .outer_deg = cones[i][1]},
                    50.0);
    }
}

// The squares of these distances are not floats.
static void a_light_far_beyond_floats_of_squares_follows_the_formulas(void **state) {
    (void)state;
    for (int spot = 0; spot < 2; spot++) {
        check_light(&(DipLightDef){.kind = spot ? DIP_LIGHT_SPOT : DIP_LIGHT_POINT,
                                   .colour_lin = {0.7f, 0.7f, 0.7f},
                                   .position_world = {-6e24f, 3e24f, 9e24f},
                                   .direction_world = {6.5f, -3.0f, -9.0f},
                                   .attenuation = {0.5f, 3e-26f, 0.0f},
                                   .inner_deg = 1.0f,
                                   .outer_deg = 8.0f},
                    5.0);
    }
}

static void several_lights_add_up(void **state) {
    (void)state;
    double darkest;
    double brightest;
    make_wall(DIP_SHADING_PHONG);
    for (int i = 0; i < DIP_TEST_SCENE_PARTS; i++) {
        add_light(&(DipLightDef){
            .kind = i % 2 ? DIP_LIGHT_POINT : DIP_LIGHT_SPOT,
            .colour_lin = {0.2f, 0.2f, 0.2f},
            .position_world = {0.5f * (float)i - 2.0f, 1.0f - 0.3f * (float)i, -4.0f},
            .direction_world = {0.1f * (float)i, 0.2f, -1.0f},
            .attenuation = {0.2f, 0.0f, 1.0f},
            .range_m = i == 3 ? 1.5f : 0.0f,
            .inner_deg = 5.0f,
            .outer_deg = 45.0f});
    }
    check_wall(0.75, &darkest, &brightest);
}

// A light that lies in the wall itself, and lights without any strength.
static void light_stays_finite_at_a_light(void **state) {
    (void)state;
    make_wall(DIP_SHADING_PHONG);
    add_light(&(DipLightDef){.kind = DIP_LIGHT_POINT,
                             .colour_lin = {1e9f, 0.0f, 1.0f},
                             .position_world = {0.0f, 0.0f, (float)-WALL_M},
                             .attenuation = {0, 0, 1e-9f}});
    Stage stage = open_stage(false);
    const DipFrame frame = draw(&stage);
    for (int i = 0; i < SIZE; i++) {
        // The normal leans up, so only the part of the wall below the light sees it.
        assert_int_equal(dip_image_pixel(&frame, i, SIZE / 2 - 1)[0], 0);
        assert_int_equal(dip_image_pixel(&frame, i, SIZE / 2)[0], 255);
        assert_int_equal(dip_image_pixel(&frame, i, SIZE / 2)[1], 0);
    }
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// --- the fixed light ---------------------------------------------------------------------------

static void the_fixed_light_as_lights_draws_the_same_picture(void **state) {
    (void)state;
    static uint8_t fixed[SIZE][SIZE][4];
    for (int as_lights = 0; as_lights < 2; as_lights++) {
        dip_test_scene_make(&scene, DIP_TEST_SCENE_lit_sphere);
        scene.def.lighting = as_lights ? dip_lighting_fixed() : NULL;
        Stage stage = open_stage(false);
        const DipFrame frame = draw(&stage);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                const uint8_t *pixel = dip_image_pixel(&frame, x, y);
                for (int c = 0; as_lights && c < 3; c++) {
                    assert_in_range(pixel[c] - fixed[y][x][c] + 1, 0, 2);
                }
                memcpy(fixed[y][x], pixel, 4);
            }
        }
        stage_close(&stage);
        dip_test_scene_free(&scene);
    }
}

// --- what is left out --------------------------------------------------------------------------

static void lights_out_of_reach_change_no_bit(void **state) {
    (void)state;
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_lights, DIP_TEST_SCENE_gouraud_lights};
    for (int kind = 0; kind < 2; kind++) {
        char hashes[2][33];
        for (int forced = 0; forced < 2; forced++) {
            dip_test_scene_make(&scene, kinds[kind]);
            for (int i = 0; i < scene.lighting.light_count; i++) {
                scene.lights[i].range_m = 1.0f + 0.7f * (float)i;
            }
            Stage stage = open_stage(forced);
            const DipFrame frame = draw(&stage);
            dip_frame_hash(&frame, hashes[forced]);
            assert_true(frame.counters.fragments_lit > 0);
            stage_close(&stage);
            dip_test_scene_free(&scene);
        }
        assert_string_equal(hashes[0], hashes[1]);
    }
}

static void frames_tell_what_is_lit_drawn_and_culled(void **state) {
    (void)state;
    make_wall(DIP_SHADING_PHONG);
    Stage stage = open_stage(false);
    DipFrame frame = draw(&stage);
    assert_true(frame.effects.lights.run);
    assert_int_equal(frame.counters.fragments_lit, SIZE * SIZE);
    assert_int_equal(frame.counters.draws_in_view, 1);
    assert_int_equal(frame.counters.draws_culled, 0);
    scene.pose.orientation[1] = 1.0; // turns around
    scene.pose.orientation[3] = 0.0;
    frame = draw(&stage);
    assert_false(frame.effects.lights.run);
    assert_string_equal(frame.effects.lights.why,
                        "no surface that the scene's lights light is in view");
    assert_int_equal(frame.counters.draws_in_view, 0);
    assert_int_equal(frame.counters.draws_culled, 1);
    stage_close(&stage);
    scene.materials[0].lit = false;
    stage = open_stage(false);
    assert_string_equal(draw(&stage).effects.lights.why, "the scene's lights light no surface");
    stage_close(&stage);
    scene.def.lighting = NULL;
    stage = open_stage(false);
    assert_string_equal(draw(&stage).effects.lights.why, "the scene has no lights of its own");
    stage_close(&stage);
    dip_test_scene_free(&scene);
}

// --- bad descriptions --------------------------------------------------------------------------

typedef void Spoil(void);

static void spoil_colour(void) {
    scene.lights[0].colour_lin[2] = -0.1f;
}

static void spoil_place(void) {
    scene.lights[0].position_world[1] = NAN;
}

static void spoil_direction(void) {
    memset(scene.lights[0].direction_world, 0, sizeof scene.lights[0].direction_world);
}

static void spoil_attenuation(void) {
    memset(scene.lights[0].attenuation, 0, sizeof scene.lights[0].attenuation);
}

static void spoil_range(void) {
    scene.lights[0].range_m = -1.0f;
}

static void spoil_cone(void) {
    scene.lights[0].inner_deg = 41.0f;
}

static void spoil_count(void) {
    scene.lighting.light_count = DIP_MAX_LIGHTS + 1;
}

static void spoil_shading(void) {
    scene.lighting.shading = (DipShading)7;
}

static void spoil_kind(void) {
    scene.lights[0].kind = (DipLightKind)3;
}

static void spoil_sky(void) {
    scene.lighting.sky_lin[1] = 0.2f;
}

static void spoil_ambient(void) {
    scene.lighting.ambient_lin[0] = INFINITY;
}

static void spoil_specular(void) {
    scene.materials[0].specular_lin[1] = -1.0f;
}

static void spoil_shininess(void) {
    scene.materials[0].shininess = 1025.0f;
}

static void bad_lights_are_refused_by_the_name_of_the_field(void **state) {
    (void)state;
    static const struct {
        Spoil *spoil;
        const char *key;
    } faults[] = {
        {spoil_colour, "colour_lin"},   {spoil_place, "position_world"},
        {spoil_range, "range_m"},       {spoil_direction, "direction_world"},
        {spoil_cone, "outer_deg"},      {spoil_attenuation, "attenuation"},
        {spoil_count, "lights"},        {spoil_shading, "shading"},
        {spoil_kind, "kind"},           {spoil_sky, "sky_lin"},
        {spoil_ambient, "ambient_lin"}, {spoil_specular, "specular_lin"},
        {spoil_shininess, "shininess"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        make_wall(DIP_SHADING_PHONG);
        scene.lighting.ambient_lin[1] = 0.1f;
        add_light(&(DipLightDef){.kind = DIP_LIGHT_SPOT,
                                 .name = "lamp",
                                 .colour_lin = {1, 1, 1},
                                 .direction_world = {0, 0, -1},
                                 .attenuation = {0, 0, 1},
                                 .outer_deg = 40.0f});
        DipScene *good = dip_scene_create(&scene.def, NULL, NULL);
        assert_non_null(good);
        dip_scene_destroy(&good);
        faults[i].spoil();
        DipError err = {0};
        assert_null(dip_scene_create(&scene.def, NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, faults[i].key);
        dip_test_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_directional_light_follows_the_formulas),
        cmocka_unit_test(a_point_light_follows_the_formulas),
        cmocka_unit_test(a_spot_light_follows_the_formulas),
        cmocka_unit_test(a_light_far_beyond_floats_of_squares_follows_the_formulas),
        cmocka_unit_test(several_lights_add_up),
        cmocka_unit_test(light_stays_finite_at_a_light),
        cmocka_unit_test(the_fixed_light_as_lights_draws_the_same_picture),
        cmocka_unit_test(lights_out_of_reach_change_no_bit),
        cmocka_unit_test(frames_tell_what_is_lit_drawn_and_culled),
        cmocka_unit_test(bad_lights_are_refused_by_the_name_of_the_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
