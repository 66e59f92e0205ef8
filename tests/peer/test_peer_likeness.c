// Compares squared errors and PSNRs with values worked out by hand.
#include "tests/peer/likeness.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

// Both pictures have 2 x 2 pixels, but their rows have different strides. One channel differs by 6;
// alpha and padding differ by more.
static void squared_error_ignores_alpha_and_padding(void **state) {
    (void)state;
    const uint8_t a[2 * 12] = {10, 20, 30, 255, 1, 2, 3, 255, 99, 99, 99, 99,
                               5,  5,  5,  255, 0, 0, 0, 255, 99, 99, 99, 99};
    const uint8_t b[2 * 8] = {10, 20, 30, 0, 1, 2, 3, 0, 5, 5, 11, 0, 0, 0, 0, 0};
    const double error = dip_likeness_squared_error(a, 12, b, 8, 2, 2);
    assert_true(error == 36.0 / 12.0);
    // An error of one 8-bit step gives 20 log10(255) = 48.1308 dB.
    assert_true(fabs(dip_likeness_psnr_db(1.0) - 48.1308) < 1e-4);
    assert_true(isinf(dip_likeness_psnr_db(0.0)));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(squared_error_ignores_alpha_and_padding)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
