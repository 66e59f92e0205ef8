// Tests of enlarging pictures, and of the size at which they are drawn before.
#include "app/bench/enlarge.h"
#include "renderer/base/srgb.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

// Enlarges a packed picture and copies the result to `to`.
static void enlarge(const uint8_t *from, int from_width, int from_height, uint8_t *to, int to_width,
                    int to_height, DipPool *pool) {
    const DipEnlargerDef def = {from_width, from_height, to_width, to_height, pool};
    DipEnlarger *enlarger = dip_enlarger_create(&def, NULL);
    assert_non_null(enlarger);
    memcpy(to, dip_enlarger_run(enlarger, from, (size_t)from_width * 4),
           (size_t)to_width * (size_t)to_height * 4);
    dip_enlarger_destroy(&enlarger);
    assert_null(enlarger);
}

static void constant_pictures_stay_constant(void **state) {
    (void)state;
    static uint8_t from[4 * 7 * 5], to[4 * 64 * 33];
    for (int code = 0; code < 256; code++) {
        const uint8_t pixel[4] = {(uint8_t)code, (uint8_t)(255 - code), (uint8_t)(code / 2),
                                  (uint8_t)(code ^ 85)};
        for (size_t i = 0; i < sizeof from; i++) {
            from[i] = pixel[i % 4];
        }
        enlarge(from, 7, 5, to, 64, 33, NULL);
        for (size_t i = 0; i < sizeof to; i++) {
            assert_int_equal(to[i], pixel[i % 4]);
        }
    }
}

// Every code in every channel, at a scale of 1.
static void scale_1_is_the_identity(void **state) {
    (void)state;
    static uint8_t from[4 * 256 * 3], to[sizeof from];
    for (size_t i = 0; i < sizeof from; i++) {
        from[i] = (uint8_t)(i / 4 + 57 * (i % 4) + 101 * (i / 1024));
    }
    enlarge(from, 256, 3, to, 256, 3, NULL);
    assert_memory_equal(to, from, sizeof to);
}

// Two pixels, black and white, are a linear ramp between their centres and constant beyond them:
// the light at the destination's pixel x of n is 2 (x + 1/2) / n - 1/2, clamped to 0..1.
static uint8_t ramp_code(int x, int n) {
    static DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    const double light = fmin(fmax(2.0 * (x + 0.5) / n - 0.5, 0.0), 1.0);
    return table.code[(int)(DIP_LINEAR16_MAX * light + 0.5)];
}

static void ramps_stay_ramps(void **state) {
    (void)state;
    enum { N = 64 };
    static uint8_t to[4 * N * N];
    uint8_t across[16], down[16];
    for (int i = 0; i < 4; i++) { // Pixels in the order of rows.
        memset(across + 4 * i, i % 2 ? 255 : 0, 4);
        memset(down + 4 * i, i / 2 ? 255 : 0, 4);
    }
    enlarge(across, 2, 2, to, N, N, NULL);
    for (int i = 0; i < N * N; i++) {
        assert_int_equal(to[4 * i], ramp_code(i % N, N));
        assert_int_equal(to[4 * i + 2], ramp_code(i % N, N));
    }
    enlarge(down, 2, 2, to, N, N, NULL);
    for (int i = 0; i < N * N; i++) {
        assert_int_equal(to[4 * i + 1], ramp_code(i / N, N));
    }
    assert_int_equal(ramp_code(N / 4 - 1, N), 0); // Beyond the centre of the black pixel.
    // The middle of the ramp is half the light, which is the code 188 and not 128.
    assert_in_range(ramp_code(N / 2, N), 188, 190);
}

// A picture of random pixels against the same formula in double precision.
static void random_pictures_match_double_precision(void **state) {
    (void)state;
    enum { W = 13, H = 9, TO_W = 31, TO_H = 20 };
    uint8_t from[4 * W * H], to[4 * TO_W * TO_H];
    uint32_t random = 1;
    for (size_t i = 0; i < sizeof from; i++) {
        random = random * 1664525u + 1013904223u;
        from[i] = (uint8_t)(random >> 24);
    }
    enlarge(from, W, H, to, TO_W, TO_H, NULL);
    static DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    int differences = 0;
    for (int i = 0; i < 3 * TO_W * TO_H; i++) {
        const int x = i / 3 % TO_W, y = i / 3 / TO_W, c = i % 3;
        const double px = fmin(fmax((x + 0.5) * W / TO_W - 0.5, 0.0), W - 1);
        const double py = fmin(fmax((y + 0.5) * H / TO_H - 0.5, 0.0), H - 1);
        double light = 0.0;
        for (int corner = 0; corner < 4; corner++) {
            const int cx = (int)px + corner % 2, cy = (int)py + corner / 2;
            const double weight = (1.0 - fabs(px - cx)) * (1.0 - fabs(py - cy));
            if (cx < W && cy < H) {
                light += weight * dip_srgb_decode(from[4 * (cy * W + cx) + c] / 255.0);
            }
        }
        const int code = table.code[(int)(DIP_LINEAR16_MAX * light + 0.5)];
        const int found = to[4 * (y * TO_W + x) + c];
        assert_in_range(found, code - (code > 0), code + 1);
        differences += found != code;
    }
    assert_true(differences <= 3); // Roundings to the next of 65535 steps.
}

static void threads_enlarge_the_same_bits(void **state) {
    (void)state;
    enum { W = 50, H = 400, TO_W = 97, TO_H = 900 };
    static uint8_t from[4 * W * H], alone[4 * TO_W * TO_H], together[sizeof alone];
    for (size_t i = 0; i < sizeof from; i++) {
        from[i] = (uint8_t)(i * i / 7);
    }
    DipPool *pool = dip_pool_create(3, NULL);
    assert_non_null(pool);
    enlarge(from, W, H, alone, TO_W, TO_H, NULL);
    for (int time = 0; time < 20; time++) {
        enlarge(from, W, H, together, TO_W, TO_H, pool);
        assert_memory_equal(alone, together, sizeof alone);
    }
    dip_pool_destroy(&pool);
}

static void scaled_pictures_keep_their_shape(void **state) {
    (void)state;
    static const struct {
        int width, height;
        double scale;
        int to_width, to_height;
    } rows[] = {
        {640, 480, 0.5, 320, 240},     {640, 480, 0.7071, 452, 339},
        {640, 480, 1.0, 640, 480},     {640, 480, 0.1, 64, 48},
        {1920, 1080, 0.85, 1632, 918}, {1280, 720, 0.7071, 912, 513},
        {641, 479, 0.5, 321, 240}, // No smaller size has exactly this shape.
        {641, 479, 1.0, 641, 479},     {1, 1, 0.1, 1, 1},
        {1, 700, 0.5, 1, 350},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        int width, height;
        dip_enlarger_source_size(rows[i].width, rows[i].height, rows[i].scale, &width, &height);
        assert_int_equal(width, rows[i].to_width);
        assert_int_equal(height, rows[i].to_height);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_pictures_stay_constant),
        cmocka_unit_test(scale_1_is_the_identity),
        cmocka_unit_test(ramps_stay_ramps),
        cmocka_unit_test(random_pictures_match_double_precision),
        cmocka_unit_test(threads_enlarge_the_same_bits),
        cmocka_unit_test(scaled_pictures_keep_their_shape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
