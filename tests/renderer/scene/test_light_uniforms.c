// Tests the lights of a scene as an eye sees them, and which lights may reach a box, by the
// formulas of lights.h and by the nearest point of each box.
#include "renderer/catalogue/random.h"
#include "renderer/scene/resources/lighting.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static DipSceneLighting *lighting_of(const DipLightDef *lights, int count) {
    const DipLightingDef def = {.ambient_lin = {0.5f, 0.25f, 0.125f},
                                .sky_lin = {0.375f, 0.1875f, 0.0625f},
                                .lights = lights,
                                .light_count = count,
                                .shading = DIP_SHADING_GOURAUD};
    DipSceneLighting *lighting = dip_scene_lighting_create(&def);
    assert_non_null(lighting);
    assert_int_equal(lighting->shading, DIP_SHADING_GOURAUD);
    return lighting;
}

// Directions may be so long or so short that their squares are no floats.
static void a_direction_is_reversed_to_length_one(void **state) {
    (void)state;
    Random random = {1};
    for (int i = 0; i < 2000; i++) {
        const double size = pow(10.0, random_real(&random, -37.0, 37.0));
        float direction[3];
        double reversed[3], expected[3], length = 0.0;
        for (int k = 0; k < 3; k++) {
            direction[k] = i % 4 == k ? 0.0f : (float)(size * random_real(&random, -1.0, 1.0));
            length += (double)direction[k] * (double)direction[k];
        }
        dip_lighting_reverse(direction, reversed);
        for (int k = 0; k < 3; k++) {
            expected[k] = -(double)direction[k] / sqrt(length);
            assert_true(fabs(reversed[k] - expected[k]) < 1e-14);
        }
    }
}

// Luminance is .2126 red + .7152 green + .0722 blue.
static void the_strongest_directional_light_casts_shadows(void **state) {
    (void)state;
    static const struct {
        int kinds[3];
        float colours[3][3];
        int shadow_light;
    } rows[] = {
        {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1},
        {{0, 0, 0}, {{1, 0, 0}, {0, 0, 1}, {0, 0, 2}}, 0},
        {{0, 0, 0}, {{0.2f, 0.2f, 0.2f}, {0, 0.26f, 0}, {0.9f, 0, 0}}, 0},
        {{0, 0, 0}, {{0.2f, 0.2f, 0.2f}, {0, 0.29f, 0}, {0.9f, 0, 0}}, 1},
        {{0, 0, 0}, {{0.2f, 0.2f, 0.2f}, {0, 0.26f, 0}, {1.0f, 0, 0}}, 2},
        {{0, 0, 0}, {{0.5f, 0, 0}, {1, 1, 1}, {1, 1, 1}}, 1},
        {{0, 0, 0}, {{0, 0, 0.001f}, {0, 0, 0}, {0, 0, 0}}, 0},
        {{0, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, -1},
        {{DIP_LIGHT_POINT, DIP_LIGHT_SPOT, 0}, {{9, 9, 9}, {9, 9, 9}, {0, 0, 1}}, 2},
        {{DIP_LIGHT_POINT, DIP_LIGHT_SPOT, DIP_LIGHT_POINT}, {{9, 9, 9}, {9, 9, 9}, {1, 1, 1}}, -1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipLightDef lights[3];
        for (int k = 0; k < 3; k++) {
            lights[k] = (DipLightDef){.name = "lamp", .kind = (DipLightKind)rows[i].kinds[k]};
            memcpy(lights[k].colour_lin, rows[i].colours[k], sizeof lights[k].colour_lin);
        }
        DipSceneLighting *lighting = lighting_of(lights, 3);
        assert_int_equal(lighting->shadow_light, rows[i].shadow_light);
        assert_null(lighting->lights[2].name); // It belongs to the caller.
        free(lighting);
    }
}

static void assert_near(double a, double b, double tolerance) {
    assert_true(fabs(a - b) <= tolerance * (1.0 + fabs(b)));
}

// The cosine times cone_scale, plus cone_shift, falls from 1 at the inner cone to 0 at the outer
// one.
static void lights_are_seen_from_the_eye(void **state) {
    (void)state;
    const DipLightDef lights[3] = {
        {.kind = DIP_LIGHT_DIRECTIONAL, .colour_lin = {1, 2, 3}, .direction_world = {0, 0, 4}},
        {.kind = DIP_LIGHT_POINT,
         .colour_lin = {4, 5, 6},
         .position_world = {10, 20, 30},
         .direction_world = {1, 0, 0},
         .attenuation = {1, 2, 3},
         .range_m = 8},
        {.kind = DIP_LIGHT_SPOT,
         .colour_lin = {7, 8, 9},
         .position_world = {-1, -2, -3},
         .direction_world = {3, -4, 0},
         .attenuation = {4, 5, 6},
         .inner_deg = 30,
         .outer_deg = 60}};
    const double eye[3] = {1.5, 2.5, -3.5};
    DipSceneLighting *lighting = lighting_of(lights, 3);
    DipLightingUniforms seen;
    dip_lighting_at(lighting, eye, &seen);
    assert_int_equal(seen.count, 3);
    for (int k = 0; k < 3; k++) {
        assert_true(seen.ambient_lin[k] == lighting->ambient_lin[k]);
        assert_true(seen.sky_lin[k] == lighting->sky_lin[k]);
        for (int i = 0; i < 3; i++) {
            assert_int_equal(seen.lights[i].kind, lights[i].kind);
            assert_true(seen.lights[i].colour_lin[k] == lights[i].colour_lin[k]);
            assert_true(seen.lights[i].attenuation[k] == lights[i].attenuation[k]);
            assert_true(!i || (double)seen.lights[i].from_eye[k] ==
                                  (double)lights[i].position_world[k] - eye[k]);
        }
        assert_near((double)seen.lights[0].to_light[k], k == 2 ? -1.0 : 0.0, 1e-6);
        assert_near((double)seen.lights[2].to_light[k], k == 2 ? 0.0 : k ? 0.8 : -0.6, 1e-6);
    }
    assert_true(seen.lights[0].inverse_range2 == 0.0f && seen.lights[2].inverse_range2 == 0.0f);
    assert_true(seen.lights[1].inverse_range2 == 1.0f / 64.0f);
    const double scale = (double)seen.lights[2].cone_scale,
                 shift = (double)seen.lights[2].cone_shift;
    assert_near(scale * sqrt(0.75) + shift, 1.0, 1e-6);
    assert_near(scale * 0.5 + shift, 0.0, 1e-6);
    free(lighting);
}

// A cone without a rim is not infinitely steep.
static void a_cone_without_a_rim_falls_within_a_thousandth(void **state) {
    (void)state;
    const DipLightDef light = {.kind = DIP_LIGHT_SPOT,
                               .direction_world = {0, -1, 0},
                               .attenuation = {1, 0, 0},
                               .inner_deg = 60,
                               .outer_deg = 60};
    DipSceneLighting *lighting = lighting_of(&light, 1);
    DipLightingUniforms seen;
    dip_lighting_at(lighting, (const double[3]){0.0, 0.0, 0.0}, &seen);
    assert_near((double)seen.lights[0].cone_scale, 1000.0, 1e-6);
    assert_near((double)seen.lights[0].cone_shift, -500.0, 1e-6);
    free(lighting);
}

// A light more than 1e18 m from the eye shines everywhere as it does at the eye.
static void lights_far_away_are_directional(void **state) {
    (void)state;
    const double eye[3] = {0.0, 0.0, 8.0};
    DipLightDef light = {.kind = DIP_LIGHT_POINT,
                         .colour_lin = {1e9f, 5e8f, 0},
                         .position_world = {3e18f, 4e18f, 0},
                         .attenuation = {2, 1e-18f, 1e-36f}};
    const double x = (double)light.position_world[0], y = (double)light.position_world[1];
    const double distance = hypot(x, y);
    const double fading = 2.0 + (double)light.attenuation[1] * distance +
                          (double)light.attenuation[2] * distance * distance;
    for (int spot = 0; spot < 4; spot++) {
        // The eye is on the axis of spot 1, and 15 and 40 degrees away from those of the others.
        const double angle = atan2(y, x) + (spot == 2   ? 15.0
                                            : spot == 3 ? 40.0
                                                        : 0.0) *
                                               (acos(-1.0) / 180.0);
        light.kind = spot ? DIP_LIGHT_SPOT : DIP_LIGHT_POINT;
        light.direction_world[0] = (float)-cos(angle);
        light.direction_world[1] = (float)-sin(angle);
        light.inner_deg = 10;
        light.outer_deg = 20;
        const double degree = acos(-1.0) / 180.0;
        const double rim =
            (cos(15.0 * degree) - cos(20.0 * degree)) / (cos(10.0 * degree) - cos(20.0 * degree));
        const double share = (spot == 2 ? rim * rim : spot == 3 ? 0.0 : 1.0) / fading;
        DipSceneLighting *lighting = lighting_of(&light, 1);
        DipLightingUniforms seen;
        dip_lighting_at(lighting, eye, &seen);
        assert_int_equal(seen.lights[0].kind, DIP_LIGHT_DIRECTIONAL);
        for (int k = 0; k < 3; k++) {
            assert_near((double)seen.lights[0].colour_lin[k], (double)light.colour_lin[k] * share,
                        1e-5);
        }
        assert_near((double)seen.lights[0].to_light[0], x / distance, 1e-6);
        assert_near((double)seen.lights[0].to_light[1], y / distance, 1e-6);
        lighting->lights[0].range_m = 1e9f; // The light ends long before the eye.
        dip_lighting_at(lighting, eye, &seen);
        assert_int_equal(seen.lights[0].kind, DIP_LIGHT_DIRECTIONAL);
        assert_true(seen.lights[0].colour_lin[0] == 0.0f && seen.lights[0].colour_lin[1] == 0.0f);
        free(lighting);
    }
}

static void lights_up_to_the_greatest_distance_stay_where_they_are(void **state) {
    (void)state;
    for (int side = 0; side < 6; side++) {
        for (int far = 0; far < 2; far++) {
            DipLightDef light = {
                .kind = DIP_LIGHT_POINT, .colour_lin = {1, 1, 1}, .attenuation = {1, 0, 0}};
            light.position_world[side / 2] =
                (side % 2 ? -1.0f : 1.0f) * (far ? 1.01e18f : 0.99e18f);
            DipSceneLighting *lighting = lighting_of(&light, 1);
            DipLightingUniforms seen;
            dip_lighting_at(lighting, (const double[3]){0.0, 0.0, 0.0}, &seen);
            assert_int_equal(seen.lights[0].kind, far ? DIP_LIGHT_DIRECTIONAL : DIP_LIGHT_POINT);
            free(lighting);
        }
    }
}

// A light must be among those that reach a box if the nearest point of the box is in its range. It
// must not be if that point is more than a hundredth beyond the range.
static void lights_reach_boxes_within_their_range(void **state) {
    (void)state;
    Random random = {2};
    int reached = 0, missed = 0;
    for (int i = 0; i < 500; i++) {
        DipLightDef lights[DIP_MAX_LIGHTS];
        DipBox box;
        for (int k = 0; k < 3; k++) {
            box.centre[k] = (float)random_real(&random, -20.0, 20.0);
            box.extent[k] = (float)random_real(&random, 0.0, 5.0);
        }
        for (int l = 0; l < DIP_MAX_LIGHTS; l++) {
            lights[l] = (DipLightDef){.kind = (DipLightKind)random_int(&random, 0, 2),
                                      .direction_world = {0, -1, 0},
                                      .attenuation = {1, 0, 0},
                                      .inner_deg = 10,
                                      .outer_deg = 20};
            lights[l].range_m = l % 8 ? (float)random_real(&random, 0.1, 20.0) : 0.0f;
            for (int k = 0; k < 3; k++) {
                lights[l].position_world[k] = (float)random_real(&random, -20.0, 20.0);
            }
        }
        DipSceneLighting *lighting = lighting_of(lights, DIP_MAX_LIGHTS);
        const uint64_t reaching = dip_lights_reaching(lighting, &box);
        for (int l = 0; l < DIP_MAX_LIGHTS; l++) {
            double distance2 = 0.0;
            for (int k = 0; k < 3; k++) {
                const double at = (double)lights[l].position_world[k];
                const double low = (double)box.centre[k] - (double)box.extent[k];
                const double high = (double)box.centre[k] + (double)box.extent[k];
                const double nearest = fmin(fmax(at, low), high);
                distance2 += (at - nearest) * (at - nearest);
            }
            const double range = (double)lights[l].range_m;
            const bool endless = lights[l].kind == DIP_LIGHT_DIRECTIONAL || range == 0.0;
            const bool reaches = reaching >> l & 1;
            if (endless || sqrt(distance2) <= range) {
                assert_true(reaches);
                reached++;
            } else if (sqrt(distance2) > 1.01 * range + 0.02) {
                assert_false(reaches);
                missed++;
            }
        }
        free(lighting);
    }
    assert_true(reached > 1000 && missed > 1000);
}

static void no_light_beyond_the_last_one_reaches_a_box(void **state) {
    (void)state;
    const DipLightDef lights[2] = {{.kind = DIP_LIGHT_DIRECTIONAL, .direction_world = {0, -1, 0}},
                                   {.kind = DIP_LIGHT_DIRECTIONAL, .direction_world = {0, -1, 0}}};
    const DipBox box = {.extent = {1, 1, 1}};
    for (int count = 0; count <= 2; count++) {
        DipSceneLighting *lighting = lighting_of(lights, count);
        assert_true(dip_lights_reaching(lighting, &box) == (UINT64_C(1) << count) - 1);
        free(lighting);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_direction_is_reversed_to_length_one),
        cmocka_unit_test(the_strongest_directional_light_casts_shadows),
        cmocka_unit_test(lights_are_seen_from_the_eye),
        cmocka_unit_test(a_cone_without_a_rim_falls_within_a_thousandth),
        cmocka_unit_test(lights_far_away_are_directional),
        cmocka_unit_test(lights_up_to_the_greatest_distance_stay_where_they_are),
        cmocka_unit_test(lights_reach_boxes_within_their_range),
        cmocka_unit_test(no_light_beyond_the_last_one_reaches_a_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
