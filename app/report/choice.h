// Chooses settings by their time and error. The whole program takes its Pareto fronts and its
// advice from here. The functions work on numbers alone, so equal numbers lead to the same choice,
// whether they come from a report, from several reports, or from prices that the preview measures.
#ifndef DIP_APP_REPORT_CHOICE_H
#define DIP_APP_REPORT_CHOICE_H

#include "app/measure/stats/estimate.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

// Which time of a path's frames must be within a budget.
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
    DipEstimate time; // Milliseconds per frame.
    // All candidates' times may be too long or too short by one common, unknown factor.
    // common_error is the standard error of this factor's logarithm. time.log_error does not
    // include this error.
    double common_error;
    double loss; // FLIP for ranking: the measured FLIP, or the FLIP that the noise of the
                 // converged picture makes if that is greater.
    double flip; // FLIP as it was measured.
    int row;     // Index by which the caller finds the combination again.
    int report;  // With several reports, index of the report that the time comes from.
} DipCandidate;

typedef struct DipCandidates {
    DipCandidate *list;
    int count;
    DipTimeKind kind; // The kind of all times in the list.
    bool disturbed;   // True if the machine was so busy that the times are wrong. Nothing is then
                      // advised.
} DipCandidates;

// A candidate is clearly better than another if its loss is lower by at least this share. A smaller
// difference is not worth a longer time.
#define DIP_CLEARLY_BETTER 0.01

// A candidate surely fits a budget if its time is within the budget with at least this probability.
#define DIP_SURELY_FITS 0.95

// Returns the probability that a candidate's time is within the budget; NAN if the error of its
// time is not known.
double dip_candidate_fits(const DipCandidate *candidate, double budget_ms);

// Returns the index of the fastest candidate whose loss is below `loss` by at least the share
// `step`. Returns -1 if there is none.
int dip_next_better(const DipCandidates *candidates, double loss, double step);

// Writes the indices of the candidates on the Pareto front to `list`, in order of time: first the
// fastest candidate, and after each candidate the next better one (dip_next_better). `list` must
// have room for all candidates. Returns the number of indices.
int dip_front(const DipCandidates *candidates, double step, int *list);

// Returns the index in `front` (in order of time) of the front's knee: the candidate after which
// more time lowers the loss much less than before. In a plot of log time against log loss, the knee
// is the point farthest below the line from the first to the last candidate (Satopaa et al. 2011).
// Returns -1 if there are fewer than three candidates or if none lies below the line.
int dip_front_knee(const DipCandidates *candidates, const int *front, int count);

enum { DIP_ADVICE_TIES = 8 };

// What to choose for a time budget. `chosen`, `ties` and `next` are indices of candidates.
typedef struct DipAdvice {
    double budget_ms;
    int chosen;  // -1 if no candidate surely fits (DIP_SURELY_FITS).
    double fits; // Probability that the chosen candidate fits the budget; NAN if none is chosen.
    // The other candidates that surely fit and whose loss is at most 1 % above the least loss of
    // those that surely fit, the fastest first.
    int ties[DIP_ADVICE_TIES];
    int tie_count; // Number of all ties; the list has the first DIP_ADVICE_TIES.
    // The fastest candidate that is clearly better than the chosen one (DIP_CLEARLY_BETTER), or the
    // fastest of all if none is chosen; -1 if there is none or if the times are disturbed.
    int next;
    double next_ms; // How much longer `next` takes than the chosen candidate, or than the budget if
                    // none is chosen; 0 if `next` is -1.
    double next_fits; // Probability that `next` fits this budget; NAN if `next` is -1.
} DipAdvice;

// Chooses among the candidates that surely fit and whose loss is at most 1 % above the least loss
// of those that surely fit. Keeps the fastest of these, and those whose time has an interval that
// overlaps the fastest one's, since their times cannot be told apart. Of these candidates, chooses
// the one with the fewest settings off their defaults; if several have equally few, chooses the
// fastest of them. If the times are disturbed, `chosen` and `next` are -1.
DipAdvice dip_advise(const DipCandidates *candidates, double budget_ms);

#endif
