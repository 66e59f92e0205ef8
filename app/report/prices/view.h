// Declares what the files of this folder share: the view of a report, the time and error of a
// combination, and the two combinations whose difference is a price. Private to this folder.
#ifndef DIP_APP_REPORT_PRICES_VIEW_H
#define DIP_APP_REPORT_PRICES_VIEW_H

#include "app/report/fit.h"
#include "app/report/flip_model.h"
#include "app/report/prices/prices.h"

// A combination on a path, with its row in the report or with one of the report's predictions.
typedef struct DipPriceEntry {
    uint64_t settings; // The settings in normal form (dip_price_normal), as one number.
    int path;
    int row;        // Index of the row; -1 if there is none.
    int prediction; // Index of the prediction; valid if there is no row.
    int rank;       // Of several entries with the same settings and path, the one of least rank
                    // counts.
} DipPriceEntry;

// A price that was computed from two rows.
typedef struct DipPriceMemory {
    bool is_known;
    int row;     // Index of the row with the step.
    int without; // Index of the row without the step.
    DipPrice price;
} DipPriceMemory;

enum { DIP_PRICE_MEMORIES = 1021 };

// Values that take a while to compute. They are kept until the report changes. The models are made
// when a prediction first needs them.
typedef struct DipPriceKept {
    bool has_models;
    DipCostModel times;   // times.rows is 0 if the report has too few times.
    DipCostMisses misses; // How far `times` misses measured times.
    DipFlipModel errors;  // errors.count is 0 if the report has too few errors. Owned.
    DipPriceMemory memories[DIP_PRICE_MEMORIES];
} DipPriceKept;

struct DipPriceView {
    const DipCostReport *report;
    DipQuality base;
    DipPriceEntry *entries; // In order of settings and path. Owned.
    int count;
    DipPriceKept *kept; // Owned.
};

// The whole time and error of a combination.
typedef struct DipPriceWhole {
    DipPriceState state; // UNKNOWN if the time is not known; the error may be known.
    DipEstimate time;
    bool has_flip;
    double flip;
    bool flip_at_floor;
} DipPriceWhole;

// Returns the entry of a combination on a path, or NULL. `normal` is a result of dip_price_normal.
const DipPriceEntry *dip_price_find(const DipPriceView *view, int path, const DipQuality *normal);

// Returns the time and error of an entry. If `entry` is NULL, neither is known.
DipPriceWhole dip_price_known(const DipPriceView *view, const DipPriceEntry *entry);

// Predicts a combination by the models. `normal` is a result of dip_price_normal. Returns false if
// the report does not tell enough.
bool dip_price_predict(const DipPriceView *view, const DipQuality *normal, DipPriceWhole *whole);

// Returns a predicted time with an error that follows from the misses of similar predictions. The
// error is the standard error of the time's logarithm: 90 % of a normal distribution with this
// standard error lies within log(1 + misses->p90) of its mean. The standard error is not below a
// fixed minimum, and has as many degrees of freedom as there are misses. Without misses, the error
// is not known.
DipEstimate dip_price_predicted_time(double ms, const DipCostMisses *misses);

// --- questions -----------------------------------------------------------------------------------

// A price is the difference between two combinations of settings: one with the step and one
// without. A question names these two.
//
// A setting that does nothing alone is priced beside its company: other settings, which both
// combinations have. They come from the pane (one of the preview's two pictures) for which the
// price is asked. Temporal AA and adaptive AA are priced beside the AA of the pane, advanced AF
// beside the AF of the pane, and upscaling filters beside the scale of the pane. A group size of
// adaptive AA is priced together with adaptive AA, against the same AA without adaptive AA.
//
// AF and advanced AF also have the antialiasing of the pane as company. They cost more where
// antialiasing shades more fragments, so their prices without it would not add up to the time of
// the whole combination. For example, the courtyard scene with AA 8x, adaptive AA and AF 16x takes
// 11 % more than that sum.
typedef struct DipPriceQuestion {
    DipQuality with;    // The base with the company and the step.
    DipQuality without; // The combination with the company but without the step.
    bool is_base;   // True if both combinations are equal: the other steps are compared with this
                    // one. This step is off for taa, aaa and aaf, bilinear for upscale, and the
                    // base's step for all other settings except asd, which has no such step.
    char needs[24]; // What the pane lacks for the step to do anything: "AF", or "".
} DipPriceQuestion;

// The settings of antialiasing, which AF and advanced AF have as company (bit s for setting s).
enum { DIP_PRICE_ANTIALIASING = 1 << DIP_SETTING_AA | 1 << DIP_SETTING_AAA | 1 << DIP_SETTING_ASD };

// Returns whether the setting is AF or advanced AF.
static inline bool dip_price_filters(DipSetting setting) {
    return setting == DIP_SETTING_AF || setting == DIP_SETTING_AAF;
}

// Returns the question for a step of a setting. `base` has the settings of the base, and `quality`
// those of the pane. If the pane lacks settings that the step needs, the question takes company
// with which the step has an effect.
DipPriceQuestion dip_price_question(const DipQuality *base, DipSetting setting, int step,
                                    const DipQuality *quality);

// Returns the normal form of settings, by which combinations are found. Settings that have no
// effect are turned off (dip_quality_effective), so combinations that differ only in these are the
// same. Mip colours get their step in `base`, because they have no price.
DipQuality dip_price_normal(const DipQuality *base, const DipQuality *quality);

#endif
