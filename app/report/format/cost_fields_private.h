// Declares what the lists of the fields of cost.json (cost_fields.h) share. Each file has the
// fields of some items; cost_fields.c has those of the report, which contains them all.
#ifndef DIP_APP_REPORT_FORMAT_COST_FIELDS_PRIVATE_H
#define DIP_APP_REPORT_FORMAT_COST_FIELDS_PRIVATE_H

#include "app/report/format/cost_fields.h"

// --- items ---------------------------------------------------------------------------------------

static inline DipCostReport *dip_cost_report_of(const DipFieldAt *at) {
    return at->context;
}

// Returns whether the report has a row with this index.
bool dip_cost_is_row(const DipCostReport *report, int row);

// Initialises a DipField that is an object in JSON but no struct in C: its fields are members of
// the struct that has this field.
#define PART .kind = DIP_FIELD_RECORD, .where = DIP_FIELD_JSON

// LIST initialises a DipField whose DipFieldList stands in another file and has facts. DERIVED_LIST
// does so for a list of derived values.
#define LIST(LIST_OF) .kind = DIP_FIELD_LIST, .where = DIP_FIELD_JSON, .list = &(LIST_OF)

#define DERIVED_LIST(LIST_OF)                                                                      \
    .kind = DIP_FIELD_LIST, .where = DIP_FIELD_JSON | DIP_FIELD_DERIVED, .list = &(LIST_OF)

// Returns how many of the flags are set.
int dip_cost_count_set(const bool *flags, int count);

// Returns the index of the set flag that has `number` set flags before it.
int dip_cost_find_set(const bool *flags, int number);

// --- fields that several items have --------------------------------------------------------------

extern const char *const dip_cost_setting_keys[DIP_SETTING_COUNT];

// Calls X(METRIC, name, title, unit, digits) for each metric that has an interval.
#define METRIC_LIST(X)                                                                             \
    X(RMSE, "rmse_lin", "RMSE", "linear", 5)                                                       \
    X(PSNR, "psnr_db", "PSNR", "dB", 2)                                                            \
    X(SSIM, "ssim", "SSIM", NULL, 4)                                                               \
    X(FLIP, "flip", "FLIP", NULL, 4)                                                               \
    X(FLICKER, "flicker_rms_lin", "flicker", "linear", 5)

#define SUMS_FIELD(name, means, TYPE, MEMBER)                                                      \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(NUMBERS, TYPE, MEMBER),                                  \
            .least = -DIP_COST_MOST_MEAN * DIP_COST_MOST_COUNT,                                    \
            .most = DIP_COST_MOST_MEAN * DIP_COST_MOST_COUNT                                       \
    }

// Returns whether a file can have these sums over pixels and bursts (series of successive frames):
// each count is 0 or at least 1, and each mean is within its limit.
bool dip_cost_are_sums(const DipMetricSums *sums);

#define STAGE_NAMES_FIELD(TYPE, KNOWN)                                                             \
    {                                                                                              \
        "stages_ms", NULL, "ms",                                                                   \
            "The parts of the mean time that each stage of the pipeline takes.",                   \
            DIP_FACT(NUMBERS, TYPE, stage_ms),                                                     \
            .names = dip_cost_stage_names, .most = DIP_COST_MOST_MS, .digits = 3, .known = KNOWN   \
    }
#define COUNTERS_FIELD(TYPE, KNOWN)                                                                \
    {                                                                                              \
        "counters", NULL, NULL, "Work of a frame, as means over the timed frames; it is exact.",   \
            DIP_FACT(NUMBERS, TYPE, counters),                                                     \
            .names = dip_counter_names, .most = DIP_COST_MOST_COUNT, .known = KNOWN,               \
            .scale = 1e-3, .digits = 4, .show = DIP_SHOW_FIGURES                                   \
    }

// --- lists and records of the report -------------------------------------------------------------

// The comments name the file that defines each list or record, and the item of each record.
extern const DipFieldList dip_cost_row_list;         // row_fields.c
extern const DipFieldList dip_cost_visit_list;       // visit_fields.c
extern const DipFieldList dip_cost_floor_list;       // path_fields.c
extern const DipFieldList dip_cost_interaction_list; // analysis_fields.c
extern const DipFieldList dip_cost_advice_list;      // analysis_fields.c
extern const DipRecord dip_cost_path_record;         // path_fields.c; the item is the DipCostReport
extern const DipRecord dip_cost_sweep_record;        // path_fields.c; DipCostSweep
extern const DipRecord dip_cost_predictions_record;  // prediction_fields.c; DipCostPredictions
extern const DipRecord dip_cost_smaller_record;      // prediction_fields.c; the DipCostReport
extern const DipRecord dip_cost_machine_record;      // analysis_fields.c; the DipCostReport
extern const DipRecord dip_cost_fit_record;          // analysis_fields.c; DipCostFit
bool dip_cost_has_smaller(const DipFieldAt *at);
DipFieldDerive dip_cost_derive_fit;

#endif
