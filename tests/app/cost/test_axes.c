// Tests of `cost axes`: enlarging, energy counters, the rows, and one run. No test looks at a time.
#include "app/cost/axes/axes_drawing.h"
#include "renderer/base/srgb.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include <math.h>

static const char *source_folder; // Of Diptych.

// --- enlarging -----------------------------------------------------------------------------------

// Enlarges a packed picture and copies the result to `to`.
static void enlarge(const uint8_t *from, int from_width, int from_height, uint8_t *to, int to_width,
                    int to_height, DipPool *pool) {
    const DipEnlargerDef def = {from_width, from_height, to_width, to_height, pool};
    DipEnlarger *enlarger = dip_enlarger_create(&def, NULL);
    assert_non_null(enlarger);
    memcpy(to, dip_enlarger_run(enlarger, from, (size_t)from_width * 4),
           (size_t)to_width * (size_t)to_height * 4);
    dip_enlarger_destroy(&enlarger);
    assert_null(enlarger);
}

static void constant_pictures_stay_constant(void **state) {
    (void)state;
    static uint8_t from[4 * 7 * 5], to[4 * 64 * 33];
    for (int code = 0; code < 256; code++) {
        const uint8_t pixel[4] = {(uint8_t)code, (uint8_t)(255 - code), (uint8_t)(code / 2),
                                  (uint8_t)(code ^ 85)};
        for (size_t i = 0; i < sizeof from; i++) {
            from[i] = pixel[i % 4];
        }
        enlarge(from, 7, 5, to, 64, 33, NULL);
        for (size_t i = 0; i < sizeof to; i++) {
            assert_int_equal(to[i], pixel[i % 4]);
        }
    }
}

// Every code in every channel, at a scale of 1.
static void scale_1_is_the_identity(void **state) {
    (void)state;
    static uint8_t from[4 * 256 * 3], to[sizeof from];
    for (size_t i = 0; i < sizeof from; i++) {
        from[i] = (uint8_t)(i / 4 + 57 * (i % 4) + 101 * (i / 1024));
    }
    enlarge(from, 256, 3, to, 256, 3, NULL);
    assert_memory_equal(to, from, sizeof to);
}

// Two pixels, black and white, are a linear ramp between their centres and constant beyond them:
// the light at the destination's pixel x of n is 2 (x + 1/2) / n - 1/2, clamped to 0..1.
static uint8_t ramp_code(int x, int n) {
    static DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    const double light = fmin(fmax(2.0 * (x + 0.5) / n - 0.5, 0.0), 1.0);
    return table.code[(int)(DIP_LINEAR16_MAX * light + 0.5)];
}

static void ramps_stay_ramps(void **state) {
    (void)state;
    enum { N = 64 };
    static uint8_t to[4 * N * N];
    uint8_t across[16], down[16];
    for (int i = 0; i < 4; i++) { // Pixels in the order of rows.
        memset(across + 4 * i, i % 2 ? 255 : 0, 4);
        memset(down + 4 * i, i / 2 ? 255 : 0, 4);
    }
    enlarge(across, 2, 2, to, N, N, NULL);
    for (int i = 0; i < N * N; i++) {
        assert_int_equal(to[4 * i], ramp_code(i % N, N));
        assert_int_equal(to[4 * i + 2], ramp_code(i % N, N));
    }
    enlarge(down, 2, 2, to, N, N, NULL);
    for (int i = 0; i < N * N; i++) {
        assert_int_equal(to[4 * i + 1], ramp_code(i / N, N));
    }
    assert_int_equal(ramp_code(N / 4 - 1, N), 0); // Beyond the centre of the black pixel.
    // The middle of the ramp is half the light, which is the code 188 and not 128.
    assert_in_range(ramp_code(N / 2, N), 188, 190);
}

// A picture of random pixels against the same formula in double precision.
static void random_pictures_match_double_precision(void **state) {
    (void)state;
    enum { W = 13, H = 9, TO_W = 31, TO_H = 20 };
    uint8_t from[4 * W * H], to[4 * TO_W * TO_H];
    uint32_t random = 1;
    for (size_t i = 0; i < sizeof from; i++) {
        random = random * 1664525u + 1013904223u;
        from[i] = (uint8_t)(random >> 24);
    }
    enlarge(from, W, H, to, TO_W, TO_H, NULL);
    static DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    int differences = 0;
    for (int i = 0; i < 3 * TO_W * TO_H; i++) {
        const int x = i / 3 % TO_W, y = i / 3 / TO_W, c = i % 3;
        const double px = fmin(fmax((x + 0.5) * W / TO_W - 0.5, 0.0), W - 1);
        const double py = fmin(fmax((y + 0.5) * H / TO_H - 0.5, 0.0), H - 1);
        double light = 0.0;
        for (int corner = 0; corner < 4; corner++) {
            const int cx = (int)px + corner % 2, cy = (int)py + corner / 2;
            const double weight = (1.0 - fabs(px - cx)) * (1.0 - fabs(py - cy));
            if (cx < W && cy < H) {
                light += weight * dip_srgb_decode(from[4 * (cy * W + cx) + c] / 255.0);
            }
        }
        const int code = table.code[(int)(DIP_LINEAR16_MAX * light + 0.5)];
        const int found = to[4 * (y * TO_W + x) + c];
        assert_in_range(found, code - (code > 0), code + 1);
        differences += found != code;
    }
    assert_true(differences <= 3); // Roundings to the next of 65535 steps.
}

static void threads_enlarge_the_same_bits(void **state) {
    (void)state;
    enum { W = 50, H = 400, TO_W = 97, TO_H = 900 };
    static uint8_t from[4 * W * H], alone[4 * TO_W * TO_H], together[sizeof alone];
    for (size_t i = 0; i < sizeof from; i++) {
        from[i] = (uint8_t)(i * i / 7);
    }
    DipPool *pool = dip_pool_create(3, NULL);
    assert_non_null(pool);
    enlarge(from, W, H, alone, TO_W, TO_H, NULL);
    for (int time = 0; time < 20; time++) {
        enlarge(from, W, H, together, TO_W, TO_H, pool);
        assert_memory_equal(alone, together, sizeof alone);
    }
    dip_pool_destroy(&pool);
}

// --- energy --------------------------------------------------------------------------------------

static char powercap[64];

static void write_counter(const char *zone, const char *name, const char *text) {
    char file[128];
    snprintf(file, sizeof file, "%s/%s", powercap, zone);
    mkdir(file, 0700);
    snprintf(file, sizeof file, "%s/%s/%s", powercap, zone, name);
    FILE *out = fopen(file, "w");
    assert_non_null(out);
    fputs(text, out);
    fclose(out);
}

static void make_zone(const char *zone, const char *name, const char *range, const char *energy) {
    write_counter(zone, "name", name);
    write_counter(zone, "max_energy_range_uj", range);
    write_counter(zone, "energy_uj", energy);
}

static int make_powercap(void **state) {
    (void)state;
    snprintf(powercap, sizeof powercap, "/tmp/diptych-axes.XXXXXX");
    assert_non_null(mkdtemp(powercap));
    make_zone("intel-rapl:0", "package-0\n", "262143328850\n", "262143328000\n");
    make_zone("intel-rapl:0:0", "core\n", "262143328850\n", "1\n"); // Part of package 0.
    make_zone("intel-rapl:1", "package-1\n", "65532610987\n", "500\n");
    make_zone("intel-rapl:2", "psys\n", "262143328850\n", "7\n");
    return 0;
}

static int remove_powercap(void **state) {
    (void)state;
    static const char *const zones[] = {"intel-rapl:0", "intel-rapl:0:0", "intel-rapl:1",
                                        "intel-rapl:2"};
    static const char *const names[] = {"/name", "/max_energy_range_uj", "/energy_uj", ""};
    for (size_t z = 0; z < sizeof zones / sizeof *zones; z++) {
        for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
            char file[128];
            snprintf(file, sizeof file, "%s/%s%s", powercap, zones[z], names[n]);
            remove(file);
        }
    }
    return rmdir(powercap);
}

// Package 0 begins again after 850 uJ and goes on to 1000; package 1 takes 2500 uJ.
static void counters_begin_again(void **state) {
    (void)state;
    DipEnergyMeter meter;
    DipEnergyReading before, after;
    dip_energy_open(&meter, powercap);
    assert_int_equal(meter.count, 2);
    assert_true(strncmp(meter.text, "2 packages in /tmp/", 19) == 0);
    assert_true(dip_energy_read(&meter, &before));
    assert_true(before.uj[0] == UINT64_C(262143328000) && before.uj[1] == 500);
    assert_true(dip_energy_between_uj(&meter, &before, &before) == 0);
    write_counter("intel-rapl:0", "energy_uj", "1000\n");
    write_counter("intel-rapl:0:0", "energy_uj", "900000\n"); // These two do not count.
    write_counter("intel-rapl:2", "energy_uj", "900000\n");
    write_counter("intel-rapl:1", "energy_uj", "3000\n");
    assert_true(dip_energy_read(&meter, &after));
    assert_int_equal(dip_energy_between_uj(&meter, &before, &after), 850 + 1000 + 2500);
}

static void counters_that_cannot_be_read_are_no_energy(void **state) {
    (void)state;
    static const char *const wrong[] = {"",     "\n",    "joules\n",
                                        "-5\n", "12x\n", "99999999999999999999999\n"};
    DipEnergyMeter meter;
    DipEnergyReading reading;
    dip_energy_open(&meter, "/nowhere");
    assert_int_equal(meter.count, 0);
    assert_string_equal(meter.text, "/nowhere has no counters of packages");
    assert_false(dip_energy_read(&meter, &reading));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        dip_energy_open(&meter, powercap);
        assert_int_equal(meter.count, 2);
        write_counter("intel-rapl:1", "energy_uj", wrong[i]);
        assert_false(dip_energy_read(&meter, &reading)); // It worked before.
        dip_energy_open(&meter, powercap);
        assert_int_equal(meter.count, 0);
        assert_non_null(strstr(meter.text, "intel-rapl:1/energy_uj cannot be read: "));
        write_counter("intel-rapl:1", "energy_uj", "5\n");
    }
}

// --- rows ----------------------------------------------------------------------------------------

static void scaled_pictures_keep_their_shape(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double scale;
        int to_width, to_height;
    } rows[] = {
        {640, 480, 0.5, 320, 240},     {640, 480, 0.7071, 452, 339},
        {640, 480, 1.0, 640, 480},     {640, 480, 0.1, 64, 48},
        {1920, 1080, 0.85, 1632, 918}, {1280, 720, 0.7071, 912, 513},
        {641, 479, 0.5, 321, 240}, // No smaller size has exactly this shape.
        {641, 479, 1.0, 641, 479},     {1, 1, 0.1, 1, 1},
        {1, 700, 0.5, 1, 350},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        int width, height;
        dip_cost_axes_scaled_size(rows[i].width, rows[i].height, rows[i].scale, &width, &height);
        assert_int_equal(width, rows[i].to_width);
        assert_int_equal(height, rows[i].to_height);
    }
}

static void other_pictures_are_named(void **state) {
    (void)state;
    static DipCostAxes axes = {.rows = {{.axis = DIP_COST_AXIS_BASE, .name = "base"},
                                        {.axis = DIP_COST_AXIS_THREADS, .name = "3"}}};
    DipError err = {0};
    assert_true(dip_cost_axes_check_picture(&axes, 1, 7, "0123", "0123", &err));
    assert_false(dip_cost_axes_check_picture(&axes, 1, 7, "0123", "0124", &err));
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
    assert_string_equal(err.message, "the picture of frame 7 with threads 3 has the hash 0123, but "
                                     "the base's has 0124; they must be the same");
}

// --- a run ---------------------------------------------------------------------------------------

enum { WIDTH = 48, HEIGHT = 36, ROUNDS = 2, TIMED = 3, PLACES = 2 };

typedef struct Run {
    DipCostAxesArguments arguments;
    DipSession session;
    DipCostAxes *axes;
    DipCostAxesDrawing *drawing;
    char config[512]; // The ini of the courtyard.
} Run;

static void open_run(Run *run) {
    DipErrorList faults = {0};
    memset(run, 0, sizeof *run);
    dip_cost_axes_options_default(&run->arguments, 0, NULL);
    snprintf(run->config, sizeof run->config, "%.400s/config/courtyard.ini", source_folder);
    run->arguments.session.config = run->config;
    run->arguments.session.has_size = true;
    run->arguments.session.size = (DipOptionSize){WIDTH, HEIGHT};
    run->arguments.measure.rounds = ROUNDS;
    run->arguments.cost.timed_frames = TIMED;
    run->arguments.cost.places = PLACES;
    run->arguments.cost.samples = 4;
    const DipSessionDef def = {
        .options = &run->arguments.session, .scene = true, .keep_model = true};
    assert_true(dip_session_open(&run->session, &def, &faults));
    dip_error_list_free(&faults);
    run->axes = calloc(1, sizeof *run->axes);
    run->drawing = calloc(1, sizeof *run->drawing);
    assert_true(run->axes && run->drawing);
    assert_true(dip_cost_axes_plan(run->axes, &run->session, &run->arguments, NULL));
}

static void close_run(Run *run) {
    dip_cost_axes_close_drawing(run->drawing);
    dip_cost_axes_free(run->axes);
    dip_session_close(&run->session);
    free(run->axes);
    free(run->drawing);
}

static int find_row(const DipCostAxes *axes, DipCostAxis axis, const char *name) {
    for (int r = 0; r < axes->report.row_count; r++) {
        if (axes->rows[r].axis == axis && strcmp(axes->rows[r].name, name) == 0) {
            return r;
        }
    }
    fail_msg("there is no row %s of %s", name, dip_cost_axis_names[axis]);
    return -1;
}

// Stands for a machine that takes a millijoule between any two readings.
static bool read_millijoules(void *context, DipEnergyReading *reading) {
    reading->uj[0] = 1000 * (uint64_t)++ * (int *)context;
    return true;
}

static void check_errors(const DipCostAxes *axes) {
    const DipCostReport *report = &axes->report;
    const DipMetrics base = dip_cost_row_metrics(report, 0, 0);
    const int whole = find_row(axes, DIP_COST_AXIS_SCALE, "1");
    const int half = find_row(axes, DIP_COST_AXIS_SCALE, "0.5");
    assert_int_equal(axes->rows[half].width, WIDTH / 2);
    assert_int_equal(axes->rows[half].shown_width, WIDTH);
    for (int place = 0; place < PLACES; place++) {
        assert_true(report->rows[half].judged[place]);
    }
    const DipMetrics same = dip_cost_row_metrics(report, whole, 0);
    assert_true(base.rmse_lin > 0.0 && same.rmse_lin == base.rmse_lin && same.flip == base.flip);
    assert_true(dip_cost_row_metrics(report, half, 0).flip > base.flip);
    assert_false(report->rows[1].judged[0]);
    assert_false(report->rows[find_row(axes, DIP_COST_AXIS_THREADS, "1")].judged[0]);
}

static void all_rows_are_measured(void **state) {
    (void)state;
    Run run;
    int readings = 0;
    const DipEnergyMeter meter = {
        .count = 1, .text = "made up", .read = read_millijoules, .context = &readings};
    open_run(&run);
    DipCostAxes *axes = run.axes;
    const DipCostReport *report = &axes->report;
    assert_true(dip_cost_axes_open_drawing(run.drawing, &run.session, axes, NULL));
    // Besides the base: the A/A row, one size, one scale, all threads and instruction sets.
    int same = 0;
    for (int r = 1; r < report->row_count; r++) {
        same += dip_cost_axes_has_base_picture(axes, r);
    }
    assert_true(same >= 5);
    assert_int_equal(axes->checked_pictures, same * ROUNDS * TIMED);
    assert_true(dip_cost_axes_judge(run.drawing, NULL, NULL));
    check_errors(axes);
    assert_true(dip_cost_axes_time(run.drawing, &meter, NULL));
    assert_string_equal(axes->energy, "made up");
    for (int r = 0; r < report->row_count; r++) {
        const DipEstimate *ratio = &report->rows[r].time.ratio;
        assert_true(r == 0 ? ratio->value == 1.0 && isnan(ratio->low)
                           : ratio->value > 0.0 && ratio->low < ratio->value &&
                                 ratio->value < ratio->high);
        // The counter rises by a millijoule per reading, and each frame ends with one.
        assert_true(fabs(axes->rows[r].frame_mj - 1.0) < 1e-12);
    }
    close_run(&run);
}

// A picture that does not have the base's bits ends the run. Here the row that says that it has the
// base's size draws other settings.
static void other_pictures_end_the_run(void **state) {
    (void)state;
    Run run;
    DipError err = {0};
    open_run(&run);
    const int row = find_row(run.axes, DIP_COST_AXIS_SIZE, "24x18");
    DipCostAxisRow *half = &run.axes->rows[row];
    half->axis = DIP_COST_AXIS_SCALE; // Enlarged, but listed as if it were drawn at the full size.
    half->shown_width = WIDTH;
    half->shown_height = HEIGHT;
    assert_false(dip_cost_axes_has_base_picture(run.axes, row));
    run.axes->rows[0].width = half->width;
    run.axes->rows[0].height = half->height;
    assert_true(dip_cost_axes_has_base_picture(run.axes, row));
    assert_false(dip_cost_axes_open_drawing(run.drawing, &run.session, run.axes, &err));
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
    assert_non_null(strstr(err.message, "they must be the same"));
    close_run(&run);
}

// Times that are made up: the fewest threads take 12 ms, others 12 / threads ms and a third more.
static void speed_ups_are_against_the_fewest_threads(void **state) {
    (void)state;
    Run run;
    open_run(&run);
    DipCostAxes *axes = run.axes;
    DipCostReport *report = &axes->report;
    while (report->row_count > 2) {
        dip_cost_row_free(&report->rows[--report->row_count]);
    }
    for (int i = 0; i < 2; i++) { // The row with more threads comes first.
        assert_int_equal(dip_cost_report_add_row(report, &report->options.baseline, 0, NULL),
                         2 + i);
        axes->rows[2 + i] = axes->rows[0];
        axes->rows[2 + i].axis = DIP_COST_AXIS_THREADS;
        axes->rows[2 + i].threads = i == 0 ? 8 : 2;
    }
    static const double ms[] = {10.0, 10.0, 4.0, 12.0};
    for (int r = 0; r < 4; r++) {
        for (int f = 0; f < ROUNDS * TIMED; f++) {
            report->rows[r].pairs[f] = (DipTimePair){.ms = ms[r], .base_ms = 10.0};
        }
    }
    report->rounds = ROUNDS;
    report->combined_first = report->row_count;
    assert_true(dip_cost_estimate_times(report, NULL));
    dip_cost_axes_compare_threads(axes);
    assert_true(fabs(axes->rows[2].speed_up.value - 3.0) < 1e-9);
    assert_true(fabs(axes->rows[2].efficiency - 0.75) < 1e-9);
    assert_true(axes->rows[3].speed_up.value == 1.0 && axes->rows[3].efficiency == 1.0);
    close_run(&run);
}

int main(int argc, char **argv) {
    source_folder = argc > 1 ? argv[1] : ".";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_pictures_stay_constant),
        cmocka_unit_test(scale_1_is_the_identity),
        cmocka_unit_test(ramps_stay_ramps),
        cmocka_unit_test(random_pictures_match_double_precision),
        cmocka_unit_test(threads_enlarge_the_same_bits),
        cmocka_unit_test_setup_teardown(counters_begin_again, make_powercap, remove_powercap),
        cmocka_unit_test_setup_teardown(counters_that_cannot_be_read_are_no_energy, make_powercap,
                                        remove_powercap),
        cmocka_unit_test(scaled_pictures_keep_their_shape),
        cmocka_unit_test(other_pictures_are_named),
        cmocka_unit_test(all_rows_are_measured),
        cmocka_unit_test(other_pictures_end_the_run),
        cmocka_unit_test(speed_ups_are_against_the_fewest_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
