// Which two combinations of settings make the price of a step: one with the step and one without.
//
// A setting that does nothing alone is priced beside its company, which both combinations have:
// temporal AA and adaptive AA beside the AA of the pane, advanced AF beside the AF of the pane. The
// group sizes of adaptive AA are priced together with adaptive AA, against the same AA without it.
//
// AF and advanced AF also have the antialiasing of the pane as company. They cost more where
// antialiasing shades more fragments, so their prices alone would not add up to the time of the
// whole: the courtyard in 8x AA with adaptive AA and AF 16x takes 11 % more than that sum.
#ifndef DIP_APP_REPORT_PRICES_QUESTION_H
#define DIP_APP_REPORT_PRICES_QUESTION_H

#include "renderer/scene/quality.h"

#include <stdbool.h>

enum { DIP_PRICE_NEEDS = 24 };

typedef struct DipPriceQuestion {
    DipQuality with;             // The base, the company and the step.
    DipQuality without;          // The base and the company.
    bool is_base;                // The step is that of the base, so both combinations are equal.
    char needs[DIP_PRICE_NEEDS]; // What the pane lacks for the step to do anything: "AF", or "".
} DipPriceQuestion;

// base: the settings that prices start from. quality: the other settings of the pane. If the pane
// lacks the company, the question has company that makes the step do something.
DipPriceQuestion dip_price_question(const DipQuality *base, DipSetting setting, int step,
                                    const DipQuality *quality);

// Returns settings that draw the same picture, with everything that has no effect as in `base`:
// advanced AF without AF, temporal AA without samples, adaptive AA with one group of samples, and
// group sizes without adaptive AA. Mip colours are taken out too, because they have no price.
DipQuality dip_price_normal(const DipQuality *base, const DipQuality *quality);

// Lists the combinations that must be timed so that every step has a price, and so that the sums of
// both panes and of every combination one step away from the requested pane are known: the base and
// the panes first, then the steps in the order of their distance from the requested pane's, and at
// the end the steps of filtering without antialiasing. Writes at most `room`; returns their number.
enum { DIP_PRICE_MAX_WANTED = 96 };
int dip_price_list_wanted(const DipQuality *base, const DipQuality *current,
                          const DipQuality *requested, DipQuality *list, int room);

#endif
