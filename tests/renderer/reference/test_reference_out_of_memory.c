// Tests what the reference renderer does when memory runs out: a reference is made whole or not at
// all, and after a failed picture it draws the right one.
#include "renderer/reference/convergence.h"
#include "renderer/reference/internal/differences.h"
#include "renderer/reference/reference.h"
#include "renderer/catalogue/scenes.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 18, VALUES = 3 * WIDTH * HEIGHT, SAMPLES = 4, SEED = 7 };

typedef struct Fixture {
    DipTestScene made;
    DipReference *reference;
    DipConvergence *convergence;
    bool for_truth;
    DipQuality quality;
    double rgb_lin[VALUES];
    double expected[VALUES];
} Fixture;

static Fixture fixture;

static bool create(void *context, DipError *err) {
    (void)context;
    fixture.reference = fixture.for_truth
                            ? dip_reference_create_for_truth(&fixture.made.def, NULL, err)
                            : dip_reference_create(&fixture.made.def, err);
    if (fixture.reference) {
        dip_reference_set_reflection(fixture.reference, &fixture.made.reflection);
    }
    return fixture.reference != NULL;
}

static bool draw(void *context, DipError *err) {
    (void)context;
    memset(fixture.rgb_lin, 0, sizeof fixture.rgb_lin);
    return dip_reference_draw(fixture.reference, &fixture.quality, &fixture.made.pose, WIDTH,
                              HEIGHT, fixture.rgb_lin, err);
}

static bool converge(void *context, DipError *err) {
    (void)context;
    memset(fixture.rgb_lin, 0, sizeof fixture.rgb_lin);
    return dip_reference_converge(fixture.reference, &fixture.made.pose, WIDTH, HEIGHT, SAMPLES,
                                  SEED, fixture.rgb_lin, err);
}

static bool open_tiles(void *context, DipError *err) {
    (void)context;
    fixture.convergence =
        dip_convergence_create(fixture.reference, &fixture.made.pose, WIDTH, HEIGHT, err);
    return fixture.convergence != NULL;
}

static bool add_tile(void *context, DipError *err) {
    (void)context;
    memset(fixture.rgb_lin, 0, sizeof fixture.rgb_lin);
    return dip_convergence_add_tile(fixture.convergence, 0, SAMPLES, SEED, 1.0, fixture.rgb_lin,
                                    NULL, err);
}

static bool share(void *context, DipError *err) {
    (void)context;
    return dip_reference_share_differences(fixture.reference, err);
}

static bool share_and_draw(void *context, DipError *err) {
    return share(context, err) && draw(context, err);
}

static void must_create(void *context) {
    assert_true(create(context, NULL));
}

static void must_open_tiles(void *context) {
    must_create(context);
    assert_true(open_tiles(context, NULL));
}

static void finish(void *context) {
    (void)context;
    dip_convergence_destroy(&fixture.convergence);
    dip_reference_destroy(&fixture.reference);
}

static void assert_expected(void) {
    assert_memory_equal(fixture.rgb_lin, fixture.expected, sizeof fixture.expected);
}

static void check_create(void *context, bool succeeded) {
    assert_int_equal(fixture.reference != NULL, succeeded);
    if (succeeded && !fixture.for_truth) {
        assert_true(draw(context, NULL));
        assert_expected();
    }
}

static void check_draw(void *context, bool succeeded) {
    assert_true(succeeded || draw(context, NULL));
    assert_expected();
}

static void check_share(void *context, bool succeeded) {
    assert_true(succeeded ? draw(context, NULL) : share_and_draw(context, NULL));
    assert_expected();
}

static void check_converge(void *context, bool succeeded) {
    assert_true(succeeded || converge(context, NULL));
    assert_expected();
}

static void check_open_tiles(void *context, bool succeeded) {
    assert_int_equal(fixture.convergence != NULL, succeeded);
    if (succeeded) {
        assert_true(add_tile(context, NULL));
        assert_expected();
    }
}

static void check_add_tile(void *context, bool succeeded) {
    assert_true(succeeded || add_tile(context, NULL));
    assert_expected();
}

// Stores what `picture` draws when no allocation fails.
static void expect(bool (*picture)(void *, DipError *)) {
    must_open_tiles(NULL);
    assert_true(picture(NULL, NULL));
    memcpy(fixture.expected, fixture.rgb_lin, sizeof fixture.expected);
    finish(NULL);
}

static void begin(DipTestSceneKind kind, const char *settings) {
    dip_test_scene_make(&fixture.made, kind);
    assert_true(dip_quality_parse(settings, &fixture.quality, NULL));
}

// Makes references for the scene that was begun, and ends it.
static void check_both_references(void) {
    expect(draw);
    for (int for_truth = 0; for_truth < 2; for_truth++) {
        fixture.for_truth = for_truth;
        dip_out_of_memory_check(
            &(DipOutOfMemory){.name = for_truth ? "a reference for truths" : "a reference",
                              .run = create,
                              .check = check_create,
                              .finish = finish,
                              .needs_every_allocation = true});
    }
    fixture.for_truth = false;
    dip_test_scene_free(&fixture.made);
}

static void reference_is_made_whole_or_not_at_all(void **state) {
    (void)state;
    begin(DIP_TEST_SCENE_water_effects, "aa=4");
    check_both_references();
    begin(DIP_TEST_SCENE_lights, "shadows=512");
    check_both_references();
}

static void failed_picture_can_be_drawn_again(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=4,aaa=on,af=16,aaf=on", "opt=advanced"};
    begin(DIP_TEST_SCENE_water_effects, "");
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        char name[80];
        snprintf(name, sizeof name, "reference picture with %s", settings[i]);
        assert_true(dip_quality_parse(settings[i], &fixture.quality, NULL));
        expect(draw);
        dip_out_of_memory_check(&(DipOutOfMemory){.name = name,
                                                  .prepare = must_create,
                                                  .run = draw,
                                                  .check = check_draw,
                                                  .finish = finish,
                                                  .needs_every_allocation = true});
    }
    dip_test_scene_free(&fixture.made);
}

static void failed_rounding_can_be_repeated(void **state) {
    (void)state;
    begin(DIP_TEST_SCENE_water_effects, "aa=4");
    expect(share_and_draw);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a reference that rounds as the renderer",
                                              .prepare = must_create,
                                              .run = share,
                                              .check = check_share,
                                              .finish = finish,
                                              .needs_every_allocation = true});
    dip_test_scene_free(&fixture.made);
}

static void failed_convergence_can_be_repeated(void **state) {
    (void)state;
    begin(DIP_TEST_SCENE_water_effects, "");
    expect(converge);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a converged picture",
                                              .prepare = must_create,
                                              .run = converge,
                                              .check = check_converge,
                                              .finish = finish,
                                              .needs_every_allocation = true});
    expect(add_tile);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "the tiles of a converged picture",
                                              .prepare = must_create,
                                              .run = open_tiles,
                                              .check = check_open_tiles,
                                              .finish = finish,
                                              .needs_every_allocation = true});
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a tile of a converged picture",
                                              .prepare = must_open_tiles,
                                              .run = add_tile,
                                              .check = check_add_tile,
                                              .finish = finish,
                                              .needs_every_allocation = true});
    dip_test_scene_free(&fixture.made);
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_is_made_whole_or_not_at_all),
        cmocka_unit_test(failed_picture_can_be_drawn_again),
        cmocka_unit_test(failed_rounding_can_be_repeated),
        cmocka_unit_test(failed_convergence_can_be_repeated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
