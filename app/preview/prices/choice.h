// Finds what the preview can choose now: the combinations of settings that have a time and an error
// from the cost report or from live prices, the advice for the time budget, and the presets. All of
// it follows from one list of candidates (app/report/choice.h), so the advice tab, the key for
// advice and the presets agree.
#ifndef DIP_APP_PREVIEW_PRICES_CHOICE_H
#define DIP_APP_PREVIEW_PRICES_CHOICE_H

#include "app/preview/prices/prices.h"

// Number of presets that follow from measurements. The possible gain is how much less error the
// best settings within the budget have than the fastest settings of all. Each preset is the fastest
// combination of settings that reaches a certain share of this gain.
enum { DIP_MEASURED_PRESETS = 4 };

// Zero-initialise.
typedef struct DipPreviewChoice {
    DipPricesKnown known;     // Nothing can be chosen unless this is DIP_PRICES_KNOWN.
    bool live;                // The times come from live prices: they are mean times of this view.
    DipCandidates candidates; // Measured by the report, or priced from one picture.
    int *front;               // Indices of the candidates on the Pareto front (dip_front). Owned.
    int front_count;
    // Index of the candidate with the base settings: those of the report's baseline, or the
    // defaults (dip_prices_base). -1 if no candidate has them.
    int base;
    DipAdvice advice;                  // The advice for the budget.
    int presets[DIP_MEASURED_PRESETS]; // Indices of candidates, or -1 while nothing fits.
    // What the members above were computed from.
    bool is_made;           // The members above have been computed.
    unsigned price_changes; // dip_prices_changes when they were computed.
    bool of_like;           // The candidates depend on `like`.
    DipQuality like;        // The requested pane's settings when they were computed.
    DipCandidate *own_list; // candidates.list if the choice owns it; otherwise NULL.
} DipPreviewChoice;

// Computes the choice again if the prices or the budget have changed, or if the candidates depend
// on `like` and `like` has changed. prices: NULL if nothing is priced. like: the settings of the
// requested pane. Returns whether the choice was computed.
bool dip_preview_choose(DipPreviewChoice *choice, const DipPrices *prices, const DipQuality *like,
                        double budget_ms);

// Computes the advice and the presets anew for another budget.
void dip_preview_choice_set_budget(DipPreviewChoice *choice, double budget_ms);
void dip_preview_choice_free(DipPreviewChoice *choice);

// Returns the candidate that is advised for the budget. Returns NULL if nothing is advised or
// choice is NULL.
const DipCandidate *dip_preview_advised(const DipPreviewChoice *choice);

// Writes why nothing is advised: what is still being measured, followed by `progress`; that the
// report lacks times or was disturbed; or that nothing fits.
void dip_preview_choice_why(const DipPreviewChoice *choice, const char *progress, char *text,
                            size_t size_bytes);

// Writes the advice, or why nothing is advised, as a line: "Within 16.7 ms: 11.2 ms p95, FLIP
// .0451, fits with 99 %; baseline 6.5 ms, .0773".
void dip_preview_choice_describe(const DipPreviewChoice *choice, char *text, size_t size_bytes);

#endif
