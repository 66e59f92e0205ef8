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
                if (ends[e].left && left <= right) {
                    count(ends[e].left * 0.5, 0, 0, length / 2, left, &below, &above);
                } else if (ends[e].right && left >= right) {
                    count(0, ends[e].right * 0.5, length / 2, length, left, &below, &above);
                }
                assert_float_equal((double)found[0], below, 2e-4);
                assert_float_equal((double)found[1], above, 2e-4);
            }
        }
    }
}

// The share of a half of a bump. SMAA blends short bumps more than their areas, by the square root
// of the area, and ever less so up to a length of 32 pixels.
static double blended_more(double area, double length) {
    const double share = fmin(length / 32, 1.0);
    return share * area + (1.0 - share) * sqrt(2.0 * area) / 2;
}

// Bumps: the line runs from half a pixel beside the edge to its middle, and back.
static void bumps_have_their_area_and_more_where_they_are_short(void **state) {
    (void)state;
    static const int patterns[] = {DIP_SMAA_LEFT_ABOVE | DIP_SMAA_RIGHT_ABOVE,
                                   DIP_SMAA_LEFT_BELOW | DIP_SMAA_RIGHT_BELOW};
    for (int below = 0; below < 2; below++) {
        const double height = below ? -0.5 : 0.5;
        for (int left = 0; left <= DIP_SMAA_STRAIGHT; left++) {
            for (int right = 0; right <= DIP_SMAA_STRAIGHT; right += 1 + right / 4) {
                const float *found = areas.straight[patterns[below]][left][right];
                const double length = left + right + 1;
                double first[2], second[2];
                count(height, 0, 0, length / 2, left, &first[0], &first[1]);
                count(0, height, length / 2, length, left, &second[0], &second[1]);
                const double wanted =
                    blended_more(first[!below], length) + blended_more(second[!below], length);
                assert_float_equal((double)found[!below], wanted, 4e-4);
                assert_float_equal((double)found[below], 0.0, 0.0);
            }
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

// The lines along diagonal stairs, in the order in which SMAA's authors number the edges at the two
// ends: the edges, and two lines, each by the corner where it starts and the corner behind the
// stairs' end where it ends. A pixel has the mean of both lines.
typedef struct Diagonal {
    int left, right;
    double lines[2][4];
} Diagonal;

static const Diagonal diagonals[16] = {
    {0, 0, {{1, 1, 1, 1}, {1, 0, 1, 0}}}, {1, 0, {{1, 0, 0, 0}, {1, 0, 1, 0}}},
    {0, 2, {{0, 0, 1, 0}, {1, 0, 1, 0}}}, {1, 2, {{1, 0, 1, 0}, {1, 0, 1, 0}}},
    {2, 0, {{1, 1, 0, 0}, {1, 1, 1, 0}}}, {3, 0, {{1, 1, 0, 0}, {1, 0, 1, 0}}},
    {2, 2, {{1, 1, 1, 0}, {1, 1, 1, 0}}}, {3, 2, {{1, 1, 1, 0}, {1, 0, 1, 0}}},
    {0, 1, {{0, 0, 1, 1}, {1, 0, 1, 1}}}, {1, 1, {{1, 0, 1, 1}, {1, 0, 1, 1}}},
    {0, 3, {{0, 0, 1, 1}, {1, 0, 1, 0}}}, {1, 3, {{1, 0, 1, 1}, {1, 0, 1, 0}}},
    {2, 1, {{1, 1, 1, 1}, {1, 1, 1, 1}}}, {3, 1, {{1, 1, 1, 1}, {1, 0, 1, 1}}},
    {2, 3, {{1, 1, 1, 1}, {1, 1, 1, 0}}}, {3, 3, {{1, 1, 1, 1}, {1, 0, 1, 0}}}};

// The share of the pixel with this lower left corner that lies below a line, counted on a grid.
static double share_below(const double line[4], double length, int x, int y) {
    enum { STEPS = 128 };
    const double slope = (line[3] + length - line[1]) / (line[2] + length - line[0]);
    int below = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const double px = x + (i % STEPS + 0.5) / STEPS, py = y + (i / STEPS + 0.5) / STEPS;
        below += py < line[1] + (px - line[0]) * slope;
    }
    return (double)below / (STEPS * STEPS);
}

static void diagonals_have_the_area_beyond_the_line(void **state) {
    (void)state;
    for (int d = 0; d < 16; d++) {
        for (int left = 0; left <= DIP_SMAA_DIAGONAL; left++) {
            for (int right = 0; right <= DIP_SMAA_DIAGONAL; right += 1 + right / 3) {
                double below[2] = {0, 0};
                for (int i = 0; i < 4; i++) {
                    below[i % 2] += share_below(diagonals[d].lines[i / 2], left + right + 1,
                                                1 + left, left + i % 2) /
                                    2;
                }
                const float *found =
                    areas.diagonal[diagonals[d].left][diagonals[d].right][left][right];
                assert_float_equal((double)found[0], 1 - below[0], 6e-3);
                assert_float_equal((double)found[1], below[1], 6e-3);
            }
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
        cmocka_unit_test(bumps_have_their_area_and_more_where_they_are_short),
        cmocka_unit_test(edges_without_a_side_are_left),
        cmocka_unit_test(diagonals_have_the_area_beyond_the_line),
        cmocka_unit_test(areas_are_shares),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
