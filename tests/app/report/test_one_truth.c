// One report, asked by every part of the program that answers: the text of `diptych cost`, its
// page, `cost advise`, the preview with the report, and the preview with the same figures as live
// prices. They contradict each other nowhere. The reports in data/ were measured by diptych on a
// busy machine and made smaller: one of combinations, and one of predicted ones. So that they are
// not red, their threads' waits are 0 and the two times of the baseline lie within 1 %. Instead of
// this folder, the test takes the reports that one_truth.sh has measured just now.
#include "app/cost/advise/common_advice.h"
#include "app/preview/prices/choice.h"
#include "app/preview/prices/price_text.h"
#include "app/preview/state/state.h"
#include "app/preview/live/figures.h"
#include "app/report/report.h"
#include "app/report/combinations.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/report/analysis.h"
#include "app/report/words.h"
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/made_live.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_REPORTS = 8 };
static char files[MOST_REPORTS][512];
static int report_count;
static bool are_stored; // The reports are those of data/, whose answers are known to be many.

static void read(int index, DipCostReport *report) {
    DipError err = {0};
    if (!dip_cost_read_report(files[index], report, &err)) {
        fail_msg("%s: %s", files[index], err.message);
    }
    // A report of a busy machine is asked for its answers, too.
    if (report->verdict == DIP_COST_RED) {
        report->verdict = DIP_COST_AMBER;
        assert_true(dip_cost_choose(report, NULL));
    }
}

// Returns what a writer prints. The caller frees it.
static char *print(const DipCostReport *report) {
    enum { ROOM = 1 << 20 };
    char *text = calloc(1, ROOM);
    assert_non_null(text);
    FILE *out = fmemopen(text, ROOM - 1, "w");
    assert_non_null(out);
    dip_cost_print(report, out);
    fclose(out);
    return text;
}

// Returns the page of a report without the places where it may break a word, which are not text.
static char *page_of(const DipCostReport *report) {
    char *text = calloc(1, 8 << 20);
    assert_non_null(text);
    assert_true(dip_cost_write_html(report, NULL, "one_truth.html", NULL));
    FILE *in = fopen("one_truth.html", "rb");
    assert_non_null(in);
    assert_true(fread(text, 1, (8 << 20) - 1, in) > 0);
    fclose(in);
    remove("one_truth.html");
    for (char *at = text; (at = strstr(at, "<wbr>"));) {
        memmove(at, at + strlen("<wbr>"), strlen(at + strlen("<wbr>")) + 1);
    }
    return text;
}

static int count_of(const char *text, const char *part) {
    const size_t length = strlen(part);
    int count = 0;
    for (size_t i = 0; text[i]; i++) {
        count += strncmp(text + i, part, length) == 0;
    }
    return count;
}

static const char *skip_space(const char *text) {
    return text + strspn(text, " \n");
}

// Returns whether a text begins with a part. Blanks and line ends count alike, since the report
// breaks long lines.
static bool begins_with(const char *text, const char *part) {
    while (*part && *text) {
        const bool space = *part == ' ';
        if (space ? skip_space(text) == text : *part != *text) {
            return false;
        }
        text = space ? skip_space(text) : text + 1;
        part = space ? skip_space(part) : part + 1;
    }
    return !*part;
}

static void expect_text(const char *text, const char *part) {
    while (*text && !begins_with(text, part)) {
        text++;
    }
    if (!*text) {
        fail_msg("\"%s\" is not in the text", part);
    }
}

// The preview with a report, asked for one budget.
typedef struct Window {
    DipPrices *prices;
    DipPreviewChoice choice;
} Window;

static void open_window(Window *window, const DipCostReport *report) {
    *window = (Window){.prices = dip_prices_create(NULL)};
    assert_true(dip_prices_set_report(window->prices, report, NULL));
}

static const DipPreviewChoice *ask(Window *window, double budget_ms) {
    const DipQuality like = dip_quality_default();
    dip_preview_choose(&window->choice, window->prices, &like, budget_ms);
    return &window->choice;
}

static void close_window(Window *window) {
    dip_preview_choice_free(&window->choice);
    dip_prices_destroy(&window->prices);
}

// --- fronts and advice ---------------------------------------------------------------------------

// Returns the part of a text between two others, and ends the text after it.
static char *cut(char *text, const char *from, const char *to) {
    char *part = strstr(text, from);
    assert_non_null(part);
    char *end = strstr(part, to);
    assert_non_null(end);
    *end = '\0';
    return part;
}

// The terminal and the page list the front, and nothing else.
static void expect_front(const DipCostReport *report, const char *list, const char *table) {
    const DipCostChoice *choice = &report->choice;
    assert_int_equal(count_of(table, "<tr data-row="), choice->front_count);
    assert_int_equal(count_of(list, "\n  "), choice->front_count + 2); // And a head of two lines.
    for (int k = 0; k < choice->front_count; k++) {
        const DipCandidate *c = &choice->candidates.list[choice->front[k]];
        char settings[DIP_COST_TEXT], line[DIP_COST_TEXT + 16];
        dip_cost_settings_text(&c->quality, settings);
        snprintf(line, sizeof line, "\n  %s ", settings);
        expect_text(list, line);
        snprintf(line, sizeof line, "data-row=\"%d\"", c->row);
        expect_text(table, line);
    }
}

static void fronts_agree(void **state) {
    (void)state;
    for (int i = 0; i < report_count; i++) {
        DipCostReport report;
        Window window;
        read(i, &report);
        open_window(&window, &report);
        const DipPreviewChoice *choice = ask(&window, 10.0);
        const DipCandidates *all = &report.choice.candidates;
        assert_int_equal(choice->front_count, report.choice.front_count);
        assert_true(!are_stored || choice->front_count > 2);
        for (int k = 0; k < choice->front_count; k++) {
            assert_int_equal(choice->candidates.list[choice->front[k]].row,
                             all->list[report.choice.front[k]].row);
        }
        char *text = print(&report), *page = page_of(&report);
        expect_front(&report, cut(text, "The Pareto front of ", "\nWhat was measured"),
                     cut(page, "id=\"pareto-front\"", "</table>"));
        free(text);
        free(page);
        close_window(&window);
        dip_cost_report_free(&report);
    }
}

// Returns what a writer of files writes. The caller frees it.
static char *file_of(bool (*write)(const DipCostReport *report, const char *file, DipError *err),
                     const DipCostReport *report) {
    enum { ROOM = 16 << 20 };
    char *text = calloc(1, ROOM);
    assert_non_null(text);
    assert_true(write(report, "one_truth.file", NULL));
    FILE *in = fopen("one_truth.file", "rb");
    assert_non_null(in);
    assert_true(fread(text, 1, ROOM - 1, in) > 0);
    fclose(in);
    remove("one_truth.file");
    return text;
}

// Text, CSV, JSON and page list the same combinations, steps and interactions.
static void lists_are_equal_in_all_forms(void **state) {
    (void)state;
    for (int i = 0; i < report_count; i++) {
        DipCostReport report;
        read(i, &report);
        assert_true(dip_cost_analyse(&report, NULL));
        char *text = print(&report), *page = page_of(&report);
        char *csv = file_of(dip_cost_write_csv, &report);
        char *json = file_of(dip_cost_write_json, &report);
        const int combinations = report.row_count - report.combined_first;
        const int interactions = report.analysis->interaction_count;
        assert_true(combinations > 5);
        assert_int_equal(count_of(csv, "\n\"combination\","), combinations);
        assert_int_equal(count_of(json, "\n{\"settings\":\""),
                         report.row_count + report.same_count + report.predicted.count +
                             report.smaller_count);
        assert_int_equal(count_of(json, "{\"a\":\""), interactions);
        assert_int_equal(strstr(text, "\nTwo settings together") != NULL, interactions > 0);
        if (interactions > 0) {
            const char *list = cut(text, "\nTwo settings together", "\n\n");
            assert_int_equal(count_of(list, "\n  "), interactions + 2);
            list = cut(page, "id=\"interaction-table\"", "</table>");
            assert_int_equal(count_of(list, "<tr>"), interactions + 1);
        }
        free(page);
        page = page_of(&report);
        assert_int_equal(count_of(cut(page, "id=\"combinations\"", "</table>"), "<tr data-row="),
                         combinations);
        free(text);
        free(page);
        free(csv);
        free(json);
        dip_cost_report_free(&report);
    }
}

// Each part names the same settings for a budget and the same next better ones, at the same price.
static void next_better_is_one(void **state) {
    (void)state;
    int advised = 0, better = 0;
    for (int i = 0; i < report_count; i++) {
        DipCostReport report;
        DipCostCommon common;
        Window window;
        read(i, &report);
        open_window(&window, &report);
        common = (DipCostCommon){.reports = calloc(1, sizeof(DipCostReport)), .report_count = 1};
        common.names[0] = files[i];
        read(i, &common.reports[0]);
        assert_true(dip_cost_common_match(&common, NULL));
        char *text = print(&report), *page = page_of(&report);
        for (int b = 0; b < report.choice.advice_count; b++) {
            const DipAdvice *a = &report.choice.advice[b];
            const DipCandidate *list = report.choice.candidates.list;
            const DipPreviewChoice *choice = ask(&window, a->budget_ms);
            DipCostCommonAdvice by_command;
            dip_cost_common_advise(&common, a->budget_ms, &by_command);
            assert_int_equal(choice->advice.chosen >= 0, a->chosen >= 0);
            assert_int_equal(by_command.all.chosen >= 0, a->chosen >= 0);
            if (a->chosen < 0) {
                continue;
            }
            char settings[DIP_COST_TEXT], part[DIP_COST_TEXT + 64], ms[DIP_NUMBER_BYTES],
                fits[DIP_NUMBER_BYTES];
            const DipCandidate *shown = &choice->candidates.list[choice->advice.chosen];
            const DipCandidate *printed = &common.candidates.list[by_command.all.chosen];
            assert_memory_equal(&shown->quality, &list[a->chosen].quality, sizeof(DipQuality));
            assert_memory_equal(&printed->quality, &list[a->chosen].quality, sizeof(DipQuality));
            assert_true(choice->advice.fits == a->fits && by_command.all.fits == a->fits);
            advised++;
            assert_int_equal(choice->advice.next >= 0, a->next >= 0);
            assert_int_equal(by_command.all.next >= 0, a->next >= 0);
            if (a->next < 0) {
                continue;
            }
            const DipCandidate *up = &choice->candidates.list[choice->advice.next];
            const DipCandidate *other = &common.candidates.list[by_command.all.next];
            assert_memory_equal(&up->quality, &list[a->next].quality, sizeof(DipQuality));
            assert_memory_equal(&other->quality, &list[a->next].quality, sizeof(DipQuality));
            assert_true(choice->advice.next_ms == a->next_ms);
            assert_true(by_command.all.next_ms == a->next_ms);
            assert_true(a->next_ms == list[a->next].time.value - list[a->chosen].time.value);
            dip_cost_settings_text(&list[a->next].quality, settings);
            dip_number_text(a->next_ms, 2, true, "-", ms);
            dip_fits_text(a->next_fits, fits);
            snprintf(part, sizeof part, "  Next better    %s: %s ms %s, FLIP ", settings, ms,
                     dip_time_kind_names[report.options.budget_of]);
            expect_text(text, part);
            expect_text(page, strstr(part, settings));
            better++;
        }
        free(text);
        free(page);
        dip_cost_common_free(&common);
        close_window(&window);
        dip_cost_report_free(&report);
    }
    assert_true(!are_stored || (advised >= 6 && better >= 3));
}

// Expects that the window prices the steps of a sweep with the two rows of the report's table.
static int expect_prices(const DipCostReport *report, const DipPrices *prices,
                         const DipCostSweep *sweep) {
    const DipQuality *base = &report->rows[sweep->base].quality;
    const double base_ms = dip_cost_ms(report, sweep->base);
    int steps = 0;
    if (sweep->path == 0 && dip_quality_count_changes(base) == 0) {
        assert_true(dip_prices_sum(prices, base).ms == base_ms);
        for (int i = 0; i < sweep->row_count; i++) {
            const int row = sweep->rows[i];
            if (row != sweep->base && dip_cost_is_timed(report, row)) {
                const int step = report->rows[row].quality.step[sweep->setting];
                const DipPrice price = dip_prices_step(prices, sweep->setting, step, base);
                assert_true(price.ms == dip_cost_ms(report, row) - base_ms);
                steps++;
            }
        }
    }
    return steps;
}

// The window has the times of the report's tables. The baseline's settings are timed more than
// once: as the row beside which all others are timed, as the A/A row, and as a combination.
static void times_are_those_of_the_tables(void **state) {
    (void)state;
    for (int i = 0; i < report_count; i++) {
        DipCostReport report;
        Window window;
        int steps = 0;
        read(i, &report);
        open_window(&window, &report);
        for (int s = 0; s < report.sweep_count; s++) {
            steps += expect_prices(&report, window.prices, &report.sweeps[s]);
        }
        assert_true(report.sweep_count == 0 || steps > 0);
        for (int r = report.combined_first; r < report.row_count && report.sweep_count == 0; r++) {
            const DipPriceSum sum = dip_prices_sum(window.prices, &report.rows[r].quality);
            assert_true(fabs(sum.ms - dip_cost_ms(&report, r)) < 1e-9);
        }
        close_window(&window);
        dip_cost_report_free(&report);
    }
}

static void expect_width(DipEstimate e) {
    if (isnan(e.low) || isnan(e.high)) {
        assert_true(isnan(e.low) && isnan(e.high) && isnan(e.log_error));
        return;
    }
    assert_true(e.low < e.value && e.value < e.high && e.log_error > 0.0);
}

// No interval has width 0: what is not known has no interval.
static void estimates_have_width_or_no_ends(void **state) {
    (void)state;
    for (int i = 0; i < report_count; i++) {
        DipCostReport report;
        read(i, &report);
        for (int r = 0; r < report.row_count; r++) {
            const DipPathEstimate *time = &report.rows[r].time;
            if (r != report.base_rows[report.rows[r].path]) {
                expect_width(time->ratio);
            }
            expect_width(time->mean_ms);
            expect_width(time->p95_ms);
            expect_width(time->worst_ms);
        }
        dip_cost_report_free(&report);
    }
}

// A report whose times come from a busy machine advises nothing, and everyone says so.
static void red_report_advises_nothing_anywhere(void **state) {
    (void)state;
    DipCostReport report;
    Window window;
    char why[200];
    read(0, &report);
    report.verdict = DIP_COST_RED;
    assert_true(dip_cost_choose(&report, NULL));
    open_window(&window, &report);
    for (int b = 0; b < report.choice.advice_count; b++) {
        assert_null(dip_cost_chosen(&report, b));
    }
    const DipPreviewChoice *choice = ask(&window, 1000.0);
    assert_null(dip_preview_advised(choice));
    dip_preview_choice_why(choice, "", why, sizeof why);
    expect_text(why, "too busy");
    DipPreviewState preview = {.choice = &window.choice};
    for (int p = 0; p <= DIP_PRESET_BEST; p++) {
        DipQuality quality;
        assert_false(dip_preview_preset(&preview, (DipPreset)p, &quality));
    }
    char *text = print(&report), *page = page_of(&report);
    expect_text(text, "too busy");
    assert_null(strstr(text, "REQUESTED: "));
    assert_null(strstr(page, "REQUESTED: "));
    free(text);
    free(page);
    close_window(&window);
    DipCostCommon common = {.reports = calloc(1, sizeof(DipCostReport)), .report_count = 1};
    common.names[0] = "red";
    common.reports[0] = report;
    assert_false(dip_cost_common_match(&common, NULL));
    dip_cost_common_free(&common);
}

// Writes times for a frame of these settings: the work of samples, probes and both together.
static double made_ms(const DipQuality *quality) {
    const double samples = dip_quality_sample_count(quality);
    const double probes = dip_quality_max_anisotropy(quality);
    return 4.0 + 0.5 * samples + 0.15 * probes + 0.02 * samples * probes -
           0.2 * quality->step[DIP_SETTING_OPT] + 0.1 * quality->step[DIP_SETTING_MIPLOD];
}

static double made_flip(const DipQuality *quality) {
    return 0.02 + 0.06 / dip_quality_sample_count(quality) +
           0.02 / dip_quality_max_anisotropy(quality) + 0.01 * quality->step[DIP_SETTING_OPT] +
           0.012 * (DIP_MIPLOD_HIGH_QUALITY - quality->step[DIP_SETTING_MIPLOD]);
}

// A live report and the same report when it was read have the same prices, the same sums and the
// same choice, at every budget; and the advice is dip_advise of them.
static void advice_of_a_live_report_is_dip_advise(void **state) {
    (void)state;
    DipPrices *live = dip_prices_create(NULL), *read_prices = dip_prices_create(NULL);
    const unsigned settings = 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AF | 1u << DIP_SETTING_OPT |
                              1u << DIP_SETTING_MIPLOD;
    DipQuality list[512];
    const DipQuality base = dip_quality_default();
    const int count = dip_cost_list_combinations(&base, settings, list, 512);
    dip_made_live(live, "aa=none", made_ms(&base), 0.01, made_flip(&base));
    for (int i = 0; i < count; i++) {
        char text[200];
        dip_quality_format(&list[i], text, sizeof text);
        if (dip_quality_count_changes(&list[i]) <= 1 || i % 5 == 0) {
            dip_made_live(live, text, made_ms(&list[i]), 0.01, made_flip(&list[i]));
        }
    }
    assert_true(dip_prices_set_report(read_prices, dip_prices_live(live), NULL));
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        for (int step = 0; step < dip_setting_info((DipSetting)s)->step_count; step++) {
            const DipPrice a = dip_prices_step(live, (DipSetting)s, step, &list[count - 1]);
            const DipPrice b = dip_prices_step(read_prices, (DipSetting)s, step, &list[count - 1]);
            assert_int_equal(a.state, b.state);
            assert_int_equal(dip_price_trust(&a), dip_price_trust(&b));
            assert_true(a.ms == b.ms && a.flip == b.flip && a.doubtful == b.doubtful);
            assert_true(a.state == DIP_PRICE_UNKNOWN || a.ms_low == b.ms_low);
        }
    }
    for (int i = 0; i < count; i++) {
        const DipPriceSum a = dip_prices_sum(live, &list[i]);
        const DipPriceSum b = dip_prices_sum(read_prices, &list[i]);
        assert_true(a.state == b.state && a.state != DIP_PRICE_UNKNOWN);
        assert_true(a.ms == b.ms && a.ms_low == b.ms_low && a.flip == b.flip);
    }
    DipPreviewChoice of_live = {0}, of_read = {0};
    int chosen = 0;
    for (double budget_ms = 3.0; budget_ms < 14.0; budget_ms += 0.25) {
        dip_preview_choose(&of_live, live, &base, budget_ms);
        dip_preview_choose(&of_read, read_prices, &base, budget_ms);
        assert_int_equal(of_live.known, DIP_PRICES_KNOWN);
        const DipAdvice advice = dip_advise(&of_read.candidates, budget_ms);
        assert_int_equal(of_live.advice.chosen, advice.chosen);
        assert_int_equal(of_read.advice.chosen, advice.chosen);
        assert_int_equal(of_live.advice.next, advice.next);
        assert_true(advice.chosen < 0 || of_live.advice.fits == of_read.advice.fits);
        assert_int_equal(of_live.front_count, of_read.front_count);
        chosen += advice.chosen >= 0;
    }
    assert_true(chosen > 20);
    dip_preview_choice_free(&of_live);
    dip_preview_choice_free(&of_read);
    dip_prices_destroy(&read_prices);
    dip_prices_destroy(&live);
}

// --- presets -------------------------------------------------------------------------------------

// The measured presets are places on the front within the budget, each at least as good as the one
// before; Best is the advice.
static void presets_are_points_of_the_front_within_the_budget(void **state) {
    (void)state;
    DipCostReport report;
    Window window;
    read(1, &report);
    open_window(&window, &report);
    DipPreviewState preview = {.choice = &window.choice};
    ask(&window, 8.0);
    const DipCandidate *list = window.choice.candidates.list;
    const DipCandidate *before = NULL;
    for (int p = 0; p <= DIP_PRESET_BEST; p++) {
        DipQuality quality;
        assert_true(dip_preview_preset(&preview, (DipPreset)p, &quality));
        const DipCandidate *c = &list[window.choice.presets[p]];
        assert_memory_equal(&c->quality, &quality, sizeof quality);
        assert_true(dip_candidate_fits(c, 8.0) >= DIP_SURELY_FITS);
        assert_true(!before || (c->loss <= before->loss && c->time.value >= before->time.value));
        before = c;
    }
    assert_int_equal(window.choice.presets[DIP_PRESET_BEST], window.choice.advice.chosen);
    assert_true(window.choice.presets[DIP_PRESET_PERFORMANCE] !=
                window.choice.presets[DIP_PRESET_BEST]);
    ask(&window, 0.1); // Nothing fits: the presets wait.
    DipQuality quality;
    assert_false(dip_preview_preset(&preview, DIP_PRESET_BALANCED, &quality));
    dip_preview_act(&preview, DIP_ACTION_PRESET, DIP_PRESET_BALANCED, false, 0);
    assert_string_equal(preview.notice, "Balanced: Nothing measured surely fits 0.1 ms.");
    close_window(&window);
    dip_cost_report_free(&report);
}

// --- numbers -------------------------------------------------------------------------------------

static void percentile_is_one(void **state) {
    (void)state;
    double values[20];
    DipTiming timing = {0};
    for (int i = 0; i < 20; i++) {
        values[i] = 1.0 + (7 * i) % 20;
        dip_timing_add(&timing, 1000, values[i]);
    }
    assert_true(fabs(dip_timing_median_ms(&timing, 1000) - 10.5) < 1e-9);
    assert_true(fabs(dip_percentile(values, 20, 0.95) - 19.05) < 1e-9);
}

static void no_change_has_no_sign_in_the_panel(void **state) {
    (void)state;
    char text[DIP_STEP_NAME_BYTES];
    dip_flip_text(0.0, true, text);
    assert_string_equal(text, ".0000");
    dip_flip_text(-0.00001, true, text);
    assert_string_equal(text, ".0000");
    dip_flip_text(-0.0123, true, text);
    assert_string_equal(text, "\u2212.0123");
    dip_flip_text(0.0123, true, text);
    assert_string_equal(text, "+.0123");
    dip_flip_text(0.0123, false, text);
    assert_string_equal(text, ".0123");
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fronts_agree),
        cmocka_unit_test(lists_are_equal_in_all_forms),
        cmocka_unit_test(next_better_is_one),
        cmocka_unit_test(times_are_those_of_the_tables),
        cmocka_unit_test(estimates_have_width_or_no_ends),
        cmocka_unit_test(red_report_advises_nothing_anywhere),
        cmocka_unit_test(advice_of_a_live_report_is_dip_advise),
        cmocka_unit_test(presets_are_points_of_the_front_within_the_budget),
        cmocka_unit_test(percentile_is_one),
        cmocka_unit_test(no_change_has_no_sign_in_the_panel),
    };
    const struct CMUnitTest of_any_reports[] = {
        cmocka_unit_test(fronts_agree),
        cmocka_unit_test(lists_are_equal_in_all_forms),
        cmocka_unit_test(next_better_is_one),
        cmocka_unit_test(times_are_those_of_the_tables),
        cmocka_unit_test(estimates_have_width_or_no_ends),
        cmocka_unit_test(red_report_advises_nothing_anywhere),
    };
    if (argc < 2 || argc - 1 > MOST_REPORTS) {
        fprintf(stderr, "usage: test_one_truth DATA, or test_one_truth COST_JSON...\n");
        return 2;
    }
    are_stored = !strstr(argv[1], ".json");
    if (are_stored) {
        snprintf(files[0], sizeof files[0], "%s/combined.json", argv[1]);
        snprintf(files[1], sizeof files[1], "%s/predicted.json", argv[1]);
        report_count = 2;
        return cmocka_run_group_tests(tests, NULL, NULL);
    }
    for (; report_count < argc - 1; report_count++) {
        snprintf(files[report_count], sizeof files[0], "%s", argv[report_count + 1]);
    }
    return cmocka_run_group_tests(of_any_reports, NULL, NULL);
}
