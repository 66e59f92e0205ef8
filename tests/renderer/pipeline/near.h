// assert_near: that a number is what it should be, or tells both. Include after <cmocka.h>.
#ifndef DIP_TESTS_RENDERER_PIPELINE_NEAR_H
#define DIP_TESTS_RENDERER_PIPELINE_NEAR_H

#include <math.h>

// NaN is near nothing.
#define assert_near(value, expected, tolerance)                                                    \
    do {                                                                                           \
        const double near_value = (value);                                                         \
        const double near_expected = (expected);                                                   \
        const double near_tolerance = (tolerance);                                                 \
        if (!(fabs(near_value - near_expected) <= near_tolerance)) {                               \
            fail_msg("%s is %.12g, expected %.12g within %g", #value, near_value, near_expected,   \
                     near_tolerance);                                                              \
        }                                                                                          \
    } while (0)

#endif
