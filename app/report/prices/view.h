// Declares what the files of this folder share: the view of a report, whole times of combinations,
// and the two combinations whose difference is a price. Private to this folder.
#ifndef DIP_APP_REPORT_PRICES_VIEW_H
#define DIP_APP_REPORT_PRICES_VIEW_H

#include "app/report/fit.h"
#include "app/report/prices/prices.h"

// A combination on a path, with its row in the report or with one of the report's predictions.
typedef struct DipPriceEntry {
    uint64_t settings; // A number for the settings of dip_price_normal.
    int path;
    int row;        // -1: none.
    int prediction; // If there is no row.
    int rank;       // Of entries with the same settings and path, the least one counts.
} DipPriceEntry;

// A price of one row minus another that was computed before.
typedef struct DipPriceMemory {
    bool is_known;
    int row;     // The row with the step,
    int without; // and the row without it.
    DipPrice price;
} DipPriceMemory;

enum { DIP_PRICE_MEMORIES = 1021 };

// What was computed from the report and is kept until it changes, since it takes a while. The
// models are made when a prediction first needs them.
typedef struct DipPriceKept {
    bool has_models;
    DipCostModel times;   // times.rows is 0 if the report has too few times.
    DipCostMisses misses; // How far `times` misses measured times.
    DipCostModel errors;  // errors.rows is 0 if the report has too few errors.
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
    DipPriceState state; // UNKNOWN: only the error is known.
    DipEstimate time;
    bool has_flip;
    double flip;
    bool flip_at_floor;
} DipPriceWhole;

// Returns the entry of a combination on a path, or NULL. `normal` is a result of dip_price_normal.
const DipPriceEntry *dip_price_find(const DipPriceView *view, int path, const DipQuality *normal);

// Returns what is known of an entry, which may be NULL.
DipPriceWhole dip_price_known(const DipPriceView *view, const DipPriceEntry *entry);

// Predicts a combination by the models. `normal` is a result of dip_price_normal. Returns false if
// the report does not tell enough.
bool dip_price_predict(const DipPriceView *view, const DipQuality *normal, DipPriceWhole *whole);

// Returns a predicted time with the error that the misses of other predictions of this kind tell.
// The error has the standard deviation of a normal distribution with the 90th percentile of the
// misses, and as many degrees of freedom as there are misses. Without misses it is not known.
DipEstimate dip_price_predicted_time(double ms, const DipCostMisses *misses);

// --- questions -----------------------------------------------------------------------------------

// The two combinations of settings whose difference is the price of a step: one with the step and
// one without.
//
// A setting that does nothing alone is priced beside its company: other settings, which both
// combinations have. Temporal AA and adaptive AA are priced beside the AA of the pane, advanced AF
// beside the AF of the pane. The group sizes of adaptive AA are priced together with adaptive AA,
// against the same AA without it.
//
// AF and advanced AF also have the antialiasing of the pane as company. They cost more where
// antialiasing shades more fragments, so their prices without it would not add up to the time of
// the whole combination: the courtyard in 8x AA with adaptive AA and AF 16x takes 11 % more than
// that sum.
typedef struct DipPriceQuestion {
    DipQuality with;    // The base, the company and the step.
    DipQuality without; // The base and the company.
    bool is_base;       // The step is that of the base, so both combinations are equal.
    char needs[24];     // What the pane lacks for the step to do anything: "AF", or "".
} DipPriceQuestion;

// The settings of antialiasing, which AF and advanced AF have as company (bit s: setting s).
enum { DIP_PRICE_ANTIALIASING = 1 << DIP_SETTING_AA | 1 << DIP_SETTING_AAA | 1 << DIP_SETTING_ASD };

// Returns whether the setting is AF or advanced AF.
static inline bool dip_price_filters(DipSetting setting) {
    return setting == DIP_SETTING_AF || setting == DIP_SETTING_AAF;
}

// base: the settings that prices start from. quality: the other settings of the pane. If the pane
// lacks the company, the question has company that makes the step do something.
DipPriceQuestion dip_price_question(const DipQuality *base, DipSetting setting, int step,
                                    const DipQuality *quality);

// Returns settings that draw the same picture. Settings that have no effect get their step in
// `base`: advanced AF without AF, temporal AA without samples, adaptive AA with one group of
// samples, and group sizes without adaptive AA. Mip colours get it too, because they have no price.
DipQuality dip_price_normal(const DipQuality *base, const DipQuality *quality);

#endif
