// Chooses settings by their time and error, with the only Pareto front and the only advice of the
// program. The functions know numbers alone, so the same figures give the same choice wherever they
// come from: a report, several reports, or prices that are measured live.
#ifndef DIP_APP_REPORT_CHOICE_H
#define DIP_APP_REPORT_CHOICE_H

#include "app/measure/stats/estimate.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

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
    double loss;         // FLIP for ranking: at least the FLIP that the noise of the truth makes.
    double flip;         // FLIP as it was measured.
    int row;             // Where the caller keeps the combination.
    int report;          // With several reports: the one that the time comes from.
} DipCandidate;

typedef struct DipCandidates {
    DipCandidate *list;
    int count;
    DipTimeKind kind; // The kind of all times in the list, and so of their differences.
    bool disturbed;   // The machine was so busy that the times are wrong. Nothing is advised.
} DipCandidates;

// A candidate is clearly better than another if its loss is lower by this share. A smaller
// difference is not worth time.
#define DIP_CLEARLY_BETTER 0.01

// A candidate is advised if it keeps within the budget with this probability.
#define DIP_SURELY_FITS 0.95

// Returns the probability that a candidate's time is within the budget; NAN if nothing is known of
// the error of its time.
double dip_candidate_fits(const DipCandidate *candidate, double budget_ms);

// Returns the fastest candidate whose loss is below `loss` by at least the share `step`. Returns -1
// if there is none.
int dip_next_better(const DipCandidates *candidates, double loss, double step);

// Lists the Pareto front in order of time: the fastest candidate, and after each candidate the next
// better one (dip_next_better). `list` has room for all candidates. Returns the number of those
// listed.
int dip_front(const DipCandidates *candidates, double step, int *list);

// Returns the index in `front` (in order of time) of the front's knee: the candidate beyond which
// more time buys least. In a plot of log time against log loss, the knee is the point farthest
// below the line from the first to the last candidate (Satopaa et al. 2011). Returns -1 for fewer
// than three.
int dip_front_knee(const DipCandidates *candidates, const int *front, int count);

enum { DIP_ADVICE_TIES = 8 };

// What to choose for a time budget. Candidates are indices in the list.
typedef struct DipAdvice {
    double budget_ms;
    int chosen;  // -1: nothing fits surely.
    double fits; // Probability that the chosen one fits the budget.
    // Others that surely fit and whose loss is within 1 % of the least, the fastest first.
    int ties[DIP_ADVICE_TIES];
    int tie_count;  // Number of all ties; the list has the first DIP_ADVICE_TIES.
    int next;       // The next better than the chosen one, or the fastest if none is chosen; or -1.
    double next_ms; // How much longer `next` takes than the chosen one, or than the budget.
    double next_fits; // Probability that `next` fits this budget.
} DipAdvice;

// Chooses among the candidates that surely fit and whose loss is within 1 % of the least such loss.
// The times of some of these cannot be told from the time of the fastest, since their intervals
// overlap. The chosen one of them has the fewest settings off their defaults. If the times are
// disturbed, nothing is chosen, and nothing is next.
DipAdvice dip_advise(const DipCandidates *candidates, double budget_ms);

#endif
