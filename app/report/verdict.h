// Judges whether the machine was quiet enough for its times to be believed.
//
// The verdict follows mainly from two kinds of signs, because each shows what the other misses. The
// waiting time of the threads shows other programs on this machine. The A/A rows (the baseline,
// timed as if it were another setting) show disturbances from outside, such as another virtual
// machine on the same host. Two further signs tell whether too many times stayed disturbed, and
// whether the time of a frame was steady before the measurement.
#ifndef DIP_APP_REPORT_VERDICT_H
#define DIP_APP_REPORT_VERDICT_H

#include "app/report/report.h"

// The signs from which a verdict follows.
typedef struct DipCostSigns {
    double wait;      // Waiting time of the threads in all frames / (time of all frames * number of
                      // threads).
    double spread;    // Greatest spread of an A/A ratio over the rounds (dip_times_spread).
    double offset;    // Greatest |log| of an A/A ratio.
    double disturbed; // Share of the times that stayed disturbed (rounds.h).
    bool settled;     // True if the time of a frame was steady before the first round (driver.h).
} DipCostSigns;

// Limits of a sign. Up to `green` the verdict is green, above `red` it is red, and between them it
// is amber.
typedef struct DipCostLimits {
    double green;
    double red;
} DipCostLimits;

extern const DipCostLimits dip_cost_wait_limits;
extern const DipCostLimits dip_cost_spread_limits;
extern const DipCostLimits dip_cost_offset_limits;

// Collects the signs from the times of subjects 0 to subjects - 1. A subject is a combination that
// was timed (rounds.h). `same` lists the A/A subjects. Sets `wait` to 0 and `settled` to true,
// because the times do not tell them.
DipCostSigns dip_cost_signs_of(const DipTimesFit *fit, int subjects, const int *same,
                               int same_count);

// Returns the verdict, and writes the reason as a sentence.
DipCostVerdict dip_cost_verdict_of(const DipCostSigns *signs, char reason[DIP_COST_REASON]);

// Fills in report->verdict, its reason and report->doubt. report->fit must have been computed. For
// an amber verdict, the doubt is how far the A/A rows differ from the baseline on the whole, or the
// standard error that follows from their spread over the rounds, whichever is more. For other
// verdicts, the doubt is 0.
void dip_cost_judge_machine(DipCostReport *report);

#endif
