// Declares what the files of this folder share: the view of a report, and whole times of
// combinations. Private to this folder.
#ifndef DIP_APP_REPORT_PRICES_VIEW_H
#define DIP_APP_REPORT_PRICES_VIEW_H

#include "app/report/fit.h"
#include "app/report/prices/prices.h"

// A combination on a path: its row in the report, or one of the report's predictions.
typedef struct DipPriceEntry {
    uint64_t settings; // A number for the settings of dip_price_normal.
    int path;
    int row;        // -1: none.
    int prediction; // If there is no row.
    int rank;       // Of entries with the same settings and path, the least one counts.
} DipPriceEntry;

// The report's models. They are made when a prediction first needs them.
typedef struct DipPriceModel {
    bool is_made;
    DipCostModel times;   // rows is 0 if the report has too few times.
    DipCostMisses misses; // Of predicted times.
    DipCostModel errors;
} DipPriceModel;

// A price that was computed before. It is kept, since its interval takes a while.
typedef struct DipPriceMemory {
    bool is_known;
    int row;     // With the step,
    int without; // and without it.
    DipPrice price;
} DipPriceMemory;

enum { DIP_PRICE_MEMORIES = 1021 };

struct DipPriceView {
    const DipCostReport *report;
    DipQuality base;
    DipPriceEntry *entries; // By settings and path. Owned.
    int count;
    DipPriceModel *model;     // Owned.
    DipPriceMemory *memories; // [DIP_PRICE_MEMORIES]; owned.
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

#endif
