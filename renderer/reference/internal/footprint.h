// Private to the reference path (and its tests): level of detail and anisotropy of a footprint.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_FOOTPRINT_H
#define DIP_RENDERER_REFERENCE_INTERNAL_FOOTPRINT_H

#include <stdbool.h>

typedef struct DipFootprint {
    double major_texels[2]; // the line that the probes lie on, its whole length, in level 0
    double eta;             // anisotropy that is made up for by probes, 1..max
    int probe_count;        // 1..max; of the finer of two levels
    double lambda;          // before bias and clamping; may be infinite or NaN
} DipFootprint;

// ddx and ddy: the Jacobian in texels of level 0 per pixel. max_anisotropy 1 is trilinear, for
// which `exact_footprint` has no meaning. min_level: the finest that may be read; probes lie no
// closer than its texels. For a Jacobian that is not finite: one probe, lambda NaN.
DipFootprint dip_reference_footprint(const double ddx[2], const double ddy[2], int max_anisotropy,
                                     bool exact_footprint, int min_level);

// The probes of the coarser of two levels, of which it has that fraction.
int dip_reference_coarser_probes(int probe_count, double fraction);

// The level to read, in steps of 1/256 within [min_level, last_level]; last_level wins where the
// chain is shorter than min_level.
double dip_reference_level(double lambda, double bias, int min_level, int last_level);

#endif
