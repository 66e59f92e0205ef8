// Private to the reference renderer and its tests: the level of detail and anisotropy of a
// footprint. A footprint is the ellipse of texels that a pixel covers. Its probes are the
// positions, along its major axis, at which the texture is read.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_FOOTPRINT_H
#define DIP_RENDERER_REFERENCE_INTERNAL_FOOTPRINT_H

#include <stdbool.h>

typedef struct DipFootprint {
    double major_texels[2]; // from the start to the end of the line of probes, in texels of level 0
    double eta;             // anisotropy that the probes compensate for, 1..max
    int probe_count;        // 1..max, for the finer of the two levels
    double lambda;          // level of detail before bias and clamping; may be infinite or NaN
} DipFootprint;

// Computes a footprint. ddx and ddy are the Jacobian in texels of level 0 per pixel. If
// max_anisotropy is 1, filtering is trilinear and `exact_footprint` has no effect. min_level is the
// finest level that may be read; probes lie at least one texel of this level apart. A Jacobian that
// is not finite gives one probe and a lambda of NaN.
DipFootprint dip_reference_footprint(const double ddx[2], const double ddy[2], int max_anisotropy,
                                     bool exact_footprint, int min_level);

// Returns the number of probes for the coarser of two levels, whose weight is `fraction`.
int dip_reference_coarser_probes(int probe_count, double fraction);

// Returns the level to read, in steps of 1/256 within [min_level, last_level]. If the chain is
// shorter than min_level, the result is last_level.
double dip_reference_level(double lambda, double bias, int min_level, int last_level);

#endif
