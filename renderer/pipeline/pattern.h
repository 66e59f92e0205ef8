// Sample positions of every antialiasing step, in 1/256 pixel from the pixel's top left corner, and
// the groups that adaptive antialiasing shares them out to.
//
// Standard, 1, 2, 4, 8: the standard patterns of Direct3D and Vulkan. 6: a six-rooks lattice chosen
// for the least error over all edge orientations, sorted by distance from the centre. The temporal
// patterns of n samples are n-rooks about the centre whose union is a pattern of 2n-rooks.
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
    DIP_SAMPLE_ROOM = 16, // so that the widest vector may be read
    DIP_MAX_SHARING = 4,  // samples of a group, where there are several groups
};

typedef struct DipSamplePattern {
    int count;
    uint8_t least; // of all coordinates
    uint8_t greatest;
    uint8_t x[DIP_SAMPLE_ROOM];
    uint8_t y[DIP_SAMPLE_ROOM];
    // sharing[n]: the groups of n samples each, one bit per sample, where such groups are: chosen
    // so that their centroids, taken as a pattern, have the least error over all orientations.
    uint8_t sharing[DIP_MAX_SHARING + 1][DIP_MAX_SAMPLES];
} DipSamplePattern;

typedef enum DipPatternKind {
    DIP_PATTERN_STANDARD,
    DIP_PATTERN_EVEN, // of temporal antialiasing: frames 0, 2, ...
    DIP_PATTERN_ODD,
    DIP_PATTERN_KINDS
} DipPatternKind;

// sample_count: 1, 2, 4, 6 or 8. Static storage.
DIP_API const DipSamplePattern *dip_sample_pattern(int sample_count);

// The same; a single sample stays in the centre whatever the kind.
DIP_API const DipSamplePattern *dip_sample_pattern_of(int sample_count, DipPatternKind kind);

static inline DipPatternKind dip_pattern_kind(bool temporal, uint64_t frame_index) {
    return !temporal ? DIP_PATTERN_STANDARD : frame_index % 2 ? DIP_PATTERN_ODD : DIP_PATTERN_EVEN;
}

// Adaptive antialiasing of one pattern.
typedef struct DipSampleGroups {
    int count;                        // 1: a single group, no adaptive antialiasing
    uint8_t samples[DIP_MAX_SAMPLES]; // of each group, one bit each
    uint8_t sharing[DIP_MAX_SAMPLES]; // per sample: the samples of its group
    // The mean position of any set of samples (its bits the index), rounded down: x | y << 8.
    int32_t centroid[1 << DIP_MAX_SAMPLES];
} DipSampleGroups;

// Whether the count's samples can be shared out to groups of so many.
DIP_API bool dip_sample_groups_exist(int sample_count, int samples_per_group);

// samples_per_group: one that dip_sample_groups_exist says is there.
DIP_API void dip_sample_groups_make(DipSampleGroups *groups, const DipSamplePattern *pattern,
                                    int samples_per_group);

#ifdef __cplusplus
}
#endif

#endif
