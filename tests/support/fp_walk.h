// Calls functions in the floating-point modes that a caller may have chosen, and compares their
// results with those in the usual mode. Tests that show that the caller's mode changes nothing
// share this.
#ifndef DIP_TESTS_SUPPORT_FP_WALK_H
#define DIP_TESTS_SUPPORT_FP_WALK_H

#include "renderer/base/hash.h"
#include "renderer/catalogue/fp_modes.h"

#include <stddef.h>

// Functions that are called together.
typedef struct FpWalkEntry {
    const char *name;
    // Calls them and adds all bits of their results to the hash. Its own arithmetic must be exact,
    // because it runs in the caller's mode, too. It may use cmocka's assertions.
    void (*call)(DipHash *hash);
} FpWalkEntry;

// Runs each entry in the usual mode and in every mode that the processor has, as the only cmocka
// test of a program. The test fails after the last entry if a result differs, if the mode is
// another one afterwards, or if an entry adds nothing to its hash; it prints a line for each.
// set_up runs before the test and tear_down after it. Either may be NULL. Returns the exit status
// of the program.
int fp_walk_main(const FpWalkEntry *entries, size_t count, int (*set_up)(void **state),
                 int (*tear_down)(void **state));

// Returns the mode of the walk at this moment, or FP_MODE_COUNT for the usual mode.
FpMode fp_walk_mode(void);

#endif
