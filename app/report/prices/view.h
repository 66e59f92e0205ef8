// What the files of this folder share: finding rows, and whole times. Private to this folder.
#ifndef DIP_APP_REPORT_PRICES_VIEW_H
#define DIP_APP_REPORT_PRICES_VIEW_H

#include "app/report/fit.h"
#include "app/report/prices/prices.h"

// What a path has of a combination: a row, or one of the report's predictions.
typedef struct DipPriceEntry {
    uint64_t settings; // Of the settings without what has no effect, a number.
    int path;
    int row;        // -1: none.
    int prediction; // If there is no row.
    int rank;       // Of entries with the same settings and path, the least one counts.
} DipPriceEntry;

// The report's models. Made when they are first asked for.
typedef struct DipPriceModel {
    bool is_made;
    DipCostModel times;   // rows is 0 if the report has too few times.
    DipCostMisses misses; // Of predicted times.
    DipCostErrorModel errors;
} DipPriceModel;

// Prices that were computed already, since their intervals take a while.
typedef struct DipPriceMemory {
    bool is_known;
    int row;
    int without;
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

// Returns what a path has of a combination without what has no effect, or NULL.
const DipPriceEntry *dip_price_find(const DipPriceView *view, int path, const DipQuality *normal);

// Returns what is known of an entry, which may be NULL.
DipPriceWhole dip_price_known(const DipPriceView *view, const DipPriceEntry *entry);

// Predicts a combination without what has no effect by the models. Returns false if the report does
// not tell enough.
bool dip_price_predict(const DipPriceView *view, const DipQuality *normal, DipPriceWhole *whole);

// Returns the time of a prediction of a kind that missed so far elsewhere. Its error has the
// standard deviation of a normal distribution with the 90th percentile of the misses, and as many
// degrees of freedom as there are misses; without misses it is not known.
DipEstimate dip_price_predicted_time(double ms, const DipCostMisses *misses);

#endif
