// Tests depths that outlive a pass: copies, passes without colours, and shadow maps by brute force.
#include "state_stage.h"

#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// --- copies of depths ----------------------------------------------------------------------------

static void depths_are_copied(void **state) {
    (void)state;
    DipDepth *depth = dip_depth_create(5, 3, 4, NULL);
    DipDepth *copy = dip_depth_create(5, 3, 4, NULL);
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < 3; y++) {
            for (int x = 0; x < 5; x++) {
                dip_depth_row(depth, s, y)[x] = (float)(s * 100 + y * 10 + x) / 512.0f;
                dip_stencil_row(depth, s, y)[x] = (uint8_t)(s * 50 + y * 10 + x);
            }
        }
    }
    assert_true(dip_depth_copy(copy, depth, NULL));
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < 3; y++) {
            assert_memory_equal(dip_depth_row(copy, s, y), dip_depth_row(depth, s, y), 5 * 4);
            assert_memory_equal(dip_stencil_row(copy, s, y), dip_stencil_row(depth, s, y), 5);
        }
    }
    static const int others[3][3] = {{6, 3, 4}, {5, 4, 4}, {5, 3, 2}};
    for (int k = 0; k < 3; k++) {
        DipDepth *other = dip_depth_create(others[k][0], others[k][1], others[k][2], NULL);
        DipError err = {0};
        assert_false(dip_depth_copy(other, depth, &err));
        assert_int_equal(err.code, DIP_ERROR_CONFLICT);
        assert_true(dip_depth_row(other, 1, 2)[4] == 0.0f);
        dip_depth_destroy(&other);
    }
    dip_depth_destroy(&copy);
    dip_depth_destroy(&depth);
}

// --- passes without colours, shadow maps ---------------------------------------------------------

// A pass without colours leaves the depths that the same pass with colours leaves, and runs no
// fragment shader.
static void depth_only(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    const float c[3][3] = {{-20, 5, 0.1f}, {90, 10, 0.9f}, {30, 80, 0.4f}};
    DipMesh *mesh = triangles(&c[0][0], 3);
    DipDepth *depths[2];
    for (int i = 0; i < 2; i++) {
        depths[i] = dip_depth_create(WIDTH, HEIGHT, 4, NULL);
        DipDraw draw = draw_of(mesh, &white, NULL);
        DipPass pass = pass_of(&draw, 1, 4);
        pass.attachments.depth = depths[i];
        if (i == 1) {
            draw.fragment_shader = NULL;
            pass.target.rgba8 = NULL;
        }
        run(&pass);
    }
    int covered = 0;
    for (int s = 0; s < 4; s++) {
        for (int y = 0; y < HEIGHT; y++) {
            assert_memory_equal(dip_depth_row(depths[0], s, y), dip_depth_row(depths[1], s, y),
                                WIDTH * sizeof(float));
            for (int x = 0; x < WIDTH; x++) {
                covered += dip_depth_row(depths[0], s, y)[x] > 0.0f;
            }
        }
    }
    assert_in_range(covered, 4 * 2000, 4 * WIDTH * HEIGHT);
    dip_depth_destroy(&depths[0]);
    dip_depth_destroy(&depths[1]);
    dip_mesh_destroy(&mesh);
}

enum { MAP_WIDTH = 13, MAP_HEIGHT = 9, READS = 64 };

typedef struct ShadowReads {
    DipShadowMap map;
    float u[READS], v[READS], z[READS];
    float lit[READS];
} ShadowReads;

// Runs the reads in one fragment, whatever its position.
static void read_shadow(DipFragmentBatch *batch) {
    ShadowReads *reads = *(ShadowReads *const *)batch->uniforms;
    float lit[READS];
    const int count = batch->count;
    batch->count = READS;
    batch->sample_shadow(batch, &reads->map, reads->u, reads->v, reads->z, lit);
    batch->count = count;
    memcpy(reads->lit, lit, sizeof lit);
}

static double texel_lit(DipDepth *depth, int x, int y, double z) {
    x = x < 0 ? 0 : x >= MAP_WIDTH ? MAP_WIDTH - 1 : x;
    y = y < 0 ? 0 : y >= MAP_HEIGHT ? MAP_HEIGHT - 1 : y;
    return z >= (double)dip_depth_row(depth, 0, y)[x];
}

// Returns the mean over a square of 2x2 texels around a point, in texels. Each texel has the weight
// of the area that it has in common with the square.
static double wide_light(DipDepth *depth, double x, double y, double z) {
    double sum = 0.0;
    for (int row = (int)floor(y - 1.0); row < y + 1.0; row++) {
        const double height = fmin(row + 1.0, y + 1.0) - fmax(row, y - 1.0);
        for (int column = (int)floor(x - 1.0); column < x + 1.0; column++) {
            const double width = fmin(column + 1.0, x + 1.0) - fmax(column, x - 1.0);
            sum += width * height * texel_lit(depth, column, row, z);
        }
    }
    return sum / 4.0;
}

static double expected_light(const ShadowReads *reads, DipDepth *depth, int i) {
    const double u = reads->u[i];
    const double v = reads->v[i];
    const double z = fmax(reads->z[i], 0.0); // behind the far plane: as if on it
    if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) {
        return 1.0;
    }
    if (reads->map.filter == DIP_SHADOW_NEAREST) {
        return texel_lit(depth, (int)(u * MAP_WIDTH), (int)(v * MAP_HEIGHT), z);
    }
    if (reads->map.filter == DIP_SHADOW_WIDE) {
        return wide_light(depth, u * MAP_WIDTH, v * MAP_HEIGHT, z);
    }
    const double x = u * MAP_WIDTH - 0.5;
    const double y = v * MAP_HEIGHT - 0.5;
    const int x0 = (int)floor(x);
    const int y0 = (int)floor(y);
    const double fx = x - x0;
    const double fy = y - y0;
    return texel_lit(depth, x0, y0, z) * (1 - fx) * (1 - fy) +
           texel_lit(depth, x0 + 1, y0, z) * fx * (1 - fy) +
           texel_lit(depth, x0, y0 + 1, z) * (1 - fx) * fy +
           texel_lit(depth, x0 + 1, y0 + 1, z) * fx * fy;
}

static void shadow_maps(void **state) {
    (void)state;
    Random random = {21};
    DipDepth *depth = dip_depth_create(MAP_WIDTH, MAP_HEIGHT, 1, NULL);
    for (int y = 0; y < MAP_HEIGHT; y++) {
        for (int x = 0; x < MAP_WIDTH; x++) {
            dip_depth_row(depth, 0, y)[x] = (float)random_int(&random, 0, 8) / 8.0f;
        }
    }
    static ShadowReads reads;
    ShadowReads *pointer = &reads;
    DipMesh *mesh = rectangle(10, 10, 11, 11, 0.5f);
    DipDraw draw = draw_of(mesh, NULL, NULL);
    draw.fragment_shader = read_shadow;
    draw.uniforms = &pointer;
    const DipPass pass = pass_of(&draw, 1, 1);
    for (int round = 0; round < 200; round++) {
        reads.map = (DipShadowMap){depth, (DipShadowFilter)(round % 3)};
        for (int i = 0; i < READS; i++) {
            reads.u[i] = (float)random_real(&random, -0.1, 1.1);
            reads.v[i] = (float)random_real(&random, -0.1, 1.1);
            reads.z[i] = (float)random_int(&random, -4, 16) / 16.0f;
        }
        run(&pass);
        for (int i = 0; i < READS; i++) {
            const double expected = expected_light(&reads, depth, i);
            // Weights are whole 1/256; nearest reads are rounded to 1/256 texel.
            if (fabs((double)reads.lit[i] - expected) > 1.0 / 128.0) {
                const double x = (double)reads.u[i] * MAP_WIDTH;
                const double y = (double)reads.v[i] * MAP_HEIGHT;
                const bool between = reads.map.filter == DIP_SHADOW_NEAREST &&
                                     (fabs(x - rint(x)) < 1e-4 || fabs(y - rint(y)) < 1e-4);
                if (!between) {
                    fail_msg("u %.6f, v %.6f: light %.5f, expected %.5f", (double)reads.u[i],
                             (double)reads.v[i], (double)reads.lit[i], expected);
                }
            }
        }
    }
    dip_mesh_destroy(&mesh);
    dip_depth_destroy(&depth);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depths_are_copied),
        cmocka_unit_test(depth_only),
        cmocka_unit_test(shadow_maps),
    };
    return cmocka_run_group_tests(tests, open_pipeline, close_pipeline);
}
