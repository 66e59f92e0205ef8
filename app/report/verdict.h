// The verdict on the machine: was it quiet enough for its times to be believed?
//
// The verdict needs two signs, because each is blind to what the other sees. The waiting time of
// the threads shows other programs on this machine. The A/A rows (the baseline, timed as if it were
// another setting) show what the machine itself cannot know, such as a neighbour on the host of a
// virtual machine.
#ifndef DIP_APP_REPORT_VERDICT_H
#define DIP_APP_REPORT_VERDICT_H

#include "app/report/report.h"

// The signs from which a verdict follows.
typedef struct DipCostSigns {
    double wait;      // Waiting time of the threads, as a share of the time on all threads.
    double spread;    // Greatest spread of an A/A ratio over the rounds (dip_times_spread).
    double offset;    // Greatest |log| of an A/A ratio.
    double disturbed; // Share of the pairs that stayed disturbed.
    bool settled;     // The time was steady before the rounds.
} DipCostSigns;

// Limits of the signs. Above `red`, times are wrong; up to `green`, they hold.
typedef struct DipCostLimits {
    double green;
    double red;
} DipCostLimits;

extern const DipCostLimits dip_cost_wait_limits;
extern const DipCostLimits dip_cost_spread_limits;
extern const DipCostLimits dip_cost_offset_limits;

// Collects the signs that the times of some subjects give; same[] are the A/A subjects. The waiting
// time is left 0, and the times count as settled.
DipCostSigns dip_cost_signs_of(const DipTimesFit *fit, int subjects, const int *same,
                               int same_count);

// Returns the verdict, and writes the reason as a sentence.
DipCostVerdict dip_cost_verdict_of(const DipCostSigns *signs, char reason[DIP_COST_REASON]);

// Fills in the verdict of a report whose report->fit is made, and report->doubt: if the verdict
// is amber, how far the baseline, timed twice, differs from itself, or from round to round.
void dip_cost_judge_machine(DipCostReport *report);

#endif
