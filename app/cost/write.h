// A report as JSON, CSV, text and HTML; each file is written whole or not at all.
#ifndef DIP_APP_COST_WRITE_H
#define DIP_APP_COST_WRITE_H

#include "app/cost/report.h"

#include <stdio.h>

bool dip_cost_write_json(const DipCostReport *report, const char *file, DipError *err);

// Reads what dip_cost_write_json wrote; figures that follow from others are found anew. Fails with
// the file and what is missing in it. The report belongs to the caller on success.
bool dip_cost_read_json(DipCostReport *report, const char *file, DipError *err);

// A line per sweep and step, and one per combination.
bool dip_cost_write_csv(const DipCostReport *report, const char *file, DipError *err);

void dip_cost_print(const DipCostReport *report, FILE *out);

// A mark for errors that say nothing, and settings that are measured on a path.
const char *dip_cost_floor_mark(const DipCostReport *report, int row); // "at floor" or ""

// The step's text in its sweep: "4", "high-quality"; of adaptive AA "off" or "asd=2".
void dip_cost_step_text(const DipCostReport *report, const DipCostSweep *sweep, int row,
                        char text[DIP_COST_TEXT]);

#endif
