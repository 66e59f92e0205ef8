// Prints common advice (common_advice.h) for a terminal, and writes it as JSON.
#include "app/cost/advise/common_advice.h"

#include "app/report/report.h"
#include "app/report/format/sections.h"
#include "app/report/words.h"

#include <math.h>

// The advice for all budgets. It is the context of all fields (DipFieldAt).
typedef struct Advised {
    const DipCostCommon *common;
    const DipCostCommonAdvice *list; // [budget]: what to choose for it.
    int count;
} Advised;

static const Advised *advised_of(const DipFieldAt *at) {
    return at->context;
}

// --- reports -------------------------------------------------------------------------------------

DIP_DERIVE(derive_number, DIP_MADE(int, (at->index + 1)))
DIP_DERIVE(derive_name, advised_of(at)->common->names[at->index])
#define SHOWN(KIND, MEMBER) DIP_FACT(KIND, DipCostReport, MEMBER)
static const DipField report_fields[] = {
    {"number", "report", NULL, "Number of the report, in the order of the command line, from 1 on.",
     .kind = DIP_FIELD_WHOLE, .derive = derive_number},
    {"name", NULL, NULL, "File or folder of the report, as the command line names it.",
     DIP_DERIVED(TEXT, derive_name)},
    {"scene", NULL, NULL, "Name of the scene that the report measured.", SHOWN(TEXT, scene)},
    {"path", NULL, NULL, "First camera path of the report, on which its combinations are timed.",
     SHOWN(TEXT, paths[0])},
    {"width", NULL, "px", "Width of the report's pictures.", SHOWN(WHOLE, width)},
    {"height", NULL, "px", "Height of the report's pictures.", SHOWN(WHOLE, height)},
    {"processor", NULL, NULL, "Name of the processor on which the report was measured.",
     SHOWN(TEXT, processor)},
    {"threads", NULL, NULL, "Number of threads that drew the report's frames.",
     SHOWN(WHOLE, threads)},
    {"verdict", "machine", NULL, "How quiet the report's machine was: green, amber or red.",
     SHOWN(NAMED, verdict), .names = dip_cost_verdict_names},
    {"combinations", NULL, NULL,
     "Number of the report's combinations that have a time and an error.",
     SHOWN(WHOLE, choice.candidates.count)},
};
static const DipRecord report_record = DIP_RECORD(
    "advised report", "A report that the command line names.", report_fields, DipCostReport, NULL);

DIP_GET_ITEM(get_report, &advised_of(at)->common->reports[index])
static int count_reports(const DipFieldAt *at) {
    return advised_of(at)->common->report_count;
}

// --- what a report says about a choice -----------------------------------------------------------

// The line of a report in the table of one budget. Values that are not known are NAN, except that
// `alone` is not set if has_alone is false. The intervals of the times include the error that all
// times of the report share.
typedef struct Line {
    DipCandidate chosen; // The common choice, with its time and error in this report.
    DipCandidate alone;  // The settings that would be chosen from this report alone.
    bool has_alone;
    bool same;   // True if `alone` and `chosen` are the same row of the report.
    double loss; // See dip_cost_common_share_lost.
} Line;

double dip_cost_common_share_lost(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                  int report) {
    const DipCostReport *r = &common->reports[report];
    const int alone = advice->alone[report];
    if (advice->all.chosen < 0 || alone < 0) {
        return NAN;
    }
    const int row = dip_cost_common_row(common, advice->all.chosen, report);
    return dip_cost_ranking_flip(r, row) / dip_cost_ranking_flip(r, alone) - 1.0;
}

static DipCandidate candidate_of(const DipCostCommon *common, int report, int row) {
    DipCandidate c = dip_candidate_of_row(&common->reports[report], row, common->candidates.kind);
    c.time = dip_estimate_widen(&c.time, c.common_error);
    return c;
}

static Line line_of(const DipCostCommon *common, const DipCostCommonAdvice *advice, int report) {
    const int alone = advice->alone[report];
    Line line = {.chosen = {.time = dip_estimate_unknown(NAN), .flip = NAN},
                 .has_alone = alone >= 0,
                 .loss = dip_cost_common_share_lost(common, advice, report)};
    if (advice->all.chosen >= 0) {
        const int row = dip_cost_common_row(common, advice->all.chosen, report);
        line.chosen = candidate_of(common, report, row);
        line.same = row == alone;
    }
    if (line.has_alone) {
        line.alone = candidate_of(common, report, alone);
    }
    return line;
}

static bool has_alone(const DipFieldAt *at) {
    return ((const Line *)at->item)->has_alone;
}

static const void *derive_alone(const DipFieldAt *at, DipFieldScratch *scratch) {
    const Line *line = at->item;
    dip_cost_settings_text(&line->alone.quality, scratch->text);
    return line->same ? "the same" : line->has_alone ? scratch->text : NULL;
}

static const DipField alone_fields[] = {
    {"settings", NULL, NULL, "All quality settings.", DIP_FACT(SETTINGS, DipCandidate, quality)},
    {"ms", NULL, "ms",
     "Time of these settings in this report, of the kind that the budget is meant for.",
     DIP_FACT(ESTIMATE, DipCandidate, time)},
    {"flip", NULL, NULL, "Mean FLIP of these settings in this report.",
     DIP_FACT(NUMBER, DipCandidate, flip)},
};
static const DipRecord alone_record =
    DIP_RECORD("choice alone", "The settings that would be chosen from one report alone.",
               alone_fields, DipCandidate, NULL);

static const DipField line_fields[] = {
    {"number", "report", NULL, "Number of the report, in the order of the command line, from 1 on.",
     .kind = DIP_FIELD_WHOLE, .derive = derive_number},
    {"ms", "time", "ms",
     "Time of the chosen settings in this report, of the kind that the budget is meant for.",
     DIP_FACT(ESTIMATE, Line, chosen.time), .digits = 2},
    {"flip", "FLIP", NULL, "Mean FLIP of the chosen settings in this report.",
     DIP_FACT(NUMBER, Line, chosen.flip), .digits = 4},
    {"alone", NULL, NULL,
     "The settings that would be chosen from this report alone; null if none is within the budget.",
     DIP_FACT(RECORD, Line, alone), .record = &alone_record, .known = has_alone},
    {"loss", NULL, "%",
     "Share by which the chosen settings have more FLIP than those chosen from this report alone.",
     DIP_FACT(NUMBER, Line, loss), .digits = 1, .scale = 100.0},
    {"other", "this report alone would choose", NULL,
     "The settings that would be chosen from this report alone, as one text.",
     .kind = DIP_FIELD_TEXT, .derive = derive_alone},
};
static const DipRecord line_record = DIP_RECORD(
    "choice in a report", "What one report says about the settings that are chosen for a budget.",
    line_fields, Line, NULL);

DIP_GET_ITEM(get_line, DIP_MADE(Line, (line_of(advised_of(at)->common, at->item, index))))

// --- budgets -------------------------------------------------------------------------------------

// Returns the choice from all reports together, for the budget whose advice is at->item.
static const DipAdvice *all_of(const DipFieldAt *at) {
    return &((const DipCostCommonAdvice *)at->item)->all;
}

// Returns the candidate with this index, or NULL if the index is -1.
static const DipCandidate *candidate_at(const DipFieldAt *at, int index) {
    return index >= 0 ? &advised_of(at)->common->candidates.list[index] : NULL;
}

DIP_DERIVE(derive_fits,
           DIP_MADE(double, dip_candidate_fits(at->item, all_of(at->owner)->budget_ms)))
static const DipField choice_fields[] = {
    {"settings", NULL, NULL, "All quality settings.", DIP_FACT(SETTINGS, DipCandidate, quality)},
    {"mean_flip", NULL, NULL, "Mean FLIP of these settings, as a mean over the reports.",
     DIP_FACT(NUMBER, DipCandidate, flip)},
    {"fits", NULL, NULL, "Probability that these settings are within the budget in every report.",
     DIP_DERIVED(NUMBER, derive_fits)},
    {"limited_by_report", NULL, NULL,
     "Index of the report in which these settings may take longest, from 0 on.",
     DIP_FACT(WHOLE, DipCandidate, report)},
};
static const DipRecord choice_record =
    DIP_RECORD("common choice", "Settings that are chosen from all reports together.",
               choice_fields, DipCandidate, NULL);

DIP_DERIVE(derive_chosen, candidate_at(at, all_of(at)->chosen))
DIP_DERIVE(derive_next, candidate_at(at, all_of(at)->next))
DIP_GET_ITEM(get_tie, &candidate_at(at, all_of(at)->ties[index])->quality)

static bool has_next(const DipFieldAt *at) {
    return all_of(at)->next >= 0;
}

static int count_ties(const DipFieldAt *at) {
    const int count = all_of(at)->tie_count;
    return count < DIP_ADVICE_TIES ? count : DIP_ADVICE_TIES;
}

static const DipField tie_element = {.kind = DIP_FIELD_SETTINGS};
static const DipField budget_fields[] = {
    {"budget_ms", NULL, "ms", "The time that a frame may take.",
     DIP_FACT(NUMBER, DipCostCommonAdvice, all.budget_ms)},
    {"chosen", NULL, NULL,
     "The settings to choose; null if none are surely within the budget in every report.",
     DIP_DERIVED(RECORD, derive_chosen), .record = &choice_record},
    {"ties", NULL, NULL,
     "Up to eight other combinations of settings that are as good as the chosen one.",
     DIP_LIST(.element = &tie_element, .count = count_ties, .item = get_tie)},
    {"tie_count", NULL, NULL, "Number of all combinations that are as good as the chosen one.",
     DIP_FACT(WHOLE, DipCostCommonAdvice, all.tie_count)},
    {"next_better", NULL, NULL,
     "The next clearly better combination, or the fastest one if none is chosen; null if there is "
     "none.",
     DIP_DERIVED(RECORD, derive_next), .record = &choice_record},
    {"next_ms", NULL, "ms",
     "How much longer the next better combination takes than the chosen one, or than the budget if "
     "none is chosen.",
     DIP_FACT(NUMBER, DipCostCommonAdvice, all.next_ms), .known = has_next},
    {"reports", NULL, NULL,
     "What each report says about the chosen settings, in the order of the command line.",
     DIP_LIST(.record = &line_record, .count = count_reports, .item = get_line)},
};
static const DipRecord budget_record =
    DIP_RECORD("budget", "The settings to choose for one time budget.", budget_fields,
               DipCostCommonAdvice, NULL);

DIP_DERIVE(derive_budget_of, dip_time_kind_names[advised_of(at)->common->candidates.kind])
DIP_DERIVE(derive_combinations, &advised_of(at)->common->candidates.count)
static int count_budgets(const DipFieldAt *at) {
    return advised_of(at)->count;
}

DIP_GET_ITEM(get_budget, &advised_of(at)->list[index])
static const DipField advised_fields[] = {
    {"format", NULL, NULL, "Number of the file's format.",
     DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    {"budget_of", NULL, NULL, "The time that budgets are meant for: p95, mean or worst.",
     DIP_DERIVED(TEXT, derive_budget_of)},
    {"combinations", NULL, NULL,
     "Number of combinations that every report holds with a time and an error.",
     DIP_DERIVED(WHOLE, derive_combinations)},
    {"reports", NULL, NULL, "The reports, in the order of the command line.",
     DIP_LIST(.record = &report_record, .count = count_reports, .item = get_report)},
    {"advice", NULL, NULL, "What to choose for each time budget.",
     DIP_LIST(.record = &budget_record, .count = count_budgets, .item = get_budget)},
};
const DipRecord dip_cost_common_record = DIP_RECORD(
    "common advice", "What `diptych cost advise --json` writes.", advised_fields, Advised, NULL);

bool dip_cost_common_write_json(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                int count, const char *file, DipError *err) {
    return dip_fields_write_json(&dip_cost_common_record, &(Advised){common, advice, count}, file,
                                 err);
}

// --- the terminal --------------------------------------------------------------------------------

static void print_reports(DipForm *form, const Advised *advised) {
    const DipCostCommon *common = advised->common;
    dip_form_table(
        form,
        &(DipTable){.caption = "The reports.",
                    .record = &report_record,
                    .context = (void *)advised,
                    .columns =
                        "number; name; scene; path; width; height; threads; verdict; combinations",
                    .items = common->reports,
                    .count = common->report_count});
    dip_form_paragraph(
        form, NULL,
        "%d combination%s of settings %s in every report. Times are %s times with their intervals "
        "of 95 %%. Mean FLIP is the mean over the reports. Loss is how much more FLIP the common "
        "choice has than the settings that the report alone would choose.",
        common->candidates.count, dip_cost_plural(common->candidates.count),
        common->candidates.count == 1 ? "is" : "are", dip_time_kind_names[common->candidates.kind]);
}

// Prints the next better combination, what it costs, and the probability that it fits the budget.
static void print_next(DipForm *form, const DipCostCommon *common, const DipAdvice *advice) {
    char settings[DIP_COST_TEXT], ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES];
    char fits[DIP_NUMBER_BYTES];
    if (advice->next < 0) {
        dip_form_fact(form, "Next better", "nothing that was measured");
        return;
    }
    const DipCandidate *next = &common->candidates.list[advice->next];
    dip_cost_settings_text(&next->quality, settings);
    dip_number_text(advice->next_ms, 2, true, "-", ms);
    dip_number_text(100.0 * (next->flip / common->candidates.list[advice->chosen].flip - 1.0), 1,
                    true, "-", flip);
    dip_fits_text(advice->next_fits, fits);
    dip_form_fact(form, "Next better",
                  "%s (mean FLIP %s %%), for %s ms in report %d, where it takes longest; fits with "
                  "%s",
                  settings, flip, ms, next->report + 1, fits);
}

static void print_chosen(DipForm *form, const Advised *advised, const DipCostCommonAdvice *advice) {
    const DipCostCommon *common = advised->common;
    const DipCandidate *chosen = &common->candidates.list[advice->all.chosen];
    Line lines[DIP_COST_MAX_COMMON_REPORTS];
    char settings[DIP_COST_TEXT], fits[DIP_NUMBER_BYTES];
    for (int i = 0; i < common->report_count; i++) {
        lines[i] = line_of(common, advice, i);
    }
    dip_cost_settings_text(&chosen->quality, settings);
    dip_fits_text(advice->all.fits, fits);
    dip_form_paragraph(form, NULL, "%s", settings);
    dip_form_fact(form, "Fits", "with %s", fits);
    dip_form_fact(form, "Error", "mean FLIP %.4f", chosen->flip);
    dip_section_ties(form, &common->candidates, &advice->all);
    print_next(form, common, &advice->all);
    dip_section_ini(form, &chosen->quality);
    dip_form_table(form, &(DipTable){.record = &line_record,
                                     .context = (void *)advised,
                                     .columns = "number; ms; flip; loss; other",
                                     .limits = {&advice->all.budget_ms, 1, false},
                                     .items = lines,
                                     .count = common->report_count});
}

static void print_nothing(DipForm *form, const DipCostCommon *common, const DipAdvice *advice) {
    char settings[DIP_COST_TEXT], fits[DIP_NUMBER_BYTES], ms[DIP_NUMBER_BYTES];
    const DipCandidate *fastest = &common->candidates.list[advice->next];
    dip_cost_settings_text(&fastest->quality, settings);
    dip_fits_text(advice->next_fits, fits);
    dip_limited_number(fastest->time.value, 2, false, (DipLimits){&advice->budget_ms, 1, false},
                       "-", ms);
    dip_form_paragraph(form, NULL,
                       "No common combination surely fits. The fastest, %s, takes %s ms in report "
                       "%d and fits with %s.",
                       settings, ms, fastest->report + 1, fits);
}

void dip_cost_common_print(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                           int count, FILE *out) {
    const Advised advised = {common, advice, count};
    DipForm form = {.out = out};
    DipCostTier tiers[DIP_COST_MAX_BUDGETS];
    for (int i = 0; i < count; i++) {
        const int chosen = advice[i].all.chosen;
        char budget[DIP_BUDGET_BYTES];
        dip_budget_text(advice[i].all.budget_ms, budget);
        dip_form_heading(&form, NULL, "%s in every report", budget);
        if (chosen >= 0) {
            print_chosen(&form, &advised, &advice[i]);
        } else {
            print_nothing(&form, common, &advice[i].all);
        }
        tiers[i] = (DipCostTier){advice[i].all.budget_ms,
                                 chosen >= 0 ? &common->candidates.list[chosen].quality : NULL, -1};
    }
    dip_section_tiers(&form, tiers, count);
    print_reports(&form, &advised);
}
