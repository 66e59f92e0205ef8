// Tests of the options of `diptych dump`, and of the record that it writes.
#include "app/cli/command_line.h"
#include "app/dump/options.h"
#include "app/dump/record.h"
#include "renderer/base/assert.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MAX_WORDS = 12 };

static const DipCommand *const only_dump[] = {&dip_dump_command};
static const DipCommandList list = {.commands = only_dump, .count = 1};

// Parses "dump" and the given arguments, which end with a NULL.
static bool parse(DipCommandLine *line, DipError *err, const char *const words[]) {
    char *argv[MAX_WORDS] = {(char *)"diptych", (char *)"dump"};
    int argc = 2;
    for (; words[argc - 2]; argc++) {
        argv[argc] = (char *)words[argc - 2];
    }
    return dip_command_line_parse(&list, argc, argv, line, err);
}

#define WORDS(...) ((const char *const[]){__VA_ARGS__, NULL})

static void assert_refused(DipErrorCode code, const char *key, const char *const words[]) {
    DipCommandLine line;
    DipError err = {0};
    assert_false(parse(&line, &err, words));
    dip_command_line_free(&line);
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
}

static void defaults_are_the_first_frame_at_30_per_second(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse(&line, &err, WORDS("--hash")));
    const DipDumpOptions *dump = line.options;
    assert_true(dump->hash);
    assert_int_equal(dump->frames.first, 0);
    assert_int_equal(dump->frames.end, 1);
    assert_int_equal(dump->frames.step, 1);
    assert_int_equal(dump->rate.frames, 30);
    assert_int_equal(dump->rate.seconds, 1);
    assert_int_equal(dump->picture, DIP_STREAM_both);
    assert_false(dump->session.has_size || dump->session.has_current || dump->session.has_isa);
    dip_command_line_free(&line);
}

static void options_reach_their_fields(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse(&line, &err,
                      WORDS("--frames=5:90:7", "--fps", "59.94", "--out", "o", "--json", "j",
                            "--requested", "aa=8", "--isa=scalar")));
    const DipDumpOptions *dump = line.options;
    assert_int_equal(dump->frames.first, 5);
    assert_int_equal(dump->frames.end, 90);
    assert_int_equal(dump->frames.step, 7);
    assert_int_equal(dump->rate.frames, 2997);
    assert_int_equal(dump->rate.seconds, 50);
    assert_string_equal(dump->out, "o");
    assert_string_equal(dump->json, "j");
    assert_true(dump->session.has_requested && !dump->session.has_current);
    assert_int_equal(dip_quality_sample_count(&dump->session.requested), 8);
    assert_true(dump->session.has_isa);
    assert_int_equal(dump->session.isa, DIP_ISA_SCALAR);
    dip_command_line_free(&line);
}

static void bad_frames_are_refused(void **state) {
    (void)state;
    static const char *const bad[] = {"5",     "5:5",   "5:2",     "-1:2",  "0:1000001",
                                      "0:5:0", "a:b",   "0:1:1:1", "0:",    ":1",
                                      "0:1:",  "0:1.5", "0x0:1",   "1:2:-1"};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(bad); i++) {
        assert_refused(DIP_ERROR_RANGE, "--frames", WORDS("--hash", "--frames", bad[i]));
    }
}

static void dump_needs_something_to_do(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_false(parse(&line, &err, WORDS("--frames", "0:2")));
    dip_command_line_free(&line);
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    assert_string_equal(err.message, "nothing to do; give one of --out DIR, --json FILE, --hash, "
                                     "--y4m FILE, --raw FILE");
}

static void standard_output_takes_the_record_or_the_hashes(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_refused(DIP_ERROR_CONFLICT, "--hash", WORDS("--hash", "--json", "-"));
    assert_true(parse(&line, &err, WORDS("--json", "-")));
    dip_command_line_free(&line);
    assert_true(parse(&line, &err, WORDS("--json", "j", "--hash")));
    dip_command_line_free(&line);
}

static void standard_output_takes_one_stream(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_CONFLICT, "--raw -", WORDS("--y4m", "-", "--raw", "-"));
    assert_refused(DIP_ERROR_CONFLICT, "--json -", WORDS("--y4m", "-", "--json", "-"));
    assert_refused(DIP_ERROR_CONFLICT, "--hash", WORDS("--raw", "-", "--hash"));
    assert_refused(DIP_ERROR_MISSING, "--pane", WORDS("--hash", "--pane", "both"));
    assert_refused(DIP_ERROR_UNKNOWN, "--pane", WORDS("--raw", "f", "--pane", "left"));
}

static DipFrameRate rate_of(const char *fps) {
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse(&line, &err, WORDS("--hash", "--fps", fps)));
    const DipFrameRate rate = ((const DipDumpOptions *)line.options)->rate;
    dip_command_line_free(&line);
    return rate;
}

static void rates_are_exact_ratios(void **state) {
    (void)state;
    static const struct {
        const char *fps;
        int frames, seconds;
    } good[] = {{"30", 30, 1},
                {"23.976", 2997, 125},
                {"30000/1001", 30000, 1001},
                {"60/2", 30, 1},
                {"0.001", 1, 1000},
                {"1000", 1000, 1},
                {"1/1000", 1, 1000},
                {"0.5", 1, 2},
                {"5000000/5000", 1000, 1},
                {"24000/1001", 24000, 1001}};
    static const char *const bad[] = {"0",      "1001",   "-5",  "30/0",  "0/1",   "1/1001",
                                      "2001/2", "1/1/1",  "30/", "/1001", "a",     "0.0009",
                                      "30/-1",  "1/5001", "nan", "1e9",   "30 /1", "2e9/2e9"};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(good); i++) {
        const DipFrameRate rate = rate_of(good[i].fps);
        assert_int_equal(rate.frames, good[i].frames);
        assert_int_equal(rate.seconds, good[i].seconds);
    }
    for (size_t i = 0; i < DIP_ARRAY_COUNT(bad); i++) {
        assert_refused(DIP_ERROR_RANGE, "--fps", WORDS("--hash", "--fps", bad[i]));
    }
}

__extension__ typedef __int128 Wide; // The truth is computed with 128 bits.

// The last frame at the longest seconds is the largest product.
static void times_of_frames_are_exact(void **state) {
    (void)state;
    static const DipFrameRate rates[] = {{30, 1}, {30000, 1001}, {2997, 50}, {5, 5000}, {1000, 1}};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rates); i++) {
        const DipDumpOptions options = {.rate = rates[i]};
        for (int index = 0; index <= 1000000; index += 1 + index / 7) {
            const Wide exact = (Wide)index * 1000000000 * rates[i].seconds / rates[i].frames;
            assert_true(dip_dump_time_ns(&options, index) == (int64_t)exact);
        }
        assert_true(dip_dump_time_ns(&options, 999999) > 0);
    }
}

static void category_excludes_another_path(void **state) {
    (void)state;
    assert_refused(DIP_ERROR_CONFLICT, "--category",
                   WORDS("--hash", "--category", "AF", "--path", "p"));
    assert_refused(DIP_ERROR_CONFLICT, "--category",
                   WORDS("--hash", "--category", "AF", "--model", "m"));
}

static void printed_and_written_records_are_equal(void **state) {
    (void)state;
    DipError err = {0};
    char file[] = "/tmp/test_dump_record.XXXXXX";
    char written[512] = "";
    char printed[512] = "";
    const DipStartTimes times = {.total_ms = 1.5};
    DipRecord *record = dip_record_create(&err);
    FILE *out = tmpfile();
    assert_non_null(record);
    assert_non_null(out);
    assert_true(mkstemp(file) >= 0);
    assert_true(dip_record_set_warnings(record, &(DipErrorList){0}, 0, &err));
    assert_true(dip_record_set_start(record, &times, 123, &err));
    assert_true(dip_record_write(record, file, &err));
    dip_record_print(record, out);
    rewind(out);
    assert_true(fread(printed, 1, sizeof printed - 1, out) > 100);
    fclose(out);
    FILE *in = fopen(file, "r");
    assert_non_null(in);
    assert_true(fread(written, 1, sizeof written - 1, in) > 100);
    fclose(in);
    remove(file);
    assert_string_equal(printed, written);
    dip_record_destroy(&record);
}

// Returns the record of no frames with these warnings. The caller frees it.
static char *record_with(const DipErrorList *warnings, int left_out) {
    const DipStartTimes times = {.total_ms = 1.5};
    char *text = NULL;
    size_t size_bytes = 0;
    DipRecord *record = dip_record_create(NULL);
    FILE *out = open_memstream(&text, &size_bytes);
    assert_true(record && out);
    assert_true(dip_record_set_warnings(record, warnings, left_out, NULL));
    assert_true(dip_record_set_start(record, &times, 123, NULL));
    dip_record_print(record, out);
    fclose(out);
    dip_record_destroy(&record);
    return text;
}

// What is not known of a warning is null. Texts from files are escaped.
static void warnings_stand_in_the_record(void **state) {
    (void)state;
    DipErrorList warnings = {0};
    DipError warning = {
        .line = 7, .file = "a\"b.ini", .key = "K\\", .message = "</script>\x1b\xff"};
    dip_error_list_add(&warnings, &warning);
    dip_error_list_add(&warnings, &(DipError){.message = "plain"});
    char *text = record_with(&warnings, 5);
    assert_non_null(strstr(text, "{\"frames\": [],\n\"warnings\": [\n"
                                 "{\"file\": \"a\\\"b.ini\", \"line\": 7, \"key\": \"K\\\\\", "
                                 "\"message\": \"\\u003c/script\\u003e??\"},\n"
                                 "{\"file\": null, \"line\": null, \"key\": null, "
                                 "\"message\": \"plain\"}],\n"
                                 "\"warnings_left_out\": 5,\n\"load_ms\": {"));
    free(text);
    text = record_with(&(DipErrorList){0}, 0);
    assert_non_null(strstr(text, "\"warnings\": [],\n\"warnings_left_out\": 0,\n"));
    free(text);
    dip_error_list_free(&warnings);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_first_frame_at_30_per_second),
        cmocka_unit_test(options_reach_their_fields),
        cmocka_unit_test(bad_frames_are_refused),
        cmocka_unit_test(dump_needs_something_to_do),
        cmocka_unit_test(standard_output_takes_the_record_or_the_hashes),
        cmocka_unit_test(standard_output_takes_one_stream),
        cmocka_unit_test(rates_are_exact_ratios),
        cmocka_unit_test(times_of_frames_are_exact),
        cmocka_unit_test(category_excludes_another_path),
        cmocka_unit_test(printed_and_written_records_are_equal),
        cmocka_unit_test(warnings_stand_in_the_record),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
