// The fields of cost.json: of a report, its rows, sweeps and advice. DipFieldAt.context is the
// DipCostReport in all of them.
#ifndef DIP_APP_REPORT_FORMAT_COST_FIELDS_H
#define DIP_APP_REPORT_FORMAT_COST_FIELDS_H

#include "app/report/format/fields.h"
#include "app/report/report.h"

#include <stddef.h>

// Limits of the values in a file. They are far wider than any real measurement needs, and keep all
// values that are computed from measurements finite.
#define DIP_COST_LEAST_MS   1e-6
#define DIP_COST_MOST_MS    1e9
#define DIP_COST_MOST_COUNT 1e15
#define DIP_COST_MOST_MEAN  1e6

// DIP_FACT is a fact that is a member of a struct. DIP_COMPUTED is a member that is computed from
// facts, and DIP_DERIVED is a value that a function computes.
#define DIP_FACT(KIND, TYPE, member)                                                               \
    .kind = DIP_FIELD_##KIND, .where = DIP_FIELD_JSON, .offset = offsetof(TYPE, member),           \
    .size = sizeof(((TYPE *)0)->member)
#define DIP_COMPUTED(KIND, TYPE, member)                                                           \
    .kind = DIP_FIELD_##KIND, .where = DIP_FIELD_JSON | DIP_FIELD_DERIVED,                         \
    .offset = offsetof(TYPE, member), .size = sizeof(((TYPE *)0)->member)
#define DIP_DERIVED(KIND, function)                                                                \
    .kind = DIP_FIELD_##KIND, .where = DIP_FIELD_JSON | DIP_FIELD_DERIVED, .derive = function
// Defines a function that derives a field, and one that gets an item of a list.
#define DIP_DERIVE(name, value)                                                                    \
    static const void *name(const DipFieldAt *at, DipFieldScratch *scratch) {                      \
        (void)at;                                                                                  \
        (void)scratch;                                                                             \
        return value;                                                                              \
    }
#define DIP_GET_ITEM(name, value)                                                                  \
    static const void *name(const DipFieldAt *at, int index, DipFieldScratch *scratch) {           \
        (void)at;                                                                                  \
        (void)index;                                                                               \
        (void)scratch;                                                                             \
        return value;                                                                              \
    }
// Stores a computed value in the scratch memory, and gives its address to DIP_DERIVE.
#define DIP_MADE(TYPE, value) (*(TYPE *)scratch = (value), scratch)
#define DIP_RECORD(NAME, MEANS, fields, TYPE, CHECK)                                               \
    { NAME, MEANS, fields, DIP_FIELD_COUNT_OF(fields), sizeof(TYPE), CHECK }
#define DIP_FIELD_COUNT_OF(fields) (int)(sizeof(fields) / sizeof *(fields))

extern const DipRecord dip_cost_report_record;               // DipCostReport
extern const DipRecord dip_cost_row_record;                  // DipCostRow
extern const DipRecord dip_cost_metrics_record;              // DipMetrics
extern const DipRecord dip_cost_prediction_of_report_record; // DipCostPrediction
extern const DipRecord dip_cost_misses_record;               // DipCostMisses
extern const DipRecord dip_cost_interaction_record;          // DipCostInteraction
extern const DipRecord dip_cost_price_record;     // double: the prices of a fit, in order
extern const DipRecord dip_cost_same_record;      // DipCostSame
extern const DipRecord dip_cost_elsewhere_record; // DipCostElsewhere

// The number of the format of every cost.json that is written. It grows when a program that reads
// the format before would misread the new one.
enum { DIP_COST_JSON_FORMAT = 3 };
DipFieldDerive dip_cost_derive_format;

#endif
