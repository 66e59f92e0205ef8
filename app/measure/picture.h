// What the metrics compare: pictures in memory, and the part of them that counts.
#ifndef DIP_APP_MEASURE_PICTURE_H
#define DIP_APP_MEASURE_PICTURE_H

#include <stddef.h>
#include <stdint.h>

// sRGB codes with a fourth byte that is not looked at, the top row first: as a DipFrame has them.
typedef struct DipPicture {
    const uint8_t *rgba8;
    size_t stride_bytes;
    int width;
    int height;
} DipPicture;

// Of which pixels a figure is: where classes[pixel] equals wanted. classes NULL: of all.
typedef struct DipRegion {
    const uint8_t *classes;
    uint8_t wanted;
} DipRegion;

#endif
