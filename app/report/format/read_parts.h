// The parts of a report that read_json.c reads with functions of their own.
#ifndef DIP_APP_REPORT_FORMAT_READ_PARTS_H
#define DIP_APP_REPORT_FORMAT_READ_PARTS_H

#include "app/report/report.h"

struct cJSON;

// Reads the sums of errors in the array `name`. Returns false if they are missing or impossible.
bool dip_cost_read_sums(const struct cJSON *object, const char *name, DipMetricSums *sums);

// Reads the rows into a report whose header has been read and whose rows are allocated. Returns
// false if a part of a row is missing or wrong.
bool dip_cost_read_rows(const struct cJSON *root, DipCostReport *report);

// Reads the log of timed frames of a report whose rows were read, if there is one. Fails with
// DIP_ERROR_MISSING or DIP_ERROR_MEMORY.
bool dip_cost_read_visits(const struct cJSON *root, DipCostReport *report, const char *file,
                          DipError *err);

// Reads the predictions, if there are any. The counters of combinations that were not measured are
// not in the file. Fails with DIP_ERROR_FORMAT or DIP_ERROR_MEMORY.
bool dip_cost_read_predictions(const struct cJSON *root, DipCostReport *report, const char *file,
                               DipError *err);

// Reads the advice. Leaves out advice that cannot be read.
void dip_cost_read_advice(const struct cJSON *root, DipCostReport *report);

#endif
