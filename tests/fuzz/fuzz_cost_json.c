// Fuzzes the reader of cost.json, which `diptych cost merge` joins with others. A report that was
// read can be written in every format, and is the same when its JSON is read again.
#include "app/cost/diff/diff.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "renderer/base/file.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The JSON library may round the last bit of a number.
static void check_numbers(const void *a, const void *b, size_t size_bytes) {
    const double *x = a;
    const double *y = b;
    for (size_t i = 0; i < size_bytes / sizeof *x; i++) {
        FUZZ_CHECK(isfinite(x[i]) && fabs(x[i] - y[i]) <= 4e-16 * fabs(y[i]));
    }
}

static void check_same_header(const DipCostReport *a, const DipCostReport *b) {
    FUZZ_CHECK(strcmp(a->scene, b->scene) == 0);
    FUZZ_CHECK(strcmp(a->scene_hash, b->scene_hash) == 0);
    FUZZ_CHECK(strcmp(a->processor, b->processor) == 0);
    FUZZ_CHECK(a->threads == b->threads && a->width == b->width && a->height == b->height);
    FUZZ_CHECK(a->rounds == b->rounds);
    FUZZ_CHECK(a->combined_first == b->combined_first);
    FUZZ_CHECK(a->options.places == b->options.places && a->options.burst == b->options.burst);
    FUZZ_CHECK(a->options.samples == b->options.samples && a->options.seed == b->options.seed);
    FUZZ_CHECK(a->options.timed_frames == b->options.timed_frames);
    check_numbers(&a->options.pixels_per_degree, &b->options.pixels_per_degree, sizeof(double));
    FUZZ_CHECK(memcmp(&a->options.baseline, &b->options.baseline, sizeof(DipQuality)) == 0);
    FUZZ_CHECK(a->path_count == b->path_count && a->refused_count == b->refused_count);
    FUZZ_CHECK(memcmp(a->paths, b->paths, sizeof a->paths) == 0);
    FUZZ_CHECK(memcmp(a->base_rows, b->base_rows, sizeof a->base_rows) == 0);
    FUZZ_CHECK(memcmp(a->same_rows, b->same_rows, sizeof a->same_rows) == 0);
    FUZZ_CHECK(a->verdict == b->verdict);
    FUZZ_CHECK(memcmp(a->refused, b->refused, sizeof a->refused) == 0);
}

static void check_same_row(const DipCostReport *report, const DipCostRow *a, const DipCostRow *b) {
    const size_t places = (size_t)report->options.places;
    FUZZ_CHECK(memcmp(&a->quality, &b->quality, sizeof a->quality) == 0);
    FUZZ_CHECK(a->path == b->path);
    FUZZ_CHECK(memcmp(a->judged, b->judged, places * sizeof *a->judged) == 0);
    check_numbers(a->viewpoints, b->viewpoints, places * sizeof *a->viewpoints);
    check_numbers(a->counters, b->counters, sizeof a->counters);
}

static void check_same_sweep(const DipCostSweep *a, const DipCostSweep *b) {
    FUZZ_CHECK(a->setting == b->setting && a->path == b->path && a->base == b->base);
    FUZZ_CHECK(a->row_count == b->row_count);
    FUZZ_CHECK(memcmp(a->rows, b->rows, sizeof a->rows) == 0);
}

static void check_same(const DipCostReport *a, const DipCostReport *b) {
    check_same_header(a, b);
    FUZZ_CHECK(a->row_count == b->row_count && a->sweep_count == b->sweep_count);
    for (int i = 0; i < a->row_count; i++) {
        check_same_row(a, &a->rows[i], &b->rows[i]);
    }
    for (int i = 0; i < a->sweep_count; i++) {
        check_same_sweep(&a->sweeps[i], &b->sweeps[i]);
    }
    const size_t floors = (size_t)a->path_count * (size_t)a->options.places;
    FUZZ_CHECK(memcmp(a->has_floor, b->has_floor, floors * sizeof *a->has_floor) == 0);
    check_numbers(a->floors, b->floors, floors * sizeof *a->floors);
    FUZZ_CHECK(a->choice.advice_count == b->choice.advice_count);
    for (int i = 0; i < a->choice.advice_count; i++) {
        FUZZ_CHECK(a->choice.advice[i].chosen == b->choice.advice[i].chosen);
        check_numbers(&a->choice.advice[i].budget_ms, &b->choice.advice[i].budget_ms,
                      sizeof(double));
    }
}

// The page has the scripts and the elements of the program, whatever the texts of the report are.
static void check_page(const DipCostReport *report) {
    const char *file = fuzz_path("x.html");
    FUZZ_CHECK(dip_cost_write_html(report, NULL, file, NULL));
    unsigned char *page;
    size_t size_bytes;
    int scripts = 0;
    FUZZ_CHECK(dip_file_read(file, "page", 1 << 29, &page, &size_bytes, NULL));
    for (size_t i = 0; i < size_bytes; i++) {
        FUZZ_CHECK(page[i] >= ' ' || page[i] == '\n');
        scripts += size_bytes - i > 8 && memcmp(page + i, "</script", 8) == 0;
    }
    FUZZ_CHECK(scripts == 4);
    free(page);
}

// A terminal shows the texts of a report and does not obey them.
static void check_text(const DipCostReport *report) {
    char *text = NULL;
    size_t size_bytes = 0;
    FILE *out = open_memstream(&text, &size_bytes);
    FUZZ_CHECK(out);
    dip_cost_print(report, out);
    FUZZ_CHECK(fclose(out) == 0);
    for (size_t i = 0; i < size_bytes; i++) {
        FUZZ_CHECK(((unsigned char)text[i] >= ' ' || text[i] == '\n') && text[i] != 0x7f);
    }
    free(text);
}

// A report does not differ from itself.
static void compare_with_itself(const DipCostReport *report, FILE *nowhere) {
    DipCostDiff diff = {.names = {"A", "B"}, .limit = 1.01, .fail_over = 1.01};
    FUZZ_CHECK(dip_cost_diff_reports(report, report, &diff, NULL));
    for (int r = 0; r < diff.row_count; r++) {
        for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
            FUZZ_CHECK(!dip_cost_diff_differs(&diff.rows[r], q));
        }
    }
    FUZZ_CHECK(diff.slower + diff.faster + diff.failed_times + diff.failed_errors == 0);
    FUZZ_CHECK(dip_cost_diff_print(&diff, nowhere, NULL));
    FUZZ_CHECK(dip_cost_diff_write_json(&diff, fuzz_path("diff.json"), NULL));
    dip_cost_diff_free(&diff);
}

static void check_accepted(DipCostReport *report) {
    static FILE *nowhere;
    nowhere = nowhere ? nowhere : fopen("/dev/null", "w");
    const char *json = fuzz_path("again.json");
    DipCostReport again;
    FUZZ_CHECK(dip_cost_analyse(report, NULL));
    FUZZ_CHECK(dip_cost_write_json(report, json, NULL));
    FUZZ_CHECK(dip_cost_read_json(&again, json, NULL));
    check_same(report, &again);
    dip_cost_report_free(&again);
    FUZZ_CHECK(dip_cost_write_csv(report, fuzz_path("x.csv"), NULL));
    check_page(report);
    check_text(report);
    compare_with_itself(report, nowhere);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    DipCostReport report;
    DipError err = {0};
    if (dip_cost_read_json(&report, fuzz_write("x.json", bytes, size_bytes), &err)) {
        check_accepted(&report);
    } else {
        FUZZ_CHECK(err.code != DIP_ERROR_NONE && err.message[0] && !report.rows);
    }
    dip_cost_report_free(&report);
    return 0;
}
