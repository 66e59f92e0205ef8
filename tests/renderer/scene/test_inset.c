// Tests the picture inside a picture for all small sizes: which pixels it copies, and that it
// leaves all others alone.
#include "renderer/scene/draw/inset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 12, STRIDE = 4 * (MOST + 1) };

// Fills a picture and the space around it with pixels of different colours.
static void fill(uint8_t bytes[MOST * STRIDE], int first) {
    for (int i = 0; i < MOST * STRIDE; i++) {
        bytes[i] = (uint8_t)(first + i * 7 + i / 256);
    }
}

static int pixels_of(int size, int step) {
    int count = 0;
    while (count * step + step / 2 < size) {
        count++;
    }
    return count;
}

// The step is the least that leaves at most half of the target, where half of one pixel is one.
// From a picture whose size is no multiple of the step, the middles of whole steps are copied.
static void check(int width, int height, int picture_width, int picture_height) {
    uint8_t target[MOST * STRIDE], picture[MOST * STRIDE], expected[MOST * STRIDE];
    fill(target, 1);
    fill(picture, 100);
    memcpy(expected, target, sizeof target);
    const int half_width = width < 2 ? 1 : width / 2, half_height = height < 2 ? 1 : height / 2;
    int step = 1;
    while (step * half_width < picture_width || step * half_height < picture_height) {
        step++;
    }
    for (int y = 0; y < pixels_of(picture_height, step); y++) {
        for (int x = 0; x < pixels_of(picture_width, step); x++) {
            memcpy(expected + y * STRIDE + 4 * x,
                   picture + (y * step + step / 2) * STRIDE + 4 * (x * step + step / 2), 4);
        }
    }
    dip_inset_draw(
        &(DipTarget){.rgba8 = target, .stride_bytes = STRIDE, .width = width, .height = height},
        &(DipTarget){.rgba8 = picture,
                     .stride_bytes = STRIDE,
                     .width = picture_width,
                     .height = picture_height});
    assert_memory_equal(target, expected, sizeof target);
    assert_true(pixels_of(picture_width, step) <= half_width);
    assert_true(pixels_of(picture_height, step) <= half_height);
}

static void every_nth_pixel_is_in_the_corner(void **state) {
    (void)state;
    for (int i = 0; i < MOST * MOST * MOST * MOST; i++) {
        check(1 + i % MOST, 1 + i / MOST % MOST, 1 + i / MOST / MOST % MOST,
              1 + i / MOST / MOST / MOST);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_nth_pixel_is_in_the_corner)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
