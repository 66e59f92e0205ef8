// The combinations that were timed at a smaller size (report.h) in the JSON report.
#ifndef DIP_APP_COST_JSON_SMALLER_H
#define DIP_APP_COST_JSON_SMALLER_H

#include "app/cost/report.h"

struct cJSON;

// Adds them to the root of the report, as "smaller". A report without them gets nothing.
void dip_cost_smaller_add(struct cJSON *root, const DipCostReport *report);

// Reads what dip_cost_smaller_add wrote. Reports of earlier versions have none. Returns false if a
// part is missing or impossible.
bool dip_cost_smaller_read(const struct cJSON *root, DipCostReport *report);

#endif
