// Tests the limits of lights, and where the loader places the lights of a file: at nodes with any
// transform, against the product of matrices in doubles.
#include "assets/model_parts.h"
#include "renderer/catalogue/random.h"
#include "tests/assets/fixture.h"
#include "tests/assets/made_scene.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

// --- limits --------------------------------------------------------------------------------------

static const float most = DIP_MAX_LIGHT_LIN;

static DipLightDef sound_light(DipLightKind kind) {
    return (DipLightDef){.kind = kind,
                         .colour_lin = {1.0f, 1.0f, 1.0f},
                         .direction_world = {0.0f, -1.0f, 0.0f},
                         .attenuation = {1.0f, 0.0f, 0.0f},
                         .outer_deg = 45.0f};
}

// Tries values for one member of a light: `good` ones have no fault, `bad` ones the one that begins
// with `fault`.
static void try_values(DipLightDef *light, float *member, float low, float high,
                       const char *fault) {
    const float saved = *member;
    const float good[] = {low, high, 0.75f * low + 0.25f * high};
    const float bad[] = {nextafterf(low, -INFINITY), nextafterf(high, INFINITY), -INFINITY,
                         INFINITY, NAN};
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i) {
        *member = good[i];
        if (dip_light_fault(light)) {
            fail_msg("%g: %s", (double)good[i], dip_light_fault(light));
        }
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        *member = bad[i];
        const char *found = dip_light_fault(light);
        if (!found || strncmp(found, fault, strlen(fault)) != 0) {
            fail_msg("%g: %s, expected %s", (double)bad[i], found ? found : "no fault", fault);
        }
    }
    *member = saved;
}

static void assert_fault(const DipLightDef *light, const char *fault) {
    const char *found = dip_light_fault(light);
    if (!found != !fault || (fault && strcmp(found, fault) != 0)) {
        fail_msg("%s, expected %s", found ? found : "no fault", fault ? fault : "none");
    }
}

static void each_member_of_a_light_has_its_limits(void **state) {
    (void)state;
    static const DipLightKind kinds[3] = {DIP_LIGHT_DIRECTIONAL, DIP_LIGHT_POINT, DIP_LIGHT_SPOT};
    for (int k = 0; k < 3; ++k) {
        DipLightDef light = sound_light(kinds[k]);
        for (int i = 0; i < 3; ++i) {
            try_values(&light, &light.colour_lin[i], 0.0f, most, "its colour or strength");
            try_values(&light, &light.position_world[i], -FLT_MAX, FLT_MAX, "its position");
            light.attenuation[(i + 1) % 3] = 1.0f;
            try_values(&light, &light.attenuation[i], 0.0f, most, "its attenuation");
            light.direction_world[(i + 1) % 3] = 1.0f;
            try_values(&light, &light.direction_world[i], -FLT_MAX, FLT_MAX, "its direction");
        }
        try_values(&light, &light.range_m, 0.0f, most, "its range");
        try_values(&light, &light.inner_deg, 0.0f, light.outer_deg, "its cone");
        light.inner_deg = 0.0f;
        try_values(&light, &light.outer_deg, kinds[k] == DIP_LIGHT_SPOT ? FLT_TRUE_MIN : 0.0f,
                   90.0f, "its cone");
    }
}

// Lights from far away do not fade, point lights have no direction, and only spot lights a cone.
static void zeros_are_faults_of_some_kinds_only(void **state) {
    (void)state;
    DipLightDef light = sound_light(DIP_LIGHT_DIRECTIONAL);
    light.attenuation[0] = light.outer_deg = 0.0f;
    assert_fault(&light, NULL);
    light.direction_world[1] = 0.0f;
    assert_fault(&light, "its direction is zero or not finite");
    light = sound_light(DIP_LIGHT_POINT);
    light.direction_world[1] = light.outer_deg = 0.0f;
    assert_fault(&light, NULL);
    light.attenuation[0] = 0.0f;
    assert_fault(&light, "its attenuation is zero, negative, too large or not a number");
    light = sound_light(DIP_LIGHT_SPOT);
    light.outer_deg = 0.0f;
    assert_fault(&light, "its cone is not within 0..90 degrees");
    light.outer_deg = 45.0f;
    light.direction_world[1] = 0.0f;
    assert_fault(&light, "its direction is zero or not finite");
    light.kind = (DipLightKind)77;
    assert_fault(&light, "its kind is unknown");
}

// --- places --------------------------------------------------------------------------------------

static void random_transform(Random *random, struct aiMatrix4x4 *matrix) {
    float *m = &matrix->a1;
    for (int i = 0; i < 12; ++i) {
        m[i] = (float)random_real(random, -2.0, 2.0);
    }
    m[12] = m[13] = m[14] = 0.0f;
    m[15] = 1.0f;
}

// Multiplies the vector (v, w) with the first three rows of a matrix.
static void transform(const struct aiMatrix4x4 *matrix, const double v[3], double w, double to[3]) {
    const float *m = &matrix->a1;
    for (int row = 0; row < 3; ++row) {
        to[row] =
            m[4 * row] * v[0] + m[4 * row + 1] * v[1] + m[4 * row + 2] * v[2] + m[4 * row + 3] * w;
    }
}

static void lights_are_placed_by_the_nodes_above_them(void **state) {
    (void)state;
    static const enum aiLightSourceType types[3] = {aiLightSource_DIRECTIONAL, aiLightSource_POINT,
                                                    aiLightSource_SPOT};
    static const DipLightKind kinds[3] = {DIP_LIGHT_DIRECTIONAL, DIP_LIGHT_POINT, DIP_LIGHT_SPOT};
    const DipModelOptions options = {.has_light_scale = true, .light_scale = 1.0};
    struct aiLight lights[3] = {0};
    Random random = {99};
    MadeScene *made = made_scene(3);
    random_transform(&random, &made->root.mTransformation);
    for (int i = 0; i < 3; ++i) {
        random_transform(&random, &made->nodes[i].mTransformation);
        lights[i] = (struct aiLight){.mType = types[i],
                                     .mName = made->nodes[i].mName,
                                     .mPosition = {1.0f, -2.0f, 0.5f},
                                     .mDirection = {-0.25f, 3.0f, 1.0f},
                                     .mAttenuationConstant = 0.5f,
                                     .mAttenuationLinear = 0.25f,
                                     .mAttenuationQuadratic = 0.125f,
                                     .mColorDiffuse = {0.5f, 0.25f, 1.0f},
                                     .mAngleInnerCone = 0.5f,
                                     .mAngleOuterCone = 0.75f};
        made->lights[i] = &lights[i];
    }
    made->scene.mNumLights = 3;
    DipModel *model = fixture_load(made_write(made), &options, NULL);
    const DipLightingDef *lighting = dip_model_scene_def(model)->lighting;
    assert_non_null(lighting);
    assert_int_equal(lighting->light_count, 3);
    for (int i = 0; i < 3; ++i) {
        const DipLightDef *light = &lighting->lights[i];
        double position[3] = {1.0, -2.0, 0.5}, direction[3] = {-0.25, 3.0, 1.0}, between[3];
        transform(&made->nodes[i].mTransformation, position, 1.0, between);
        transform(&made->root.mTransformation, between, 1.0, position);
        transform(&made->nodes[i].mTransformation, direction, 0.0, between);
        transform(&made->root.mTransformation, between, 0.0, direction);
        const double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                                   direction[2] * direction[2]);
        assert_int_equal(light->kind, kinds[i]);
        for (int axis = 0; axis < 3; ++axis) {
            assert_float_equal(light->position_world[axis], i == 0 ? 0.0 : position[axis], 1e-5);
            assert_float_equal(light->direction_world[axis],
                               i == 1 ? 0.0 : direction[axis] / length, 1e-6);
            assert_float_equal(light->attenuation[axis], i == 0 ? axis == 0 : ldexp(0.5, -axis),
                               0.0);
        }
        // assimp gives the full angles of this format.
        const double half = 0.5 * 180.0 / acos(-1.0);
        assert_float_equal(light->inner_deg, i == 2 ? 0.5 * half : 0.0, 1e-4);
        assert_float_equal(light->outer_deg, i == 2 ? 0.75 * half : 0.0, 1e-4);
        assert_true(light->range_m == 0.0f);
    }
    dip_model_destroy(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_member_of_a_light_has_its_limits),
                                       cmocka_unit_test(zeros_are_faults_of_some_kinds_only),
                                       cmocka_unit_test(lights_are_placed_by_the_nodes_above_them)};
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
