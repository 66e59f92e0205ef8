// The distribution of FLIP over pixels (app/measure/metrics/flip_tail.h) in the JSON report.
#ifndef DIP_APP_REPORT_FORMAT_JSON_TAIL_H
#define DIP_APP_REPORT_FORMAT_JSON_TAIL_H

#include "app/measure/metrics/flip_tail.h"

#include <stdbool.h>

struct cJSON;

// Adds the distribution to a JSON object, as "flip_tail". Returns the object that was added, or
// NULL when memory runs out or if the distribution is not known.
struct cJSON *dip_cost_tail_add(struct cJSON *to, const DipFlipTail *tail);

// Reads what dip_cost_tail_add wrote. Without "flip_tail", which reports of earlier versions do not
// have, *tail becomes 0. Returns false if a number is missing or impossible.
bool dip_cost_tail_read(const struct cJSON *from, DipFlipTail *tail);

#endif
