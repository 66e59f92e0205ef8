// Printing common advice for a terminal.
#include "app/cost/advise/advise_output.h"

#include "app/report/front.h"
#include "app/report/tiers.h"
#include "app/files/put.h"

#include <math.h>

double dip_cost_common_share_lost(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                  int report) {
    const DipCostReport *r = &common->reports[report];
    const int alone = advice->alone[report];
    if (advice->chosen < 0 || alone < 0) {
        return NAN;
    }
    const int row = common->rows[advice->chosen * common->report_count + report];
    return dip_cost_ranking_flip(r, row) / dip_cost_ranking_flip(r, alone) - 1.0;
}

static void print_reports(const DipCostCommon *common, FILE *out) {
    dip_put_text(out, "%d report%s:\n", common->report_count,
                 dip_cost_plural(common->report_count));
    for (int i = 0; i < common->report_count; i++) {
        const DipCostReport *r = &common->reports[i];
        int rows[DIP_COST_MAX_ROWS];
        dip_put_text(out,
                     "  %2d  %s: %s, path %s, %dx%d pixels, %d thread%s; %s; %d combinations\n",
                     i + 1, common->names[i], r->scene, r->paths[0], r->width, r->height,
                     r->threads, dip_cost_plural(r->threads), dip_cost_verdict_names[r->verdict],
                     dip_cost_list_plotted(r, rows));
    }
    const DipCostReport *first = &common->reports[0];
    dip_put_text(
        out,
        "%d combination%s of settings %s in every report. Times are %s times, with a bound "
        "that they surely keep.\n"
        "Mean FLIP is the mean over the reports. Loss is how much more FLIP the common choice "
        "has than the settings that the report alone would choose.\n",
        common->count, dip_cost_plural(common->count), common->count == 1 ? "is" : "are",
        dip_cost_budget_of_names[first->options.budget_of]);
}

static void print_line(const DipCostCommon *common, const DipCostCommonAdvice *advice, int report,
                       FILE *out) {
    const DipStatsEstimate time = dip_cost_common_time(common, advice->chosen, report);
    const double loss = dip_cost_common_share_lost(common, advice, report);
    const int alone = advice->alone[report];
    const int row = common->rows[advice->chosen * common->report_count + report];
    char settings[DIP_COST_TEXT] = "the same";
    char lost[24] = "";
    if (alone >= 0 && alone != row) {
        dip_cost_settings_text(&common->reports[report].rows[alone].quality, settings);
        // Adding 0 turns -0 into 0.
        snprintf(lost, sizeof lost, "%.1f %%", round(1000.0 * loss) / 10.0 + 0.0);
    }
    dip_put_text(out, "    %6d %8.2f %8.2f %8.5f %8s  %s\n", report + 1, time.value, time.high,
                 dip_cost_common_flip(common, advice->chosen, report), lost, settings);
}

// Says what stands in the way of better settings.
static void print_limit(const DipCostCommon *common, const DipCostCommonAdvice *advice, FILE *out) {
    char settings[DIP_COST_TEXT];
    if (advice->next < 0) {
        dip_put_text(out, "    no combination is better, whatever its time\n");
        return;
    }
    dip_cost_settings_text(&common->qualities[advice->next], settings);
    dip_put_text(
        out,
        "    next better: %s (mean FLIP %.1f %%), but it may take up to %.2f ms in report %d\n",
        settings,
        100.0 * (dip_cost_common_mean_flip(common, advice->next) /
                     dip_cost_common_mean_flip(common, advice->chosen) -
                 1.0),
        dip_cost_common_time(common, advice->next, advice->limit).high, advice->limit + 1);
}

static void print_undecided(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                            FILE *out) {
    char settings[DIP_COST_TEXT];
    if (advice->undecided < 0) {
        return;
    }
    dip_cost_settings_text(&common->qualities[advice->undecided], settings);
    dip_put_text(
        out,
        "    not surely within the budget, but perhaps: %s (mean FLIP %.5f); times with less "
        "noise would tell\n",
        settings, dip_cost_common_mean_flip(common, advice->undecided));
}

static void print_nothing(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                          FILE *out) {
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&common->qualities[advice->next], settings);
    dip_put_text(
        out,
        "\n%g ms: no common combination is surely that fast; the fastest, %s, may take up to "
        "%.2f ms in report %d\n",
        advice->budget_ms, settings, dip_cost_common_time(common, advice->next, advice->limit).high,
        advice->limit + 1);
}

static void print_budget(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                         FILE *out) {
    if (advice->chosen < 0) {
        print_nothing(common, advice, out);
        print_undecided(common, advice, out);
        return;
    }
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&common->qualities[advice->chosen], settings);
    dip_put_text(out, "\n%g ms: %s  (mean FLIP %.5f)\n", advice->budget_ms, settings,
                 dip_cost_common_mean_flip(common, advice->chosen));
    dip_put_text(out, "    %6s %8s %8s %8s %8s  %s\n", "report", "ms", "bound", "FLIP", "loss",
                 "this report alone would choose");
    for (int i = 0; i < common->report_count; i++) {
        print_line(common, advice, i, out);
    }
    print_limit(common, advice, out);
    print_undecided(common, advice, out);
}

static void print_tiers(const DipCostCommon *common, const DipCostCommonAdvice *advice, FILE *out) {
    DipCostTier tiers[DIP_COST_TIER_COUNT];
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        const int chosen = advice[i].chosen;
        tiers[i] =
            (DipCostTier){advice[i].budget_ms, chosen >= 0 ? &common->qualities[chosen] : NULL, -1};
    }
    dip_cost_tiers_print(tiers, out);
}

void dip_cost_common_print(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                           int count, FILE *out) {
    print_reports(common, out);
    for (int i = 0; i < count; i++) {
        print_budget(common, &advice[i], out);
    }
    if (count == DIP_COST_TIER_COUNT) {
        print_tiers(common, advice, out);
    }
}
