// Sample patterns: the positions of a pixel's samples, and the groups into which adaptive
// antialiasing divides the samples. Positions are in 1/256 pixel from the pixel's top left corner.
//
// The standard patterns of 1, 2, 4 and 8 samples are the standard patterns of Direct3D and Vulkan.
// In an n-rooks pattern, each of n columns and each of n rows has exactly one sample. The pattern
// of 6 samples is a six-rooks lattice: the one with the least error over all edge orientations. Its
// samples are sorted by distance from the centre. Temporal antialiasing alternates between two
// patterns of n samples. Each of them is an n-rooks pattern whose mean is the pixel's centre.
// Together they form a 2n-rooks pattern. All functions are thread-safe.
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
    // Length of arrays with an entry per sample. It is the number of lanes of the widest vector.
    DIP_SAMPLE_ROOM = 16,
    DIP_MAX_SHARING = 4, // most samples that a group has, if there are several groups
};

typedef struct DipSamplePattern {
    int count;
    uint8_t least;    // smallest coordinate of all samples, in x or y
    uint8_t greatest; // greatest coordinate of all samples, in x or y
    uint8_t x[DIP_SAMPLE_ROOM];
    uint8_t y[DIP_SAMPLE_ROOM];
    // sharing[n][g]: the samples of group g, one bit per sample, when the pattern is divided into
    // groups of n >= 2 samples. The entry is 0 if the pattern cannot be divided into several groups
    // of n. The groups' centroids, taken as a pattern, have the least error over all edge
    // orientations.
    uint8_t sharing[DIP_MAX_SHARING + 1][DIP_MAX_SAMPLES];
    // The order in which alpha to coverage keeps samples: a surface that may have n of them keeps
    // the first n. Of all orders, this is the one whose first samples stay nearest to the centre:
    // the sum, over n, of the squared distance of the first n samples' mean from the centre is
    // least. Samples that lie opposite each other therefore follow each other.
    uint8_t order[DIP_MAX_SAMPLES];
} DipSamplePattern;

typedef enum DipPatternKind {
    DIP_PATTERN_STANDARD,
    DIP_PATTERN_EVEN, // frames 0, 2, ... with temporal antialiasing
    DIP_PATTERN_ODD,  // frames 1, 3, ... with temporal antialiasing
    DIP_PATTERN_KINDS
} DipPatternKind;

// Returns the standard pattern of 1, 2, 4, 6 or 8 samples. Static storage.
DIP_API const DipSamplePattern *dip_sample_pattern(int sample_count);

// Returns the pattern of a kind with 1, 2, 4, 6 or 8 samples. In every kind, a pattern of 1 sample
// has its sample at the pixel's centre. Static storage.
DIP_API const DipSamplePattern *dip_sample_pattern_of(int sample_count, DipPatternKind kind);

// Returns the kind of pattern of a frame. temporal: temporal antialiasing is on.
static inline DipPatternKind dip_pattern_kind(bool temporal, uint64_t frame_index) {
    return !temporal ? DIP_PATTERN_STANDARD : frame_index % 2 ? DIP_PATTERN_ODD : DIP_PATTERN_EVEN;
}

// The groups into which adaptive antialiasing divides a pattern's samples.
typedef struct DipSampleGroups {
    int count;                        // number of groups; 1 means that the samples are not divided
    uint8_t samples[DIP_MAX_SAMPLES]; // the samples of each group, one bit each
    uint8_t sharing[DIP_MAX_SAMPLES]; // the samples of each sample's group, one bit each
    // Mean position of every set of samples, rounded down, as x | y << 8. The index is the set
    // itself, with one bit per sample. The entry of the empty set is 0.
    int32_t centroid[1 << DIP_MAX_SAMPLES];
} DipSampleGroups;

// Returns whether adaptive antialiasing can divide sample_count samples (1, 2, 4, 6 or 8) into
// groups of samples_per_group, which may be any number.
DIP_API bool dip_sample_groups_exist(int sample_count, int samples_per_group);

// Fills in the groups of a pattern. dip_sample_groups_exist must return true for samples_per_group.
DIP_API void dip_sample_groups_make(DipSampleGroups *groups, const DipSamplePattern *pattern,
                                    int samples_per_group);

#ifdef __cplusplus
}
#endif

#endif
