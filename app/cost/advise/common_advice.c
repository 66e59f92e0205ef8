// Matching the combinations of several reports, and choosing among them.
#include "app/cost/advise/common_advice.h"

#include "app/report/candidates.h"
#include "app/report/format/formats.h"

#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory");
}

// --- matching ------------------------------------------------------------------------------------

// A combination of one report.
typedef struct Entry {
    DipQuality quality;
    int row;
} Entry;

static int compare_entries(const void *a, const void *b) {
    return memcmp(&((const Entry *)a)->quality, &((const Entry *)b)->quality, sizeof(DipQuality));
}

// Lists the combinations of a report that have times and errors, and those that another row stands
// for. Returns NULL and fills *err when memory runs out. The caller frees the list.
static Entry *list_entries(const DipCostReport *report, int *count, DipError *err) {
    const DipCandidates *all = &report->choice.candidates;
    Entry *entries =
        malloc(((size_t)all->count + (size_t)report->same_count + 1) * sizeof *entries);
    *count = 0;
    for (int i = 0; entries && i < all->count; i++) {
        entries[(*count)++] = (Entry){all->list[i].quality, all->list[i].row};
    }
    for (int i = 0; entries && i < report->same_count; i++) {
        int viewpoints;
        dip_cost_row_sums(report, report->same[i].row, &viewpoints);
        if (viewpoints > 0) {
            entries[(*count)++] = (Entry){report->same[i].quality, report->same[i].row};
        }
    }
    if (!entries) {
        out_of_memory(err);
    }
    return entries;
}

static bool begin_match(DipCostCommon *common, const Entry *entries, int count, DipError *err) {
    const size_t room = (size_t)count + 1;
    free(common->qualities); // The lists of an earlier match go.
    free(common->rows);
    free(common->candidates.list);
    common->qualities = malloc(room * sizeof *common->qualities);
    common->rows = malloc(room * (size_t)common->report_count * sizeof *common->rows);
    common->candidates.list = malloc(room * sizeof *common->candidates.list);
    if (!common->qualities || !common->rows || !common->candidates.list) {
        return out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        common->qualities[i] = entries[i].quality;
        common->rows[i * common->report_count] = entries[i].row;
    }
    common->count = count;
    return true;
}

// Keeps the combinations that this report has, too.
static void keep_matches(DipCostCommon *common, int report, Entry *entries, int count) {
    const int reports = common->report_count;
    int kept = 0;
    qsort(entries, (size_t)count, sizeof *entries, compare_entries);
    for (int i = 0; i < common->count; i++) {
        const Entry wanted = {common->qualities[i], -1};
        const Entry *found =
            bsearch(&wanted, entries, (size_t)count, sizeof *entries, compare_entries);
        if (found) {
            common->qualities[kept] = common->qualities[i];
            memmove(common->rows + kept * reports, common->rows + i * reports,
                    (size_t)report * sizeof *common->rows);
            common->rows[kept++ * reports + report] = found->row;
        }
    }
    common->count = kept;
}

// Checks that a report can be used beside the first one.
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

static bool match_report(DipCostCommon *common, int index, DipError *err) {
    int count;
    Entry *entries = list_entries(&common->reports[index], &count, err);
    bool done = entries != NULL;
    if (done && index == 0) {
        done = begin_match(common, entries, count, err);
    } else if (done) {
        keep_matches(common, index, entries, count);
    }
    free(entries);
    if (done && common->count == 0) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, common->names[index], 0, NULL,
                             "has measured no combination of settings that all reports before it "
                             "have, too");
    }
    return done;
}

// The time that a combination surely keeps within in one report.
static double bound_of(const DipCandidate *candidate) {
    const DipEstimate time = dip_estimate_widen(&candidate->time, candidate->common_error);
    return time.high;
}

// Returns the candidate that stands for a combination: its means of FLIP, and its time in the
// report in which it may take longest.
static DipCandidate join(const DipCostCommon *common, int combination) {
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
    joined.quality = common->qualities[combination];
    joined.loss = loss;
    joined.flip = flip;
    joined.row = combination;
    return joined;
}

bool dip_cost_common_match(DipCostCommon *common, DipError *err) {
    for (int i = 0; i < common->report_count; i++) {
        if (!dip_cost_choose(&common->reports[i], err) || !check_report(common, i, err) ||
            !match_report(common, i, err)) {
            return false;
        }
    }
    common->candidates.count = common->count;
    common->candidates.kind = common->reports[0].options.budget_of;
    for (int c = 0; c < common->count; c++) {
        common->candidates.list[c] = join(common, c);
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
    free(common->qualities);
    free(common->rows);
    free(common->candidates.list);
    *common = (DipCostCommon){0};
}

// --- advice --------------------------------------------------------------------------------------

DipCandidate dip_cost_common_candidate(const DipCostCommon *common, int combination, int report) {
    return dip_candidate_of_row(&common->reports[report],
                                common->rows[combination * common->report_count + report],
                                common->reports[report].options.budget_of);
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
