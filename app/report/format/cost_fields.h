// Declares the lists of the fields of cost.json (fields.h), and macros that make such lists. In all
// lists of this file, DipFieldAt.context is the DipCostReport.
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

// Initialisers of a DipField. DIP_FACT makes a fact. DIP_COMPUTED, DIP_DERIVED and DIP_SHOWN make
// derived fields. The value of a DIP_COMPUTED field is a member of the struct; a function computes
// the value of a DIP_DERIVED or DIP_SHOWN field. JSON has no DIP_SHOWN fields.
#define DIP_MEMBER(KIND, WHERE, TYPE, member)                                                      \
    .kind = DIP_FIELD_##KIND, .where = WHERE, .offset = offsetof(TYPE, member),                    \
    .size = sizeof(((TYPE *)0)->member)
#define DIP_FACT(KIND, TYPE, member) DIP_MEMBER(KIND, DIP_FIELD_JSON, TYPE, member)
#define DIP_COMPUTED(KIND, TYPE, member)                                                           \
    DIP_MEMBER(KIND, DIP_FIELD_JSON | DIP_FIELD_DERIVED, TYPE, member)
#define DIP_DERIVED(KIND, function)                                                                \
    .kind = DIP_FIELD_##KIND, .where = DIP_FIELD_JSON | DIP_FIELD_DERIVED, .derive = function
#define DIP_SHOWN(KIND, function)                                                                  \
    .kind = DIP_FIELD_##KIND, .where = DIP_FIELD_DERIVED, .derive = function
// Initialisers of a DipField that is a list, of facts (DIP_LIST) or of derived values
// (DIP_DERIVED_LIST). The arguments are the initialisers of its DipFieldList. DIP_ARRAY gives the
// initialisers for a list whose items lie in an array that is a member of the owner.
#define DIP_LIST_OF(WHERE, ...)                                                                    \
    .kind = DIP_FIELD_LIST, .where = WHERE, .list = &(const DipFieldList) {                        \
        __VA_ARGS__                                                                                \
    }
#define DIP_LIST(...)         DIP_LIST_OF(DIP_FIELD_JSON, __VA_ARGS__)
#define DIP_DERIVED_LIST(...) DIP_LIST_OF(DIP_FIELD_JSON | DIP_FIELD_DERIVED, __VA_ARGS__)
#define DIP_ARRAY(OWNER, MEMBER, COUNTED)                                                          \
    .items = offsetof(OWNER, MEMBER), .counted = offsetof(OWNER, COUNTED)
// DIP_DERIVE defines a function that derives a field (DipFieldDerive). DIP_GET_ITEM defines a
// function that gets an item of a list (DipFieldList.item).
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
// Defines a function that returns whether something is true of an item (TYPE bool), or a number of
// things that the item has (TYPE int).
#define DIP_OF_ITEM(TYPE, name, value)                                                             \
    static TYPE name(const DipFieldAt *at) {                                                       \
        (void)at;                                                                                  \
        return value;                                                                              \
    }
// Values for DIP_DERIVE. DIP_MADE stores a value in *scratch. DIP_WRITTEN calls a function that
// writes a text to scratch->text.
#define DIP_MADE(TYPE, value) (*(TYPE *)scratch = (value), scratch)
#define DIP_WRITTEN(call)     ((call), scratch->text)
// Initialisers of a DipRecord. The items of DIP_RECORD are structs of the type TYPE; those of
// DIP_RECORD_OF_ARRAYS are no structs of their own (DipRecord.size).
#define DIP_RECORD(NAME, MEANS, fields, TYPE, CHECK)                                               \
    { NAME, MEANS, fields, DIP_FIELD_COUNT_OF(fields), sizeof(TYPE), CHECK }
#define DIP_RECORD_OF_ARRAYS(NAME, MEANS, fields, CHECK)                                           \
    { NAME, MEANS, fields, DIP_FIELD_COUNT_OF(fields), 0, CHECK }
#define DIP_FIELD_COUNT_OF(fields) (int)(sizeof(fields) / sizeof *(fields))

// The comments name the struct that has the fields.
extern const DipRecord dip_cost_report_record;               // DipCostReport
extern const DipRecord dip_cost_row_record;                  // DipCostRow
extern const DipRecord dip_cost_metrics_record;              // DipMetrics
extern const DipRecord dip_cost_prediction_of_report_record; // DipCostPrediction
extern const DipRecord dip_cost_misses_record;               // DipCostMisses
extern const DipRecord dip_cost_interaction_record;          // DipCostInteraction
extern const DipRecord dip_cost_warning_record;              // DipError, a warning
extern const DipRecord dip_cost_price_record;     // DipCostFit; item i is the fit's term i
extern const DipRecord dip_cost_same_record;      // DipCostSame
extern const DipRecord dip_cost_elsewhere_record; // DipCostElsewhere

// The format number that every new cost.json has. It grows when a program that reads the previous
// format would misread the new one.
enum { DIP_COST_JSON_FORMAT = 3 };
DipFieldDerive dip_cost_derive_format;

#endif
