// Choosing settings by their time and error: the only Pareto front and the only advice of the
// program. The functions know numbers alone, so the same figures give the same choice wherever they
// come from: a report, several reports, or prices that are measured live.
#ifndef DIP_APP_REPORT_CHOICE_H
#define DIP_APP_REPORT_CHOICE_H

#include "app/measure/stats/estimate.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The time of a path's frames that must be within a budget.
typedef enum DipTimeKind {
    DIP_TIME_P95,  // The 95th percentile over the frames.
    DIP_TIME_MEAN, // The mean over the frames.
    DIP_TIME_WORST // The slowest frame.
} DipTimeKind;

enum { DIP_TIME_KIND_COUNT = 3 };
extern const char *const dip_time_kind_names[DIP_TIME_KIND_COUNT]; // "p95", "mean", "worst"

// A combination of settings that can be chosen.
typedef struct DipCandidate {
    DipQuality quality;
    DipEstimate time;    // Milliseconds per frame.
    double common_error; // Standard error of the time's logarithm that all candidates share.
    double loss;         // FLIP by which candidates rank: at least what the truth's noise makes.
    double flip;         // FLIP as it was measured.
    int row;             // Where the caller keeps the combination.
    int report;          // With several reports: the one that the time comes from.
} DipCandidate;

typedef struct DipCandidates {
    DipCandidate *list;
    int count;
    DipTimeKind kind; // Of all times in the list, and so of all differences of them.
    bool disturbed;   // The times are wrong (a red machine), so nothing is advised.
} DipCandidates;

// A candidate is clearly better than another if its loss is lower by this share. Less is not worth
// time.
#define DIP_CLEARLY_BETTER 0.01

// A candidate is advised if it keeps within the budget with this probability.
#define DIP_SURELY_FITS 0.95

// Returns the probability that a candidate's time is within the budget; NAN if nothing is known of
// the error of its time.
double dip_candidate_fits(const DipCandidate *candidate, double budget_ms);

// Returns the fastest candidate whose loss is at least `step` (a share) below `loss`, or that has
// less than it for a step of 0. Returns -1 if there is none.
int dip_next_better(const DipCandidates *candidates, double loss, double step);

// Lists the Pareto front in order of time: the fastest candidate, then always dip_next_better than
// the one before. `list` has room for all candidates. Returns the number of those listed.
int dip_front(const DipCandidates *candidates, double step, int *list);

// Returns the index in `front` (in order of time) of its knee: the candidate beyond which more time
// buys least. In a plot of log time against log loss it is the point farthest below the line from
// the first to the last (Satopaa et al. 2011). Returns -1 for fewer than three.
int dip_front_knee(const DipCandidates *candidates, const int *front, int count);

enum { DIP_ADVICE_TIES = 8 };

// What to choose for a time budget. Candidates are indices in the list.
typedef struct DipAdvice {
    double budget_ms;
    int chosen;  // -1: nothing fits surely.
    double fits; // Probability that the chosen one fits the budget.
    // Others that surely fit and whose loss is within 1 % of the least, the fastest first.
    int ties[DIP_ADVICE_TIES];
    int tie_count;  // All of them; the list has the first DIP_ADVICE_TIES.
    int next;       // The next better than the chosen one, or the fastest if none is chosen; or -1.
    double next_ms; // How much longer it takes than the chosen one, or than the budget.
    double next_fits; // Probability that it fits this budget.
} DipAdvice;

// Chooses the least loss of what surely fits; within 1 % of it the fastest, and of those whose
// intervals overlap with the fastest one's, the one with the fewest settings off their defaults. Of
// disturbed times nothing is chosen, and nothing is next.
DipAdvice dip_advise(const DipCandidates *candidates, double budget_ms);

#ifdef __cplusplus
}
#endif

#endif
