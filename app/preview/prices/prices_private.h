// What prices*.c and price_report.c share.
#ifndef DIP_APP_PREVIEW_PRICES_PRICES_PRIVATE_H
#define DIP_APP_PREVIEW_PRICES_PRICES_PRIVATE_H

#include "app/preview/prices/price_model.h"
#include "app/preview/prices/price_question.h"
#include "app/preview/prices/prices.h"

// The whole time and the error of one combination.
typedef struct DipPriceKnown {
    DipQuality quality;  // Without what has no effect (dip_price_normal).
    DipPriceState state; // UNKNOWN: only the error is known.
    double ms;
    double ms_low;
    double ms_high;
    bool has_flip;
    double flip;
    bool flip_at_floor;
    int next_samples; // Samples of the finest truth that the error was measured against live.
    double next_flip; // The error against that truth.
} DipPriceKnown;

typedef struct DipPriceList {
    DipPriceKnown *items; // Owned.
    int count;
    int room;
} DipPriceList;

// The price of a step that a report measured.
typedef struct DipPriceTag {
    DipQuality with;
    DipQuality without;
    DipSetting setting; // The first setting whose step this is.
    DipPrice price;
} DipPriceTag;

// What prices take from a report.
typedef struct DipPriceReport {
    char scene[DIP_COST_TEXT];
    char processor[DIP_COST_TEXT];
    char isa[16];
    char path[16]; // Name of path 0.
    int threads;
    int width;
    int height;
    bool has_times;
    bool has_errors;
    bool doubtful;
    double pixels_per_degree;
    DipQuality base;
    DipPriceList known; // Combinations on path 0, measured or predicted.
    DipPriceTag *tags;  // Owned.
    int tag_count;
    int tag_room;
    DipPriceModel *model; // Owned; NULL if the report has too few times.
} DipPriceReport;

struct DipPrices {
    bool has_report;
    DipPriceReport report;
    bool prefers_rough;
    DipPriceList rough;
    bool rough_doubtful;
    DipPriceConditions conditions;
    unsigned changes;         // See dip_prices_changes.
    double pixels_per_degree; // 0: none was set.
    char progress[DIP_PRICE_PROGRESS];
};

// Fills in everything that prices need of a report. Fails with MEMORY.
bool dip_price_report_make(DipPriceReport *made, const DipCostReport *report, DipError *err);
void dip_price_report_free(DipPriceReport *report);

// Returns the price that a question asks for, or NULL. Bases of several settings may lie on several
// paths, so the setting counts for them.
const DipPrice *dip_price_report_find(const DipPriceReport *report, DipSetting setting,
                                      const DipPriceQuestion *question);

// The combinations that prices are made of now: of the report, or measured live.
const DipPriceList *dip_prices_list(const DipPrices *prices);

// Returns the combination with these settings (or, of several, the first), or NULL.
const DipPriceKnown *dip_price_list_find(const DipPriceList *list, const DipQuality *quality);

// Adds a combination at the end. Returns false if memory runs out.
bool dip_price_list_add(DipPriceList *list, const DipPriceKnown *known);

#endif
