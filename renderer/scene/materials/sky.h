// Computes the sky at a given time. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SKY_H
#define DIP_RENDERER_SCENE_MATERIALS_SKY_H

#include "renderer/scene/materials/surface.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

// Returns how far a layer of clouds has scrolled, in texture widths, 0..1. The result repeats
// exactly after the layer's period, which is 60 s / |speed_per_min|, rounded to whole nanoseconds.
// A layer whose |speed_per_min| is below 1e-6 does not move.
double dip_sky_phase(double speed_per_min, int64_t time_ns);

// Computes the uniforms of the sky's shader at a time.
DipSkyUniforms dip_sky_at(const DipSkyDef *sky, int64_t time_ns);

#endif
