// Computes the colours of the maps of work (maps.h), rounds the ends of the maps' scales, and
// formats the maps' values.
#ifndef DIP_APP_PREVIEW_TOOLS_MAP_COLOURS_H
#define DIP_APP_PREVIEW_TOOLS_MAP_COLOURS_H

#include <stddef.h>
#include <stdint.h>

enum { DIP_MAP_COLOURS = 256 };

// Writes the sRGB colour of a value in 0..1 in the palette "cividis", from dark blue to yellow.
// Values outside 0..1 are clamped. Thread-safe.
void dip_cividis(float value, uint8_t rgb[3]);

// Returns the index of a value's colour among DIP_MAP_COLOURS colours, which stand for the values
// from 0 to `end`. The value must not be negative; values above `end` get the last colour.
static inline int dip_map_colour_index(float value, float end) {
    const float index = value / end * (DIP_MAP_COLOURS - 1) + 0.5f;
    return index < (float)DIP_MAP_COLOURS ? (int)index : DIP_MAP_COLOURS - 1;
}

// Rounds a value up to a power of 10 times 1, 1.5, 2, 3, 4, 5, 6 or 8. Returns 1 for values of 0
// and below.
double dip_map_round_up(double value);

// Writes a value of at least 0 with a few digits: "0", ".043", ".43", "4.30", "43" or "4321".
void dip_map_format(double value, char *text, size_t size_bytes);

#endif
