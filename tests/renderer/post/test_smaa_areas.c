// The computed areas of SMAA against areas that are counted on a fine grid.
#include "renderer/post/filters/smaa_areas.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static DipSmaaAreas areas;

static int set_up(void **state) {
    (void)state;
    dip_smaa_areas_make(&areas);
    return 0;
}

// The heights of the line over the edge at its two ends, in half pixels; 0: the line ends at the
// middle of the edge. The four crossing edges of an end leave three cases.
typedef struct Ends {
    int pattern;
    int left;
    int right;
} Ends;

// Sums the line's height over the columns of a pixel. What lies on the smaller side of a crossing
// belongs to the other pixel.
static void count(double from, double to, double begin, double end, int x, double *below,
                  double *above) {
    enum { STEPS = 4000 };
    *below = *above = 0;
    for (int i = 0; i < STEPS; i++) {
        const double at = x + (i + 0.5) / STEPS;
        const double height = from + (to - from) * (at - begin) / (end - begin);
        if (at >= begin && at <= end) {
            *(height < 0 ? below : above) += fabs(height) / STEPS;
        }
    }
}

// Lines from one side of an edge to the other: the areas are those under the line.
static void slopes_have_the_area_under_the_line(void **state) {
    (void)state;
    static const Ends ends[] = {
        {DIP_SMAA_LEFT_ABOVE | DIP_SMAA_RIGHT_BELOW, 1, -1},
        {DIP_SMAA_LEFT_BELOW | DIP_SMAA_RIGHT_ABOVE, -1, 1},
    };
    for (size_t e = 0; e < 2; e++) {
        for (int left = 0; left <= DIP_SMAA_STRAIGHT; left += 1 + left / 4) {
            for (int right = 0; right <= DIP_SMAA_STRAIGHT; right += 1 + right / 4) {
                const float *found = areas.straight[ends[e].pattern][left][right];
                double below, above;
                count(ends[e].left * 0.5, ends[e].right * 0.5, 0, left + right + 1, left, &below,
                      &above);
                assert_float_equal((double)found[0], below, 2e-4);
                assert_float_equal((double)found[1], above, 2e-4);
            }
        }
    }
}

// Edges that something crosses at one end only: the line runs to the edge's middle.
static void one_crossed_end_has_half_a_line(void **state) {
    (void)state;
    static const Ends ends[] = {{DIP_SMAA_LEFT_ABOVE, 1, 0},
                                {DIP_SMAA_LEFT_BELOW, -1, 0},
                                {DIP_SMAA_RIGHT_ABOVE, 0, 1},
                                {DIP_SMAA_RIGHT_BELOW, 0, -1}};
    for (size_t e = 0; e < 4; e++) {
        for (int left = 0; left <= DIP_SMAA_STRAIGHT; left += 1 + left / 4) {
            for (int right = 0; right <= DIP_SMAA_STRAIGHT; right += 1 + right / 4) {
                const float *found = areas.straight[ends[e].pattern][left][right];
                const double length = left + right + 1;
                double below = 0, above = 0;
                if (ends[e].left && left < right) {
                    count(ends[e].left * 0.5, 0, 0, length / 2, left, &below, &above);
                } else if (ends[e].right && left > right) {
                    count(0, ends[e].right * 0.5, length / 2, length, left, &below, &above);
                } else if (left == right) {
                    continue; // The line ends within the pixel; SMAA takes the trapezoid's mean.
                }
                assert_float_equal((double)found[0], below, 2e-4);
                assert_float_equal((double)found[1], above, 2e-4);
            }
        }
    }
}

// Bumps of one height: from the greatest length on, nothing is added to the area.
static void long_bumps_have_their_area(void **state) {
    (void)state;
    const int pattern = DIP_SMAA_LEFT_ABOVE | DIP_SMAA_RIGHT_ABOVE;
    for (int left = 16; left <= DIP_SMAA_STRAIGHT; left += 3) {
        for (int right = 16; right <= DIP_SMAA_STRAIGHT; right += 3) {
            const float *found = areas.straight[pattern][left][right];
            const double length = left + right + 1;
            double below, above, more;
            if (left == right) {
                continue;
            }
            count(0.5, 0, 0, length / 2, left, &below, &above);
            count(0, 0.5, length / 2, length, left, &below, &more);
            assert_float_equal((double)found[1], above + more, 2e-4);
            assert_float_equal((double)found[0], 0.0, 0.0);
        }
    }
}

// Ends that say nothing, or the same on both sides, leave the edge as it is.
static void edges_without_a_side_are_left(void **state) {
    (void)state;
    static const int patterns[] = {0, 15, DIP_SMAA_LEFT_ABOVE | DIP_SMAA_LEFT_BELOW,
                                   DIP_SMAA_RIGHT_ABOVE | DIP_SMAA_RIGHT_BELOW};
    for (size_t p = 0; p < 4; p++) {
        for (int i = 0; i < 33 * 33; i++) {
            assert_float_equal((double)areas.straight[patterns[p]][i / 33][i % 33][0], 0.0, 0.0);
            assert_float_equal((double)areas.straight[patterns[p]][i / 33][i % 33][1], 0.0, 0.0);
        }
    }
}

// A diagonal without edges at its ends: the mean of the lines from (1, 1) to (1, 1) behind its end
// and from (1, 0) to (1, 0), counted on a grid.
static void diagonals_have_the_area_beyond_the_line(void **state) {
    (void)state;
    enum { STEPS = 400 };
    for (int left = 0; left <= DIP_SMAA_DIAGONAL; left++) {
        for (int right = 0; right <= DIP_SMAA_DIAGONAL; right++) {
            double inside[2] = {0, 0};
            for (int line = 0; line < 2; line++) {
                const double y0 = line ? 0 : 1;
                for (int i = 0; i < STEPS * STEPS; i++) {
                    const double x = (i % STEPS + 0.5) / STEPS, y = (i / STEPS + 0.5) / STEPS;
                    // Both lines are parallel to the diagonal: y = x - 1 + y0.
                    const double px = 1 + left + x;
                    inside[0] += left + y < px - 1 + y0 ? 0.5 / (STEPS * STEPS) : 0;
                    inside[1] += 1 + left + y < px - 1 + y0 ? 0.5 / (STEPS * STEPS) : 0;
                }
            }
            const float *found = areas.diagonal[0][0][left][right];
            assert_float_equal((double)found[0], 1 - inside[0], 3e-3);
            assert_float_equal((double)found[1], inside[1], 3e-3);
        }
    }
}

// All areas are shares of a pixel.
static void areas_are_shares(void **state) {
    (void)state;
    const float *all = &areas.straight[0][0][0][0];
    for (size_t i = 0; i < sizeof areas / sizeof *all; i++) {
        assert_true(all[i] >= 0.0f && all[i] <= 1.0f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_have_the_area_under_the_line),
        cmocka_unit_test(one_crossed_end_has_half_a_line),
        cmocka_unit_test(long_bumps_have_their_area),
        cmocka_unit_test(edges_without_a_side_are_left),
        cmocka_unit_test(diagonals_have_the_area_beyond_the_line),
        cmocka_unit_test(areas_are_shares),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
