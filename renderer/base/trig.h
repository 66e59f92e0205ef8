// Sine, cosine, tangent and arc tangent with the same bits on every machine and compiler.
//
// The results of libm differ between versions and processors. These functions use only + - * / and
// sqrt, each of which IEEE 754 rounds in exactly one way. They are pure and thread-safe.
#ifndef DIP_RENDERER_BASE_TRIG_H
#define DIP_RENDERER_BASE_TRIG_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DIP_PI 3.14159265358979323846

// Sine, cosine and tangent of an angle in radians. For |angle| <= 1e6, dip_sin and dip_cos are
// within 2.5e-16 of the true value, and dip_tan has a relative error below 1e-15. The result is NaN
// for an angle that is not finite or beyond +-1e6, because a double that large leaves few digits
// for the fraction of a turn. Symmetry is exact: dip_sin(-a) is -dip_sin(a), and dip_cos(-a) is
// dip_cos(a).
DIP_API double dip_sin(double angle_rad);
DIP_API double dip_cos(double angle_rad);
DIP_API double dip_tan(double angle_rad);

// Returns the angle of the point (x, y) in radians, -pi..pi, with a relative error below 1e-15. A
// zero counts as positive: the angle of (0, 0) is 0, and the angle of (-1, -0) is pi. The result is
// NaN if a coordinate is NaN or both are infinite.
DIP_API double dip_atan2(double y, double x);

// Arc cosine, 0..pi, and arc sine, -pi/2..pi/2, in radians, within 1e-15 of the true value. The
// result is NaN for x outside -1..1. Near x = +-1, dip_acos loses no digits to cancellation: the
// angle is as exact as x.
DIP_API double dip_acos(double x);
DIP_API double dip_asin(double x);

#ifdef __cplusplus
}
#endif

#endif
