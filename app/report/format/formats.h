// Writes a report as JSON, CSV and text, and reads it from JSON. (html.h writes the HTML page.)
// Each file is written whole or not at all.
#ifndef DIP_APP_REPORT_FORMAT_FORMATS_H
#define DIP_APP_REPORT_FORMAT_FORMATS_H

#include "app/report/report.h"

#include <stdio.h>

// Writes the whole report, with the time of every frame of every round.
bool dip_cost_write_json(const DipCostReport *report, const char *file, DipError *err);

// Reads what dip_cost_write_json wrote. Computes derived values again instead of reading them. On
// failure, *err names the file and the part that is missing or wrong. On success the caller frees
// the report.
bool dip_cost_read_json(DipCostReport *report, const char *file, DipError *err);

// Reads a report like dip_cost_read_json. `name` is a JSON file, or a folder that has the file
// cost.json.
bool dip_cost_read_report(const char *name, DipCostReport *report, DipError *err);

// Writes one line per A/A row (the baseline, timed a second time), one per step of each sweep (the
// steps of one setting), and one per combination, measured or only predicted.
bool dip_cost_write_csv(const DipCostReport *report, const char *file, DipError *err);

// Prints the report for a terminal.
void dip_cost_print(const DipCostReport *report, FILE *out);

#endif
