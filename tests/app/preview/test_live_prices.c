// Tests of rough prices with real painters: of models, and of a scene of the gallery. No time is
// asserted, since the machine may be busy.
#include "app/measure/metrics/flip.h"
#include "app/preview/live/live_prices.h"
#include "renderer/catalogue/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// The picture has several blocks in each direction, and the last ones are cut off.
enum { WIDTH = 131, HEIGHT = 107 };

static const char *assets;
static DipTestScene scene;
static DipSession session;
static DipPrices *prices;
static DipLivePrices *live;
static DipLivePicture picture;
static const DipQuality *panes;
static DipQuality quality[DIP_PANE_COUNT];
static uint8_t truth_rgba8[4 * WIDTH * HEIGHT];
static const DipSrgbPicture truth = {truth_rgba8, 4 * WIDTH, WIDTH, HEIGHT};

static int set_up(void **state) {
    (void)state;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_fence);
    session = (DipSession){.pool = dip_pool_create(1, NULL), .isa = dip_isa_best()};
    session.scene = dip_scene_create(&scene.def, NULL, NULL);
    prices = dip_prices_create(NULL);
    live = dip_live_prices_create(&session, prices, NULL);
    assert_true(session.pool && session.scene && prices && live);
    picture = (DipLivePicture){.pose = scene.pose,
                               .width = WIDTH,
                               .height = HEIGHT,
                               .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE};
    quality[DIP_PANE_CURRENT] = dip_quality_default();
    assert_true(
        dip_quality_parse("aa=4,aaa=on,asd=2,af=4,aaf=on", &quality[DIP_PANE_REQUESTED], NULL));
    panes = quality;
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_live_prices_destroy(&live);
    dip_prices_destroy(&prices);
    dip_gallery_destroy(&session.gallery);
    dip_scene_destroy(&session.scene);
    dip_pool_destroy(&session.pool);
    dip_test_scene_free(&scene);
    return 0;
}

static DipLiveTruth truth_of(const DipSrgbPicture *against, int samples) {
    return (DipLiveTruth){.picture = against ? *against : (DipSrgbPicture){0}, .samples = samples};
}

static bool step_without_truth(double budget_ms) {
    return dip_live_prices_step(live, &picture, panes, &(DipLiveTruth){0}, budget_ms);
}

// Measures until nothing is left. Returns the number of steps that had news.
static int measure(const DipSrgbPicture *against, int samples) {
    const DipLiveTruth with = truth_of(against, samples);
    int news = 0, steps = 0;
    do {
        news += dip_live_prices_step(live, &picture, panes, &with, 5.0);
        assert_true(++steps < 100000);
    } while (dip_live_prices_are_working(live));
    return news;
}

static void check_all_known(bool with_errors) {
    const DipQuality *pane = &panes[DIP_PANE_REQUESTED];
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        for (int step = 0; step < dip_setting_info((DipSetting)s)->step_count; step++) {
            const DipPrice price = dip_prices_step(prices, (DipSetting)s, step, pane);
            if (s == DIP_SETTING_MIPDEBUG) {
                continue;
            }
            assert_int_not_equal(price.state, DIP_PRICE_UNKNOWN);
            assert_true(price.state == DIP_PRICE_BASE || price.ms_low <= price.ms_high);
            assert_int_equal(price.has_flip, with_errors);
        }
    }
    assert_true(dip_prices_find_live(prices, &panes[DIP_PANE_CURRENT]) >= 0);
    assert_true(dip_prices_find_live(prices, pane) >= 0);
}

// Draws with a painter of the test's own. The frame is valid until the painter draws again.
static DipFrame draw(DipPainter *painter, const DipQuality *with) {
    DipFrame frame;
    assert_true(dip_painter_set_quality(painter, with, NULL));
    assert_true(
        dip_painter_draw(painter, session.scene, &picture.pose, picture.time_ns, &frame, NULL));
    return frame;
}

static DipPainter *make_painter(void) {
    const DipRendererDef def = {.pool = session.pool,
                                .isa = session.isa,
                                .width = WIDTH,
                                .height = HEIGHT,
                                .quality = dip_quality_default()};
    DipPainter *painter = dip_painter_create(&def, session.gallery, NULL);
    assert_non_null(painter);
    return painter;
}

// Draws with the best settings what stands for the truth.
static void make_truth(void) {
    DipPainter *painter = make_painter();
    DipQuality best;
    assert_true(dip_quality_parse("aa=8,aaa=on,af=16,aaf=on", &best, NULL));
    const DipFrame frame = draw(painter, &best);
    for (int y = 0; y < HEIGHT; y++) {
        memcpy(truth_rgba8 + 4 * WIDTH * y, frame.rgba8 + frame.stride_bytes * (size_t)y,
               4 * WIDTH);
    }
    dip_painter_destroy(&painter);
}

// FLIP of a whole picture.
static double flip_of(const char *settings) {
    static float map[WIDTH * HEIGHT];
    DipPainter *painter = make_painter();
    DipQuality with;
    DipFlip flip;
    DipFlipAnalysis analysis;
    assert_true(dip_quality_parse(settings, &with, NULL));
    const DipFrame frame = draw(painter, &with);
    const DipSrgbPicture drawn = {frame.rgba8, frame.stride_bytes, WIDTH, HEIGHT};
    assert_true(dip_flip_init(&flip, WIDTH, HEIGHT, DIP_FLIP_PIXELS_PER_DEGREE));
    assert_true(dip_flip_analysis_init(&flip, &analysis));
    dip_flip_analyse(&flip, &truth, &analysis);
    dip_flip_compare(&flip, &drawn, &analysis, map);
    double sum = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        sum += (double)map[i];
    }
    dip_flip_analysis_free(&analysis);
    dip_flip_free(&flip);
    dip_painter_destroy(&painter);
    return sum / (WIDTH * HEIGHT);
}

static void all_steps_of_models_get_a_price(void **state) {
    (void)state;
    assert_true(measure(NULL, 0) > 1);
    check_all_known(false);
    assert_string_equal(dip_prices_progress(prices), "");
}

static void errors_are_those_of_whole_pictures(void **state) {
    (void)state;
    make_truth();
    measure(&truth, 1);
    check_all_known(true);
    const double base = flip_of("aa=none"), aa_8 = flip_of("aa=8");
    DipPrice price = dip_prices_step(prices, DIP_SETTING_AA, 0, &panes[DIP_PANE_REQUESTED]);
    assert_true(fabs(price.flip - base) <= 1e-9);
    price = dip_prices_step(prices, DIP_SETTING_AA, 4, &panes[DIP_PANE_REQUESTED]);
    assert_true(fabs(price.flip - (aa_8 - base)) <= 1e-9);
    assert_true(price.flip < 0.0);
    // Errors against a better truth replace the old ones.
    memset(truth_rgba8, 128, sizeof truth_rgba8);
    measure(&truth, 2);
    price = dip_prices_step(prices, DIP_SETTING_AA, 0, &panes[DIP_PANE_REQUESTED]);
    assert_true(fabs(price.flip - flip_of("aa=none")) <= 1e-9 && fabs(price.flip - base) > 1e-3);
}

// While errors against a finer truth are measured, those against the coarser one stay, all of them.
static void errors_do_not_vanish_when_the_truth_gets_finer(void **state) {
    (void)state;
    const DipQuality *pane = &panes[DIP_PANE_REQUESTED];
    make_truth();
    measure(&truth, 32);
    const double base = dip_prices_step(prices, DIP_SETTING_AA, 0, pane).flip;
    const double step = dip_prices_step(prices, DIP_SETTING_AA, 4, pane).flip;
    memset(truth_rgba8, 128, sizeof truth_rgba8);
    const DipLiveTruth finer = truth_of(&truth, 128);
    do {
        check_all_known(true);
        assert_true(dip_prices_step(prices, DIP_SETTING_AA, 0, pane).flip == base);
        assert_true(dip_prices_step(prices, DIP_SETTING_AA, 4, pane).flip == step);
        dip_live_prices_step(live, &picture, panes, &finer, 0.0);
    } while (dip_live_prices_lack_errors(live));
    assert_true(dip_prices_step(prices, DIP_SETTING_AA, 0, pane).flip != base);
}

// Nothing is timed while another thread draws a truth, and the progress says what is waited for.
static void times_wait_while_a_truth_is_drawn(void **state) {
    (void)state;
    DipLiveTruth drawn = {.next_samples = 32, .drawn = 0.4};
    for (int i = 0; i < 2000; i++) {
        dip_live_prices_step(live, &picture, panes, &drawn, 5.0);
    }
    assert_false(dip_live_prices_are_working(live));
    assert_true(dip_prices_find_live(prices, &panes[DIP_PANE_REQUESTED]) < 0);
    assert_string_equal(dip_prices_progress(prices), "errors: the converged picture is 40 % drawn");
    dip_live_prices_pause(live);
    picture.time_ns++;
    drawn.waits = true;
    dip_live_prices_step(live, &picture, panes, &drawn, 5.0);
    assert_string_equal(
        dip_prices_progress(prices),
        "errors: the converged picture is 40 % drawn, waiting for a free processor");
    measure(NULL, 0);
    check_all_known(false);
}

static void another_picture_has_no_prices_yet(void **state) {
    (void)state;
    measure(NULL, 0);
    const DipQuality *pane = &panes[DIP_PANE_REQUESTED];
    picture.pose.position_world[0] += 0.5;
    step_without_truth(0.0);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 1, pane).state, DIP_PRICE_UNKNOWN);
    assert_string_not_equal(dip_prices_progress(prices), "");
    dip_live_prices_pause(live);
    assert_string_equal(dip_prices_progress(prices), "");
    measure(NULL, 0);
    picture.width -= 32;
    step_without_truth(0.0);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 1, pane).state, DIP_PRICE_UNKNOWN);
    dip_live_prices_pause(live);
    measure(&truth, 1); // The truth has another size, so it is not used.
    check_all_known(false);
}

// Live prices start from the baseline of a report that was opened, even if the user prefers them.
static void another_baseline_begins_anew(void **state) {
    (void)state;
    DipCostReport report = {.path_count = 1};
    assert_true(dip_quality_parse("aa=2", &report.options.baseline, NULL));
    make_truth();
    measure(&truth, 1);
    assert_true(dip_prices_set_report(prices, &report, NULL));
    dip_prices_prefer_rough(prices, true);
    measure(&truth, 1);
    check_all_known(true);
    const DipQuality *pane = &panes[DIP_PANE_REQUESTED];
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 1, pane).state, DIP_PRICE_BASE);
    assert_int_equal(dip_prices_step(prices, DIP_SETTING_AA, 0, pane).state, DIP_PRICE_ROUGH);
}

static void scenes_of_the_gallery_have_prices(void **state) {
    (void)state;
    int index;
    assert_true(dip_gallery_find("blend", &index, NULL));
    const DipGalleryDef def = {index, session.pool, session.isa, assets};
    session.gallery = dip_gallery_create(&def, NULL);
    assert_non_null(session.gallery);
    session.shows_gallery = true;
    dip_gallery_pose(index, 0, &picture.pose);
    assert_true(measure(NULL, 0) > 1);
    check_all_known(false);
    // The painters leave before their gallery goes.
    dip_live_prices_leave_scene(live);
    dip_gallery_destroy(&session.gallery);
    assert_false(dip_live_prices_are_working(live));
    picture.pose = scene.pose;
    measure(NULL, 0);
    check_all_known(false);
}

// A history is dearer while the camera moves, which is what reports time. The frame that is timed
// must therefore blend its pixels with those of a frame that another pose has shown.
static void a_history_is_priced_for_a_moving_camera(void **state) {
    (void)state;
    assert_true(dip_quality_parse("taa=history", &quality[DIP_PANE_REQUESTED], NULL));
    measure(NULL, 0);
    const int row = dip_prices_find_live(prices, &quality[DIP_PANE_REQUESTED]);
    assert_true(row >= 0);
    const double *counters = dip_prices_live(prices)->rows[row].counters;
    assert_true(counters[DIP_COUNTER_pixels_reprojected] > 0.5 * WIDTH * HEIGHT);
}

int main(int argc, char **argv) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(all_steps_of_models_get_a_price),
        TEST(errors_are_those_of_whole_pictures),
        TEST(errors_do_not_vanish_when_the_truth_gets_finer),
        TEST(times_wait_while_a_truth_is_drawn),
        TEST(another_picture_has_no_prices_yet),
        TEST(another_baseline_begins_anew),
        TEST(a_history_is_priced_for_a_moving_camera),
        TEST(scenes_of_the_gallery_have_prices),
    };
    assets = argc > 1 ? argv[1] : "assets";
    return cmocka_run_group_tests(tests, NULL, NULL);
}
