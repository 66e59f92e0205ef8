// Writes the page of a made-up report with made-up pictures, for page.py, and the report itself,
// for hostile.py: make_page FILE [JSON].
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/files/pictures.h"
#include "tests/app/cost/made_report.h"

#include <stdio.h>
#include <stdlib.h>

enum { COMBINATIONS = 50, WIDTH = 64, HEIGHT = 48, CROP = 24 };

// --- rows ----------------------------------------------------------------------------------------

// Gives all parts of the picture errors that differ from row to row.
static void fill_errors(DipCostReport *report, DipCostRow *row, double error) {
    for (int p = 0; p < report->options.places; p++) {
        row->judged[p] = true;
        row->viewpoints[p].bursts = 1.0;
        row->viewpoints[p].squared_flicker = error * error / 9.0;
        row->viewpoints[p].squared_two_mean = error * error / 2.0;
        for (int r = 0; r < DIP_METRIC_REGION_COUNT; r++) {
            const double pixels = r == 1 ? 0.0 : 100.0 + r;
            row->viewpoints[p].regions[r] =
                (DipMetricRegionSums){.pixels = pixels,
                                      .squared_lin = pixels * error * error,
                                      .squared_codes = pixels * 3000.0 * error * error,
                                      .flip = pixels * error,
                                      .ssim_pixels = pixels,
                                      .ssim = pixels * (1.0 - error)};
        }
    }
}

static void add_combination(DipCostReport *report, int index) {
    DipQuality quality = dip_quality_default();
    quality.step[DIP_SETTING_AA] = (uint8_t)(index % 5);
    quality.step[DIP_SETTING_AF] = (uint8_t)(index / 5 % 5);
    quality.step[DIP_SETTING_MIPLOD] = (uint8_t)(3 - index / 25);
    const int added = dip_cost_report_add_row(report, &quality, 0, NULL);
    if (added < 0) {
        abort();
    }
    DipCostRow *row = &report->rows[added];
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        row->counters[c] = c < 3 ? 7000.0 : 123456.7 * (1 + c + index % 7);
    }
    dip_made_times(report, added, 2.0 + 1.7 * (index % 5) + 0.23 * index);
    fill_errors(report, row, 0.11 - 0.013 * (index % 5) - 0.0007 * index + 0.0031 * (index % 3));
}

static void add_combinations(DipCostReport *report) {
    DipCostRow *rows = realloc(report->rows, DIP_COST_MAX_ROWS * sizeof *rows);
    if (!rows) {
        abort();
    }
    report->rows = rows;
    report->combined_first = report->row_count;
    for (int r = 0; r < report->row_count; r++) {
        fill_errors(report, &rows[r], 0.09 - 0.01 * r);
    }
    for (int i = 0; i < COMBINATIONS; i++) {
        add_combination(report, i);
    }
    report->sweeps[1] =
        (DipCostSweep){.setting = DIP_SETTING_MIPLOD,
                       .base = report->combined_first,
                       .rows = {report->combined_first + 25, report->combined_first},
                       .row_count = 2};
    report->sweep_count = 2;
    if (!dip_cost_estimate_times(report, NULL)) {
        abort();
    }
}

// Combinations that were only predicted, one that was measured later, and one that another row
// stands for.
static void add_predictions(DipCostReport *report) {
    enum { PREDICTED = 12 };
    DipCostPredictions *p = &report->predicted;
    free(p->list);
    free(report->same);
    p->list = calloc(PREDICTED, sizeof *p->list);
    report->same = calloc(1, sizeof *report->same);
    if (!p->list || !report->same) {
        abort();
    }
    p->count = PREDICTED;
    p->trained = 40;
    p->times = p->errors = (DipCostMisses){0.0213, 0.0712, 0.95, 0.9, 1};
    p->times_left_out = p->errors_left_out = (DipCostMisses){0.0318, 0.0817, 0.91, 0.8, 40};
    for (int i = 0; i < PREDICTED; i++) {
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_OPT] = 1;
        quality.step[DIP_SETTING_AA] = (uint8_t)(i % 5);
        quality.step[DIP_SETTING_AF] = (uint8_t)(i / 5);
        p->list[i] = (DipCostPrediction){.quality = quality,
                                         .ms = 1.51 + 1.37 * i,
                                         .p95_ms = 1.63 + 1.41 * i,
                                         .flip = 0.1234 - 0.00713 * i,
                                         .row = i == 3 ? report->combined_first + 3 : -1};
    }
    report->same[0] = (DipCostSame){dip_quality_default(), report->combined_first + 7};
    report->same[0].quality.step[DIP_SETTING_AAA] = 1;
    report->same_count = 1;
}

// --- pictures ------------------------------------------------------------------------------------

static uint8_t pixels[WIDTH * HEIGHT * 4];

// Draws stripes; the picture with number 0 is the truth.
static void draw(int number) {
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            uint8_t *pixel = pixels + 4 * (y * WIDTH + x);
            pixel[0] = (uint8_t)(3 * x + 5 * number);
            pixel[1] = (uint8_t)(5 * y);
            pixel[2] = (uint8_t)((x + y + number) / 4 % 2 ? 200 : 40);
            pixel[3] = 255;
        }
    }
}

static char *uri(const char *type, bool made, unsigned char **bytes, const size_t *size) {
    char *text = made ? dip_cost_data_uri(type, *bytes, *size) : NULL;
    if (!text) {
        abort();
    }
    free(*bytes);
    return text;
}

static void fill_picture(DipCostPicture *picture, int row, int number, bool whole) {
    uint8_t palette[3 * 256];
    uint8_t indices[CROP * CROP];
    unsigned char *bytes;
    size_t size;
    draw(number);
    picture->row = row;
    bool made = dip_png_encode(pixels, WIDTH * 4, CROP, CROP, &bytes, &size);
    picture->crop = uri("image/png", made, &bytes, &size);
    if (whole) {
        made = dip_jpeg_encode(pixels, WIDTH * 4, WIDTH, HEIGHT, 95, &bytes, &size);
        picture->frame = uri("image/jpeg", made, &bytes, &size);
    }
    if (row < 0) {
        return;
    }
    for (int i = 0; i < 256; i++) {
        palette[3 * i] = palette[3 * i + 1] = palette[3 * i + 2] = (uint8_t)(255 - i);
    }
    for (int i = 0; i < CROP * CROP; i++) {
        indices[i] = (uint8_t)(i % 251 + number);
    }
    made = dip_png_encode_indexed(indices, palette, CROP, CROP, &bytes, &size);
    picture->map = uri("image/png", made, &bytes, &size);
}

// The set of the combinations has whole frames, too.
static void fill_set(DipCostPictureSet *set, const int *rows, int count, bool whole) {
    fill_picture(&set->truth, -1, 0, whole);
    set->count = count;
    set->x = 8;
    set->y = 16;
    for (int i = 0; i < count; i++) {
        fill_picture(&set->pictures[i], rows[i], i + 1, whole);
    }
}

int main(int argc, char **argv) {
    DipCostReport report;
    DipCostPictures pictures = {0};
    DipError err = {0};
    if (argc != 2 && argc != 3) {
        fprintf(stderr, "usage: make_page FILE [JSON]\n");
        return 2;
    }
    dip_made_report(&report, 3);
    add_combinations(&report);
    add_predictions(&report);
    const int first = report.combined_first;
    report.options.pictures = DIP_COST_PICTURES_FULL;
    report.options.budget_count = 4;
    for (int i = 0; i < 4; i++) {
        report.options.budgets_ms[i] = 0.5 + 3.7 * i;
    }
    if (!dip_cost_choose(&report, &err)) {
        return 1;
    }
    for (int s = 0; s < report.sweep_count; s++) {
        fill_set(&pictures.sweeps[s], report.sweeps[s].rows, report.sweeps[s].row_count, false);
    }
    fill_set(&pictures.front, (const int[]){first, first + 1, first + 2, first + 49}, 4, true);
    const bool written = dip_cost_analyse(&report, &err) &&
                         dip_cost_write_html(&report, &pictures, argv[1], &err) &&
                         (argc < 3 || dip_cost_write_json(&report, argv[2], &err));
    if (!written) {
        fprintf(stderr, "%s\n", err.message);
    }
    dip_cost_pictures_free(&pictures);
    dip_cost_report_free(&report);
    return written ? 0 : 1;
}
