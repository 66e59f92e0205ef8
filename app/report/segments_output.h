// Printing advice per segment (segments.h), and writing it as JSON.
#ifndef DIP_APP_REPORT_SEGMENTS_OUTPUT_H
#define DIP_APP_REPORT_SEGMENTS_OUTPUT_H

#include "app/report/segments.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct cJSON;

// Advice for `count` budgets. Everything is borrowed.
typedef struct DipCostSegmentList {
    const DipCostReport *report;
    const DipCostSegments *segments;
    const DipCostSegmentAdvice *advice;
    int count;
} DipCostSegmentList;

// Prints a table of the segments for each budget.
void dip_cost_segments_print(const DipCostSegmentList *list, FILE *out);

// Adds the same to a JSON object, as "segments" and "advice_per_segment".
void dip_cost_segments_add_json(const DipCostSegmentList *list, struct cJSON *root);

#ifdef __cplusplus
}
#endif

#endif
