// Sample positions of every antialiasing step, in 1/256 pixel from the pixel's top left corner.
//
// 1, 2, 4, 8: the standard patterns of Direct3D and Vulkan. 6: a six-rooks lattice chosen for the
// least error over all edge orientations, sorted by distance from the centre.
#ifndef DIP_RENDERER_RASTER_PATTERN_H
#define DIP_RENDERER_RASTER_PATTERN_H

#include <stdint.h>

enum {
    DIP_MAX_SAMPLES = 8,
    DIP_SAMPLE_ROOM = 16, // so that the widest vector may be read
};

typedef struct DipSamplePattern {
    int count;
    uint8_t least; // of all coordinates
    uint8_t greatest;
    uint8_t x[DIP_SAMPLE_ROOM];
    uint8_t y[DIP_SAMPLE_ROOM];
} DipSamplePattern;

// sample_count: 1, 2, 4, 6 or 8. Static storage.
const DipSamplePattern *dip_sample_pattern(int sample_count);

#endif
