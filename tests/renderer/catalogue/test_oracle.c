// Tests that the triangles which the catalogue tries are as hard as their kinds say, with exact
// integers. What the oracle says of their samples is tested by tests/renderer/pipeline.
#include "renderer/catalogue/oracle.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { TRIANGLES = 500, SAMPLES = 4, LIMIT = DIP_ORACLE_LIMIT };

static const DipOracleRegion region = {-3, 5, 17, 11};
static const DipSamplePattern *pattern;

// Calls a check for random triangles of a kind.
static void for_each(DipOracleKind kind, bool (*check)(const DipOracleTriangle *triangle)) {
    Random random = {(uint64_t)kind + 1};
    pattern = dip_sample_pattern(SAMPLES);
    for (int i = 0; i < TRIANGLES; i++) {
        const DipOracleTriangle t = dip_oracle_make(kind, &random, pattern, &region, LIMIT);
        if (!check(&t)) {
            fail_msg("%s %d: %d %d, %d %d, %d %d", dip_oracle_kind_name(kind), i, t.x[0], t.y[0],
                     t.x[1], t.y[1], t.x[2], t.y[2]);
        }
    }
}

// Twice the signed area of a triangle's corners a and b and a point.
static int64_t area(const DipOracleTriangle *t, int a, int b, int64_t x, int64_t y) {
    return ((int64_t)t->x[b] - t->x[a]) * (y - t->y[a]) -
           ((int64_t)t->y[b] - t->y[a]) * (x - t->x[a]);
}

static int64_t whole_area(const DipOracleTriangle *t) {
    return llabs(area(t, 0, 1, t->x[2], t->y[2]));
}

static bool between(int64_t at, int64_t a, int64_t b) {
    return (at >= a && at <= b) || (at >= b && at <= a);
}

// Returns how many samples of the region lie on an edge or at its ends.
static int samples_on_edge(const DipOracleTriangle *t, int a, int b) {
    int count = 0;
    for (int p = 0; p < region.width * region.height; p++) {
        for (int s = 0; s < SAMPLES; s++) {
            const int x = (region.x0 + p % region.width) * 256 + pattern->x[s];
            const int y = (region.y0 + p / region.width) * 256 + pattern->y[s];
            count += area(t, a, b, x, y) == 0 && between(x, t->x[a], t->x[b]) &&
                     between(y, t->y[a], t->y[b]);
        }
    }
    return count;
}

static bool is_at_sample(const DipOracleTriangle *t, int corner) {
    const DipOracleTriangle point = {{t->x[corner], t->x[corner]}, {t->y[corner], t->y[corner]}};
    return samples_on_edge(&point, 0, 1) == 1;
}

// One that takes a sample twice, instead of two, has an edge without length.
static bool passes_samples(const DipOracleTriangle *t) {
    int most = 0;
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3, found = samples_on_edge(t, i, next);
        const bool is_point = t->x[i] == t->x[next] && t->y[i] == t->y[next];
        most = found + is_point > most ? found + is_point : most;
    }
    return most >= 2;
}

static bool stands_on_samples(const DipOracleTriangle *t) {
    return is_at_sample(t, 0) && is_at_sample(t, 1) && is_at_sample(t, 2);
}

// The third corner lies up to 2/256 pixel from the line through the others, in x and in y, and up
// to half of 1/256 more, by rounding.
static bool is_narrow(const DipOracleTriangle *t) {
    int64_t longest = 0;
    for (int i = 0; i < 3; i++) {
        const int64_t dx = llabs((int64_t)t->x[i] - t->x[(i + 1) % 3]);
        const int64_t dy = llabs((int64_t)t->y[i] - t->y[(i + 1) % 3]);
        longest = dx + dy > longest ? dx + dy : longest;
    }
    return 2 * whole_area(t) <= 5 * longest;
}

static bool has_no_area(const DipOracleTriangle *t) {
    return whole_area(t) == 0;
}

static bool is_axis_aligned(const DipOracleTriangle *t) {
    bool horizontal = false, at_sample = false;
    for (int i = 0; i < 3; i++) {
        horizontal = horizontal || t->y[i] == t->y[(i + 1) % 3];
        at_sample = at_sample || is_at_sample(t, i);
    }
    return horizontal && at_sample;
}

static int at_limit;

static bool counts_corners_at_the_limit(const DipOracleTriangle *t) {
    for (int i = 0; i < 3; i++) {
        at_limit += abs(t->x[i]) == LIMIT || abs(t->y[i]) == LIMIT;
    }
    return true;
}

static void triangles_are_as_hard_as_their_kind(void **state) {
    (void)state;
    for_each(DIP_ORACLE_through_samples, passes_samples);
    for_each(DIP_ORACLE_on_samples, stands_on_samples);
    for_each(DIP_ORACLE_sliver, is_narrow);
    for_each(DIP_ORACLE_flat, has_no_area);
    for_each(DIP_ORACLE_axis_aligned, is_axis_aligned);
    at_limit = 0;
    for_each(DIP_ORACLE_guard, counts_corners_at_the_limit);
    assert_in_range(at_limit, TRIANGLES, 3 * TRIANGLES); // about 2.5 corners of 3, half of them
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(triangles_are_as_hard_as_their_kind)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
