// Sine, cosine, tangent and arc tangent with the same bits on every machine and compiler.
//
// libm's results differ between versions and processors; these use + - * / and sqrt alone, each of
// which IEEE 754 rounds in one way only. All functions are pure and thread-safe.
#ifndef DIP_RENDERER_BASE_TRIG_H
#define DIP_RENDERER_BASE_TRIG_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DIP_PI 3.14159265358979323846

// Angles in radians. Within 2.5e-16 of the true value (dip_tan: 1e-15 of it, relative) for
// |angle| <= 1e6. NaN for a greater angle, whose fraction of a turn a double hardly holds, and
// for one that is not finite. Odd and even as they should be: dip_sin(-a) is -dip_sin(a) exactly.
DIP_API double dip_sin(double angle_rad);
DIP_API double dip_cos(double angle_rad);
DIP_API double dip_tan(double angle_rad);

// The angle of the point (x, y), -pi..pi, within 1e-15 relative. Zeros count as positive: (0, 0)
// has angle 0, (-1, -0) has pi. NaN when a coordinate is NaN or both are infinite.
DIP_API double dip_atan2(double y, double x);

// 0..pi and -pi/2..pi/2, within 1e-15; NaN outside -1..1. Near +-1 (acos) the angle is as exact as
// x is, not as 1 - x would be.
DIP_API double dip_acos(double x);
DIP_API double dip_asin(double x);

#ifdef __cplusplus
}
#endif

#endif
