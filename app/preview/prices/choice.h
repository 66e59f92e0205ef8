// What the preview can choose now: the combinations of the cost report or of live prices, the
// advice for the budget, and presets. All of it follows from one list of candidates
// (app/report/choice.h), so the tab of advice, the key for advice and the presets agree.
#ifndef DIP_APP_PREVIEW_PRICES_CHOICE_H
#define DIP_APP_PREVIEW_PRICES_CHOICE_H

#include "app/preview/prices/prices.h"

typedef enum DipChoiceState {
    DIP_CHOICE_NO_TIMES,  // Times are missing, so nothing can be chosen.
    DIP_CHOICE_NO_ERRORS, // Errors are missing.
    DIP_CHOICE_DISTURBED, // The times are wrong: the machine was too busy.
    DIP_CHOICE_KNOWN
} DipChoiceState;

// Presets that are measured: the fastest settings that reach a share of what the best within the
// budget gains over the fastest of all.
enum { DIP_MEASURED_PRESETS = 4 };

// Zero-initialise.
typedef struct DipPreviewChoice {
    DipChoiceState state;
    bool live;                // From live prices, so times are means of this view.
    DipCandidates candidates; // Those that the report measured, or prices of one picture.
    int *front;               // The thinned front: indices of candidates. Owned.
    int front_count;
    int base;         // The candidate with the settings that prices start from, or -1.
    DipAdvice advice; // For the budget.
    int presets[DIP_MEASURED_PRESETS]; // Candidates, or -1 while nothing fits.
    // What all of it was computed from.
    bool is_made;
    unsigned price_changes;
    bool of_like; // The candidates depend on `like`.
    DipQuality like;
    DipCandidate *own_list; // Owned.
} DipPreviewChoice;

// Computes the choice again if something has changed. prices may be NULL. like: the settings of the
// requested pane. Returns whether it was computed.
bool dip_preview_choose(DipPreviewChoice *choice, const DipPrices *prices, const DipQuality *like,
                        double budget_ms);

// Asks for another budget at once.
void dip_preview_choice_set_budget(DipPreviewChoice *choice, double budget_ms);
void dip_preview_choice_free(DipPreviewChoice *choice);

// Returns what is advised for the budget, or NULL.
const DipCandidate *dip_preview_advised(const DipPreviewChoice *choice);

// Says in a sentence why nothing is advised: what is awaited, with `progress`, or that nothing
// fits.
void dip_preview_choice_why(const DipPreviewChoice *choice, const char *progress, char *text,
                            size_t size_bytes);

// Writes the advice as a line: "Within 16.7 ms: 11.2 ms p95, FLIP .0451, fits with 99 %; baseline
// 6.5 ms, .0773".
void dip_preview_choice_describe(const DipPreviewChoice *choice, char *text, size_t size_bytes);

#endif
