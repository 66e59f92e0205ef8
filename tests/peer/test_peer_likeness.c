// Errors of pictures against ones worked out by hand.
#include "tests/peer/likeness.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

// 2 x 2 pixels in rows of different strides; one channel differs by 6, alpha and padding by more.
static void errors_count_colours_only(void **state) {
    (void)state;
    const uint8_t a[2 * 12] = {10, 20, 30, 255, 1, 2, 3, 255, 99, 99, 99, 99,
                               5,  5,  5,  255, 0, 0, 0, 255, 99, 99, 99, 99};
    const uint8_t b[2 * 8] = {10, 20, 30, 0, 1, 2, 3, 0, 5, 5, 11, 0, 0, 0, 0, 0};
    const double error = dip_likeness_squared_error(a, 12, b, 8, 2, 2);
    assert_true(error == 36.0 / 12.0);
    // 20 log10(255) = 48.1308 dB for an error of one code.
    assert_true(fabs(dip_likeness_psnr_db(1.0) - 48.1308) < 1e-4);
    assert_true(isinf(dip_likeness_psnr_db(0.0)));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(errors_count_colours_only)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
