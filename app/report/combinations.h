// Lists the combinations of the steps of several settings (--combine). Composes the work of a
// combination whose work was not counted from the work of combinations that were counted.
#ifndef DIP_APP_REPORT_COMBINATIONS_H
#define DIP_APP_REPORT_COMBINATIONS_H

#include "app/report/report.h"

#include <stdint.h>

// Lists every combination of the steps of the settings in the mask `settings` (bit s for setting
// s). All other settings are those of the baseline. Leaves out combinations that the renderer
// refuses, and combinations in which an enabled setting has no effect (dip_quality_effective),
// since another combination draws the same picture. Advanced AF without AF is an example. If asd is
// among the settings, also leaves out aaa=all with groups of several samples, because frames with
// aaa=all take long. Returns the number of combinations; the list has the first `room` of them.
int dip_cost_list_combinations(const DipQuality *baseline, unsigned settings, DipQuality *list,
                               int room);

// Returns how many combinations dip_cost_list_combinations would list. They need not be listed to
// be counted, so millions may be counted.
int64_t dip_cost_count_combinations_of(const DipQuality *baseline, unsigned settings);

// Returns `from` with the settings of `mask` (bit s for setting s) taken from `with`.
DipQuality dip_cost_take_settings(const DipQuality *from, const DipQuality *with, unsigned mask);

// Alternating temporal AA does nothing without AA, advanced AF does nothing without AF, and an
// upscaling filter does nothing without a scale below 1. Reports and prices therefore measure
// temporal AA together with DIP_COST_COMPANY_AA if AA is off, advanced AF together with
// DIP_COST_COMPANY_AF if AF is off, and upscaling filters together with DIP_COST_COMPANY_SCALE if
// the scale is not below 1.
enum { DIP_COST_COMPANY_AA = 2, DIP_COST_COMPANY_AF = 4, DIP_COST_COMPANY_SCALE = DIP_SCALE_1_1_5 };

// --- composed work -------------------------------------------------------------------------------

// Groups of settings change the work nearly independently of each other: the settings of samples
// (antialiasing, temporal AA, adaptive AA and its groups), anisotropic filtering with advanced AF,
// texture optimisation, mip detail, render scale with its upscaling filter, post-process AA,
// sharpening, shadows, and instancing. A composed counter is the base combination's counter, times
// the factors by which each group alone changes it. The pixels that filters write follow from the
// settings instead, and the work of shadows is added.
//
// Two pairs of settings depend on each other. Antialiasing and render scale together decide how
// many samples lie on a small triangle, and so whether it is drawn, and how many pixels show
// several fragments. Post-process AA finds fewer edges in a picture that is drawn smaller.
// Combinations that change both settings of a pair and nothing else are therefore counted, too
// (corners). They correct the product of the two factors.

// Returns how many pixels all filters of the finished picture write, per pixel of the frame.
double dip_cost_pixels_filtered(const DipQuality *quality);

enum { DIP_WORK_GROUPS = 9 };

// Returns the mask of the settings of a group, 0 to DIP_WORK_GROUPS - 1. Group 0 has the settings
// of samples.
unsigned dip_work_group(int group);

// Returns the counters [DIP_COUNTER_COUNT] of a combination, or NULL if it was not counted.
// They are borrowed until dip_work_compose returns.
typedef const double *DipWorkFind(const void *context, const DipQuality *quality);

enum { DIP_WORK_PAIRS = 2 };

// Returns the mask of the two settings of a pair, 0 to DIP_WORK_PAIRS - 1.
unsigned dip_work_pair(int pair);

// Holds the counters of the base with other steps of the two settings of a pair, indexed
// [pair][step of the setting that DipSetting lists first][step of the other]. An entry is NULL if
// its combination was not counted.
enum { DIP_WORK_MOST_STEPS = 8 };
typedef struct DipWorkCorners {
    const double *of[DIP_WORK_PAIRS][DIP_WORK_MOST_STEPS][DIP_WORK_MOST_STEPS];
} DipWorkCorners;

// Returns whether a combination is a corner: it differs from the base in both settings of a pair,
// and in nothing else.
bool dip_work_is_corner(const DipQuality *base, const DipQuality *quality);

// Notes the counters of a combination, which are borrowed, for each pair if it differs from the
// base at most in the settings of this pair.
void dip_work_note_corner(DipWorkCorners *corners, const DipQuality *base,
                          const DipQuality *quality, const double *counters);

// Composes the counters of a combination. The settings of samples and those of shadows are always
// groups of their own. All other groups are treated as one group if the base with the settings of
// all of them was counted; otherwise each is treated by itself. Returns false if a combination that
// is needed was not counted, or if the combination differs from the base in a setting that belongs
// to no group.
bool dip_work_compose(DipWorkFind *find, const void *context, const DipQuality *base,
                      const DipQuality *quality, double counters[DIP_COUNTER_COUNT]);

// Composes the counters of one combination after another that share some parts. A part is the base
// with the settings of one or more groups taken from the combination; each group belongs to one
// part. A part that changes the shadows must change no other setting. A DipWorkSum may be copied at
// any time, to go on in several ways. It borrows all counters.
typedef struct DipWorkSum {
    const DipQuality *base;
    const double *of_base;
    const double *of_shadows;      // Counters of the base with the combination's shadows, or NULL.
    const DipWorkCorners *corners; // Borrowed; NULL if there are none.
    double counters[DIP_COUNTER_COUNT];
    double pixels; // Pixels of a frame; 0 if neither the base nor a part filters them.
} DipWorkSum;

DipWorkSum dip_work_begin(const DipQuality *base, const double *of_base);
void dip_work_add(DipWorkSum *sum, const DipQuality *part, const double *of_part);

// Writes the counters of the combination `quality`, whose parts have all been added.
void dip_work_end(const DipWorkSum *sum, const DipQuality *quality,
                  double counters[DIP_COUNTER_COUNT]);

// Returns the number of groups in which a combination differs from the base, or -1 if it differs in
// a setting that belongs to no group.
int dip_work_count_groups(const DipQuality *base, const DipQuality *quality);

#endif
