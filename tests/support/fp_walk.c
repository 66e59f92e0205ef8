// Walks through functions in all floating-point modes.
#include "tests/support/fp_walk.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static FpMode mode = FP_MODE_COUNT;
static const FpWalkEntry *walked;
static size_t walked_count;

FpMode fp_walk_mode(void) {
    return mode;
}

// Returns whether an entry gives the expected result in a mode and leaves the mode as it was.
static bool is_same(const FpWalkEntry *entry, const char *expected) {
    char found[DIP_HASH_HEX_SIZE];
    DipHash hash = dip_hash_begin(0);
    const FpModeState before = fp_mode_enter(mode);
    entry->call(&hash);
    const bool kept = fp_mode_is(mode);
    fp_mode_return(before);
    dip_hash_hex(&hash, found);
    const bool same = strcmp(expected, found) == 0;
    if (!kept || !same) {
        print_error("%s, %s: %s\n", entry->name, fp_mode_name(mode),
                    kept ? "other bits" : "another mode afterwards");
    }
    return kept && same;
}

static void the_mode_of_the_caller_changes_nothing(void **state) {
    (void)state;
    char empty[DIP_HASH_HEX_SIZE];
    const DipHash nothing = dip_hash_begin(0);
    int faults = 0;
    dip_hash_hex(&nothing, empty);
    for (size_t e = 0; e < walked_count; e++) {
        char expected[DIP_HASH_HEX_SIZE];
        DipHash hash = dip_hash_begin(0);
        walked[e].call(&hash);
        dip_hash_hex(&hash, expected);
        if (strcmp(expected, empty) == 0) {
            print_error("%s: no result\n", walked[e].name);
            faults++;
        }
        for (int m = 0; m < FP_MODE_COUNT; m++) {
            mode = (FpMode)m;
            faults += !is_same(&walked[e], expected);
        }
        mode = FP_MODE_COUNT;
    }
    assert_int_equal(faults, 0);
}

int fp_walk_main(const FpWalkEntry *entries, size_t count, int (*set_up)(void **state),
                 int (*tear_down)(void **state)) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_mode_of_the_caller_changes_nothing)};
    walked = entries;
    walked_count = count;
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
