// Tells what each step of each setting costs in time and gains in accuracy, and how long whole
// combinations of settings take. A price is a view of a report. It does not matter whether the
// report was read from a file or is being filled by the preview (dip_cost_is_view).
//
// A step's price is the difference between the step and the base, on a path on which both were
// measured. The base has the settings of the report's baseline. A setting that has no effect alone
// is priced beside its company: the settings that it needs, which both the base and the step get
// (view.h). AF and advanced AF are also priced beside the antialiasing of the pane, so that prices
// add up. If that price is not known, the price beside the same AA without adaptive AA stands for
// it, or else the price without antialiasing.
//
// A combination without a row is predicted: by the report's own predictions, otherwise by the
// models of times and errors (fit.h) from its composed work (combinations.h). With too few rows for
// the models, its time is the sum of prices.
#ifndef DIP_APP_REPORT_PRICES_PRICES_H
#define DIP_APP_REPORT_PRICES_PRICES_H

#include "app/report/choice.h"
#include "app/report/report.h"

typedef enum DipPriceState {
    DIP_PRICE_UNKNOWN,   // The time was not measured, at least not yet.
    DIP_PRICE_BASE,      // The step is the base: ms and flip are its own time and error.
    DIP_PRICE_MEASURED,  // Measured along a path.
    DIP_PRICE_PREDICTED, // From a report's model (docs/cost.md): the combination was not timed.
    DIP_PRICE_ROUGH      // Measured with a few frames of one picture, or the sum of prices.
} DipPriceState;

// How a time may be shown. Every part of the program that shows or uses a price asks
// dip_price_trust or dip_price_sum_trust, so that no number looks surer in one place than in
// another.
typedef enum DipPriceTrust {
    DIP_PRICE_TRUST_UNKNOWN,  // There is no number.
    DIP_PRICE_TRUST_DOUBTFUL, // The interval is too wide, or the machine was too busy. The time is
                              // shown with one digit and "?"; it has no bar and enters no sum.
    DIP_PRICE_TRUST_ZERO,     // The time is 0 as far as anyone can tell: "≈ 0".
    DIP_PRICE_TRUST_KNOWN
} DipPriceTrust;

// One step's price. `state` tells about the time: an UNKNOWN price can have an error, because a
// report can have errors without times, and the other way round. Intervals hold 95 %.
typedef struct DipPrice {
    DipPriceState state;
    double ms; // Milliseconds that the step adds to the base; of the base itself: the whole time.
    double ms_low;
    double ms_high;
    double without_ms; // The whole time without the step; 0 for the base.
    bool has_flip;     // The error is known. (The preview has times before it has errors.)
    double flip;       // What the step adds to the base's FLIP; of the base itself: its FLIP.
    bool flip_at_floor;
    bool needs_company; // The step does nothing with the quality that the price was asked for;
                        // `needs` says what it needs, such as "AF".
    char needs[24];
    char beside[48]; // The company of the step and of the base: "aa=8,aaa=on"; "" if none.
    char path[32];   // The path that the price was measured on: "DEFAULT"; "" for one picture.
    // The machine was too busy for the report's times to be believed (its verdict is red).
    bool doubtful;
} DipPrice;

// The whole time of one combination of settings, and its parts: base_ms + the sum of parts_ms +
// together_ms is ms, exactly.
typedef struct DipPriceSum {
    DipPriceState state; // MEASURED or, from one picture, ROUGH if this very combination was timed;
                         // otherwise PREDICTED, or ROUGH if it is the sum of the parts. UNKNOWN:
                         // the price of a part is not known, and ms lacks it.
    double ms;
    double ms_low;
    double ms_high;
    bool has_flip;
    double flip;
    double base_ms;
    // Each setting's own price at its step. The group size (asd) has no part of its own: its price
    // is in the part of adaptive AA.
    double parts_ms[DIP_SETTING_COUNT];
    DipPriceTrust parts_trust[DIP_SETTING_COUNT];
    double together_ms; // By how much ms exceeds the base and the parts; it may be negative.
    bool doubtful;      // As in DipPrice.
} DipPriceSum;

DipPriceTrust dip_price_trust(const DipPrice *price);
DipPriceTrust dip_price_sum_trust(const DipPriceSum *sum);

// Finds a report's rows by their settings, and holds the models that predict the others.
typedef struct DipPriceView DipPriceView;

// The report is borrowed until the view is destroyed. Fails with MEMORY.
DipPriceView *dip_price_view_create(const DipCostReport *report, DipError *err);
void dip_price_view_destroy(DipPriceView **view); // *view may be NULL.

// Follows a report whose rows, times or errors have changed. Fails with MEMORY.
bool dip_price_view_update(DipPriceView *view, DipError *err);

const DipCostReport *dip_price_view_report(const DipPriceView *view);

// The settings that prices start from: those of the report's baseline.
DipQuality dip_price_base(const DipPriceView *view);

// Returns the row with these settings on path 0, or the row that draws the same pictures, or -1.
int dip_price_row(const DipPriceView *view, const DipQuality *quality);

// Returns whether all times are doubtful, because the machine was too busy while they were taken.
bool dip_price_is_doubtful(const DipPriceView *view);

// Returns the price of a step of a setting for a pane that has the other settings of `quality`.
DipPrice dip_price_step(const DipPriceView *view, DipSetting setting, int step,
                        const DipQuality *quality);

// Returns the whole time of a combination and its parts.
DipPriceSum dip_price_sum(const DipPriceView *view, const DipQuality *quality);

typedef enum DipPricesKnown {
    DIP_PRICES_NO_TIMES,  // Times of some steps are not known yet.
    DIP_PRICES_NO_ERRORS, // The times are known, but not all errors.
    DIP_PRICES_KNOWN
} DipPricesKnown;

// Lists what can be chosen from a report that has not measured combinations along a path: the
// combinations of aa, aaa, af, aaf, opt and miplod, measured or predicted, with the other settings
// of the base. The list is NULL, and the result is not KNOWN, until all steps are known that the
// combination `like` could take, since settings that need others, such as adaptive AA, are priced
// beside them. The caller frees candidates->list. Takes some milliseconds. When memory runs out,
// the result is NO_TIMES.
DipPricesKnown dip_price_candidates(const DipPriceView *view, const DipQuality *like,
                                    DipCandidates *candidates);

// Lists the combinations that must be timed so that every step has a price, and so that the whole
// times of both panes and of every combination one step away from the requested pane are known. The
// base and the panes come first, then the steps in the order of their distance from those of the
// requested pane, and at the end the steps of filtering without antialiasing. Writes at most `room`
// combinations; returns their number.
enum { DIP_PRICE_MAX_WANTED = 96 };
int dip_price_list_wanted(const DipQuality *base, const DipQuality *current,
                          const DipQuality *requested, DipQuality *list, int room);

#endif
