// Tests what the writers and readers of reports do when memory runs out: a file is written whole or
// stays as it was, and a journal never loses a measurement.
#include "app/cost/advise/common_advice.h"
#include "app/cost/diff/diff.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/cost/journal.h"
#include "app/dump/record.h"
#include "app/files/pictures.h"
#include "tests/app/cost/made_report.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cjson/cJSON.h>
#include <cmocka.h>

enum { ROUNDS = 3, MAX_BYTES = 1 << 20 };

typedef struct Content {
    size_t size;
    char bytes[MAX_BYTES];
} Content;

static void read_content(const char *file, Content *content) {
    FILE *in = fopen(file, "rb");
    content->size = in ? fread(content->bytes, 1, MAX_BYTES, in) : 0;
    if (in) {
        fclose(in);
    }
}

static void write_text(const char *file, const char *text) {
    FILE *out = fopen(file, "wb");
    assert_non_null(out);
    fputs(text, out);
    fclose(out);
}

// --- files ---------------------------------------------------------------------------------------

static const char old_text[] = "the old file";

typedef struct Writing {
    DipCostReport report;
    DipCostReport read;
    DipRecord *record;
    const char *file;
    Content expected;
    Content found;
    uint8_t rgba8[4 * 64 * 48];
} Writing;

static Writing w;

static bool write_json(void *context, DipError *err) {
    (void)context;
    return dip_cost_write_json(&w.report, w.file, err);
}

static bool write_csv(void *context, DipError *err) {
    (void)context;
    return dip_cost_write_csv(&w.report, w.file, err);
}

static bool write_html(void *context, DipError *err) {
    (void)context;
    return dip_cost_write_html(&w.report, NULL, w.file, err);
}

static bool write_png(void *context, DipError *err) {
    (void)context;
    const DipFrame frame = {.rgba8 = w.rgba8, .stride_bytes = 4 * 64, .width = 64, .height = 48};
    return dip_png_write(w.file, &frame, err);
}

static bool write_pfm(void *context, DipError *err) {
    static const float rgb[3 * 8 * 6] = {0.25f, 0.5f};
    (void)context;
    return dip_pfm_write(w.file, rgb, 8, 6, err);
}

// Encoders of pictures in memory have no error of their own.
static bool encode_pictures(void *context, DipError *err) {
    unsigned char *png = NULL;
    unsigned char *jpeg = NULL;
    size_t size;
    static const uint8_t palette[3 * 256];
    (void)context;
    const bool made = dip_png_encode_indexed(w.rgba8, palette, 64, 48, &png, &size) &&
                      dip_jpeg_encode(w.rgba8, 4 * 64, 64, 48, 95, &jpeg, &size);
    char *uri = made ? dip_cost_data_uri("image/jpeg", jpeg, size) : NULL;
    free(png);
    free(jpeg);
    free(uri);
    return uri || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

static bool write_record(void *context, DipError *err) {
    (void)context;
    DipDrawnFrame drawn = {.pose = {.fov_y_deg = 50.0}, .frame = {.copied = true}};
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        drawn.qualities[p] = dip_quality_default();
#define SET_WHY(name, text) drawn.frame.panes[p].effects.name.why = "why not";
        DIP_EFFECT_LIST(SET_WHY)
#undef SET_WHY
    }
    const DipStartTimes times = {0};
    DipError warning = {.message = "not drawn"};
    const DipErrorList warnings = {.items = &warning, .count = 1};
    DipRecord *record = dip_record_create(err);
    const bool written = record && dip_record_add(record, &drawn, err) &&
                         dip_record_set_warnings(record, &warnings, 0, err) &&
                         dip_record_set_start(record, &times, 1000, err) &&
                         dip_record_write(record, w.file, err);
    dip_record_destroy(&record);
    return written;
}

// cJSON allocates through this program, so that its allocations can fail as well.
static void hook_cjson(void) {
    cJSON_Hooks hooks = {.malloc_fn = malloc, .free_fn = free};
    cJSON_InitHooks(&hooks);
}

static void write_old(void *context) {
    (void)context;
    hook_cjson();
    write_text(w.file, old_text);
}

static void check_written(void *context, bool succeeded) {
    (void)context;
    read_content(w.file, &w.found);
    assert_int_equal(w.found.size, succeeded ? w.expected.size : strlen(old_text));
    assert_memory_equal(w.found.bytes, succeeded ? w.expected.bytes : old_text, w.found.size);
}

static void remove_file(void *context) {
    (void)context;
    remove(w.file);
}

static void check_writer(const char *name, const char *file, bool (*write)(void *, DipError *),
                         int short_count) {
    w.file = file;
    write_old(NULL);
    assert_true(write(NULL, NULL));
    read_content(file, &w.expected);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = name,
                                              .prepare = write_old,
                                              .run = write,
                                              .check = check_written,
                                              .finish = remove_file,
                                              .short_count = short_count});
}

static void files_are_written_whole_or_stay(void **state) {
    (void)state;
    dip_made_report(&w.report, ROUNDS);
    check_writer("cost.json", "cost.json", write_json, 200);
    check_writer("record.json", "record.json", write_record, 0);
    check_writer("a PNG", "picture.png", write_png, 0);
    check_writer("a PFM", "picture.pfm", write_pfm, 0);
    check_writer("cost.csv", "cost.csv", write_csv, 0);
    check_writer("cost.html", "cost.html", write_html, 100);
    dip_cost_report_free(&w.report);
}

// --- comparing -----------------------------------------------------------------------------------

static DipCostReport other;
static DipCostDiff diff;

static void make_diff(void *context) {
    (void)context;
    hook_cjson();
    diff = (DipCostDiff){.names = {"A", "B"}, .limit = 1.01};
}

static bool compare(void *context, DipError *err) {
    (void)context;
    return dip_cost_diff_reports(&w.report, &other, &diff, err);
}

static void check_diff(void *context, bool succeeded) {
    (void)context;
    assert_int_equal(diff.rows != NULL, succeeded);
}

static void free_diff(void *context) {
    (void)context;
    dip_cost_diff_free(&diff);
}

static void make_compared(void *context) {
    make_diff(context);
    assert_true(compare(context, NULL));
}

static bool print_diff(void *context, DipError *err) {
    return dip_cost_diff_print(&diff, context, err);
}

static bool write_diff(void *context, DipError *err) {
    (void)context;
    return dip_cost_diff_write_json(&diff, w.file, err);
}

static bool find_cause(void *context, DipError *err) {
    static const double per_start[4] = {1.0, 1.1, 2.0, 2.1}, work[2] = {1.0, 2.0};
    (void)context;
    DipCause cause;
    return dip_cause_find(&(DipCauseData){2, 2, 1, per_start, work}, &cause, err);
}

static void comparisons_are_whole_or_fail(void **state) {
    (void)state;
    dip_made_report(&w.report, ROUNDS);
    dip_made_report(&other, ROUNDS);
    other.rows[2].counters[3] += 1.0;
    FILE *nowhere = fopen("/dev/null", "w");
    assert_non_null(nowhere);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "comparing reports",
                                              .prepare = make_diff,
                                              .run = compare,
                                              .check = check_diff,
                                              .finish = free_diff,
                                              .needs_every_allocation = true});
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "printing a comparison",
                                              .context = nowhere,
                                              .prepare = make_compared,
                                              .run = print_diff,
                                              .finish = free_diff,
                                              .needs_every_allocation = true});
    dip_out_of_memory_check(&(DipOutOfMemory){
        .name = "finding a cause", .run = find_cause, .needs_every_allocation = true});
    make_compared(NULL);
    check_writer("a comparison", "diff.json", write_diff, 100);
    free_diff(NULL);
    fclose(nowhere);
    dip_cost_report_free(&w.report);
    dip_cost_report_free(&other);
}

// --- advice for several reports ------------------------------------------------------------------

static DipCostCommon common;

static bool read_common(void *context, DipError *err) {
    static const char *const files[2] = {"cost.json", "cost.json"};
    (void)context;
    return dip_cost_common_read(&common, files, 2, DIP_TIME_P95, err);
}

static void free_common(void *context) {
    (void)context;
    dip_cost_common_free(&common);
}

static bool write_common(void *context, DipError *err) {
    (void)context;
    DipCostCommonAdvice advice;
    dip_cost_common_advise(&common, 5.0, &advice);
    return dip_cost_common_write_json(&common, &advice, 1, w.file, err);
}

static void common_advice_is_whole_or_fails(void **state) {
    (void)state;
    dip_made_report(&w.report, ROUNDS);
    const DipQuality quality = dip_quality_default();
    dip_made_combination(&w.report, &quality, 2.0, 0.1);
    assert_true(dip_cost_estimate_times(&w.report, NULL));
    assert_true(dip_cost_write_json(&w.report, "cost.json", NULL));
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "reading several reports",
                                              .run = read_common,
                                              .finish = free_common,
                                              .needs_every_allocation = true,
                                              .short_count = 200});
    hook_cjson();
    assert_true(read_common(NULL, NULL));
    check_writer("common advice", "advice.json", write_common, 100);
    free_common(NULL);
    dip_cost_report_free(&w.report);
    assert_int_equal(remove("cost.json"), 0);
}

static void pictures_are_encoded_whole_or_not_at_all(void **state) {
    (void)state;
    dip_out_of_memory_check(
        &(DipOutOfMemory){.name = "pictures in memory", .run = encode_pictures});
}

// --- reading a report ----------------------------------------------------------------------------

static bool read_json(void *context, DipError *err) {
    (void)context;
    return dip_cost_read_json(&w.read, w.file, err);
}

static void check_read(void *context, bool succeeded) {
    (void)context;
    assert_int_equal(w.read.rows != NULL, succeeded);
    if (succeeded) {
        assert_int_equal(w.read.row_count, w.report.row_count);
        assert_int_equal(w.read.rounds, ROUNDS);
    }
}

static void free_read(void *context) {
    (void)context;
    dip_cost_report_free(&w.read);
}

static void report_is_read_whole_or_not_at_all(void **state) {
    (void)state;
    dip_made_report(&w.report, ROUNDS);
    w.file = "cost.json";
    assert_true(write_json(NULL, NULL));
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "reading cost.json",
                                              .run = read_json,
                                              .check = check_read,
                                              .finish = free_read,
                                              .needs_every_allocation = true,
                                              .short_count = 200});
    dip_cost_report_free(&w.report);
    assert_int_equal(remove("cost.json"), 0);
}

// --- the journal ---------------------------------------------------------------------------------

static const char plan[] = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
static const char key[] = "0123456789abcdef0123456789abcdef";
static const DipTimed first = {.subject = 1, .frame = 2, .ms = 1.0 / 3.0, .parts_ms = {2e-9}};
static const DipTimed second = {.subject = 3, .round = 1, .ms = 12345.678};
enum { SEED = 5 };
static DipCostJournal *journal;

static bool open_journal(void *context, DipError *err) {
    (void)context;
    journal = dip_cost_journal_open(".", plan, err);
    return journal != NULL;
}

static bool add_round(void *context, DipError *err) {
    (void)context;
    return dip_cost_journal_add_round(journal, SEED, &second, 1, err);
}

static bool add_errors(void *context, DipError *err) {
    (void)context;
    const DipCostBurstErrors errors = {.sums = {.bursts = 7.0}};
    return dip_cost_journal_add(journal, key, &errors, err);
}

static void close_journal(void *context) {
    (void)context;
    dip_cost_journal_close(&journal, false);
}

// Makes a journal with one round, and leaves it closed.
static void make_journal(void *context) {
    remove("cost.state");
    assert_true(open_journal(context, NULL));
    assert_true(dip_cost_journal_add_round(journal, SEED, &first, 1, NULL));
    close_journal(context);
}

static void make_open_journal(void *context) {
    make_journal(context);
    assert_true(open_journal(context, NULL));
}

// Compares all members. The padding between them is not compared.
static void assert_same_timed(const DipTimed *a, const DipTimed *b) {
    assert_memory_equal(a, b, offsetof(DipTimed, frame) + sizeof a->frame);
    assert_memory_equal(&a->begin_ns, &b->begin_ns, sizeof *a - offsetof(DipTimed, begin_ns));
}

static void assert_rounds(int rounds) {
    assert_int_equal(dip_cost_journal_round_count(journal, NULL), rounds);
    for (int i = 0; i < rounds; i++) {
        int count;
        DipTimed *timed = dip_cost_journal_round(journal, i, SEED, &count);
        assert_int_equal(count, 1);
        assert_same_timed(timed, i ? &second : &first);
        free(timed);
    }
}

// Whatever failed, the measurements of the past must still be in the file.
static void check_opened(void *context, bool succeeded) {
    assert_true(succeeded || open_journal(context, NULL));
    assert_rounds(1);
}

// The next run must find what was added, and what was there before.
static void check_round(void *context, bool succeeded) {
    close_journal(context);
    assert_true(open_journal(context, NULL));
    assert_rounds(1 + succeeded);
}

static void check_errors(void *context, bool succeeded) {
    DipCostBurstErrors errors;
    close_journal(context);
    assert_true(open_journal(context, NULL));
    assert_rounds(1);
    assert_int_equal(dip_cost_journal_find(journal, key, &errors), succeeded);
}

static void journal_never_loses_a_measurement(void **state) {
    (void)state;
    DipOutOfMemory operation = {.name = "opening a journal",
                                .prepare = make_journal,
                                .run = open_journal,
                                .check = check_opened,
                                .finish = close_journal,
                                .needs_every_allocation = true};
    dip_out_of_memory_check(&operation);
    operation.prepare = make_open_journal;
    operation.name = "a round in the journal";
    operation.run = add_round;
    operation.check = check_round;
    dip_out_of_memory_check(&operation);
    operation.name = "errors in the journal";
    operation.run = add_errors;
    operation.check = check_errors;
    dip_out_of_memory_check(&operation);
    remove("cost.state");
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    char folder[] = "/tmp/cost_out_of_memory.XXXXXX";
    if (!mkdtemp(folder) || chdir(folder) != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_written_whole_or_stay),
        cmocka_unit_test(comparisons_are_whole_or_fail),
        cmocka_unit_test(common_advice_is_whole_or_fails),
        cmocka_unit_test(pictures_are_encoded_whole_or_not_at_all),
        cmocka_unit_test(report_is_read_whole_or_not_at_all),
        cmocka_unit_test(journal_never_loses_a_measurement),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return failed + (chdir("/") != 0 || rmdir(folder) != 0);
}
