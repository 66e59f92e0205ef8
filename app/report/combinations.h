// The combinations of the steps of several settings (--combine).
#ifndef DIP_APP_REPORT_COMBINATIONS_H
#define DIP_APP_REPORT_COMBINATIONS_H

#include "renderer/scene/quality.h"

// Lists every combination of the steps of the settings in the mask `settings` (bit s: setting s).
// All other settings are those of the baseline. Leaves out combinations that the renderer refuses,
// and those in which an enabled setting has no effect, since another combination draws the same
// picture: advanced AF without AF, temporal AA without samples, and adaptive AA with a single group
// of samples. Returns the number of combinations; the list has the first `room` of them.
int dip_cost_list_combinations(const DipQuality *baseline, unsigned settings, DipQuality *list,
                               int room);

// --- settings whose work is counted together -----------------------------------------------------

// Returns the settings that decide which samples and fragments are drawn (bit s: setting s), which
// are antialiasing and its variants. All other settings decide how textures are read.
unsigned dip_cost_sampling_settings(void);

// Returns `from` with the settings of `mask` (bit s: setting s) taken from `with`.
DipQuality dip_cost_take_settings(const DipQuality *from, const DipQuality *with, unsigned mask);

#endif
