// Tells what each step of each setting costs in time and gains in accuracy, and how long whole
// combinations of settings take. All prices are computed from a report. It does not matter whether
// the report was read from a file or is being filled by the preview (dip_cost_is_view).
//
// The base is the combination with the settings of the report's baseline. The price of a step is
// the difference that the step makes to the base. It comes from a path on which rows with and
// without the step were measured, or from path 0 if one of the two is predicted. A setting that has
// no effect alone is priced together with its company: the settings that it needs, which are then
// set both with the step and without it (view.h). AF and advanced AF are also priced together with
// the antialiasing of the pane (one of the preview's two pictures), so that prices add up. If this
// price was not measured, two others may replace it: first the price with the pane's AA but the
// base's adaptive AA, then the price with the base's antialiasing. Of the three, the one of which
// most is known is taken, and the earliest of them if equally much is known.
//
// A combination without a row is predicted: by the report's own predictions, otherwise by the
// models of times and errors (fit.h) from its composed work (combinations.h). If there are too few
// rows for the models or for composing the work, its time is the time of the base (or of a measured
// combination that is more like it) plus the prices of the steps in which the two differ.
#ifndef DIP_APP_REPORT_PRICES_PRICES_H
#define DIP_APP_REPORT_PRICES_PRICES_H

#include "app/report/choice.h"
#include "app/report/report.h"

typedef enum DipPriceState {
    DIP_PRICE_UNKNOWN, // The time was neither measured nor predicted, at least not yet.
    DIP_PRICE_BASE,    // The other steps are compared with this one: ms and flip are the whole time
                       // and error of a combination with this step (DipPriceQuestion.with, view.h).
    DIP_PRICE_MEASURED,  // Measured along a path.
    DIP_PRICE_PREDICTED, // Not timed, but predicted by a report's model (fit.h).
    DIP_PRICE_ROUGH      // Measured with a few frames of one picture, or computed by adding prices.
} DipPriceState;

// How a time may be shown. Every part of the program that shows or uses a price asks
// dip_price_trust or dip_price_sum_trust, so that no number looks surer in one place than in
// another.
typedef enum DipPriceTrust {
    DIP_PRICE_TRUST_UNKNOWN,  // There is no number.
    DIP_PRICE_TRUST_DOUBTFUL, // The interval is too wide, or the machine was too busy. The time is
                              // shown with one significant digit and "?". In the preview's bar of a
                              // sum, it has no part of its own: the hatched part includes it.
    DIP_PRICE_TRUST_ZERO,     // The time is 0 as far as anyone can tell: "≈ 0".
    DIP_PRICE_TRUST_KNOWN
} DipPriceTrust;

// One step's price. `state` tells about the time: an UNKNOWN price can have an error, because a
// report can have errors without times. A price with a time can lack an error. Intervals are 95 %
// intervals.
typedef struct DipPrice {
    DipPriceState state;
    double ms; // Milliseconds that the step adds. If `state` is BASE, the whole time.
    double ms_low;
    double ms_high;
    double without_ms;  // The whole time without the step; 0 if `state` is BASE.
    bool has_flip;      // True if the error is known. (The preview has times before it has errors.)
    double flip;        // What the step adds to FLIP. If `state` is BASE, the whole FLIP.
    bool flip_at_floor; // True if the error with the step cannot be told from the noise of the
                        // converged picture that it is measured against.
    bool needs_company; // True if the step has no effect with the settings of the pane. `needs`
                        // then says what the pane lacks, such as "AF".
    char needs[24];
    char beside[48]; // The company: "aa=8,aaa=on"; "" if there is none.
    char path[32];   // Name of the path that the price is for, such as "DEFAULT"; "" if nothing is
                     // known or if the report is of one picture.
    // True if the machine was too busy for the report's times to be believed (the report's verdict
    // is red).
    bool doubtful;
} DipPrice;

// The whole time of one combination of settings, and its parts. The sum of base_ms, all parts_ms
// and together_ms is exactly ms.
typedef struct DipPriceSum {
    // MEASURED if this very combination was timed along a path, and ROUGH if it was timed in one
    // picture. Otherwise PREDICTED, or ROUGH if prices of steps were added up. UNKNOWN if one of
    // these prices is not known; ms then lacks it.
    DipPriceState state;
    double ms;
    double ms_low;
    double ms_high;
    // The time that is compared with a budget, and its kind: that of DipCostOptions.budget_of, if
    // the report knows it of this combination, and the mean (ms) otherwise.
    DipTimeKind judged_by;
    double judged_ms;
    bool has_flip;
    double flip;
    double base_ms;
    DipPriceTrust base_trust; // dip_price_sum_trust of the base alone.
    // The price of each setting's step. The group size (asd) has no part of its own: its price is
    // in the part of adaptive AA.
    double parts_ms[DIP_SETTING_COUNT];
    DipPriceTrust parts_trust[DIP_SETTING_COUNT];
    double together_ms; // By how much ms exceeds the sum of the base and the parts; it may be
                        // negative.
    bool doubtful;      // As in DipPrice.
} DipPriceSum;

DipPriceTrust dip_price_trust(const DipPrice *price);
DipPriceTrust dip_price_sum_trust(const DipPriceSum *sum);

// A view finds the rows of a report by their settings, and holds the models that predict other
// combinations.
typedef struct DipPriceView DipPriceView;

// The report is borrowed until the view is destroyed. Fails with DIP_ERROR_MEMORY.
DipPriceView *dip_price_view_create(const DipCostReport *report, DipError *err);
void dip_price_view_destroy(DipPriceView **view); // *view may be NULL.

// Updates the view. Call it after the rows, times or errors of its report have changed. Fails with
// DIP_ERROR_MEMORY.
bool dip_price_view_update(DipPriceView *view, DipError *err);

const DipCostReport *dip_price_view_report(const DipPriceView *view);

// Returns the settings of the base, which are those of the report's baseline.
DipQuality dip_price_base(const DipPriceView *view);

// Returns the row with these settings on path 0, or a row that draws the same pictures, or -1 if
// there is neither.
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

// Lists the candidates for a choice from a report that has not measured combinations along a path.
// They are the combinations of aa, aaa, af, aaf, opt and miplod, measured or predicted, with the
// other settings of the base. The prices of the steps of these settings, for a pane with the
// settings `like`, must be known first. Exceptions are steps without effect for this pane, and
// steps that reports of earlier versions lack. Until the prices are known, the list is NULL and the
// result is not DIP_PRICES_KNOWN. The caller frees candidates->list. Takes some milliseconds. When
// memory runs out, the result is DIP_PRICES_NO_TIMES.
DipPricesKnown dip_price_candidates(const DipPriceView *view, const DipQuality *like,
                                    DipCandidates *candidates);

// Lists the combinations that must be timed so that every step has a price, and so that the whole
// times of both panes and of every combination one step away from the pane `requested` are known.
// The base and the panes come first, then the combinations for the steps, ordered by their distance
// from the steps of `requested`, and then the combinations one step away. The combinations for AF
// and advanced AF with the base's antialiasing come last. Writes at most `room` combinations;
// returns their number.
enum { DIP_PRICE_MAX_WANTED = 96 };
int dip_price_list_wanted(const DipQuality *base, const DipQuality *current,
                          const DipQuality *requested, DipQuality *list, int room);

#endif
