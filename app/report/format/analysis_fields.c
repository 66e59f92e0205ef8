// Lists the fields of interactions, fits and advice, which are computed from rows, and of what the
// timing tells about the machine.
#include "app/report/format/cost_fields_private.h"

#include "app/measure/stats/estimate.h"
#include "app/report/analysis.h"
#include "app/report/choice.h"

#include <limits.h>

// --- what is computed ----------------------------------------------------------------------------

static const DipField interaction_fields[] = {
    {"a", NULL, NULL, "Key of one setting.", DIP_FACT(NAMED, DipCostInteraction, a),
     .names = dip_cost_setting_keys},
    {"b", NULL, NULL, "Key of the other setting.", DIP_FACT(NAMED, DipCostInteraction, b),
     .names = dip_cost_setting_keys},
    {"combinations", "combinations", "of the others",
     "Number of combinations of the other settings over which the means are taken.",
     DIP_FACT(WHOLE, DipCostInteraction, contexts)},
    {"flip", "FLIP", "difference",
     "FLIP of both settings together, less that of each alone, plus that of neither. Above 0, both "
     "together lower FLIP by less than the sum of what each lowers it.",
     DIP_FACT(NUMBER, DipCostInteraction, flip), .digits = 5, .show = DIP_SHOW_SIGN},
    {"time", "time", "factor",
     "Time of both together times that of neither, divided by the times of each alone. Above 1, "
     "both together cost more than the product of their ratios; 0 without times.",
     DIP_FACT(NUMBER, DipCostInteraction, time), .digits = 3, .show = DIP_SHOW_OF_TIMES},
};
const DipRecord dip_cost_interaction_record =
    DIP_RECORD("interaction", "Two settings at their last steps together, against each alone.",
               interaction_fields, DipCostInteraction, NULL);

DIP_OF_ITEM(int, count_interactions,
            dip_cost_report_of(at)->analysis ? dip_cost_report_of(at)->analysis->interaction_count
                                             : 0)

DIP_GET_ITEM(get_interaction, &dip_cost_report_of(at)->analysis->interactions[index])

const DipFieldList dip_cost_interaction_list = {
    .record = &dip_cost_interaction_record, .count = count_interactions, .item = get_interaction};

// Each price belongs to a term of the fit, which is a kind of work in a stage.
DIP_DERIVE(derive_stage, ((const DipCostFit *)at->item)->stages[at->index])
DIP_DERIVE(derive_work, ((const DipCostFit *)at->item)->names[at->index])
static const DipField price_fields[] = {
    {"stage", "stage", NULL, "Name of the stage of the pipeline that does the work.",
     DIP_DERIVED(TEXT, derive_stage)},
    {"work", "unit of work", NULL, "The kind of work; \"frame\" is what every frame takes.",
     DIP_DERIVED(TEXT, derive_work)},
    {"ns", "time", "ns", "Time that one unit of this work takes in its stage.",
     DIP_FACT(NUMBER, DipCostFit, ns[0]), .stride = sizeof(double), .digits = 3,
     .show = DIP_SHOW_FIGURES},
};
const DipRecord dip_cost_price_record = DIP_RECORD_OF_ARRAYS(
    "price of work", "The time that one unit of a kind of work takes.", price_fields, NULL);

static const DipField fit_fields[] = {
    {"prices", NULL, NULL, "The price of each kind of work.",
     DIP_LIST(.record = &dip_cost_price_record, .counted = offsetof(DipCostFit, count))},
    {"r2", NULL, NULL, "Share of the relative variance of the times that the fit explains.",
     DIP_FACT(NUMBER, DipCostFit, r2), .digits = 3},
    {"median_miss", NULL, NULL, "Median of |fitted / measured - 1| over the rows.",
     DIP_FACT(NUMBER, DipCostFit, median_miss), .digits = 3},
    {"median_miss_of_others", NULL, NULL,
     "Median of |predicted / measured - 1| if each row is predicted from all others.",
     DIP_FACT(NUMBER, DipCostFit, others.median), .digits = 3},
    {"within_10_percent_of_others", NULL, NULL,
     "Share of the rows that are predicted from all others within 10 %.",
     DIP_FACT(NUMBER, DipCostFit, others.within_10), .digits = 3},
};
const DipRecord dip_cost_fit_record = DIP_RECORD(
    "fit", "A linear fit of the times of the stages to their work.", fit_fields, DipCostFit, NULL);

const void *dip_cost_derive_fit(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCostAnalysis *analysis = dip_cost_report_of(at)->analysis;
    (void)scratch;
    return analysis && analysis->fit.rows > 0 ? &analysis->fit : NULL;
}

// --- advice --------------------------------------------------------------------------------------

// Only the budgets are facts: advice is computed again from times and errors.
static const DipAdvice *advice_of(const DipFieldAt *at) {
    return &dip_cost_report_of(at)->choice.advice[at->index];
}

static const DipCandidate *candidate_of(const DipFieldAt *at, int index) {
    return &dip_cost_report_of(at)->choice.candidates.list[index];
}

DIP_OF_ITEM(bool, has_next, advice_of(at)->next >= 0)

DIP_DERIVE(derive_chosen,
           DIP_MADE(int,
                    advice_of(at)->chosen >= 0 ? candidate_of(at, advice_of(at)->chosen)->row : -1))
DIP_DERIVE(derive_next,
           DIP_MADE(int, has_next(at) ? candidate_of(at, advice_of(at)->next)->row : -1))

// Derives the time of the chosen candidate. Its interval includes the error that all candidates
// share.
static const void *derive_chosen_ms(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipCandidate *chosen = dip_cost_chosen(dip_cost_report_of(at), at->index);
    return chosen ? DIP_MADE(DipEstimate, dip_estimate_widen(&chosen->time, chosen->common_error))
                  : NULL;
}

static int count_ties(const DipFieldAt *at) {
    const int count = advice_of(at)->tie_count;
    return count < DIP_ADVICE_TIES ? count : DIP_ADVICE_TIES;
}

DIP_GET_ITEM(get_tie, &candidate_of(at, advice_of(at)->ties[index])->row)
static const DipField tie_element = {.kind = DIP_FIELD_WHOLE};

#define OF_ADVICE(KIND, member)                                                                    \
    DIP_COMPUTED(KIND, DipCostReport, choice.advice[0].member), .stride = sizeof(DipAdvice)
static const DipField advice_fields[] = {
    {"budget_ms", "budget", "ms", "The time that a frame may take.",
     DIP_FACT(NUMBER, DipCostReport, options.budgets_ms[0]), .stride = sizeof(double),
     .least = DIP_COST_LEAST_MS, .most = DIP_COST_MOST_MS},
    {"row", NULL, NULL, "Index of the chosen row, or -1 if none is surely within the budget.",
     DIP_DERIVED(WHOLE, derive_chosen)},
    {"ms", NULL, "ms", "The row's time, of the kind that the budget is meant for (`budget_of`).",
     DIP_DERIVED(ESTIMATE, derive_chosen_ms), .digits = 2},
    {"fits", "fits", NULL, "Probability that the time of the chosen row is within the budget.",
     OF_ADVICE(NUMBER, fits)},
    {"ties", NULL, NULL,
     "Up to eight other rows that are as good: they surely fit, too, and their FLIP is within 1 % "
     "of the least. The fastest comes first.",
     DIP_DERIVED_LIST(.element = &tie_element, .count = count_ties, .item = get_tie)},
    {"tie_count", NULL, NULL, "Number of all rows that are as good as the chosen one.",
     OF_ADVICE(WHOLE, tie_count)},
    {"next", NULL, NULL,
     "Index of the next better row, or of the fastest row if none is chosen; -1 if there is none.",
     DIP_DERIVED(WHOLE, derive_next)},
    {"next_ms", NULL, "ms",
     "How much longer the row `next` takes than the chosen one, or than the budget if none is "
     "chosen.",
     OF_ADVICE(NUMBER, next_ms), .known = has_next, .digits = 2},
    {"next_fits", NULL, NULL, "Probability that the time of the row `next` is within the budget.",
     OF_ADVICE(NUMBER, next_fits), .known = has_next},
};
static const DipRecord advice_record =
    DIP_RECORD_OF_ARRAYS("advice", "The row to choose for one time budget.", advice_fields, NULL);

DIP_OF_ITEM(int, count_advice, dip_cost_report_of(at)->choice.advice_count)

const DipFieldList dip_cost_advice_list = {.record = &advice_record,
                                           .count = count_advice,
                                           .counted = offsetof(DipCostReport, options.budget_count),
                                           .most = DIP_COST_MAX_BUDGETS};

// --- the machine ---------------------------------------------------------------------------------

DIP_DERIVE(derive_reason, dip_cost_report_of(at)->verdict_reason)
static const DipField machine_fields[] = {
    {"verdict", "machine", NULL, "How quiet the machine was: green, amber or red.",
     DIP_COMPUTED(NAMED, DipCostReport, verdict), .names = dip_cost_verdict_names},
    {"reason", NULL, NULL, "The measured figures from which the verdict comes.",
     DIP_DERIVED(TEXT, derive_reason)},
    {"wait", NULL, NULL, "Waiting time of all timed frames divided by (their time x threads).",
     DIP_FACT(NUMBER, DipCostReport, machine.wait), .most = DIP_COST_MOST_MEAN},
    {"repeated", NULL, NULL, "Number of frames that were timed again.",
     DIP_FACT(WHOLE, DipCostReport, machine.repeated), .most = INT_MAX},
    {"has_wait", NULL, NULL, "Whether the machine tells how long threads wait.",
     DIP_FACT(FLAG, DipCostReport, machine.has_wait)},
    {"settled", NULL, NULL, "Whether the times of frames were steady before the first round began.",
     DIP_FACT(FLAG, DipCostReport, machine.settled)},
    {"doubt", NULL, NULL,
     "Standard error of the logarithm of a time by which an amber verdict widens the intervals "
     "of all times.",
     DIP_COMPUTED(NUMBER, DipCostReport, doubt), .digits = 3},
    {"starts", NULL, NULL,
     "Number of starts of the program, each with rounds / starts rounds; 0 without times.",
     DIP_FACT(WHOLE, DipCostReport, starts), .most = DIP_TIMED_MOST_STARTS},
};
const DipRecord dip_cost_machine_record = DIP_RECORD(
    "machine", "What the timing tells about the machine.", machine_fields, DipCostReport, NULL);
