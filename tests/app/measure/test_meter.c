// Tests that a meter, which works block by block, finds the values of whole pictures to the bit.
#include "app/measure/metrics/meter.h"
#include "app/measure/metrics/ssim.h"
#include "tests/app/measure/map_sum.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 320 * 240, WINDOW = DIP_PICTURE_BLOCK };

static uint8_t codes[2][4 * MOST];
static float light[3 * MOST];
static uint8_t classes[MOST];
static float whole_map[MOST];
static DipMeter meter;
static int width, height;
static double pixels_per_degree;

static DipSrgbPicture picture(int index) {
    return (DipSrgbPicture){codes[index], 4 * (size_t)width, width, height};
}

static DipMeterStandard standard(void) {
    return (DipMeterStandard){.picture = picture(1), .rgb_lin = light, .classes = classes};
}

// Makes two pictures of this size, a smooth one and the same with noise.
static void make_pictures(int new_width, int new_height, double new_pixels_per_degree) {
    width = new_width;
    height = new_height;
    pixels_per_degree = new_pixels_per_degree;
    uint32_t random = 1;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const int i = y * width + x;
            for (int c = 0; c < 4; c++) {
                random = random * 1664525u + 1013904223u;
                const int smooth = 100 + (x * (c + 1) / 3 + y / (c + 1)) % 100;
                codes[1][4 * i + c] = (uint8_t)smooth;
                codes[0][4 * i + c] = (uint8_t)(smooth + (int)(random >> 16) % 90 - 45);
                light[3 * i + c % 3] = (float)smooth / 255.0f;
            }
            classes[i] = (uint8_t)(random >> 20) % DIP_SEEN_COUNT;
        }
    }
}

static void init(DipMeterKind kind) {
    assert_true(dip_meter_init(&meter, kind, width, height, pixels_per_degree));
}

static DipMetricSums judge(const DipMeterStandard *against) {
    const DipSrgbPicture test = picture(0);
    DipMetricSums sums = {.bursts = 0.0};
    dip_meter_begin_burst(&meter);
    assert_true(dip_meter_add(&meter, &test, NULL, against, &sums));
    dip_meter_end_burst(&meter, &sums);
    return sums;
}

// Computes FLIP in a window of at most one block, which is not divided.
static void flip_of_window(const DipPixelRect *window, float *map) {
    DipFlip flip;
    DipFlipAnalysis analysis;
    const DipSrgbPicture test = picture(0), against = picture(1);
    const DipSrgbPicture test_part = dip_picture_part(&test, window);
    const DipSrgbPicture against_part = dip_picture_part(&against, window);
    assert_true(dip_flip_init(&flip, window->width, window->height, pixels_per_degree));
    assert_true(dip_flip_analysis_init(&flip, &analysis));
    dip_flip_analyse(&flip, &against_part, &analysis);
    dip_flip_compare(&flip, &test_part, &analysis, map);
    dip_flip_analysis_free(&analysis);
    dip_flip_free(&flip);
}

// Checks the pixels whose surroundings lie within the window or end at the border of the picture.
static int check_window(const DipPixelRect *window, bool *seen) {
    static float map[WINDOW * WINDOW];
    const int reach = meter.flip.reach_px;
    int checked = 0;
    flip_of_window(window, map);
    for (int y = window->y; y < window->y + window->height; y++) {
        for (int x = window->x; x < window->x + window->width; x++) {
            const bool whole =
                (x - window->x >= reach || window->x == 0) &&
                (y - window->y >= reach || window->y == 0) &&
                (window->x + window->width - x > reach || window->x + window->width == width) &&
                (window->y + window->height - y > reach || window->y + window->height == height);
            const int i = y * width + x;
            if (whole) {
                assert_true(meter.flip_map[i] ==
                            map[(y - window->y) * window->width + (x - window->x)]);
                checked += !seen[i];
                seen[i] = true;
            }
        }
    }
    return checked;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// Windows that lie across the borders of blocks see every pixel at least once.
static void check_flip(void) {
    static bool seen[MOST];
    const int pace = WINDOW - 2 * meter.flip.reach_px;
    int checked = 0;
    memset(seen, 0, sizeof seen);
    for (int y = 0; y == 0 || y - pace + WINDOW < height; y += pace) {
        for (int x = 0; x == 0 || x - pace + WINDOW < width; x += pace) {
            const DipPixelRect window = {x, y, smaller(WINDOW, width - x),
                                         smaller(WINDOW, height - y)};
            checked += check_window(&window, seen);
        }
    }
    assert_int_equal(checked, width * height);
}

static void check_sum(const float *map, int region, double sum, double pixels) {
    const DipPixelMask mask = {classes, (uint8_t)(region - 1)};
    const DipMapSum whole =
        dip_map_sum(map, (size_t)width * (size_t)height, region == 0 ? (DipPixelMask){0} : mask);
    assert_true(whole.sum == sum && whole.pixel_count == pixels);
}

static void check_whole(void) {
    static float errors[3 * MOST];
    const size_t count = (size_t)width * (size_t)height;
    const DipSrgbPicture test = picture(0), against = picture(1);
    const DipMeterStandard by = standard();
    init(DIP_METER_BURSTS);
    const DipMetricSums sums = judge(&by);
    check_flip();
    for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
        const DipMetricRegionSums *region = &sums.regions[r];
        check_sum(meter.flip_map, r, region->flip, region->pixels);
        assert_true(dip_ssim_map(&test, &against, whole_map));
        check_sum(whole_map, r, region->ssim, region->ssim_pixels);
        dip_difference_codes_map(&test, &against, whole_map);
        check_sum(whole_map, r, region->squared_codes, region->pixels);
        dip_difference_lin(&test, light, errors);
        dip_difference_squared_map(errors, count, whole_map);
        check_sum(whole_map, r, region->squared_lin, region->pixels);
    }
    assert_true(sums.regions[0].pixels == (double)count && sums.regions[0].flip > 0.0);
    dip_meter_free(&meter);
}

static void blocks_have_the_values_of_the_whole_picture(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double pixels_per_degree;
    } sizes[] = {{211, 163, DIP_FLIP_PIXELS_PER_DEGREE},
                 {97, 193, DIP_FLIP_PIXELS_PER_DEGREE},
                 {301, 95, 94.2},
                 {319, 7, 25.0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        make_pictures(sizes[i].width, sizes[i].height, sizes[i].pixels_per_degree);
        check_whole();
    }
}

// A standard that was analysed as a whole, and a meter that keeps no earlier frames, change no bit.
static void shorter_ways_give_the_same_sums(void **state) {
    (void)state;
    make_pictures(211, 163, DIP_FLIP_PIXELS_PER_DEGREE);
    DipMeterStandard by = standard();
    init(DIP_METER_BURSTS);
    const DipMetricSums sums = judge(&by);
    const DipFlipTail tail = dip_flip_tail_result(&meter.tail);
    DipFlipAnalysis analysis;
    assert_true(dip_flip_analysis_init(&meter.flip, &analysis));
    dip_flip_analyse(&meter.flip, &by.picture, &analysis);
    dip_meter_free(&meter);
    by.analysis = &analysis;
    init(DIP_METER_PICTURES);
    const DipMetricSums again = judge(&by);
    const DipFlipTail again_tail = dip_flip_tail_result(&meter.tail);
    assert_memory_equal(&sums, &again, sizeof sums);
    assert_memory_equal(&tail, &again_tail, sizeof tail);
    assert_true(sums.squared_static > 0.0 && sums.squared_flicker == 0.0);
    dip_meter_free(&meter);
    dip_flip_analysis_free(&analysis);
    init(DIP_METER_FLIP);
    const DipSrgbPicture test = picture(0);
    by = standard();
    DipMetricSums quick = {.bursts = 0.0};
    assert_true(dip_meter_add(&meter, &test, NULL, &by, &quick));
    assert_true(quick.regions[0].flip == sums.regions[0].flip);
    assert_true(quick.regions[0].squared_lin == sums.regions[0].squared_lin);
    assert_true(quick.regions[0].squared_codes == sums.regions[0].squared_codes);
    dip_meter_free(&meter);
}

// A picture that is dropped after any number of steps leaves no trace.
static void a_dropped_picture_leaves_no_trace(void **state) {
    (void)state;
    make_pictures(211, 163, DIP_FLIP_PIXELS_PER_DEGREE);
    const DipMeterStandard by = standard();
    const DipSrgbPicture test = picture(0), other = picture(1);
    init(DIP_METER_PICTURES);
    const DipMetricSums expected = judge(&by);
    DipMeterStandard itself = by;
    itself.picture = picture(0);
    assert_true(judge(&itself).regions[0].flip == 0.0); // A new standard is analysed anew.
    for (int steps = 0; steps < 8; steps++) {
        dip_meter_set_standard(&meter, &by);
        dip_meter_begin(&meter, &other, NULL);
        for (int i = 0; i < steps; i++) {
            dip_meter_step(&meter);
        }
        // The blocks of the standard that were analysed then are not analysed again.
        dip_meter_begin_burst(&meter);
        dip_meter_begin(&meter, &test, NULL);
        while (dip_meter_step(&meter) != DIP_STEP_DONE) {
        }
        DipMetricSums sums = meter.sums;
        dip_meter_end_burst(&meter, &sums);
        assert_memory_equal(&sums, &expected, sizeof sums);
    }
    dip_meter_free(&meter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_have_the_values_of_the_whole_picture),
        cmocka_unit_test(shorter_ways_give_the_same_sums),
        cmocka_unit_test(a_dropped_picture_leaves_no_trace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
