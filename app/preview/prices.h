// What each step of each setting costs in time and gains in accuracy, as the panel shows it.
//
// A price is the difference between a step and the base, on the path that the price was measured
// on. The base has the default settings; a setting that has no effect alone is priced beside its
// company, the settings that it needs (adaptive AA beside the AA of the quality, advanced AF beside
// AF), at the base and at the step.
//
// Prices come from one of two sources. A cost report (`diptych cost`, docs/cost.md) gives measured
// prices with intervals. Without a report, the preview measures rough prices in the background
// while camera and scene rest (price_job.h).
#ifndef DIP_APP_PREVIEW_PRICES_H
#define DIP_APP_PREVIEW_PRICES_H

#include "app/cost/report.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum DipPriceState {
    DIP_PRICE_UNKNOWN,   // Not measured (yet).
    DIP_PRICE_BASE,      // The step is the base: ms and flip are its own time and error.
    DIP_PRICE_MEASURED,  // From a report.
    DIP_PRICE_PREDICTED, // From a report's model (docs/cost.md), for steps that were not timed.
    DIP_PRICE_ROUGH      // Measured live, from a few frames.
} DipPriceState;

// One step's price. Intervals hold 95 % as the report's do; a rough price's interval is that of its
// few frames.
typedef struct DipPrice {
    DipPriceState state;
    double ms; // Added to the base, in milliseconds; of the base itself: the whole time.
    double ms_low;
    double ms_high;
    bool ms_is_zero; // The interval holds 0, so the panel says "≈ 0".
    bool has_flip;   // The error is known. (The truth takes longer than the times.)
    double flip;     // Added to the base's FLIP; of the base itself: its FLIP.
    bool flip_at_floor;
    bool needs_company; // The step does nothing with the quality that the price was asked for;
                        // `needs` says what it needs, such as "AF".
    char needs[24];
    char path[32]; // The path that the price was measured on: "DEFAULT".
} DipPrice;

// The prices of all steps, and the sum for one combination of settings.
typedef struct DipPriceSum {
    DipPriceState state; // MEASURED if this very combination was timed; otherwise PREDICTED, or
                         // ROUGH if it is the sum of the parts.
    double ms;
    double ms_low;
    double ms_high;
    bool has_flip;
    double flip;
    double base_ms;
    double parts_ms[DIP_SETTING_COUNT]; // Each setting's own price at its step.
    double together_ms; // What the sum adds to the base and the parts; it may be negative.
} DipPriceSum;

typedef struct DipPrices DipPrices;

// Makes prices without a source: all are unknown. Fails with MEMORY.
DipPrices *dip_prices_create(DipError *err);
void dip_prices_destroy(DipPrices **prices);

// Takes prices from a report, which is copied as far as needed. width and height: size of a pane
// now, in pixels. Prices of another size are kept and dip_prices_source says so.
bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err);

// Adds what the live measurement found for one combination of settings. flip below 0: unknown.
void dip_prices_add_rough(DipPrices *prices, const DipQuality *quality, double ms, double ms_low,
                          double ms_high, double flip);

// Forgets rough prices, because the picture, its size or its scene has changed.
void dip_prices_forget_rough(DipPrices *prices);

// Returns the price of a step of a setting for a pane that has the other settings of `quality`.
DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality);

DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality);

// Says where the prices come from and for what they hold: "Prices: report of this scene, path
// DEFAULT, 640x480, 2 threads. The panes are 320x240." Returns whether the prices are stale: the
// size, scene or machine differ from those of the panes.
bool dip_prices_source(const DipPrices *prices, int width, int height, char *text,
                       size_t size_bytes);

#endif
