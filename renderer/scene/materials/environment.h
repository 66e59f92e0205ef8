// An environment in the form that the shader of metallic-roughness surfaces reads: blurred by the
// lobes of some roughnesses. docs/picture.md, Environment, defines the light.
#ifndef DIP_RENDERER_SCENE_MATERIALS_ENVIRONMENT_H
#define DIP_RENDERER_SCENE_MATERIALS_ENVIRONMENT_H

#include <stdint.h>

enum { DIP_ENVIRONMENT_LEVELS = 9 };

// Level k is the environment for roughness k / 8 as an octahedral map: the direction (x, y, z) with
// |x| + |y| + |z| = 1 lies at (x, z) if y is not negative. The lower half is folded over the edges
// of that square, so that the corners are straight below. A level has (cells + 1)^2 texels at the
// corners of its cells; the first one is at x = z = -1, and x grows along the rows.
//
// A texel has mantissas of 9 bits for red, green and blue, from the lowest bits on, and an exponent
// e of 5 bits: a channel is mantissa * 2^(e - 24).
typedef struct DipEnvironmentMap {
    // The light on a white matt surface with the unit normal (x, y, z) is the sum of these numbers
    // times 1, x, y, z, xy, yz, xz, x^2 - y^2 and 3 z^2 - 1, but at least 0.
    float soft_lin[9][3];
    int32_t cells[DIP_ENVIRONMENT_LEVELS]; // along each side of a level
    int32_t first[DIP_ENVIRONMENT_LEVELS]; // index of the level's first texel
    int32_t texels[];
} DipEnvironmentMap;

#endif
