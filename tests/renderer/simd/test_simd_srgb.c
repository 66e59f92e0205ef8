// Compares the sRGB codes of all 16-bit lights with the formula of sRGB in long doubles: those of
// the table, and those of every instruction set of this machine.
#include "renderer/base/srgb.h"
#include "tests/renderer/simd/simd_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { LIGHTS = DIP_LINEAR16_MAX + 1 };

static DipSrgbEncodeTable table;

// Returns floor(255 * encode(light / 65535) + 1/2). The straight part and the curve differ by less
// than 1e-7 where they meet, at a light of 205.2, far from a step between two codes (208.5).
static int code_of(int linear16) {
    const long double light = linear16 / 65535.0L;
    const long double encoded =
        linear16 <= 205 ? 12.92L * light : 1.055L * powl(light, 1.0L / 2.4L) - 0.055L;
    return (int)floorl(255.0L * encoded + 0.5L);
}

static void the_table_has_the_code_of_every_light(void **state) {
    (void)state;
    for (int light = 0; light < LIGHTS; light++) {
        assert_int_equal(dip_srgb_code(&table, light), code_of(light));
    }
}

static void every_instruction_set_has_the_code_of_every_light(void **state) {
    (void)state;
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (!dip_isa_available((DipIsa)isa)) {
            continue;
        }
        const SimdSet *set = &simd_sets[isa];
        for (int first = 0; first < LIGHTS; first += set->lanes) {
            int32_t light[SIMD_LANES_MAX];
            uint32_t code[SIMD_LANES_MAX];
            // Neighbouring lanes have distant lights, so that all parts of the curve are mixed.
            for (int i = 0; i < set->lanes; i++) {
                light[i] = (int32_t)((uint32_t)(first + i) * 40503u % LIGHTS);
            }
            simd_call(set, SIMD_vu_srgb_codes, &table, light, NULL, code);
            for (int i = 0; i < set->lanes; i++) {
                assert_int_equal(code[i], code_of(light[i]));
            }
        }
    }
}

int main(void) {
    dip_srgb_encode_table(&table);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_has_the_code_of_every_light),
        cmocka_unit_test(every_instruction_set_has_the_code_of_every_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
