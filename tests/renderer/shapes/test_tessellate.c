// Tests tessellation: the counts and positions of Direct3D 11's tessellator, areas that sum to the
// domain's, and surfaces without cracks or T-junctions.
#include "renderer/shapes/tessellate.h"
#include "renderer/catalogue/random.h"
#include "tests/renderer/shapes/manifold.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

static const uint32_t one_patch[4] = {0, 1, 2, 3};
static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

// Domain function that writes the location itself. Domains are compared in the plane, in which the
// control points wind counter-clockwise: (u, v) of a quadrilateral, (v, w) of a triangle.
static void write_location(const DipDomainBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        float *out = batch->out + (size_t)i * 3;
        out[0] = batch->w ? batch->v[i] : batch->u[i];
        out[1] = batch->w ? batch->w[i] : batch->v[i];
        out[2] = batch->w ? batch->u[i] : 0.0f;
    }
}

static DipTessellationDef one_patch_def(DipDomain domain, DipPartitioning partitioning,
                                        const DipTessellationFactors *factors) {
    return (DipTessellationDef){.domain = domain,
                                .partitioning = partitioning,
                                .attributes = &corners[0][0],
                                .attribute_count = 3,
                                .vertex_count = 4,
                                .indices = one_patch,
                                .index_count = domain == DIP_DOMAIN_QUAD ? 4 : 3,
                                .factors = factors,
                                .function = write_location,
                                .out_attribute_count = 3};
}

static DipShape tessellate(DipDomain domain, DipPartitioning partitioning,
                           DipTessellationFactors factors) {
    DipShape shape;
    const DipTessellationDef def = one_patch_def(domain, partitioning, &factors);
    DipError err;
    if (!dip_tessellate(&shape, &def, &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
    return shape;
}

static DipTessellationFactors equal_factors(float factor) {
    return (DipTessellationFactors){{factor, factor, factor, factor}, {factor, factor}};
}

static void check_counts(DipDomain domain, DipPartitioning partitioning, float factor, int points,
                         int triangles) {
    DipShape shape = tessellate(domain, partitioning, equal_factors(factor));
    assert_int_equal(shape.vertex_count, points);
    assert_int_equal(shape.index_count, 3 * triangles);
    dip_shape_free(&shape);
}

static void equal_factors_give_the_counts_of_direct3d(void **context) {
    (void)context;
    for (int n = 1; n <= 64; n++) {
        const bool odd = n % 2;
        const int points = odd ? 3 * (n + 1) * (n + 1) / 4 : 3 * n * n / 4 + 3 * n / 2 + 1;
        const int triangles = odd ? (3 * n * n - 1) / 2 : 3 * n * n / 2;
        check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, (float)n, points, triangles);
        check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, (float)n - 0.5f, points,
                     triangles);
        check_counts(DIP_DOMAIN_QUAD, DIP_PARTITIONING_INTEGER, (float)n, (n + 1) * (n + 1),
                     2 * n * n);
        if (odd) {
            check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_FRACTIONAL_ODD, (float)n, points,
                         triangles);
            check_counts(DIP_DOMAIN_QUAD, DIP_PARTITIONING_FRACTIONAL_ODD, (float)n,
                         (n + 1) * (n + 1), 2 * n * n);
        }
    }
    // A fractional-odd factor of 64 becomes 63.
    check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_FRACTIONAL_ODD, 64.0f, 3072, 5953);
    check_counts(DIP_DOMAIN_QUAD, DIP_PARTITIONING_FRACTIONAL_ODD, 64.0f, 4096, 7938);
    check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, INFINITY, 3169, 6144);
    check_counts(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, 0.25f, 3, 1);
}

// --- positions -----------------------------------------------------------------------------------

static int compare_floats(const void *a, const void *b) {
    const float left = *(const float *)a;
    const float right = *(const float *)b;
    return (left > right) - (left < right);
}

// Writes the sorted positions of the vertices on the edge v = 0 of a quadrilateral.
static int edge_positions(DipPartitioning partitioning, float factor, float *positions) {
    DipTessellationFactors factors = {{1.0f, factor, 1.0f, 1.0f}, {3.0f, 3.0f}};
    DipShape shape = tessellate(DIP_DOMAIN_QUAD, partitioning, factors);
    int count = 0;
    for (uint32_t i = 0; i < shape.vertex_count; i++) {
        if (shape.attributes[3 * i + 1] == 0.0f) {
            positions[count++] = shape.attributes[3 * i];
        }
    }
    qsort(positions, (size_t)count, sizeof *positions, compare_floats);
    dip_shape_free(&shape);
    return count;
}

// Number of parts of the half edge, without its highest binary digit.
static int strip(int number) {
    int digit = 1;
    while (digit * 2 <= number) {
        digit *= 2;
    }
    return number - digit;
}

// The definition of a fractional-odd position in real numbers.
static double odd_position(double factor, int p) {
    const double half = factor / 2.0 + 0.5;
    const int coarse = (int)floor(half);
    const int fine = (int)ceil(half);
    if (p >= fine) {
        return 1.0 - odd_position(factor, 2 * fine - 1 - p);
    }
    const int split = coarse == fine ? fine + 1 : coarse == 1 ? 0 : 2 * strip(coarse - 1) + 1;
    const double fraction = half - coarse;
    const double on_coarse = (double)(p > split ? p - 1 : p) / (2 * coarse - 1);
    return (1.0 - fraction) * on_coarse + fraction * p / (2 * fine - 1);
}

static void edges_are_divided_as_direct3d_divides_them(void **context) {
    (void)context;
    float found[80];
    static const struct {
        float factor;
        int count;
        double positions[10];
    } published[] = {
        {1.5f, 4, {0, .0833, .9167, 1}},
        {3.5f, 6, {0, .3, .35, .65, .7, 1}},
        {7.5f, 10, {0, .1349, .2698, .4048, .4325, .5675, .5952, .7302, .8651, 1}},
    };
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        const int count =
            edge_positions(DIP_PARTITIONING_FRACTIONAL_ODD, published[i].factor, found);
        assert_int_equal(count, published[i].count);
        for (int p = 0; p < count; p++) {
            assert_near(found[p], published[i].positions[p], 1e-4);
        }
    }
    for (double factor = 1.0; factor <= 63.0; factor += 0.0625) {
        const int count = edge_positions(DIP_PARTITIONING_FRACTIONAL_ODD, (float)factor, found);
        assert_int_equal(count, 2 * (int)ceil(factor / 2.0 + 0.5));
        for (int p = 0; p < count; p++) {
            // 31 steps of a length that is rounded to 1/65536.
            assert_near(found[p], odd_position(factor, p), 3e-4);
            assert_true(found[p] == 1.0f - found[count - 1 - p]);
        }
    }
    for (int n = 1; n <= 64; n++) {
        const int count = edge_positions(DIP_PARTITIONING_INTEGER, (float)n, found);
        assert_int_equal(count, n + 1);
        for (int p = 0; p <= n; p++) {
            assert_near(found[p], (double)p / n, 3e-4);
            assert_true(found[p] == 1.0f - found[n - p]);
        }
    }
}

// As a factor grows a little, no point jumps and the number of points changes only where new points
// are at the position of others.
static void points_slide_and_do_not_jump(void **context) {
    (void)context;
    float before[80];
    float after[80];
    int before_count = edge_positions(DIP_PARTITIONING_FRACTIONAL_ODD, 1.0f, before);
    for (float factor = 1.0f; factor <= 63.0f; factor += 0.015625f) {
        const int count = edge_positions(DIP_PARTITIONING_FRACTIONAL_ODD, factor, after);
        for (int p = 0; p < count; p++) {
            float nearest = 1.0f;
            for (int q = 0; q < before_count; q++) {
                nearest = fminf(nearest, fabsf(before[q] - after[p]));
            }
            assert_true(nearest < 0.01f);
        }
        memcpy(before, after, sizeof before);
        before_count = count;
    }
}

// --- areas and edges -----------------------------------------------------------------------------

// Returns twice the area of a triangle in units of 2^-32, which is a whole number.
static int64_t doubled_area(const DipShape *shape, size_t i) {
    int64_t p[3][2];
    for (int k = 0; k < 3; k++) {
        const float *location = shape->attributes + 3 * (size_t)shape->indices[i + (size_t)k];
        for (int a = 0; a < 2; a++) {
            p[k][a] = (int64_t)(location[a] * 65536.0f);
            assert_true((float)p[k][a] == location[a] * 65536.0f);
        }
    }
    return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
}

static int parts_of(float factor, DipPartitioning partitioning) {
    const double clamped =
        fmin(fmax(factor, 1.0), partitioning == DIP_PARTITIONING_INTEGER ? 64.0 : 63.0);
    return partitioning == DIP_PARTITIONING_INTEGER ? (int)ceil(clamped)
                                                    : 2 * (int)ceil(clamped / 2.0 + 0.5) - 1;
}

static float random_factor(Random *random) {
    const float real = (float)random_real(random, 0.1, 70.0);
    switch (random_int(random, 0, 3)) {
    case 0:
        return (float)random_int(random, 1, 64);
    case 1:
        return 1.0f;
    case 2:
        return 1.0f + 0.05f * real;
    default:
        return real;
    }
}

static void pieces_cover_the_domain_once(void **context) {
    (void)context;
    Random random = {1};
    for (int i = 0; i < 3000; i++) {
        const DipDomain domain = i % 2 ? DIP_DOMAIN_QUAD : DIP_DOMAIN_TRIANGLE;
        const DipPartitioning partitioning =
            i % 4 < 2 ? DIP_PARTITIONING_INTEGER : DIP_PARTITIONING_FRACTIONAL_ODD;
        DipTessellationFactors factors;
        size_t border = 0;
        for (int e = 0; e < 4; e++) {
            factors.edge[e] = random_factor(&random);
            factors.inside[e % 2] = random_factor(&random);
            border += domain == DIP_DOMAIN_QUAD || e < 3
                          ? (size_t)parts_of(factors.edge[e], partitioning)
                          : 0;
        }
        DipShape shape = tessellate(domain, partitioning, factors);
        int64_t area = 0;
        for (size_t t = 0; t < shape.index_count; t += 3) {
            const int64_t piece = doubled_area(&shape, t);
            assert_true(piece >= 0);
            area += piece;
        }
        assert_true(area == (domain == DIP_DOMAIN_QUAD ? INT64_C(2) << 32 : INT64_C(1) << 32));
        const EdgeCounts counts = count_edges(shape.indices, shape.index_count);
        assert_int_equal(counts.border, border);
        assert_int_equal(counts.repeated, 0);
        assert_int_equal(counts.collapsed, 0);
        dip_shape_free(&shape);
    }
}

// --- neighbours ----------------------------------------------------------------------------------

// Factor of an edge, from the positions of its ends alone, in any order. It is a multiple of 1/8
// above the least factor, so that new points are never at the position of others.
static float factor_of(const float *a, const float *b, float least, float most) {
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        sum += sin(12.9898 * ((double)a[i] + b[i]) + 78.233 * (double)a[i] * b[i] + i);
    }
    return least + floorf(8.0f * (most - least) * (float)(sum - floor(sum))) / 8.0f;
}

// Tessellates a closed prism and checks that the result is closed: every edge has exactly one
// neighbour, so there are neither cracks nor T-junctions.
static void check_closed(DipPartitioning partitioning, int sides, float least, float most) {
    DipShape prism;
    assert_true(dip_shape_prism(&prism, 0.7f, 1.9f, sides, false, NULL));
    const uint32_t patches = prism.index_count / 3;
    DipTessellationFactors *factors = malloc(patches * sizeof *factors);
    for (uint32_t i = 0; i < patches; i++) {
        const float *at[3];
        for (int k = 0; k < 3; k++) {
            at[k] = prism.attributes +
                    (size_t)prism.indices[3 * i + (uint32_t)k] * DIP_SHAPE_ATTRIBUTES;
        }
        for (int e = 0; e < 3; e++) {
            factors[i].edge[e] = factor_of(at[(e + 1) % 3], at[(e + 2) % 3], least, most);
        }
        factors[i].edge[3] = 0.0f;
        factors[i].inside[0] = factors[i].inside[1] = least + (float)(i % 7);
    }
    const DipTessellationDef def = {.domain = DIP_DOMAIN_TRIANGLE,
                                    .partitioning = partitioning,
                                    .attributes = prism.attributes,
                                    .attribute_count = DIP_SHAPE_ATTRIBUTES,
                                    .vertex_count = prism.vertex_count,
                                    .indices = prism.indices,
                                    .index_count = prism.index_count,
                                    .factors = factors,
                                    .function = dip_domain_linear,
                                    .out_attribute_count = DIP_SHAPE_ATTRIBUTES};
    DipShape shape;
    assert_true(dip_tessellate(&shape, &def, NULL));
    uint32_t *joined = malloc(shape.index_count * sizeof *joined);
    join_positions(shape.attributes, DIP_SHAPE_ATTRIBUTES, shape.vertex_count, shape.indices,
                   shape.index_count, joined);
    const EdgeCounts counts = count_edges(joined, shape.index_count);
    assert_int_equal(counts.inner, shape.index_count);
    assert_int_equal(counts.repeated, 0);
    assert_int_equal(counts.collapsed, 0);
    const double before =
        enclosed_volume(prism.attributes, DIP_SHAPE_ATTRIBUTES, prism.indices, prism.index_count);
    const double after =
        enclosed_volume(shape.attributes, DIP_SHAPE_ATTRIBUTES, shape.indices, shape.index_count);
    assert_near(after, before, 1e-5);
    free(joined);
    free(factors);
    dip_shape_free(&shape);
    dip_shape_free(&prism);
}

static void neighbours_meet_without_cracks(void **context) {
    (void)context;
    for (int sides = 3; sides < 12; sides++) {
        check_closed(DIP_PARTITIONING_INTEGER, sides, 1.0f, 20.0f);
        check_closed(DIP_PARTITIONING_FRACTIONAL_ODD, sides, 1.3125f, 20.0f);
        check_closed(DIP_PARTITIONING_FRACTIONAL_ODD, sides, 1.3125f, 64.0f);
    }
}

// Two quadrilaterals that share an edge in opposite directions have the same points there.
static void quadrilaterals_share_their_edges(void **context) {
    (void)context;
    Random random = {2};
    for (int i = 0; i < 300; i++) {
        float control[6][3];
        for (int k = 0; k < 18; k++) {
            control[k / 3][k % 3] = (float)random_real(&random, -5.0, 5.0);
        }
        // The shared edge has the points 1 and 2. It is u = 1 of the first patch, and each edge of
        // the second one in turn.
        static const uint32_t others[4][4] = {
            {1, 5, 4, 2}, {2, 1, 5, 4}, {4, 2, 1, 5}, {5, 4, 2, 1}};
        static const int edge_of[4] = {0, 1, 2, 3};
        uint32_t indices[8] = {0, 1, 2, 3};
        memcpy(indices + 4, others[i % 4], sizeof others[0]);
        DipTessellationFactors factors[2];
        for (int k = 0; k < 2; k++) {
            factors[k] = equal_factors((float)random_real(&random, 1.5, 30.0));
        }
        factors[0].edge[2] = factors[1].edge[edge_of[i % 4]] =
            (float)random_real(&random, 1.0, 63.0);
        const DipTessellationDef def = {.domain = DIP_DOMAIN_QUAD,
                                        .partitioning = DIP_PARTITIONING_FRACTIONAL_ODD,
                                        .attributes = &control[0][0],
                                        .attribute_count = 3,
                                        .vertex_count = 6,
                                        .indices = indices,
                                        .index_count = 8,
                                        .factors = factors,
                                        .function = dip_domain_linear,
                                        .out_attribute_count = 3};
        DipShape shape;
        assert_true(dip_tessellate(&shape, &def, NULL));
        uint32_t *joined = malloc(shape.index_count * sizeof *joined);
        join_positions(shape.attributes, 3, shape.vertex_count, shape.indices, shape.index_count,
                       joined);
        const size_t apart = count_edges(shape.indices, shape.index_count).border;
        const size_t together = count_edges(joined, shape.index_count).border;
        const int shared = parts_of(factors[0].edge[2], DIP_PARTITIONING_FRACTIONAL_ODD);
        assert_int_equal(apart - together, 2 * shared);
        free(joined);
        dip_shape_free(&shape);
    }
}

// --- the caller's function -----------------------------------------------------------------------

typedef struct Seen {
    uint32_t patches;
    int points;
} Seen;

static void count_points(const DipDomainBatch *batch) {
    Seen *seen = (Seen *)batch->uniforms;
    assert_true(batch->control[0] == &corners[0][0] + 3 * one_patch[batch->patch % 2]);
    seen->patches |= 1u << batch->patch;
    seen->points += batch->count;
    memset(batch->out, 0,
           (size_t)batch->count * (size_t)batch->out_attribute_count * sizeof(float));
}

static void patches_without_points_are_left_out(void **context) {
    (void)context;
    const uint32_t indices[12] = {0, 1, 2, 1, 2, 3, 0, 3, 1, 1, 3, 0};
    DipTessellationFactors factors[4] = {equal_factors(2.0f), equal_factors(2.0f),
                                         equal_factors(2.0f), equal_factors(2.0f)};
    factors[1].edge[2] = 0.0f;
    factors[2].edge[0] = -1.0f;
    Seen seen = {0, 0};
    DipTessellationDef def = one_patch_def(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, factors);
    def.indices = indices;
    def.index_count = 12;
    def.function = count_points;
    def.uniforms = &seen;
    def.out_attribute_count = 5;
    DipShape shape;
    assert_true(dip_tessellate(&shape, &def, NULL));
    assert_int_equal(seen.patches, 1 | 8);
    assert_int_equal(seen.points, 14);
    assert_int_equal(shape.vertex_count, 14);
    assert_int_equal(shape.index_count, 2 * 18);
    assert_int_equal(shape.attribute_count, 5);
    dip_shape_free(&shape);
    def.index_count = 0;
    assert_true(dip_tessellate(&shape, &def, NULL));
    assert_int_equal(shape.index_count, 0);
    dip_shape_free(&shape);
}

// --- refusals ------------------------------------------------------------------------------------

static void check_refused(const DipTessellationDef *def, DipErrorCode code, const char *key) {
    DipShape shape;
    DipError err;
    assert_false(dip_tessellate(&shape, def, &err));
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
    assert_null(shape.attributes);
    assert_null(shape.indices);
}

static void bad_input_is_refused_by_name(void **context) {
    (void)context;
    DipTessellationFactors factors = equal_factors(4.0f);
    const uint32_t beyond[3] = {0, 4, 1};
    const DipTessellationDef good =
        one_patch_def(DIP_DOMAIN_TRIANGLE, DIP_PARTITIONING_INTEGER, &factors);
    DipTessellationDef def;
#define REFUSED(code, key, change)                                                                 \
    do {                                                                                           \
        def = good;                                                                                \
        change;                                                                                    \
        check_refused(&def, DIP_ERROR_##code, key);                                                \
    } while (0)
    REFUSED(RANGE, "domain", def.domain = DIP_DOMAIN_COUNT);
    REFUSED(RANGE, "partitioning", def.partitioning = DIP_PARTITIONING_COUNT);
    REFUSED(RANGE, "attribute_count", def.attribute_count = 0);
    REFUSED(RANGE, "out_attribute_count", def.out_attribute_count = 0);
    REFUSED(RANGE, "out_attribute_count", def.out_attribute_count = 17);
    REFUSED(RANGE, "out_attribute_count", def.function = dip_domain_linear;
            def.out_attribute_count = 4);
    REFUSED(FORMAT, "index_count", def.index_count = 4);
    REFUSED(MISSING, "attributes", def.attributes = NULL);
    REFUSED(MISSING, "indices", def.indices = NULL);
    REFUSED(MISSING, "factors", def.factors = NULL);
    REFUSED(MISSING, "function", def.function = NULL);
    REFUSED(RANGE, "indices", def.indices = beyond);
    factors.edge[1] = NAN;
    REFUSED(RANGE, "factors", (void)0);
    factors = equal_factors(4.0f);
    factors.inside[0] = NAN;
    REFUSED(RANGE, "factors", (void)0);
    factors = equal_factors(4.0f);
    factors.inside[1] = factors.edge[3] = NAN; // a triangle has neither
    DipShape shape;
    assert_true(dip_tessellate(&shape, &good, NULL));
    dip_shape_free(&shape);
#undef REFUSED
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_factors_give_the_counts_of_direct3d),
        cmocka_unit_test(edges_are_divided_as_direct3d_divides_them),
        cmocka_unit_test(points_slide_and_do_not_jump),
        cmocka_unit_test(pieces_cover_the_domain_once),
        cmocka_unit_test(neighbours_meet_without_cracks),
        cmocka_unit_test(quadrilaterals_share_their_edges),
        cmocka_unit_test(patches_without_points_are_left_out),
        cmocka_unit_test(bad_input_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
