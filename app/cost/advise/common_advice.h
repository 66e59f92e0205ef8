// Makes common advice: for a time budget, one choice of settings for several reports. Each report
// may have another scene, camera path, size or machine. Only combinations of settings that every
// report has measured can be chosen; a row that draws the same pictures stands for a combination
// that was not timed.
#ifndef DIP_APP_COST_ADVISE_COMMON_ADVICE_H
#define DIP_APP_COST_ADVISE_COMMON_ADVICE_H

#include "app/report/format/fields.h"
#include "app/report/report.h"

enum { DIP_COST_MAX_COMMON_REPORTS = 64 };

// The reports, and the combinations that every report has measured.
typedef struct DipCostCommon {
    const char *names[DIP_COST_MAX_COMMON_REPORTS]; // As on the command line. Borrowed.
    DipCostReport *reports;                         // Owned.
    int report_count;
    // The combinations as candidates: their mean FLIP over the reports, and their time in the
    // report in which they may take longest. `row` of a candidate is its index in this list. The
    // list is owned.
    DipCandidates candidates;
} DipCostCommon;

// What to choose for one time budget.
typedef struct DipCostCommonAdvice {
    DipAdvice all; // The common choice, among common->candidates.
    // [report]: the row that would be chosen from this report alone, or -1 if none would.
    int alone[DIP_COST_MAX_COMMON_REPORTS];
} DipCostCommonAdvice;

// Reads reports: files, or folders that have a cost.json. Borrows the strings of `files` as names.
// `budget_of` is the kind of time that must be within the budget. Fails if a report cannot be read,
// has no combinations with times and errors, comes from a machine that was too busy
// (DIP_ERROR_BUSY) or from another build than the first report, or if no combination is in all
// reports. Also fails with DIP_ERROR_MEMORY. Free *common even after a failure.
bool dip_cost_common_read(DipCostCommon *common, const char *const *files, int count,
                          DipTimeKind budget_of, DipError *err);

// Lists the combinations that all of common->reports have. First fill in the reports, their
// options.budget_of, their number and their names. Fails for the same reasons as
// dip_cost_common_read, except that no file is read.
bool dip_cost_common_match(DipCostCommon *common, DipError *err);
void dip_cost_common_free(DipCostCommon *common);

// Returns the row of a combination in one report: its own row, or the row of a combination that
// draws the same pictures. `combination` is an index in common->candidates.
int dip_cost_common_row(const DipCostCommon *common, int combination, int report);

// Returns the time and error of a combination in one report.
DipCandidate dip_cost_common_candidate(const DipCostCommon *common, int combination, int report);

// Chooses the common settings for a budget (dip_advise), and the settings that would be chosen from
// each report alone. With a single report, the two are the same.
void dip_cost_common_advise(const DipCostCommon *common, double budget_ms,
                            DipCostCommonAdvice *advice);

// Returns the share by which the chosen combination's FLIP in one report is above the FLIP of the
// row that would be chosen from this report alone. A FLIP below the noise floor of the report's
// truths counts as the floor (dip_cost_ranking_flip). Returns NAN if there is no common choice, or
// if no row would be chosen from this report alone.
double dip_cost_common_share_lost(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                  int report);

// Prints the advice for `count` budgets for a terminal. Four budgets are also printed as the tiers
// of a settings menu.
void dip_cost_common_print(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                           int count, FILE *out);

// Writes the advice to a file as JSON. Fails with DIP_ERROR_MEMORY, or DIP_ERROR_IO if the file
// cannot be written.
extern const DipRecord dip_cost_common_record; // The fields of the file.
bool dip_cost_common_write_json(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                int count, const char *file, DipError *err);

#endif
