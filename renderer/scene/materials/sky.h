// The sky at a time. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_MATERIALS_SKY_H
#define DIP_RENDERER_SCENE_MATERIALS_SKY_H

#include "renderer/scene/materials/surface.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

// How far a layer has scrolled, 0..1 texture width. It repeats exactly with the layer's period,
// 60 s / |speed| rounded to whole nanoseconds; a speed below 1e-6 stands still.
double dip_sky_phase(double speed_per_min, int64_t time_ns);

DipSkyUniforms dip_sky_at(const DipSkyDef *sky, int64_t time_ns);

#endif
