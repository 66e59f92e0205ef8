// Finds the combinations that several reports have in common, and chooses among them.
#include "app/cost/advise/common_advice.h"

#include "app/report/report.h"
#include "app/report/format/formats.h"

#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory");
}

// --- matching ------------------------------------------------------------------------------------

// Returns the row of a combination in a report, or the row of a combination that draws the same
// pictures. Returns -1 if there is no such row, or if the row's errors are not known.
static int find_row(const DipCostReport *report, const DipQuality *quality) {
    const int row = dip_report_find_same(report, quality, report->combined_first);
    return row >= 0 && dip_cost_is_judged(report, row) ? row : -1;
}

// Lists the combinations of the first report. The list includes combinations that have no row
// because another row draws the same pictures (report->same).
static bool begin_match(DipCostCommon *common, DipError *err) {
    const DipCostReport *report = &common->reports[0];
    const DipCandidates *own = &report->choice.candidates;
    DipCandidates *all = &common->candidates;
    dip_candidates_free(all); // Frees the list of an earlier match.
    all->list = malloc(((size_t)own->count + (size_t)report->same_count) * sizeof *all->list);
    if (!all->list) {
        return out_of_memory(err);
    }
    memcpy(all->list, own->list, (size_t)own->count * sizeof *all->list);
    all->count = own->count;
    all->kind = report->options.budget_of;
    for (int i = 0; i < report->same_count; i++) {
        if (find_row(report, &report->same[i].quality) >= 0) {
            all->list[all->count++] = (DipCandidate){.quality = report->same[i].quality};
        }
    }
    return true;
}

// Removes the combinations that the report `index` does not have.
static bool keep_matches(DipCostCommon *common, int index, DipError *err) {
    DipCandidates *all = &common->candidates;
    int kept = 0;
    for (int i = 0; i < all->count; i++) {
        if (find_row(&common->reports[index], &all->list[i].quality) >= 0) {
            all->list[kept++] = all->list[i];
        }
    }
    all->count = kept;
    return kept > 0 ||
           dip_error_set(err, DIP_ERROR_CONFLICT, common->names[index], 0, NULL,
                         "has measured no combination of settings that all reports before it "
                         "have, too");
}

// Checks that a report has times and combinations, that its machine was quiet enough and that it
// comes from the same build as the first report.
static bool check_report(const DipCostCommon *common, int index, DipError *err) {
    const DipCostReport *report = &common->reports[index];
    const char *const name = common->names[index];
    if (report->rounds == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, name, 0, NULL,
                             "has no times; measure the report without --errors-only");
    }
    if (report->verdict == DIP_COST_RED) {
        return dip_error_set_runtime(err, DIP_ERROR_BUSY, name, 0, NULL,
                                     "has wrong times: the machine was too busy. %.200s",
                                     report->verdict_reason);
    }
    if (report->choice.candidates.count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, name, 0, NULL,
                             "has no combinations of settings with times and errors; measure the "
                             "report with --combine or --predict");
    }
    if (strcmp(report->build, common->reports[0].build) != 0) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, name, 0, NULL,
                             "comes from another build of diptych (%.12s) than %.100s (%.12s)",
                             report->build, common->names[0], common->reports[0].build);
    }
    return true;
}

// Returns the upper end of the interval of a combination's time in one report.
static double bound_of(const DipCandidate *candidate) {
    const DipEstimate time = dip_estimate_widen(&candidate->time, candidate->common_error);
    return time.high;
}

// Fills in the candidate that stands for a combination in all reports. Its FLIP is the mean over
// the reports. Its time is the combination's time in the report in which it may take longest.
static void join(DipCostCommon *common, int combination) {
    DipCandidate *to = &common->candidates.list[combination];
    DipCandidate joined = {.time = dip_estimate_unknown(0.0)};
    double loss = 0.0, flip = 0.0;
    for (int i = 0; i < common->report_count; i++) {
        const DipCandidate one = dip_cost_common_candidate(common, combination, i);
        loss += one.loss / common->report_count;
        flip += one.flip / common->report_count;
        if (i == 0 || bound_of(&one) > bound_of(&joined)) {
            joined = one;
            joined.report = i;
        }
    }
    joined.quality = to->quality;
    joined.loss = loss;
    joined.flip = flip;
    joined.row = combination;
    *to = joined;
}

bool dip_cost_common_match(DipCostCommon *common, DipError *err) {
    for (int i = 0; i < common->report_count; i++) {
        if (!dip_cost_choose(&common->reports[i], err) || !check_report(common, i, err) ||
            (i == 0 && !begin_match(common, err)) || !keep_matches(common, i, err)) {
            return false;
        }
    }
    for (int c = 0; c < common->candidates.count; c++) {
        join(common, c);
    }
    return true;
}

// --- reading -------------------------------------------------------------------------------------

bool dip_cost_common_read(DipCostCommon *common, const char *const *files, int count,
                          DipTimeKind budget_of, DipError *err) {
    *common = (DipCostCommon){.reports = calloc((size_t)count, sizeof *common->reports)};
    if (!common->reports) {
        return out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        DipCostReport *report = &common->reports[i];
        if (!dip_cost_read_report(files[i], report, err)) {
            return false;
        }
        common->names[common->report_count++] = files[i];
        report->options.budget_of = budget_of;
    }
    return dip_cost_common_match(common, err);
}

void dip_cost_common_free(DipCostCommon *common) {
    for (int i = 0; i < common->report_count; i++) {
        dip_cost_report_free(&common->reports[i]);
    }
    free(common->reports);
    dip_candidates_free(&common->candidates);
    *common = (DipCostCommon){0};
}

// --- advice --------------------------------------------------------------------------------------

int dip_cost_common_row(const DipCostCommon *common, int combination, int report) {
    return find_row(&common->reports[report], &common->candidates.list[combination].quality);
}

DipCandidate dip_cost_common_candidate(const DipCostCommon *common, int combination, int report) {
    const DipCostReport *of = &common->reports[report];
    return dip_candidate_of_row(of, dip_cost_common_row(common, combination, report),
                                of->options.budget_of);
}

void dip_cost_common_advise(const DipCostCommon *common, double budget_ms,
                            DipCostCommonAdvice *advice) {
    advice->all = dip_advise(&common->candidates, budget_ms);
    for (int i = 0; i < common->report_count; i++) {
        const DipCandidates *candidates = &common->reports[i].choice.candidates;
        const int chosen = dip_advise(candidates, budget_ms).chosen;
        advice->alone[i] = chosen >= 0 ? candidates->list[chosen].row : -1;
    }
}
