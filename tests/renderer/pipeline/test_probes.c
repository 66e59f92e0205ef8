// Tests anisotropic texture reads. A read is the mean of several probes (bilinear samples along the
// pixel's footprint) and takes fewer probes in the coarser of two mip levels. Compares the kernels
// of every instruction set with closed forms and with the reference in double precision.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "renderer/reference/internal/differences.h"
#include "renderer/reference/internal/texture.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

enum { SIZE = 256, LANES = DIP_FRAGMENT_BATCH };

static uint8_t texels[4 * SIZE * SIZE];

// One texture, which a kernel of some instruction set and the reference both read.
typedef struct Bench {
    DipTexture *fast;
    DipRefTexture reference;
    DipTextureDef def;
    DipFragmentBatch batch;
    float colour[3][LANES];
    float alpha[LANES];
} Bench;

static Bench bench;

static void open_bench(DipWrap wrap) {
    bench.def = (DipTextureDef){.name = "test",
                                .width = SIZE,
                                .height = SIZE,
                                .rgba8 = texels,
                                .encoding = DIP_ENCODING_LINEAR,
                                .wrap_u = wrap,
                                .wrap_v = wrap,
                                .border_rgba8 = {250, 5, 130, 70}};
    bench.fast = dip_texture_create(&bench.def, NULL);
    assert_non_null(bench.fast);
    assert_true(dip_reference_texture_init(&bench.reference, &bench.def, DIP_REF_MAX_LEVELS, NULL));
}

static void close_bench(void) {
    dip_texture_destroy(&bench.fast);
    dip_reference_texture_free(&bench.reference);
}

// Places the footprint of lane i at (u, v), in texels. It is `major` texels long, `minor` texels
// wide, and turned by `angle`.
static void place(int i, double u, double v, double major, double minor, double angle) {
    const double dx[2] = {major * cos(angle), major * sin(angle)};
    const double dy[2] = {-minor * sin(angle), minor * cos(angle)};
    const double at[2] = {u, v};
    for (int s = 0; s < 2; s++) {
        bench.batch.varying[s][i] = (float)(at[s] / SIZE);
        bench.batch.varying_dx[s][i] = (float)(dx[s] / SIZE);
        bench.batch.varying_dy[s][i] = (float)(dy[s] / SIZE);
    }
}

static void sample(const DipKernels *kernels, bool cheap) {
    const DipSampler sampler = {
        .texture = bench.fast, .max_anisotropy = 16, .exact_footprint = true, .cheap = cheap};
    bench.batch.count = LANES;
    bench.batch.work = (DipShaderWork){0};
    kernels->dip_kernel_sample_alpha(&bench.batch, &sampler, 0, bench.alpha);
    bench.batch.work = (DipShaderWork){0};
    kernels->dip_kernel_sample_colour(&bench.batch, &sampler, 0, bench.colour);
}

#define FOR_EACH_ISA(kernels)                                                                      \
    for (int isa = DIP_ISA_SCALAR; isa < DIP_ISA_COUNT; isa++)                                     \
        for (const DipKernels *kernels = dip_isa_available((DipIsa)isa) ? dip_kernels((DipIsa)isa) \
                                                                        : NULL;                    \
             kernels; kernels = NULL)

// The texels' values rise by one per column and fall by one per row, and light is linear in these
// values. If the probes are spread evenly around the middle of a footprint, a read gives the value
// at the middle. The number of probes does not matter.
static void a_ramp_is_read_exactly(void **state) {
    (void)state;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const uint8_t texel[4] = {(uint8_t)(i % SIZE), (uint8_t)(SIZE - 1 - i / SIZE), 0,
                                  (uint8_t)(i % SIZE)};
        memcpy(texels + 4 * i, texel, 4);
    }
    open_bench(DIP_WRAP_CLAMP);
    FOR_EACH_ISA(kernels) {
        Random random = {7};
        for (int round = 0; round < 100; round++) {
            double u[LANES], v[LANES];
            for (int i = 0; i < LANES; i++) {
                const double minor = exp2(random_real(&random, 0.0, 2.0));
                u[i] = random_real(&random, 48.0, 208.0);
                v[i] = random_real(&random, 48.0, 208.0);
                place(i, u[i], v[i], minor * random_real(&random, 1.0, 16.0), minor,
                      random_real(&random, -3.0, 3.0));
            }
            sample(kernels, round % 2);
            for (int i = 0; i < LANES; i++) {
                // Tolerances: probe positions are rounded down by up to 8/256 texel. Alpha has 8
                // bits. Red and green are stored as the square root of light, in steps of 1/2048.
                assert_near(bench.colour[0][i] * 255.0, u[i] - 0.5 - 1.0 / 64.0, 0.14);
                assert_near(bench.colour[1][i] * 255.0, SIZE - 0.5 - v[i] + 1.0 / 64.0, 0.14);
                assert_near(bench.alpha[i] * 255.0, u[i] - 0.5 - 1.0 / 64.0, 0.6);
            }
        }
    }
    close_bench();
}

// Reads stripes of 10 texels each along u, with a footprint 20 texels long and 1.25 texels wide.
// The read takes 16 probes in level 0 and half as many as that in level 1, whose weight is log2
// 1.25. Both numbers are even, so every probe has a partner half a period away that reads the
// opposite stripe. The mean is therefore 1/2 wherever the footprint lies. An odd number of probes,
// or probes in other positions, would give another mean.
static void a_footprint_of_one_period_reads_the_mean_of_stripes(void **state) {
    (void)state;
    enum { PERIOD = 20, WIDTH = 240 };
    for (int i = 0; i < SIZE * SIZE; i++) {
        memset(texels + 4 * i, i % WIDTH / (PERIOD / 2) % 2 ? 255 : 0, 4);
    }
    bench.def = (DipTextureDef){.name = "stripes",
                                .width = WIDTH,
                                .height = SIZE,
                                .rgba8 = texels,
                                .encoding = DIP_ENCODING_LINEAR};
    bench.fast = dip_texture_create(&bench.def, NULL);
    assert_non_null(bench.fast);
    FOR_EACH_ISA(kernels) {
        for (int i = 0; i < LANES; i++) {
            place(i, 0.0, 100.0, 20.0, 1.25, 0.0);
            bench.batch.varying[0][i] = (float)((100.0 + i * 0.37) / WIDTH);
            bench.batch.varying_dx[0][i] = (float)(20.0 / WIDTH);
        }
        sample(kernels, false);
        assert_int_equal(bench.batch.work.probes, LANES * 16);
        assert_int_equal(bench.batch.work.texels, LANES * 4 * (16 + 8));
        for (int i = 0; i < LANES; i++) {
            assert_near(bench.colour[0][i], 0.5, 0.003);
            assert_near(bench.alpha[i], 0.5, 0.003);
        }
    }
    dip_texture_destroy(&bench.fast);
}

// If the coarser level has the weight f, it takes ceil(N max(1/2, f)) of the N probes, or none if f
// is 0.
static void the_coarser_level_takes_fewer_probes(void **state) {
    (void)state;
    static const struct {
        double major, minor;
        int near, far;
    } cases[] = {{16.0, 1.0, 16, 0},  {16.0, 1.1, 15, 8},  {15.9, 1.5, 11, 7},
                 {15.9, 1.75, 10, 9}, {15.9, 1.98, 9, 9},  {4.0, 2.0, 2, 0},
                 {1.3, 1.2, 2, 1},    {40.0, 3.6, 12, 11}, {1.9, 1.9, 1, 1}};
    open_bench(DIP_WRAP_REPEAT);
    FOR_EACH_ISA(kernels) {
        for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
            for (int i = 0; i < LANES; i++) {
                place(i, 99.0, 77.0, cases[k].major, cases[k].minor, 0.0);
            }
            sample(kernels, false);
            assert_int_equal(bench.batch.work.probes, LANES * cases[k].near);
            assert_int_equal(bench.batch.work.texels, LANES * 4 * (cases[k].near + cases[k].far));
        }
    }
    close_bench();
}

// A texture of noise reveals even the smallest difference in the positions or the number of probes.
static void check_noise(DipWrap wrap) {
    Random noise = {11};
    for (int i = 0; i < 4 * SIZE * SIZE; i++) {
        texels[i] = (uint8_t)random_u64(&noise);
    }
    open_bench(wrap);
    FOR_EACH_ISA(kernels) {
        Random random = {12};
        double worst = 0.0;
        int far_off = 0;
        for (int round = 0; round < 100; round++) {
            for (int i = 0; i < LANES; i++) {
                const double minor = exp2(random_real(&random, -1.0, 5.0));
                place(i, random_real(&random, -300.0, 300.0), random_real(&random, -300.0, 300.0),
                      minor * random_real(&random, 1.0, 20.0), minor,
                      random_real(&random, -3.0, 3.0));
            }
            const bool cheap = round % 2;
            sample(kernels, cheap);
            const DipRefFilter filter = {
                .max_anisotropy = 16, .exact_footprint = true, .cheap = cheap};
            for (int i = 0; i < LANES; i++) {
                const double uv[2] = {bench.batch.varying[0][i], bench.batch.varying[1][i]};
                const double dx[2] = {bench.batch.varying_dx[0][i], bench.batch.varying_dx[1][i]};
                const double dy[2] = {bench.batch.varying_dy[0][i], bench.batch.varying_dy[1][i]};
                double rgba[4];
                dip_reference_sample(&bench.reference, &filter, uv, dx, dy, rgba);
                const double off =
                    fmax(fabs(bench.colour[0][i] - rgba[0]), fabs(bench.alpha[i] - rgba[3]));
                // Rounding may make the kernel's and the reference's levels of detail differ by
                // 1/256.
                far_off += off > 0.01;
                worst = fmax(worst, off > 0.01 ? 0.0 : off);
            }
        }
        assert_true(far_off <= 3);
        assert_near(worst, 0.0, 0.008);
    }
    close_bench();
}

static void noise_is_read_as_the_reference_reads_it(void **state) {
    (void)state;
    for (int wrap = 0; wrap < DIP_WRAP_COUNT; wrap++) {
        check_noise((DipWrap)wrap);
    }
}

// With the same rounded texels, a read differs from the reference by what the filter rounds off, as
// judges that compare with such a reference allow. Footprints lie where neither a position nor a
// level of detail is near a tie.
static void rounded_texels_leave_the_rounding_of_the_filter(void **state) {
    (void)state;
    Random random = {13};
    for (int i = 0; i < 4 * SIZE * SIZE; i++) {
        texels[i] = i < 2 * SIZE * SIZE ? (uint8_t)random_u64(&random) : 255;
    }
    open_bench(DIP_WRAP_REPEAT);
    assert_true(dip_reference_round_texture(&bench.reference, NULL));
    FOR_EACH_ISA(kernels) {
        double worst[3] = {0.0};
        for (int round = 0; round < 200; round++) {
            for (int i = 0; i < LANES; i++) {
                const double size = exp2((random_int(&random, -128, 640) + 0.25) / 256.0);
                place(i, (4 * random_int(&random, 0, 65535) + 1) / 1024.0,
                      (4 * random_int(&random, 0, 65535) + 1) / 1024.0, size, size, 0.0);
            }
            const DipSampler sampler = {.texture = bench.fast,
                                        .max_anisotropy = round % 2 ? 16 : 1,
                                        .exact_footprint = true};
            bench.batch.count = LANES;
            kernels->dip_kernel_sample_colour(&bench.batch, &sampler, 0, bench.colour);
            const DipRefFilter filter = {.max_anisotropy = sampler.max_anisotropy,
                                         .exact_footprint = true};
            for (int i = 0; i < LANES; i++) {
                const double uv[2] = {bench.batch.varying[0][i], bench.batch.varying[1][i]};
                const double dx[2] = {bench.batch.varying_dx[0][i], bench.batch.varying_dx[1][i]};
                const double dy[2] = {bench.batch.varying_dy[0][i], bench.batch.varying_dy[1][i]};
                double rgba[4];
                dip_reference_sample(&bench.reference, &filter, uv, dx, dy, rgba);
                for (int c = 0; c < 3; c++) {
                    worst[c] = fmax(worst[c], fabs(bench.colour[c][i] - rgba[c]));
                }
            }
        }
        for (int c = 0; c < 3; c++) {
            assert_near(worst[c], 0.0, DIP_REF_MOST_SHIFT);
        }
    }
    close_bench();
}

// The smallest level (one texel) is read through a footprint of 16 times 256 texels of the largest
// level, so every lane takes 16 probes. A least level of detail beyond the chain means the smallest
// level, so it must not change that number.
static void a_least_level_beyond_the_chain_is_the_smallest_level(void **state) {
    (void)state;
    open_bench(DIP_WRAP_REPEAT);
    FOR_EACH_ISA(kernels) {
        for (int level = 8; level <= 20; level++) {
            const DipSampler sampler = {.texture = bench.fast,
                                        .max_anisotropy = 16,
                                        .exact_footprint = true,
                                        .min_lod8 = level * 256};
            for (int i = 0; i < LANES; i++) {
                place(i, 100.0, 50.0, 16.0 * SIZE, SIZE, 0.1 * i);
            }
            bench.batch.count = LANES;
            bench.batch.work = (DipShaderWork){0};
            kernels->dip_kernel_sample_colour(&bench.batch, &sampler, 0, bench.colour);
            assert_int_equal(bench.batch.work.probes, 16 * LANES);
        }
    }
    close_bench();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ramp_is_read_exactly),
        cmocka_unit_test(a_footprint_of_one_period_reads_the_mean_of_stripes),
        cmocka_unit_test(the_coarser_level_takes_fewer_probes),
        cmocka_unit_test(noise_is_read_as_the_reference_reads_it),
        cmocka_unit_test(rounded_texels_leave_the_rounding_of_the_filter),
        cmocka_unit_test(a_least_level_beyond_the_chain_is_the_smallest_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
