// Finds the two combinations of settings whose difference is the price of a step: one with the step
// and one without.
//
// A setting that does nothing alone is priced beside its company: other settings, which both
// combinations have. Temporal AA and adaptive AA are priced beside the AA of the pane, advanced AF
// beside the AF of the pane. The group sizes of adaptive AA are priced together with adaptive AA,
// against the same AA without it.
//
// AF and advanced AF also have the antialiasing of the pane as company. They cost more where
// antialiasing shades more fragments, so their prices without it would not add up to the time of
// the whole combination: the courtyard in 8x AA with adaptive AA and AF 16x takes 11 % more than
// that sum.
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

// The settings of antialiasing, which AF and advanced AF have as company (bit s: setting s).
enum { DIP_PRICE_ANTIALIASING = 1 << DIP_SETTING_AA | 1 << DIP_SETTING_AAA | 1 << DIP_SETTING_ASD };

// Returns whether the setting is AF or advanced AF.
static inline bool dip_price_filters(DipSetting setting) {
    return setting == DIP_SETTING_AF || setting == DIP_SETTING_AAF;
}

// base: the settings that prices start from. quality: the other settings of the pane. If the pane
// lacks the company, the question has company that makes the step do something.
DipPriceQuestion dip_price_question(const DipQuality *base, DipSetting setting, int step,
                                    const DipQuality *quality);

// Returns settings that draw the same picture. Settings that have no effect get their step in
// `base`: advanced AF without AF, temporal AA without samples, adaptive AA with one group of
// samples, and group sizes without adaptive AA. Mip colours get it too, because they have no price.
DipQuality dip_price_normal(const DipQuality *base, const DipQuality *quality);

// Lists the combinations that must be timed so that every step has a price, and so that the whole
// times of both panes and of every combination one step away from the requested pane are known. The
// base and the panes come first, then the steps in the order of their distance from those of the
// requested pane, and at the end the steps of filtering without antialiasing. Writes at most `room`
// combinations; returns their number.
enum { DIP_PRICE_MAX_WANTED = 96 };
int dip_price_list_wanted(const DipQuality *base, const DipQuality *current,
                          const DipQuality *requested, DipQuality *list, int room);

#endif
