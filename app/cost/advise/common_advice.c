// Matching the combinations of several reports, and choosing among them.
#include "app/cost/advise/common_advice.h"

#include "app/report/format/formats.h"
#include "app/report/front.h"

#include <math.h>
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
    int rows[DIP_COST_MAX_ROWS];
    const int plotted = dip_cost_list_plotted(report, rows);
    Entry *entries = malloc(((size_t)plotted + (size_t)report->same_count + 1) * sizeof *entries);
    *count = 0;
    for (int i = 0; entries && i < plotted; i++) {
        entries[(*count)++] = (Entry){report->rows[rows[i]].quality, rows[i]};
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
    common->qualities = malloc(room * sizeof *common->qualities);
    common->rows = malloc(room * (size_t)common->report_count * sizeof *common->rows);
    common->losses = malloc(room * sizeof *common->losses);
    if (!common->qualities || !common->rows || !common->losses) {
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
    int rows[DIP_COST_MAX_ROWS];
    if (report->rounds == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, name, 0, NULL,
                             "has no times; measure the report without --errors-only");
    }
    if (report->verdict == DIP_COST_RED) {
        return dip_error_set_runtime(err, DIP_ERROR_BUSY, name, 0, NULL,
                                     "has wrong times: the machine was too busy. %.200s",
                                     report->verdict_reason);
    }
    if (dip_cost_list_plotted(report, rows) == 0) {
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

bool dip_cost_common_match(DipCostCommon *common, DipError *err) {
    for (int i = 0; i < common->report_count; i++) {
        if (!check_report(common, i, err) || !match_report(common, i, err)) {
            return false;
        }
    }
    for (int c = 0; c < common->count; c++) {
        double sum = 0.0;
        for (int i = 0; i < common->report_count; i++) {
            sum += dip_cost_ranking_flip(&common->reports[i],
                                         common->rows[c * common->report_count + i]);
        }
        common->losses[c] = sum / common->report_count;
    }
    return true;
}

// --- reading -------------------------------------------------------------------------------------

bool dip_cost_common_read(DipCostCommon *common, const char *const *files, int count,
                          DipCostBudgetOf budget_of, DipError *err) {
    *common = (DipCostCommon){.reports = calloc((size_t)count, sizeof *common->reports)};
    if (!common->reports) {
        return out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        DipCostReport *report = &common->reports[i];
        if (!dip_cost_read_report(files[i], report, err)) {
            return false;
        }
        report->options.budget_of = budget_of;
        common->names[common->report_count++] = files[i];
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
    free(common->losses);
    *common = (DipCostCommon){0};
}

// --- times and errors ----------------------------------------------------------------------------

static int row_of(const DipCostCommon *common, int combination, int report) {
    return common->rows[combination * common->report_count + report];
}

DipStatsEstimate dip_cost_common_time(const DipCostCommon *common, int combination, int report) {
    return dip_cost_budget_time(&common->reports[report], row_of(common, combination, report));
}

double dip_cost_common_flip(const DipCostCommon *common, int combination, int report) {
    return dip_cost_row_metrics(&common->reports[report], row_of(common, combination, report), 0)
        .flip;
}

double dip_cost_common_mean_flip(const DipCostCommon *common, int combination) {
    double sum = 0.0;
    for (int i = 0; i < common->report_count; i++) {
        sum += dip_cost_common_flip(common, combination, i);
    }
    return sum / common->report_count;
}

// The greatest upper bound over all reports. *report is the report that has it.
static double greatest_bound(const DipCostCommon *common, int combination, int *report) {
    double greatest = 0.0;
    *report = 0;
    for (int i = 0; i < common->report_count; i++) {
        const double high = dip_cost_common_time(common, combination, i).high;
        *report = high > greatest ? i : *report;
        greatest = fmax(greatest, high);
    }
    return greatest;
}

static double greatest_low(const DipCostCommon *common, int combination) {
    double greatest = 0.0;
    for (int i = 0; i < common->report_count; i++) {
        greatest = fmax(greatest, dip_cost_common_time(common, combination, i).low);
    }
    return greatest;
}

// The geometric means of the value and of both bounds over the reports.
static DipStatsEstimate mean_time(const DipCostCommon *common, int combination) {
    DipStatsEstimate logs = {0};
    for (int i = 0; i < common->report_count; i++) {
        const DipStatsEstimate time = dip_cost_common_time(common, combination, i);
        logs.value += log(time.value) / common->report_count;
        logs.low += log(time.low) / common->report_count;
        logs.high += log(time.high) / common->report_count;
    }
    return (DipStatsEstimate){exp(logs.value), exp(logs.low), exp(logs.high)};
}

// --- choosing ------------------------------------------------------------------------------------

// True if combination a is to be preferred to combination b, whose errors are alike.
static bool is_preferred(const DipCostCommon *common, int a, int b) {
    const DipStatsEstimate x = mean_time(common, a);
    const DipStatsEstimate y = mean_time(common, b);
    const bool apart = x.high < y.low || y.high < x.low;
    const int changes = dip_quality_count_changes(&common->qualities[a]) -
                        dip_quality_count_changes(&common->qualities[b]);
    return !apart && changes != 0 ? changes < 0 : x.value < y.value;
}

static int choose(const DipCostCommon *common, double budget_ms) {
    double least = INFINITY;
    int report;
    for (int c = 0; c < common->count; c++) {
        if (greatest_bound(common, c, &report) <= budget_ms) {
            least = fmin(least, common->losses[c]);
        }
    }
    int best = -1;
    for (int c = 0; c < common->count; c++) {
        if (greatest_bound(common, c, &report) <= budget_ms && common->losses[c] <= 1.01 * least &&
            (best < 0 || is_preferred(common, c, best))) {
            best = c;
        }
    }
    return best;
}

// Finds the fastest combination whose mean FLIP is at most `enough`.
static void find_next(const DipCostCommon *common, double enough, DipCostCommonAdvice *advice) {
    double least = INFINITY;
    for (int c = 0; c < common->count; c++) {
        int report;
        const double bound = greatest_bound(common, c, &report);
        if (common->losses[c] <= enough && bound < least) {
            least = bound;
            advice->next = c;
            advice->limit = report;
        }
    }
}

void dip_cost_common_advise(const DipCostCommon *common, double budget_ms,
                            DipCostCommonAdvice *advice) {
    *advice = (DipCostCommonAdvice){.budget_ms = budget_ms, .next = -1, .limit = -1};
    advice->chosen = choose(common, budget_ms);
    const double enough = advice->chosen >= 0 ? 0.99 * common->losses[advice->chosen] : INFINITY;
    find_next(common, enough, advice);
    advice->undecided = -1;
    for (int c = 0; c < common->count; c++) {
        if (common->losses[c] <= enough && greatest_low(common, c) <= budget_ms &&
            (advice->undecided < 0 || common->losses[c] < common->losses[advice->undecided])) {
            advice->undecided = c;
        }
    }
    for (int i = 0; i < common->report_count; i++) {
        advice->alone[i] = dip_cost_choose(&common->reports[i], budget_ms);
    }
}
