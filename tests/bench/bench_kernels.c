// Measures what the kernels cost per unit of work on every instruction set of this machine. Compare
// the table before and after a change to a kernel.
//
//   dip_bench_kernels [ROW [ISA]]      only rows whose name contains ROW, only one instruction set
//
// Cycles are core cycles. Their length is measured with a chain of dependent additions, each of
// which takes one cycle. Every number is the fastest of many measurements.
#include "app/cli/machine.h"
#include "renderer/base/assert.h"
#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/geometry/setup.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/catalogue/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 60, SEED = 4711, TRIANGLES = 512 };

// A tile with its depth and visibility buffers, and the triangles to draw into it.
typedef struct Raster {
    _Alignas(64) float depth[DIP_BLOCKS * DIP_BLOCK_PIXELS * DIP_MAX_SAMPLES];
    _Alignas(64) uint32_t ids[DIP_BLOCKS * DIP_BLOCK_PIXELS * DIP_MAX_SAMPLES];
    DipTile tile;
    DipTriangle triangles[TRIANGLES + DIP_SETUP_EXCESS];
    int triangle_count;
} Raster;

static Raster raster;

// A kernel with one kind of input. `prepare` fills the input; `run` does the work once and returns
// the number of units of work.
typedef struct Row {
    const char *name;
    const char *unit;
    void (*prepare)(int parameter);
    double (*run)(const DipKernels *kernels);
    int parameter;
} Row;

// --- coverage and depth ------------------------------------------------------------------------

static void begin_raster(int sample_count) {
    raster.tile = (DipTile){.pattern = dip_sample_pattern(sample_count)};
    raster.tile.depth = raster.depth;
    raster.tile.id = raster.ids;
    raster.triangle_count = 0;
}

// Adds a triangle with corners in pixels. The triangle is nearer (its depth is greater) than all
// triangles that were added before.
static void add_triangle(const double x[3], const double y[3]) {
    static DipScreenBatch screen;
    static uint8_t corner[3][DIP_BATCH_ALIGN];
    static float surfaces[(1 + DIP_SETUP_EXCESS) * DIP_PLANES_ALIGN];
    for (int i = 0; i < 3; i++) {
        screen.x[i] = (int32_t)(x[i] * 256.0);
        screen.y[i] = (int32_t)(y[i] * 256.0);
        screen.z[i] = 0.1f + 0.001f * (float)raster.triangle_count + 0.0001f * (float)i;
        screen.rw[i] = 1.0f;
        corner[i][0] = (uint8_t)i;
    }
    const DipSetupTarget target = {.width = DIP_TILE,
                                   .height = DIP_TILE,
                                   .region_last = {DIP_TILE - 1, DIP_TILE - 1},
                                   .plane_stride = DIP_PLANES_ALIGN,
                                   .cull = DIP_CULL_NONE,
                                   .sample_max = {255, 255}};
    const uint32_t patch[DIP_BATCH_ALIGN] = {0};
    const DipSetupBatch batch = {
        .count = 1, .corner = {corner[0], corner[1], corner[2]}, .patch = patch, .screen = &screen};
    raster.triangle_count +=
        dip_kernels(DIP_ISA_SCALAR)
            ->dip_kernel_setup(&target, &batch, raster.triangles + raster.triangle_count, surfaces);
}

static void prepare_full_tile(int sample_count) {
    begin_raster(sample_count);
    add_triangle((double[]){-10.0, 200.0, -10.0}, (double[]){-10.0, -10.0, 200.0});
}

static void prepare_small(int sample_count, double area_px) {
    Random random = {SEED};
    begin_raster(sample_count);
    while (raster.triangle_count < TRIANGLES) {
        double x[3];
        double y[3];
        const double at_x = random_real(&random, 8.0, DIP_TILE - 8.0);
        const double at_y = random_real(&random, 8.0, DIP_TILE - 8.0);
        const double reach = area_px < 10.0 ? 2.5 : 8.0;
        for (int i = 0; i < 3; i++) {
            x[i] = at_x + random_real(&random, -reach, reach);
            y[i] = at_y + random_real(&random, -reach, reach);
        }
        const double area = 0.5 * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
        if (area > 0.9 * area_px && area < 1.1 * area_px) {
            add_triangle(x, y);
        }
    }
}

static void prepare_3_pixels(int sample_count) {
    prepare_small(sample_count, 3.0);
}

static void prepare_60_pixels(int sample_count) {
    prepare_small(sample_count, 60.0);
}

static void draw_triangles(const DipKernels *kernels) {
    raster.tile.touched = 0;
    for (int t = 0; t < raster.triangle_count; t++) {
        kernels->dip_kernel_draw_triangle(&raster.tile, &raster.triangles[t], (uint32_t)t + 1,
                                          NULL);
    }
}

static double run_full_tile(const DipKernels *kernels) {
    draw_triangles(kernels);
    return DIP_TILE * DIP_TILE;
}

static double run_small(const DipKernels *kernels) {
    draw_triangles(kernels);
    return raster.triangle_count;
}

// --- texture reads -----------------------------------------------------------------------------

enum { TEXELS = 1024, BATCHES_X = 80, BATCHES = 10 * BATCHES_X };

// A strip of 640x80 fragments that sample one texture, in batches of 8x8.
typedef struct Reads {
    DipTexture *texture;
    DipSampler sampler;
    DipFragmentBatch batch;
    float u[BATCHES][DIP_FRAGMENT_BATCH];
    float v[BATCHES][DIP_FRAGMENT_BATCH];
} Reads;

static Reads reads;

// Texels of level 0 per pixel along x and y.
typedef struct Footprint {
    float x;
    float y;
    int max_anisotropy;
    bool exact_footprint;
} Footprint;

enum { MAGNIFIED, TRILINEAR, AF_2, AF_4, AF_16, AF_16_ADVANCED };

static const Footprint footprints[] = {
    [MAGNIFIED] = {0.3f, 0.3f, 1, false}, [TRILINEAR] = {2.8f, 2.8f, 1, false},
    [AF_2] = {2.8f, 1.4f, 16, false},     [AF_4] = {5.6f, 1.4f, 16, false},
    [AF_16] = {22.4f, 1.4f, 16, false},   [AF_16_ADVANCED] = {22.4f, 1.4f, 16, true},
};

static void make_texture(void) {
    static uint8_t rgba8[TEXELS * TEXELS * 4];
    Random random = {SEED};
    for (size_t i = 0; i < sizeof rgba8; i++) {
        rgba8[i] = i % 4 == 3 ? 255 : (uint8_t)random_u64(&random);
    }
    const DipTextureDef def = {.name = "noise",
                               .width = TEXELS,
                               .height = TEXELS,
                               .rgba8 = rgba8,
                               .encoding = DIP_ENCODING_SRGB};
    reads.texture = dip_texture_create(&def, NULL);
    DIP_ASSERT(reads.texture);
}

static void prepare_reads(int kind) {
    const Footprint *footprint = &footprints[kind];
    if (!reads.texture) {
        make_texture();
    }
    reads.sampler = (DipSampler){.texture = reads.texture,
                                 .max_anisotropy = footprint->max_anisotropy,
                                 .exact_footprint = footprint->exact_footprint};
    const float step_x = footprint->x / TEXELS;
    const float step_y = footprint->y / TEXELS;
    reads.batch.count = DIP_FRAGMENT_BATCH;
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        reads.batch.varying_dx[0][i] = step_x;
        reads.batch.varying_dx[1][i] = 0.0f;
        reads.batch.varying_dy[0][i] = 0.0f;
        reads.batch.varying_dy[1][i] = step_y;
        for (int b = 0; b < BATCHES; b++) {
            const int x = b % BATCHES_X * DIP_BLOCK + dip_block_x(i);
            const int y = b / BATCHES_X * DIP_BLOCK + dip_block_y(i);
            reads.u[b][i] = (float)x * step_x + 0.013f;
            reads.v[b][i] = (float)y * step_y + 0.017f;
        }
    }
}

static double run_reads(const DipKernels *kernels) {
    static float out[3][DIP_FRAGMENT_BATCH];
    for (int b = 0; b < BATCHES; b++) {
        memcpy(reads.batch.varying[0], reads.u[b], sizeof reads.u[b]);
        memcpy(reads.batch.varying[1], reads.v[b], sizeof reads.v[b]);
        kernels->dip_kernel_sample_colour(&reads.batch, &reads.sampler, 0, out);
    }
    return BATCHES * DIP_FRAGMENT_BATCH;
}

// --- the table ---------------------------------------------------------------------------------

static const Row rows[] = {
    // One triangle fills a tile that has just been cleared.
    {"tile, 1 sample", "pixel", prepare_full_tile, run_full_tile, 1},
    {"tile, 2 samples", "pixel", prepare_full_tile, run_full_tile, 2},
    {"tile, 4 samples", "pixel", prepare_full_tile, run_full_tile, 4},
    {"tile, 8 samples", "pixel", prepare_full_tile, run_full_tile, 8},
    {"3-pixel triangles, 1 sample", "triangle", prepare_3_pixels, run_small, 1},
    {"3-pixel triangles, 4 samples", "triangle", prepare_3_pixels, run_small, 4},
    {"60-pixel triangles, 1 sample", "triangle", prepare_60_pixels, run_small, 1},
    {"60-pixel triangles, 4 samples", "triangle", prepare_60_pixels, run_small, 4},
    {"texture, magnified", "fragment", prepare_reads, run_reads, MAGNIFIED},
    {"texture, trilinear", "fragment", prepare_reads, run_reads, TRILINEAR},
    {"texture, AF 16 at 2:1", "fragment", prepare_reads, run_reads, AF_2},
    {"texture, AF 16 at 4:1", "fragment", prepare_reads, run_reads, AF_4},
    {"texture, AF 16 at 16:1", "fragment", prepare_reads, run_reads, AF_16},
    {"texture, advanced AF 16 at 16:1", "fragment", prepare_reads, run_reads, AF_16_ADVANCED},
};

static double fastest_ns_per_unit(const Row *row, const DipKernels *kernels) {
    enum { REPEAT = 20 };
    double fastest = 1e30;
    for (int round = 0; round < ROUNDS; round++) {
        const int64_t begin = dip_clock_ns();
        double units = 0.0;
        for (int i = 0; i < REPEAT; i++) {
            units += row->run(kernels);
        }
        const double ns = (double)(dip_clock_ns() - begin) / units;
        fastest = ns < fastest ? ns : fastest;
    }
    return fastest;
}

static void measure_row(const Row *row, const char *only_isa, double ns_per_cycle) {
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        const bool wanted = !only_isa || strcmp(only_isa, dip_isa_name((DipIsa)isa)) == 0;
        if (!wanted || !dip_isa_available((DipIsa)isa)) {
            continue;
        }
        row->prepare(row->parameter);
        const double ns = fastest_ns_per_unit(row, dip_kernels((DipIsa)isa));
        printf("%-32s %-8s %10.3f ns %10.2f cycles per %s\n", row->name, dip_isa_name((DipIsa)isa),
               ns, ns / ns_per_cycle, row->unit);
    }
}

int main(int argc, char **argv) {
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        fprintf(stderr, "usage: dip_bench_kernels [ROW [ISA]]\n");
        return 2;
    }
    dip_fp_mode_set();
    const double ns_per_cycle = dip_machine_ns_per_cycle();
    printf("one cycle is %.3f ns\n", ns_per_cycle);
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(rows); i++) {
        if (argc < 2 || strstr(rows[i].name, argv[1])) {
            measure_row(&rows[i], argc > 2 ? argv[2] : NULL, ns_per_cycle);
        }
    }
    return 0;
}
