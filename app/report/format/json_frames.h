// The list of kept frames (kept_frames.h) in the JSON report.
#ifndef DIP_APP_REPORT_FORMAT_JSON_FRAMES_H
#define DIP_APP_REPORT_FORMAT_JSON_FRAMES_H

#include "app/report/report.h"

struct cJSON;

// Adds report->kept to the root of the report, as "frames", if there are any.
void dip_cost_frames_add(struct cJSON *root, const DipCostReport *report);

// Reads what dip_cost_frames_add wrote, after the report's header has been read. Without "frames",
// the report keeps none. Fails with DIP_ERROR_FORMAT or DIP_ERROR_MEMORY.
bool dip_cost_frames_read(const struct cJSON *root, DipCostReport *report, const char *file,
                          DipError *err);

#endif
