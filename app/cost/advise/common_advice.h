// Common advice: one choice of settings for several reports. Each report may have another scene,
// camera path, size or machine. Only combinations of settings that every report has measured can be
// chosen.
#ifndef DIP_APP_COST_ADVISE_COMMON_ADVICE_H
#define DIP_APP_COST_ADVISE_COMMON_ADVICE_H

#include "app/report/report.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_COST_MAX_COMMON_REPORTS = 64 };

// The reports, and the combinations that every report has measured. In a report, a combination that
// draws the same pictures as another one has the row of that other one.
typedef struct DipCostCommon {
    const char *names[DIP_COST_MAX_COMMON_REPORTS]; // As on the command line. Borrowed.
    DipCostReport *reports;                         // Owned.
    int report_count;
    DipQuality *qualities; // [combination]. Owned.
    int *rows;             // [combination * report_count + report]: its row. Owned.
    double *losses;        // [combination]: mean of its FLIP over the reports. Owned.
    int count;             // Number of combinations.
} DipCostCommon;

// The combination to choose for one time budget. Combinations are indices in DipCostCommon, or -1
// for none.
typedef struct DipCostCommonAdvice {
    double budget_ms;
    int chosen;
    // The fastest combination whose mean FLIP is at least 1 % below that of the chosen one or, if
    // none is chosen, the fastest of all. The fastest one has the least upper bound in the report
    // in which it takes longest.
    int next;
    int limit; // The report in which `next` takes longest, or -1.
    // The combination of least mean FLIP that may be within the budget in every report, but is not
    // surely so. Its mean FLIP is at least 1 % below that of the chosen one.
    int undecided;
    int alone[DIP_COST_MAX_COMMON_REPORTS]; // The row that each report alone would choose, or -1.
} DipCostCommonAdvice;

// Reads reports: files, or folders that have a cost.json. `files` is borrowed as the names.
// `budget_of` is the time that must be within the budget. Fails if a report cannot be read, has no
// combinations with times and errors, comes from a machine that was too busy (DIP_ERROR_BUSY) or
// from another build of the program, or if no combination is in all reports. Free *common even
// after a failure.
bool dip_cost_common_read(DipCostCommon *common, const char *const *files, int count,
                          DipCostBudgetOf budget_of, DipError *err);

// Finds the common combinations of common->reports. Takes the place of the second half of
// dip_cost_common_read, and fails for the same reasons.
bool dip_cost_common_match(DipCostCommon *common, DipError *err);
void dip_cost_common_free(DipCostCommon *common);

// The time of a combination in one report, of the kind that budgets are meant for.
DipEstimate dip_cost_common_time(const DipCostCommon *common, int combination, int report);

// The FLIP of a combination in one report.
double dip_cost_common_flip(const DipCostCommon *common, int combination, int report);

// The mean FLIP of a combination over the reports.
double dip_cost_common_mean_flip(const DipCostCommon *common, int combination);

// Chooses the combination with the least mean FLIP that is surely within the budget in every
// report: the upper end of its interval is at most the budget. The floor of each report's truths is
// the least FLIP that counts. Among combinations whose mean FLIP is within 1 % of the least, takes
// the fastest one (by the geometric mean over the reports), and among those whose intervals overlap
// with it, the one with the fewest settings off their defaults. For a single report the choice is
// that of dip_cost_choose.
void dip_cost_common_advise(const DipCostCommon *common, double budget_ms,
                            DipCostCommonAdvice *advice);

#ifdef __cplusplus
}
#endif

#endif
