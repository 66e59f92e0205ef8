// The combinations that were timed at a smaller size (report.h) in the JSON report.
#ifndef DIP_APP_REPORT_FORMAT_JSON_SMALLER_H
#define DIP_APP_REPORT_FORMAT_JSON_SMALLER_H

#include "app/report/report.h"

struct cJSON;

// Adds the times, their stages and the counters of a combination that was timed elsewhere.
void dip_cost_elsewhere_add_times(struct cJSON *object, const DipCostElsewhere *row);

// Reads what dip_cost_elsewhere_add_times wrote. Returns false if a part is missing or impossible.
bool dip_cost_elsewhere_read_times(const struct cJSON *object, DipCostElsewhere *row);

// Adds the combinations to the root of the report, as "smaller". A report without them gets
// nothing.
void dip_cost_smaller_add(struct cJSON *root, const DipCostReport *report);

// Reads what dip_cost_smaller_add wrote. Reports of earlier versions have none. Returns false if a
// part is missing or impossible.
bool dip_cost_smaller_read(const struct cJSON *root, DipCostReport *report);

#endif
