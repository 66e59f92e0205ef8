// assert_near compares a number with an expected number. If they differ by more than a tolerance,
// it prints both and fails the test. Include this file after <cmocka.h>.
#ifndef DIP_TESTS_RENDERER_PIPELINE_NEAR_H
#define DIP_TESTS_RENDERER_PIPELINE_NEAR_H

#include <math.h>

// A NaN fails the check.
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
