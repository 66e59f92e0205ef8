// Tests of what a cost report is written to: JSON that is read back, CSV, the page and the
// terminal.
#include "app/report/report.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
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

static const char *const file = "test_cost_formats.json";

// Compares arrays of numbers. The JSON library may round the last bit.
static void check_values(const void *a, const void *b, size_t size) {
    const double *x = a;
    const double *y = b;
    for (size_t i = 0; i < size / sizeof(double); i++) {
        const double most = 4e-16 * fabs(y[i]);
        if (!(fabs(x[i] - y[i]) <= most) && x[i] != y[i] && !(isnan(x[i]) && isnan(y[i]))) {
            fail_msg("%.17g, expected %.17g", x[i], y[i]);
        }
    }
}

static void check_same_warnings(const DipCostReport *a, const DipCostReport *b) {
    assert_int_equal(a->warning_count, b->warning_count);
    assert_int_equal(a->warnings_left_out, b->warnings_left_out);
    for (int i = 0; i < a->warning_count; i++) {
        assert_string_equal(a->warnings[i].file, b->warnings[i].file);
        assert_int_equal(a->warnings[i].line, b->warnings[i].line);
        assert_string_equal(a->warnings[i].key, b->warnings[i].key);
        assert_string_equal(a->warnings[i].message, b->warnings[i].message);
    }
}

static void check_same(const DipCostReport *a, const DipCostReport *b) {
    check_same_warnings(a, b);
    assert_string_equal(a->scene, b->scene);
    assert_string_equal(a->scene_hash, b->scene_hash);
    assert_string_equal(a->date, b->date);
    assert_int_equal(a->rounds, b->rounds);
    assert_int_equal(a->combined_first, b->combined_first);
    assert_string_equal(a->paths[1], b->paths[1]);
    assert_string_equal(a->refused[0], b->refused[0]);
    assert_int_equal(a->row_count, b->row_count);
    for (int r = 0; r < a->row_count; r++) {
        const DipCostRow *x = &a->rows[r];
        const DipCostRow *y = &b->rows[r];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        assert_int_equal(x->path, y->path);
        assert_memory_equal(x->judged, y->judged, 3 * sizeof(bool));
        check_values(x->tails, y->tails, 3 * sizeof *x->tails);
        check_values(x->viewpoints, y->viewpoints, 3 * sizeof *x->viewpoints);
        check_values(&x->time.ratio, &y->time.ratio, sizeof x->time.ratio);
        check_values(&x->time.p95_ms, &y->time.p95_ms, sizeof x->time.p95_ms);
        check_values(x->counters, y->counters, sizeof x->counters);
    }
    check_values(a->floors, b->floors, 6 * sizeof *a->floors);
    assert_memory_equal(a->sweeps[0].rows, b->sweeps[0].rows, sizeof a->sweeps[0].rows);
    assert_int_equal(a->choice.candidates.count, b->choice.candidates.count);
    assert_int_equal(a->predicted.count, b->predicted.count);
    for (int i = 0; i < a->predicted.count; i++) {
        const DipCostPrediction *x = &a->predicted.list[i];
        const DipCostPrediction *y = &b->predicted.list[i];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        assert_true(x->ms == y->ms && x->p95_ms == y->p95_ms && x->flip == y->flip);
        assert_int_equal(x->row, y->row);
        assert_true(a->predicted.times.median == b->predicted.times.median);
        assert_true(a->predicted.times.within_10 == b->predicted.times.within_10);
        assert_true(a->predicted.errors_left_out.p90 == b->predicted.errors_left_out.p90);
    }
    assert_int_equal(a->smaller_count, b->smaller_count);
    assert_int_equal(a->smaller_width, b->smaller_width);
    assert_int_equal(a->smaller_height, b->smaller_height);
    for (int i = 0; i < a->smaller_count; i++) {
        const DipCostElsewhere *x = &a->smaller[i];
        const DipCostElsewhere *y = &b->smaller[i];
        assert_memory_equal(&x->quality, &y->quality, sizeof x->quality);
        check_values(&x->ms, &y->ms, 3 * sizeof(double)); // Value, low and high.
        check_values(x->counters, y->counters, sizeof x->counters);
        check_values(x->stage_ms, y->stage_ms, sizeof x->stage_ms);
    }
    assert_int_equal(a->choice.advice_count, b->choice.advice_count);
    for (int i = 0; i < a->choice.advice_count; i++) {
        assert_true(a->choice.advice[i].budget_ms == b->choice.advice[i].budget_ms);
        assert_int_equal(a->choice.advice[i].chosen, b->choice.advice[i].chosen);
    }
    assert_int_equal(a->verdict, b->verdict);
    assert_true(a->rounds == 0 || a->machine.wait == b->machine.wait);
}

static void json_keeps_everything(void **state) {
    (void)state;
    for (int rounds = 0; rounds < 5; rounds += 2) {
        DipCostReport report;
        DipCostReport read;
        DipError err = {0};
        dip_made_report(&report, rounds);
        assert_true(dip_cost_write_json(&report, file, &err));
        assert_true(dip_cost_read_json(&read, file, &err));
        check_same(&report, &read);
        dip_cost_report_free(&report);
        dip_cost_report_free(&read);
    }
    remove(file);
}

// A log of two starts, in which each frame of a path is timed in one round.
static void add_log(DipCostReport *report) {
    const int frames = dip_cost_frame_count(report), rounds = report->options.rounds / 2;
    DipTimed *list = calloc((size_t)(report->row_count * frames), sizeof *list);
    int rows[8], count = 0;
    assert_true(list && report->row_count <= 8);
    for (int r = 0; r < report->row_count; r++) {
        rows[r] = r;
        for (int f = 0; f < frames; f++) {
            const int round = (f + f / 3) % (2 * rounds);
            list[count++] = (DipTimed){.subject = r,
                                       .start = round / rounds,
                                       .round = round % rounds,
                                       .frame = f,
                                       .begin_ns = 1000000 * r,
                                       .ms = (1.0 + r) * (1.0 + 0.001 * (7 * f % 11)),
                                       .wait = f == 1 ? NAN : 0.01};
        }
    }
    const DipTimes times = {list, count, report->row_count, 2, rounds, frames, NULL, false};
    dip_cost_log_clear(report);
    assert_true(dip_cost_log_add(report, &times, rows, NULL));
    free(list);
    assert_true(dip_cost_estimate_times(report, NULL));
}

static void json_keeps_the_log(void **state) {
    (void)state;
    DipCostReport report, read;
    dip_made_report(&report, 4);
    add_log(&report);
    assert_true(fabs(report.rows[3].time.ratio.value - 4.0) < 0.1);
    assert_true(report.rows[3].time.ratio.low < report.rows[3].time.ratio.high);
    assert_true(dip_cost_write_json(&report, file, NULL));
    assert_true(dip_cost_read_json(&read, file, NULL));
    assert_true(read.starts == 2 && read.log_count == report.log_count);
    int found = 0;
    for (int i = 0; i < read.log_count; i++) {
        const DipTimed *a = &report.log[i], *b = &read.log[i];
        found += a->subject == b->subject && a->start == b->start && a->round == b->round &&
                 a->block == b->block && a->frame == b->frame && a->begin_ns == b->begin_ns &&
                 fabs(a->ms - b->ms) <= 4e-16 * a->ms && (a->wait == b->wait || isnan(b->wait));
    }
    assert_int_equal(found, read.log_count);
    check_values(&report.rows[3].time.ratio, &read.rows[3].time.ratio, sizeof(DipEstimate));
    dip_cost_report_free(&report);
    dip_cost_report_free(&read);
    remove(file);
}

static char *read_whole(size_t *size) {
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    char *text = calloc(1, 1 << 20);
    *size = fread(text, 1, 1 << 20, in);
    fclose(in);
    return text;
}

static void write_whole(const char *text, size_t size) {
    FILE *out = fopen(file, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, size, out), size);
    fclose(out);
}

// Reports of earlier versions have no date.
static void json_without_a_date_is_read(void **state) {
    (void)state;
    DipCostReport report;
    DipCostReport read;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, file, &err));
    char *text = read_whole(&size);
    char *format = strstr(text, "\"format\":3");
    assert_non_null(format);
    format[9] = '2';
    char *date = strstr(text, "\"date\":\"2026-01-31T23:59:58Z\",");
    assert_non_null(date);
    memmove(date, strchr(date, ',') + 1, strlen(strchr(date, ',')));
    write_whole(text, strlen(text));
    assert_true(dip_cost_read_json(&read, file, &err));
    assert_string_equal(read.date, "");
    dip_cost_report_free(&read);
    dip_cost_report_free(&report);
    free(text);
    remove(file);
}

// A file that is cut short anywhere, or that lacks a field, is refused, and the error names the
// file.
static void broken_json_is_refused(void **state) {
    (void)state;
    static const char *const fields[] = {
        "\"width\"",
        "\"rows\"",
        "\"sums\"",
        "\"begin_ms\"",
        "\"setting\"",
        "\"path\"",
        "\"baseline\"",
        "\"combinations\":[\n{\"settings\":\"aa=none,taa=off,aaa=off,"
        "asd=1,af=none,aaf=off,opt=off,miplod=high-quality,scale=1,upscale=bilinear,"
        "post=off,sharpen=off,shadows=off,gi=on,mipdebug=off\",\"ms\":0.5"};
    DipCostReport report;
    DipCostReport read;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    assert_true(dip_cost_write_json(&report, file, &err));
    dip_cost_report_free(&report);
    char *text = read_whole(&size);
    for (size_t cut = 0; cut < size; cut += size / 37) {
        write_whole(text, cut);
        assert_false(dip_cost_read_json(&read, file, &err));
        assert_string_equal(err.file, file);
    }
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        char *at = strstr(text, fields[f]);
        assert_non_null(at);
        at[1] ^= 1;
        write_whole(text, size);
        assert_false(dip_cost_read_json(&read, file, &err));
        at[1] ^= 1;
    }
    free(text);
    remove(file);
    assert_false(dip_cost_read_json(&read, "none.json", &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
}

// Each line of the CSV has the same number of fields as the header. The HTML page has all its parts
// and refers to no other file.
static void csv_and_page_are_complete(void **state) {
    (void)state;
    DipCostReport report;
    DipError err = {0};
    size_t size;
    dip_made_report(&report, 2);
    strcpy(report.scene, "a \"b\", c");
    assert_true(dip_cost_write_csv(&report, file, &err));
    char *text = read_whole(&size);
    assert_non_null(strstr(text, ",\"a \"\"b\"\", c\",64,48,"));
    assert_non_null(strstr(text, ",version,date,verdict,warnings,"));
    assert_non_null(strstr(text, ",\"0\",\"2026-01-31T23:59:58Z\",\"green\",5,"));
    int lines = 0, commas = 0, first = 0;
    bool quoted = false;
    for (const char *c = text; *c; c++) {
        quoted = quoted != (*c == '"');
        commas += *c == ',' && !quoted;
        if (*c == '\n') {
            first = lines++ ? first : commas;
            assert_int_equal(commas, first);
            commas = 0;
        }
    }
    assert_int_equal(lines, 1 + 2 + 3 + 1); // One of two combinations was only predicted.
    assert_non_null(strstr(text, "\n\"predicted\",\"\",\"DEFAULT\",\"aa=4,"));
    assert_non_null(strstr(text, ",flip_tail_p50,flip_tail_p95,flip_tail_p99,flip_tail_worst,"));
    // aa=4 is row 3: the means of equal percentiles, and the worst block at the first viewpoint.
    assert_non_null(strstr(text, ",0.0025,0.025,0.05,0.075,0,1,32,16,32,32,"));
    free(text);
    assert_true(dip_cost_write_html(&report, NULL, file, &err));
    text = read_whole(&size);
    assert_non_null(strstr(text, "Antialiasing"));
    assert_non_null(strstr(text, "opt=standard"));
    assert_non_null(strstr(text, "</html>"));
    assert_null(strstr(text, "http://www.w3.org/1999"));
    for (const char *at = text; (at = strstr(at, "href=")) != NULL; at++) {
        assert_int_equal(strncmp(at, "href=\"#", 7), 0); // a link within the page
    }
    assert_null(strstr(text, " src=\"h"));
    assert_null(strstr(text, "@import"));
    assert_non_null(strstr(text, "2026-01-31T23:59:58Z"));
    assert_null(strstr(text, "nan"));
    free(text);
    remove(file);
    dip_cost_report_free(&report);
}

// Parts of a report have the same warnings, perhaps of files in other folders. Each is kept once.
// No number of warnings is too great: those that are not kept are counted.
static void warnings_are_added_once(void **state) {
    (void)state;
    static DipError many[DIP_COST_MAX_WARNINGS + 30];
    const int most = DIP_COST_MAX_WARNINGS, count = (int)(sizeof many / sizeof *many);
    DipError few[] = {{.file = "/a/b/m.gltf", .key = "k", .message = "one"},
                      {.file = "m.gltf", .line = 1, .key = "k", .message = "one"},
                      {.file = "m.gltf", .key = "l", .message = "one"},
                      {.file = "m.gltf", .key = "k", .message = "two"},
                      {.file = "n.gltf", .key = "k", .message = "one"}};
    DipCostReport report = {.rounds = 0};
    assert_true(dip_cost_report_add_warnings(&report, few, 0, NULL));
    assert_true(dip_cost_report_add_warnings(&report, few, 5, NULL));
    assert_int_equal(report.warning_count, 5);
    assert_string_equal(report.warnings[0].file, "m.gltf");
    strcpy(few[0].file, "/elsewhere/m.gltf");
    few[4].line = 9;
    assert_true(dip_cost_report_add_warnings(&report, few, 5, NULL));
    assert_int_equal(report.warning_count, 6);
    assert_int_equal(report.warnings[5].line, 9);
    for (int i = 0; i < count; i++) {
        snprintf(many[i].message, sizeof many[i].message, "%d", i);
    }
    assert_true(dip_cost_report_add_warnings(&report, many, count, NULL));
    assert_int_equal(report.warning_count, most);
    assert_int_equal(report.warnings_left_out, 6 + count - most);
    assert_string_equal(report.warnings[6].message, "0");
    dip_cost_report_free(&report);
}

// A page lists the warnings, and a terminal shows their number. Both escape them.
static void warnings_are_shown_escaped(void **state) {
    (void)state;
    DipCostReport report;
    size_t size;
    dip_made_report(&report, 2);
    strcpy(report.warnings[0].message, "</script><b>\x1b[31m'\"");
    assert_true(dip_cost_write_html(&report, NULL, file, NULL));
    char *text = read_whole(&size);
    assert_non_null(strstr(text, "<a href=\"#warnings\">"));
    assert_non_null(strstr(text, "<th scope=\"row\">made.gltf</th>"));
    assert_non_null(strstr(text, ">extensionsUsed</td><td class=\"l\">"
                                 "&lt;/script&gt;&lt;b&gt;?[31m&#39;&quot;</td>"));
    assert_non_null(strstr(text, "2 more warnings are left out."));
    free(text);
    FILE *out = fopen(file, "w");
    assert_non_null(out);
    dip_cost_print(&report, out);
    fclose(out);
    text = read_whole(&size);
    assert_non_null(strstr(text, "Warnings"));
    assert_non_null(strstr(text, "5 when the scene was loaded; cost.json and cost.html list them"));
    free(text);
    report.warning_count = report.warnings_left_out = 0;
    assert_true(dip_cost_write_html(&report, NULL, file, NULL));
    text = read_whole(&size);
    assert_null(strstr(text, "arnings"));
    free(text);
    remove(file);
    dip_cost_report_free(&report);
}

// The settings of a row are written whole, however long their text is.
static void long_settings_are_not_cut(void **state) {
    (void)state;
    static const char longest[] =
        "aa=8,taa=alternate,aaa=coverage,asd=2,af=16,aaf=on,opt=advanced,miplod=high-performance,"
        "scale=1/1.7,upscale=bicubic,post=fxaa,sharpen=medium,shadows=1024,gi=off,mipdebug=on";
    DipQuality quality;
    char text[DIP_COST_TEXT];
    assert_true(dip_quality_parse(longest, &quality, NULL));
    dip_cost_settings_text(&quality, text);
    assert_string_equal(text, longest);
}

// The tables, the titles and the bars of a report from a busy machine write no time and no ratio of
// times as if it were sure. Only the ratios of A/A, which say how wrong times are, keep their
// digits, and so does the base's ratio to itself.
static void doubtful_times_have_a_mark(void **state) {
    (void)state;
    enum { ROOM = 1 << 20 };
    static char text[2][ROOM];
    for (int busy = 0; busy < 2; busy++) {
        DipCostReport report;
        DipError err;
        dip_made_report(&report, 16);
        dip_made_times(&report, 1, 1.25);
        dip_made_times(&report, 3, 8.996);
        DipQuality both = dip_quality_default();
        both.step[DIP_SETTING_AA] = both.step[DIP_SETTING_AF] = 1;
        dip_made_combination(&report, &both, 7.125, 0.01);
        both.step[DIP_SETTING_AA] = 2;
        dip_made_combination(&report, &both, 7.875, 0.005);
        assert_true(dip_cost_estimate_times(&report, NULL));
        report.verdict = busy ? DIP_COST_RED : DIP_COST_GREEN;
        assert_true(dip_cost_choose(&report, NULL));
        FILE *out = fmemopen(text[0], ROOM - 1, "w");
        assert_non_null(out);
        dip_cost_print(&report, out);
        fclose(out);
        assert_true(dip_cost_write_html(&report, NULL, "doubtful_times.html", &err));
        FILE *in = fopen("doubtful_times.html", "rb");
        assert_non_null(in);
        text[1][fread(text[1], 1, ROOM - 1, in)] = '\0';
        fclose(in);
        remove("doubtful_times.html");
        assert_int_equal(strstr(text[0], " 9.00 ") != NULL, !busy);
        assert_int_equal(strstr(text[0], " 9? ") != NULL, busy);
        assert_int_equal(strstr(text[1], ">9.00</td>") != NULL, !busy);
        assert_int_equal(strstr(text[1], ">9?</td>") != NULL, busy);
        assert_non_null(strstr(text[1], busy ? ": 9? ms" : ": 9.00 ms")); // A row's title.
        assert_non_null(strstr(text[1], busy ? "of the path: 1? ms<" : "of the path: 1.00 ms<"));
        for (int page = 0; page < 2; page++) {
            assert_non_null(strstr(text[page], "1.250")); // A/A.
            assert_int_equal(strstr(text[page], "8.996") != NULL, !busy);
            assert_int_equal(strstr(text[page], "3.000") != NULL, !busy);
        }
        assert_int_equal(strstr(text[1], ">7.125</td>") != NULL, !busy);  // Only the page lists it.
        assert_int_equal(strstr(text[1], ">9.00</text>") != NULL, !busy); // A bar.
        assert_int_equal(strstr(text[1], ">9?</text>") != NULL, busy);
        assert_non_null(strstr(text[1], ">1.00</text>")); // The base's.
        assert_non_null(strstr(text[1], busy ? ">1?</td><td class=\"n\">1.000</td>"
                                             : ">1.00</td><td class=\"n\">1.000</td>"));
        dip_cost_report_free(&report);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_keeps_everything),       cmocka_unit_test(json_keeps_the_log),
        cmocka_unit_test(json_without_a_date_is_read), cmocka_unit_test(broken_json_is_refused),
        cmocka_unit_test(csv_and_page_are_complete),   cmocka_unit_test(warnings_are_added_once),
        cmocka_unit_test(warnings_are_shown_escaped),  cmocka_unit_test(long_settings_are_not_cut),
        cmocka_unit_test(doubtful_times_have_a_mark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
