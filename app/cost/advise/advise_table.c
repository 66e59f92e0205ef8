// Printing common advice for a terminal.
#include "app/cost/advise/advise_output.h"

#include "app/report/tiers.h"
#include "app/files/put.h"
#include "app/report/words.h"

#include <math.h>

double dip_cost_common_share_lost(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                  int report) {
    const DipCostReport *r = &common->reports[report];
    const int alone = advice->alone[report];
    if (advice->all.chosen < 0 || alone < 0) {
        return NAN;
    }
    const int row = common->rows[advice->all.chosen * common->report_count + report];
    return dip_cost_ranking_flip(r, row) / dip_cost_ranking_flip(r, alone) - 1.0;
}

static void print_reports(const DipCostCommon *common, FILE *out) {
    dip_put_text(out, "%d report%s:\n", common->report_count,
                 dip_cost_plural(common->report_count));
    for (int i = 0; i < common->report_count; i++) {
        const DipCostReport *r = &common->reports[i];
        dip_put_text(out,
                     "  %2d  %s: %s, path %s, %dx%d pixels, %d thread%s; %s; %d combinations\n",
                     i + 1, common->names[i], r->scene, r->paths[0], r->width, r->height,
                     r->threads, dip_cost_plural(r->threads), dip_cost_verdict_names[r->verdict],
                     r->choice.candidates.count);
    }
    dip_put_text(
        out,
        "%d combination%s of settings %s in every report. Times are %s times with their "
        "intervals of 95 %%.\n"
        "Mean FLIP is the mean over the reports. Loss is how much more FLIP the common choice "
        "has than the settings that the report alone would choose.\n",
        common->count, dip_cost_plural(common->count), common->count == 1 ? "is" : "are",
        dip_time_kind_names[common->candidates.kind]);
}

static void print_line(const DipCostCommon *common, const DipCostCommonAdvice *advice, int report,
                       FILE *out) {
    const DipCandidate c = dip_cost_common_candidate(common, advice->all.chosen, report);
    const DipEstimate time = dip_estimate_widen(&c.time, c.common_error);
    const double loss = dip_cost_common_share_lost(common, advice, report);
    const int alone = advice->alone[report];
    const int row = common->rows[advice->all.chosen * common->report_count + report];
    char settings[DIP_COST_TEXT] = "the same";
    char lost[24] = "";
    if (alone >= 0 && alone != row) {
        dip_cost_settings_text(&common->reports[report].rows[alone].quality, settings);
        // Adding 0 turns -0 into 0.
        snprintf(lost, sizeof lost, "%.1f %%", round(1000.0 * loss) / 10.0 + 0.0);
    }
    dip_put_text(out, "    %6d %8.2f %8.2f %8.2f %8.5f %8s  %s\n", report + 1, time.value, time.low,
                 time.high, c.flip, lost, settings);
}

// Says what stands in the way of better settings.
static void print_next(const DipCostCommon *common, const DipAdvice *advice, FILE *out) {
    char settings[DIP_COST_TEXT], ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES];
    char fits[DIP_NUMBER_BYTES];
    if (advice->next < 0) {
        dip_put_text(out, "    no combination is better, whatever its time\n");
        return;
    }
    const DipCandidate *next = &common->candidates.list[advice->next];
    dip_cost_settings_text(&next->quality, settings);
    dip_number_text(advice->next_ms, 2, true, "-", ms);
    dip_number_text(100.0 * (next->flip / common->candidates.list[advice->chosen].flip - 1.0), 1,
                    true, "-", flip);
    dip_fits_text(advice->next_fits, fits);
    dip_put_text(out,
                 "    next better: %s (mean FLIP %s %%), for %s ms in report %d, where it takes "
                 "longest; fits with %s\n",
                 settings, flip, ms, next->report + 1, fits);
}

static void print_nothing(const DipCostCommon *common, const DipAdvice *advice, FILE *out) {
    char settings[DIP_COST_TEXT], budget[DIP_BUDGET_BYTES], fits[DIP_NUMBER_BYTES];
    const DipCandidate *fastest = &common->candidates.list[advice->next];
    dip_cost_settings_text(&fastest->quality, settings);
    dip_budget_text(advice->budget_ms, budget);
    dip_fits_text(advice->next_fits, fits);
    dip_put_text(
        out,
        "\n%s: no common combination surely fits; the fastest, %s, takes %.2f ms in report %d "
        "and fits with %s\n",
        budget, settings, fastest->time.value, fastest->report + 1, fits);
}

static void print_ties(const DipCostCommon *common, const DipAdvice *advice, FILE *out) {
    char settings[DIP_COST_TEXT];
    for (int i = 0; i < advice->tie_count && i < DIP_ADVICE_TIES; i++) {
        dip_cost_settings_text(&common->qualities[advice->ties[i]], settings);
        dip_put_text(out, "%s%s", i > 0 ? "; " : "    as good within 1 %: ", settings);
    }
    dip_put_text(out, "%s%s", advice->tie_count > DIP_ADVICE_TIES ? "; ..." : "",
                 advice->tie_count > 0 ? "\n" : "");
}

static void print_budget(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                         FILE *out) {
    const DipAdvice *all = &advice->all;
    if (all->chosen < 0) {
        print_nothing(common, all, out);
        return;
    }
    const DipCandidate *chosen = &common->candidates.list[all->chosen];
    char settings[DIP_COST_TEXT], budget[DIP_BUDGET_BYTES], fits[DIP_NUMBER_BYTES];
    dip_cost_settings_text(&chosen->quality, settings);
    dip_budget_text(all->budget_ms, budget);
    dip_fits_text(all->fits, fits);
    dip_put_text(out, "\n%s: %s  (mean FLIP %.5f; fits with %s)\n", budget, settings, chosen->flip,
                 fits);
    dip_put_text(out, "    %6s %8s %8s %8s %8s %8s  %s\n", "report", "ms", "from", "to", "FLIP",
                 "loss", "this report alone would choose");
    for (int i = 0; i < common->report_count; i++) {
        print_line(common, advice, i, out);
    }
    print_ties(common, all, out);
    print_next(common, all, out);
}

static void print_tiers(const DipCostCommon *common, const DipCostCommonAdvice *advice, FILE *out) {
    DipCostTier tiers[DIP_COST_TIER_COUNT];
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        const int chosen = advice[i].all.chosen;
        tiers[i] = (DipCostTier){advice[i].all.budget_ms,
                                 chosen >= 0 ? &common->qualities[chosen] : NULL, -1};
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
