// Reduces repeating varyings (DipDraw.repeating_varyings), so that large texture coordinates keep
// their precision in the shading planes.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_REPEAT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_REPEAT_H

// A triangle's repeating varyings are reduced by a multiple of this number, so that their values at
// the corner nearest to the eye are within half of it. The number is even, so that mirrored
// textures keep their phase. A smaller number would hardly be more precise: floats within +-32 have
// steps of at most 2^-19, 1/64 texel of the largest texture. But it would change the bits of
// ordinary pictures, whose coordinates lie within +-32.
#define DIP_REPEAT_STEP 64.0

// Adding this number to v and subtracting it again rounds v to the nearest integer, ties to even,
// if |v| <= 2^51. Numbers that are larger have no fraction that matters.
#define DIP_REPEAT_ROUNDER 0x1.8p52

// Returns the multiple of DIP_REPEAT_STEP that is nearest to a value.
static inline double dip_nearest_repeat(double value) {
    const double steps = value * (1.0 / DIP_REPEAT_STEP);
    return ((steps + DIP_REPEAT_ROUNDER) - DIP_REPEAT_ROUNDER) * DIP_REPEAT_STEP;
}

#endif
