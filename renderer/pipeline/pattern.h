// Sample patterns: where a pixel's samples are, and the groups into which adaptive antialiasing
// divides them. Positions are in 1/256 pixel from the pixel's top left corner.
//
// The standard patterns of 1, 2, 4 and 8 samples are those of Direct3D and Vulkan. The one of 6
// samples is a six-rooks lattice, chosen for the least error over all edge orientations and sorted
// by distance from the centre. (In an n-rooks pattern, each of n columns and n rows has one
// sample.) The two temporal patterns of n samples are n-rooks patterns whose mean is the pixel's
// centre; together they form a 2n-rooks pattern. All functions are thread-safe.
#ifndef DIP_RENDERER_PIPELINE_PATTERN_H
#define DIP_RENDERER_PIPELINE_PATTERN_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_MAX_SAMPLES = 8,
    DIP_SAMPLE_ROOM = 16, // length of arrays with an entry per sample: the widest vector fits
    DIP_MAX_SHARING = 4,  // most samples in a group, if there are several groups
};

typedef struct DipSamplePattern {
    int count;
    uint8_t least;    // smallest of all coordinates in x and y
    uint8_t greatest; // greatest of all coordinates in x and y
    uint8_t x[DIP_SAMPLE_ROOM];
    uint8_t y[DIP_SAMPLE_ROOM];
    // sharing[n][g]: the samples of group g, one bit per sample, if the pattern divides into
    // several groups of n >= 2 samples; otherwise 0. The groups are chosen so that their centroids,
    // taken as a pattern, have the least error over all edge orientations.
    uint8_t sharing[DIP_MAX_SHARING + 1][DIP_MAX_SAMPLES];
} DipSamplePattern;

typedef enum DipPatternKind {
    DIP_PATTERN_STANDARD,
    DIP_PATTERN_EVEN, // temporal antialiasing, frames 0, 2, ...
    DIP_PATTERN_ODD,  // temporal antialiasing, frames 1, 3, ...
    DIP_PATTERN_KINDS
} DipPatternKind;

// Returns the standard pattern of 1, 2, 4, 6 or 8 samples. Static storage.
DIP_API const DipSamplePattern *dip_sample_pattern(int sample_count);

// Returns a kind's pattern of 1, 2, 4, 6 or 8 samples. A single sample is at the pixel's centre in
// every kind. Static storage.
DIP_API const DipSamplePattern *dip_sample_pattern_of(int sample_count, DipPatternKind kind);

// Returns the kind of pattern that a frame uses with or without temporal antialiasing.
static inline DipPatternKind dip_pattern_kind(bool temporal, uint64_t frame_index) {
    return !temporal ? DIP_PATTERN_STANDARD : frame_index % 2 ? DIP_PATTERN_ODD : DIP_PATTERN_EVEN;
}

// The groups of one pattern's samples, for adaptive antialiasing.
typedef struct DipSampleGroups {
    int count;                        // number of groups; 1: no adaptive antialiasing
    uint8_t samples[DIP_MAX_SAMPLES]; // the samples of each group, one bit each
    uint8_t sharing[DIP_MAX_SAMPLES]; // the group that each sample belongs to, as bits of samples
    // Mean position of every set of samples, rounded down, as x | y << 8. The index is the set, one
    // bit per sample; the entry of the empty set is 0.
    int32_t centroid[1 << DIP_MAX_SAMPLES];
} DipSampleGroups;

// Returns whether adaptive antialiasing can divide sample_count samples into groups of
// samples_per_group.
DIP_API bool dip_sample_groups_exist(int sample_count, int samples_per_group);

// Fills in the groups of a pattern. samples_per_group: a number for which dip_sample_groups_exist
// returns true.
DIP_API void dip_sample_groups_make(DipSampleGroups *groups, const DipSamplePattern *pattern,
                                    int samples_per_group);

#ifdef __cplusplus
}
#endif

#endif
