// Sine, cosine, tangent and arc tangent from IEEE-exact operations.
#include "renderer/base/trig.h"

#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdint.h>

// pi/2 as the sum of three parts. The first two parts have 32 significant bits, so that n times
// either part is exact for |n| < 2^21. The sum of the three parts differs from pi/2 by less than
// 2^-122.
static const double HALF_PI_1 = 0x1.921fb54400000p+0;
static const double HALF_PI_2 = 0x1.0b4611a600000p-34;
static const double HALF_PI_3 = 0x1.3198a2e037073p-69;
static const double TWO_OVER_PI = 0x1.45f306dc9c883p-1;
static const double MAX_ANGLE_RAD = 1e6;

// Splits an angle into quadrant * pi/2 + rest. |rest| <= pi/4, apart from rounding.
static double reduce(double angle_rad, unsigned *quadrant) {
    const double turns = angle_rad * TWO_OVER_PI;
    // Halves are rounded away from zero, so that the results for a and -a differ only in sign.
    const int32_t count = (int32_t)(turns < 0.0 ? turns - 0.5 : turns + 0.5);
    const double n = (double)count;
    // `coarse` is exact. `rest` is rounded; `lost` is the rounding error of `rest`.
    const double coarse = angle_rad - n * HALF_PI_1;
    const double step = n * HALF_PI_2;
    const double rest = coarse - step;
    const double lost = (coarse - rest) - step;
    *quadrant = (unsigned)count & 3u;
    return rest + (lost - n * HALF_PI_3);
}

// Taylor series of the sine for |x| <= pi/4. The first term that is left out is below 2e-19.
static double sin_series(double x) {
    const double s = x * x;
    double sum = 1.0 / 355687428096000.0; // 1 / 17!
    sum = sum * s - 1.0 / 1307674368000.0;
    sum = sum * s + 1.0 / 6227020800.0;
    sum = sum * s - 1.0 / 39916800.0;
    sum = sum * s + 1.0 / 362880.0;
    sum = sum * s - 1.0 / 5040.0;
    sum = sum * s + 1.0 / 120.0;
    sum = sum * s - 1.0 / 6.0;
    return x + x * (s * sum);
}

static double cos_series(double x) {
    const double s = x * x;
    double sum = 1.0 / 20922789888000.0; // 1 / 16!
    sum = sum * s - 1.0 / 87178291200.0;
    sum = sum * s + 1.0 / 479001600.0;
    sum = sum * s - 1.0 / 3628800.0;
    sum = sum * s + 1.0 / 40320.0;
    sum = sum * s - 1.0 / 720.0;
    sum = sum * s + 1.0 / 24.0;
    // The result is 1 - s/2 + s^2 * sum. The rounding error of 1 - s/2 is added back.
    const double half = 0.5 * s;
    const double head = 1.0 - half;
    return head + (((1.0 - head) - half) + s * s * sum);
}

static int is_usable(double angle_rad) {
    return angle_rad >= -MAX_ANGLE_RAD && angle_rad <= MAX_ANGLE_RAD;
}

static double compute_sin(double angle_rad) {
    if (!is_usable(angle_rad)) {
        return NAN;
    }
    unsigned quadrant;
    const double rest = reduce(angle_rad, &quadrant);
    const double value = quadrant & 1u ? cos_series(rest) : sin_series(rest);
    return quadrant & 2u ? -value : value;
}

static double compute_cos(double angle_rad) {
    if (!is_usable(angle_rad)) {
        return NAN;
    }
    unsigned quadrant;
    const double rest = reduce(angle_rad, &quadrant);
    const double value = quadrant & 1u ? sin_series(rest) : cos_series(rest);
    return (quadrant + 1u) & 2u ? -value : value;
}

static double compute_tan(double angle_rad) {
    if (!is_usable(angle_rad)) {
        return NAN;
    }
    unsigned quadrant;
    const double rest = reduce(angle_rad, &quadrant);
    const double sine = sin_series(rest);
    const double cosine = cos_series(rest);
    return quadrant & 1u ? -cosine / sine : sine / cosine;
}

// Arc tangent for x in 0..1: atan(x) = atan(k/8) + atan(t) with t = (x - k/8) / (1 + x k/8). k is
// chosen so that |t| <= 1/16. For such t, the first term that the series leaves out is below 1e-19
// of the result.
static double atan_unit(double x) {
    static const double eighths[] = {
        // eighths[k] = atan(k/8)
        0.0,
        0x1.fd5ba9aac2f6ep-4,
        0x1.f5b75f92c80ddp-3,
        0x1.6f61941e4def1p-2,
        0x1.dac670561bb4fp-2,
        0x1.1e00babdefeb4p-1,
        0x1.4978fa3269ee1p-1,
        0x1.700a7c5784634p-1,
        0x1.921fb54442d18p-1,
    };
    const int k = (int)(x * 8.0 + 0.5);
    const double centre = (double)k * 0.125;
    const double t = (x - centre) / (1.0 + x * centre);
    const double s = t * t;
    double sum = 1.0 / 13.0;
    sum = sum * s - 1.0 / 11.0;
    sum = sum * s + 1.0 / 9.0;
    sum = sum * s - 1.0 / 7.0;
    sum = sum * s + 1.0 / 5.0;
    sum = sum * s - 1.0 / 3.0;
    return eighths[k] + (t + t * (s * sum));
}

static double compute_atan2(double y, double x) {
    const double width = fabs(x);
    const double height = fabs(y);
    if (isnan(x) || isnan(y) || (isinf(x) && isinf(y))) {
        return NAN;
    }
    double angle = 0.0;
    if (height > width) {
        angle = 0.5 * DIP_PI - atan_unit(width / height);
    } else if (width > 0.0) {
        angle = atan_unit(height / width);
    }
    if (x < 0.0) {
        angle = DIP_PI - angle;
    }
    return y < 0.0 ? -angle : angle;
}

static double compute_acos(double x) {
    if (!(x >= -1.0 && x <= 1.0)) {
        return NAN;
    }
    return compute_atan2(sqrt((1.0 - x) * (1.0 + x)), x);
}

static double compute_asin(double x) {
    if (!(x >= -1.0 && x <= 1.0)) {
        return NAN;
    }
    return compute_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

// Defines a public function that computes in the mode of fp_mode.h.
#define DEFINE_IN_FP_MODE(name, argument)                                                          \
    double dip_##name(double argument) {                                                           \
        DIP_FP_MODE_SCOPE();                                                                       \
        DIP_FP_PIN(argument);                                                                      \
        double result = compute_##name(argument);                                                  \
        DIP_FP_PIN(result);                                                                        \
        return result;                                                                             \
    }

DEFINE_IN_FP_MODE(sin, angle_rad)
DEFINE_IN_FP_MODE(cos, angle_rad)
DEFINE_IN_FP_MODE(tan, angle_rad)
DEFINE_IN_FP_MODE(acos, x)
DEFINE_IN_FP_MODE(asin, x)

double dip_atan2(double y, double x) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(y);
    DIP_FP_PIN(x);
    double angle = compute_atan2(y, x);
    DIP_FP_PIN(angle);
    return angle;
}
