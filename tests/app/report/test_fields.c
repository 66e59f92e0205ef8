// Reports that the last release wrote are read, and what is written is read back to the byte.
// Usage: test_fields ROOT
#include "app/report/analysis.h"
#include "app/report/format/cost_fields.h"
#include "app/report/format/formats.h"
#include "renderer/base/file.h"
#include "tests/app/cost/made_report.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *root;
static const char *const first = "test_fields_1.json";
static const char *const second = "test_fields_2.json";

static char *read_text(const char *file) {
    unsigned char *bytes;
    size_t size_bytes;
    assert_true(dip_file_read(file, "report", 1 << 28, &bytes, &size_bytes, NULL));
    char *text = realloc(bytes, size_bytes + 1);
    assert_non_null(text);
    text[size_bytes] = '\0';
    return text;
}

static void write_text(const char *file, const char *text) {
    FILE *out = fopen(file, "wb");
    assert_non_null(out);
    assert_int_equal(fputs(text, out) < 0, 0);
    fclose(out);
}

// Writes a report, reads it, and writes it again.
static void check_round_trip(DipCostReport *report) {
    DipCostReport again;
    DipError err = {0};
    assert_true(dip_cost_analyse(report, NULL));
    assert_true(dip_cost_write_json(report, first, NULL));
    if (!dip_cost_read_json(&again, first, &err)) {
        fail_msg("[%s] %s", err.key, err.message);
    }
    assert_true(dip_cost_analyse(&again, NULL));
    assert_true(dip_cost_write_json(&again, second, NULL));
    char *one = read_text(first);
    char *other = read_text(second);
    assert_string_equal(one, other);
    free(one);
    free(other);
    dip_cost_report_free(&again);
    remove(first);
    remove(second);
}

static void stored_reports_are_written_again_to_the_byte(void **state) {
    (void)state;
    static const char *const names[] = {"combined", "predicted", "part"};
    for (int i = 0; i < 3; i++) {
        char file[512];
        DipCostReport report;
        DipError err = {0};
        snprintf(file, sizeof file, "%s/tests/app/report/stored/%s.json", root, names[i]);
        if (!dip_cost_read_json(&report, file, &err)) {
            fail_msg("%s: [%s] %s", names[i], err.key, err.message);
        }
        assert_int_equal(report.rounds > 0, i < 2);
        assert_int_equal(report.log_count > 0, i < 2); // Made of the pairs of times that they have.
        assert_int_equal(report.predicted.count > 0, i == 1);
        assert_int_equal(report.warning_count + report.warnings_left_out, 0); // It has no list.
        check_round_trip(&report);
        dip_cost_report_free(&report);
    }
}

static void made_reports_are_written_again_to_the_byte(void **state) {
    (void)state;
    for (int rounds = 0; rounds <= 4; rounds += 2) {
        DipCostReport report;
        dip_made_report(&report, rounds);
        check_round_trip(&report);
        dip_cost_report_free(&report);
    }
}

// Whatever a measurement gives, the file that it writes is read: what is not known, or too large
// for any file, is null.
static void extreme_measurements_are_read_again(void **state) {
    (void)state;
    static const double ends[][2] = {{-4e19, 4e19}, {0.0, INFINITY}, {-INFINITY, INFINITY},
                                     {NAN, NAN},    {0.5, 0.5},      {-1e308, 1e308}};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        DipCostReport report;
        dip_made_report(&report, 2);
        report.smaller[0].ms = (DipEstimate){0.5, ends[i][0], ends[i][1], NAN, NAN};
        check_round_trip(&report);
        dip_cost_report_free(&report);
    }
    // Of a row that nearly equals the truth, a prediction may be wrong by any factor.
    static const double misses[] = {0.0, 1e6, 4e19, 1e300};
    for (size_t i = 0; i < sizeof misses / sizeof *misses; i++) {
        DipCostReport report;
        dip_made_report(&report, 2);
        report.predicted.times = (DipCostMisses){misses[i], misses[i], 0.0, 0.0, 1};
        check_round_trip(&report);
        dip_cost_report_free(&report);
    }
}

// Replaces a part of a text.
static char *replaced(const char *text, const char *from, const char *to) {
    const char *at = strstr(text, from);
    assert_non_null(at);
    char *made = malloc(strlen(text) + strlen(to) + 1);
    assert_non_null(made);
    sprintf(made, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    return made;
}

static void what_is_no_fact_is_refused_by_its_name(void **state) {
    (void)state;
    static const struct {
        const char *from, *to, *key;
    } cases[] = {
        {"\"width\":64", "\"width\":0", "width"},
        {"\"width\":64", "\"width\":64.5", "width"},
        {"\"width\":64", "\"width\":\"64\"", "width"},
        {"\"scene\":\"made up\"", "\"scene\":7", "scene"},
        {"\"name\":\"AA\"", "\"name\":\"<b>\"", "paths[1]"},
        {"\"setting\":\"aa\"", "\"setting\":\"zz\"", "sweeps[0].setting"},
        {"\"place\":2", "\"place\":3", "rows[0].places[1]"},
        {"\"line\":12", "\"line\":0", "warnings[1].line"},
        {"\"line\":12", "\"line\":\"12\"", "warnings[1].line"},
        {"\"key\":\"NEAR\",", "", "warnings[1].key"},
        {"\"message\":\"ACME_smell is not drawn\"", "\"message\":null", "warnings[0].message"},
        {"\"warnings_left_out\":2", "\"warnings_left_out\":-1", "warnings_left_out"},
        {"\"warnings\":[", "\"warnings\":{\"a\":[]},\"b\":[", "warnings"},
        {"\"settled\":true", "\"settled\":1", "machine.settled"},
        {"\"ms\":0.5,\"ms_low\":0.4", "\"ms\":0.5,\"ms_low\":0.6", "smaller.combinations[0].ms"},
        {"\"ms\":0.5,\"ms_low\":0.4,\"ms_high\":0.6", "\"ms\":0.5,\"ms_low\":0.5,\"ms_high\":0.5",
         "smaller.combinations[0].ms"},
        {"\"ms\":0.5,\"ms_low\":0.4,", "\"ms\":0.5,", "smaller.combinations[0].ms"},
    };
    DipCostReport report;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, first, NULL));
    dip_cost_report_free(&report);
    char *good = read_text(first);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        DipError err = {0};
        char *bad = replaced(good, cases[i].from, cases[i].to);
        write_text(first, bad);
        assert_false(dip_cost_read_json(&report, first, &err));
        assert_string_equal(err.key, cases[i].key);
        free(bad);
    }
    free(good);
    remove(first);
}

// Derived fields of a file are not believed.
static void derived_fields_are_computed_again(void **state) {
    (void)state;
    DipCostReport report;
    DipCostReport read;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, first, NULL));
    char *good = read_text(first);
    char *bad = replaced(good, "\"title\":\"Antialiasing\"", "\"title\":\"something else\"");
    write_text(first, bad);
    assert_true(dip_cost_read_json(&read, first, NULL));
    assert_true(dip_cost_write_json(&read, first, NULL));
    char *again = read_text(first);
    assert_string_equal(good, again);
    dip_cost_report_free(&report);
    dip_cost_report_free(&read);
    free(good);
    free(bad);
    free(again);
    remove(first);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: test_fields ROOT\n");
        return 2;
    }
    root = argv[1];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_reports_are_written_again_to_the_byte),
        cmocka_unit_test(made_reports_are_written_again_to_the_byte),
        cmocka_unit_test(extreme_measurements_are_read_again),
        cmocka_unit_test(what_is_no_fact_is_refused_by_its_name),
        cmocka_unit_test(derived_fields_are_computed_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
