// Judges how far other programs disturbed the timing: green, amber or red.
#include "app/report/verdict.h"

#include <math.h>
#include <stdio.h>

const char *const dip_cost_verdict_names[] = {"green", "amber", "red"};

// The limits come from 66 measurements whose true ratios were known, on a quiet machine, beside one
// or two busy loops, and beside bursts of load (docs/cost-methods.md). None of the measurements
// under load is green, and no green one errs by more than 2.5 %.
const DipCostLimits dip_cost_wait_limits = {0.05, 0.20};
const DipCostLimits dip_cost_spread_limits = {0.05, 0.10};
const DipCostLimits dip_cost_offset_limits = {0.02, 0.05};
// If a greater share of the times was disturbed, the verdict is red.
static const double most_disturbed = 0.25;

static DipCostVerdict judge(double sign, const DipCostLimits *limits) {
    return sign > limits->red     ? DIP_COST_RED
           : sign > limits->green ? DIP_COST_AMBER
                                  : DIP_COST_GREEN;
}

DipCostVerdict dip_cost_verdict_of(const DipCostSigns *signs, char reason[DIP_COST_REASON]) {
    const double wait = 100.0 * signs->wait, offset = 100.0 * (exp(signs->offset) - 1.0);
    const struct {
        DipCostVerdict verdict;
        const char *reason;
        double percent;
    } found[] = {
        {judge(signs->wait, &dip_cost_wait_limits),
         "The threads waited %.0f %% of their time for a core, which other programs held.", wait},
        {judge(signs->spread, &dip_cost_spread_limits),
         "The baseline was timed twice in every round, and the two times differed by %.0f %% from "
         "round to round.",
         100.0 * fmin(signs->spread, 10.0)},
        {judge(signs->offset, &dip_cost_offset_limits),
         "The baseline was timed twice, as if it were two settings, and the two differ by %.0f %%.",
         offset},
    };
    DipCostVerdict verdict = DIP_COST_GREEN;
    snprintf(reason, DIP_COST_REASON,
             "The threads waited %.1f %% of their time for a core, and the baseline, timed twice, "
             "differed by %.1f %%.",
             wait, offset);
    for (size_t i = 0; i < sizeof found / sizeof *found; i++) {
        if (found[i].verdict > verdict) {
            verdict = found[i].verdict;
            snprintf(reason, DIP_COST_REASON, found[i].reason, found[i].percent);
        }
    }
    if (signs->disturbed > most_disturbed && verdict < DIP_COST_RED) {
        verdict = DIP_COST_RED;
        snprintf(reason, DIP_COST_REASON,
                 "%.0f %% of the times were disturbed by other programs, although they were taken "
                 "twice.",
                 100.0 * signs->disturbed);
    }
    if (!signs->settled && verdict < DIP_COST_AMBER) {
        verdict = DIP_COST_AMBER;
        snprintf(reason, DIP_COST_REASON,
                 "The time of a frame did not become steady within 100 frames before the "
                 "measurement.");
    }
    return verdict;
}

DipCostSigns dip_cost_signs_of(const DipTimesFit *fit, int subjects, const int *same,
                               int same_count) {
    DipCostSigns signs = {.settled = true};
    double disturbed = 0.0, timed = 0.0;
    for (int i = 0; i < same_count; i++) {
        signs.spread = fmax(signs.spread, dip_times_spread(fit, same[i]));
        signs.offset = fmax(signs.offset, fabs(log(dip_times_ratio(fit, same[i]).value)));
    }
    for (int s = 0; s < subjects; s++) {
        const DipAlong along = dip_times_along(fit, s);
        disturbed += along.timed - along.kept;
        timed += along.timed;
    }
    signs.disturbed = disturbed / fmax(timed, 1.0);
    return signs;
}

void dip_cost_judge_machine(DipCostReport *report) {
    DipCostSigns signs =
        dip_cost_signs_of(report->fit, report->row_count, report->same_rows, report->path_count);
    signs.wait = report->machine.wait;
    signs.settled = report->machine.settled;
    report->verdict = dip_cost_verdict_of(&signs, report->verdict_reason);
    // The A/A rows draw what the baseline draws and should take the same time. Their difference, on
    // the whole and from round to round, is the error that the machine adds to every comparison.
    const double of_rounds = signs.spread / sqrt(report->options.rounds);
    report->doubt = report->verdict == DIP_COST_AMBER ? fmax(signs.offset, of_rounds) : 0.0;
}
