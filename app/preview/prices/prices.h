// Provides the prices that the preview shows. They come from a cost report that was read from a
// file, or from the live report, which the preview fills with measurements while nothing moves.
// app/report/prices/prices.h says what a price is.
#ifndef DIP_APP_PREVIEW_PRICES_PRICES_H
#define DIP_APP_PREVIEW_PRICES_PRICES_H

#include "app/report/prices/prices.h"

typedef struct DipPrices DipPrices;

// Creates prices without a report. At first all prices are unknown. Fails with MEMORY.
DipPrices *dip_prices_create(DipError *err);
void dip_prices_destroy(DipPrices **prices);

// The scene that the panes show, and the machine that draws the panes. Strings are borrowed until
// the conditions are set again. A member that is NULL or 0 is not known, and is not compared with
// the report.
typedef struct DipPriceConditions {
    const char *scene;     // As dip_cost_scene_name names it.
    const char *processor; // As dip_machine_processor names it.
    const char *isa;
    int threads;
} DipPriceConditions;

void dip_prices_set_conditions(DipPrices *prices, const DipPriceConditions *conditions);

// Sets the viewing distance for which the user wants FLIP, in pixels per degree; 0 if the user has
// not given one.
void dip_prices_set_viewing(DipPrices *prices, double pixels_per_degree);

// Returns the pixels per degree for the FLIP of the panes and of live prices: those that were set,
// or else those of the report, or else DIP_FLIP_PIXELS_PER_DEGREE.
double dip_prices_viewing(const DipPrices *prices);

// Takes prices from a report, which is borrowed until another one is set. After a failure, prices
// have no report. Fails with MEMORY.
bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err);
bool dip_prices_has_report(const DipPrices *prices);

// Returns whether there is a report, and its scene is another one than the conditions name.
bool dip_prices_are_of_other_scene(const DipPrices *prices);

// Sets whether live prices are used although there is a report. A user wants this if the report is
// stale (dip_prices_source). Without a report, live prices are always used.
void dip_prices_prefer_rough(DipPrices *prices, bool prefer);

// Returns whether the prices come from the live report, so that measuring is worthwhile.
bool dip_prices_are_rough(const DipPrices *prices);

// Returns the view of the report that the prices come from now.
const DipPriceView *dip_prices_view(const DipPrices *prices);

// Returns the settings that prices start from: those of the report's baseline, or the defaults.
DipQuality dip_prices_base(const DipPrices *prices);

// Returns the live report. It measures one picture from one viewpoint instead of camera paths
// (dip_cost_is_view).
DipCostReport *dip_prices_live(DipPrices *prices);

// Returns the index of the live report's row with these settings, or with settings that draw the
// same pictures. Returns -1 if there is none.
int dip_prices_find_live(const DipPrices *prices, const DipQuality *quality);

// Returns the same index as dip_prices_find_live, but adds a row if there is none. Fails with
// MEMORY, also if all DIP_PRICES_LIVE_ROWS rows are in use, and then returns -1.
enum { DIP_PRICES_LIVE_ROWS = 256 };
int dip_prices_live_row(DipPrices *prices, const DipQuality *quality, DipError *err);

// Updates the live prices from the live report. If `timed`, first computes the report's times from
// its log. Fails with MEMORY.
bool dip_prices_update_live(DipPrices *prices, bool timed, DipError *err);

// Empties the live report, because the picture, its size or its scene has changed.
void dip_prices_forget_live(DipPrices *prices);

// Returns a number that grows whenever a price may have changed.
unsigned dip_prices_changes(const DipPrices *prices);

// Sets the text that tells the user what is being measured: "times: 12 steps left, 4 s", or "" if
// nothing is. The text is copied and cut to DIP_PRICE_PROGRESS bytes. Returns whether it is new.
enum { DIP_PRICE_PROGRESS = 96 };
bool dip_prices_set_progress(DipPrices *prices, const char *text);
const char *dip_prices_progress(const DipPrices *prices);

// Return what dip_price_step and dip_price_sum return for the report that the prices come from now.
DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality);
DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality);

// Returns whether all times are doubtful, because the machine was too busy while they were taken.
bool dip_prices_are_doubtful(const DipPrices *prices);

// Writes where the prices come from and for what they hold: "Prices: report of this scene, path
// DEFAULT, 640x480, 2 threads. The panes are 320x240." width and height: size of a pane in pixels.
// Returns whether the prices are stale: the size, scene, threads, machine, instruction set or
// viewing distance differ from those of the panes. Live prices are never stale.
bool dip_prices_source(const DipPrices *prices, int width, int height, char *text,
                       size_t size_bytes);

#endif
