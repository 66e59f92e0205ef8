// What each step of each setting costs in time and gains in accuracy, as the panel shows it.
//
// A price is the difference between a step and the base, on the path that the price was measured
// on. The base has the default settings; a setting that has no effect alone is priced beside its
// company, the settings that it needs (adaptive AA beside the AA of the quality, advanced AF beside
// AF), at the base and at the step. AF and advanced AF are also priced beside the antialiasing of
// the quality, so that prices add up (price_question.h). If that price is not known, the price
// beside the same AA without adaptive AA stands for it, or else the price without antialiasing.
//
// Prices come from one of two sources. A cost report (`diptych cost`, docs/cost.md) gives measured
// prices with intervals. Without a report, the preview measures rough prices in the background
// while camera and scene rest (price_job.h).
#ifndef DIP_APP_PREVIEW_PRICES_PRICES_H
#define DIP_APP_PREVIEW_PRICES_PRICES_H

#include "app/report/report.h"
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

// What may be shown of a time. Every part of the program that shows or uses a price asks one of the
// two functions below, so that no number looks surer in one place than in another.
typedef enum DipPriceTrust {
    DIP_PRICE_TRUST_UNKNOWN,  // There is no number.
    DIP_PRICE_TRUST_DOUBTFUL, // The interval is too wide, or the report is: one digit and "?". It
                              // has no bar and enters no sum.
    DIP_PRICE_TRUST_ZERO,     // The time is 0 as far as anyone can tell: "≈ 0".
    DIP_PRICE_TRUST_KNOWN
} DipPriceTrust;

// One step's price. `state` tells about the time: an UNKNOWN price can have an error, because a
// report can have errors without times, and the other way round. Intervals hold 95 % as the
// report's do; a rough price's interval is that of its few frames.
typedef struct DipPrice {
    DipPriceState state;
    double ms; // Added to the base, in milliseconds; of the base itself: the whole time.
    double ms_low;
    double ms_high;
    double without_ms; // The whole time without the step; 0 for the base.
    bool has_flip;     // The error is known. (The truth takes longer than the times.)
    double flip;       // Added to the base's FLIP; of the base itself: its FLIP.
    bool flip_at_floor;
    bool needs_company; // The step does nothing with the quality that the price was asked for;
                        // `needs` says what it needs, such as "AF".
    char needs[24];
    char beside[48]; // The company that both times have: "aa=8,aaa=on"; "" if none.
    char path[32];   // The path that the price was measured on: "DEFAULT"; "" for rough prices.
    // The machine was too busy for the report's times to be believed (its verdict is red).
    bool doubtful;
} DipPrice;

// The whole time of one combination of settings, and its parts: base_ms + the sum of parts_ms +
// together_ms is ms, exactly.
typedef struct DipPriceSum {
    DipPriceState state; // MEASURED if this very combination was timed; otherwise PREDICTED, or
                         // ROUGH if it is the sum of the parts or was measured live. UNKNOWN: the
                         // price of a part is not known, and ms lacks it.
    double ms;
    double ms_low;
    double ms_high;
    bool has_flip;
    double flip;
    double base_ms;
    // Each setting's own price at its step. The group size (asd) has no part of its own: that of
    // adaptive AA holds it.
    double parts_ms[DIP_SETTING_COUNT];
    DipPriceTrust parts_trust[DIP_SETTING_COUNT];
    double together_ms; // What the sum adds to the base and the parts; it may be negative.
    bool doubtful;      // As in DipPrice.
} DipPriceSum;

DipPriceTrust dip_price_trust(const DipPrice *price);
DipPriceTrust dip_price_sum_trust(const DipPriceSum *sum);

typedef struct DipPrices DipPrices;

// Makes prices without a source: all are unknown. Fails with MEMORY.
DipPrices *dip_prices_create(DipError *err);
void dip_prices_destroy(DipPrices **prices);

// What the panes are drawn from and drawn on now. Strings are borrowed until the next call; NULL
// and 0 stand for what is not known and is not compared with the report.
typedef struct DipPriceConditions {
    const char *scene;     // As dip_cost_scene_name names it.
    const char *processor; // As dip_machine_processor names it.
    const char *isa;
    int threads;
} DipPriceConditions;

void dip_prices_set_conditions(DipPrices *prices, const DipPriceConditions *conditions);

// Sets the viewing distance for which the user wants FLIP, in pixels per degree; 0: none is wanted.
void dip_prices_set_viewing(DipPrices *prices, double pixels_per_degree);

// Returns the pixels per degree for the FLIP of the panes and of rough prices: those that were set,
// or else those of the report, or else DIP_FLIP_PIXELS_PER_DEGREE.
double dip_prices_viewing(const DipPrices *prices);

// Takes prices from a report, which is copied as far as needed. On failure there are no prices from
// a report. Fails with MEMORY.
bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err);
bool dip_prices_has_report(const DipPrices *prices);

// Takes prices from the JSON file of a report. Fails as dip_cost_read_json and
// dip_prices_set_report do.
bool dip_prices_load_report(DipPrices *prices, const char *file, DipError *err);

// Returns whether there is a report and it is of another scene than the conditions name.
bool dip_prices_are_of_other_scene(const DipPrices *prices);

// Says whether rough prices are used although there is a report, because the report is stale and
// the user wants to measure here. Without a report, rough prices are always used.
void dip_prices_prefer_rough(DipPrices *prices, bool prefer);

// Returns whether the prices come from live measurement, so that it is worth measuring.
bool dip_prices_are_rough(const DipPrices *prices);

// The settings that prices start from: those of the report's baseline, or the defaults.
DipQuality dip_prices_base(const DipPrices *prices);

// Adds what the live measurement found for one combination of settings, in place of what was known
// of it. The interval is that of the combination beside the base; that of the base itself is empty.
// flip below 0: unknown; a FLIP that was known stays. Returns false if memory runs out.
bool dip_prices_add_rough(DipPrices *prices, const DipQuality *quality, double ms, double ms_low,
                          double ms_high, double flip);

// Adds the FLIP of a combination whose rough time is known, against a truth of `samples` samples
// per pixel. If errors against a coarser truth are known, they hold until all are known against the
// finer one, since errors against two truths must not be compared.
void dip_prices_add_rough_flip(DipPrices *prices, const DipQuality *quality, double flip,
                               int samples);

// Writes the combinations whose rough times are known but whose errors against a truth of `samples`
// samples or more are not, at most `room`. Returns their number.
int dip_prices_list_without_flip(const DipPrices *prices, int samples, DipQuality *list, int room);

// Says whether the machine was too busy for the rough times to be believed.
void dip_prices_set_rough_doubtful(DipPrices *prices, bool doubtful);

// Returns the number of combinations whose rough times are known.
int dip_prices_rough_count(const DipPrices *prices);

// Returns whether a rough time of this combination is known, or of one with the same picture.
bool dip_prices_has_rough(const DipPrices *prices, const DipQuality *quality);

// Forgets rough prices, because the picture, its size or its scene has changed.
void dip_prices_forget_rough(DipPrices *prices);

// Grows whenever a price may have changed.
unsigned dip_prices_changes(const DipPrices *prices);

// What is being measured, for the panel: "3 of 8 frames, 4 s left", or "" if nothing is. The text
// is copied and cut to DIP_PRICE_PROGRESS bytes. Returns whether the text is new.
enum { DIP_PRICE_PROGRESS = 96 };
bool dip_prices_set_progress(DipPrices *prices, const char *text);
const char *dip_prices_progress(const DipPrices *prices);

// Returns the price of a step of a setting for a pane that has the other settings of `quality`.
DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality);

// Returns the sum for a combination. A combination that was not timed is predicted by the report's
// model; its interval is the share by which 90 % of such predictions miss. What the model does not
// know is the sum of the parts, whose intervals are added as independent errors.
DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality);

// Returns whether all times are doubtful, because the machine was too busy while they were taken.
bool dip_prices_are_doubtful(const DipPrices *prices);

// Says where the prices come from and for what they hold: "Prices: report of this scene, path
// DEFAULT, 640x480, 2 threads. The panes are 320x240." width and height: size of a pane in pixels.
// Returns whether the prices are stale: the size, scene, threads, machine or viewing distance
// differ from those of the panes.
bool dip_prices_source(const DipPrices *prices, int width, int height, char *text,
                       size_t size_bytes);

#endif
