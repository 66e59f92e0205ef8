// Runs an operation again and again while chosen allocations fail (allocation.h), and checks that
// every failure is clean: one clear line of error, nothing leaked, nothing half-done.
//
// The driver first runs the operation without a failure and counts its N allocations. Then it runs
// the operation once for each allocation that fails alone, and once for each allocation from which
// on all fail.
#ifndef DIP_TESTS_SUPPORT_OUT_OF_MEMORY_H
#define DIP_TESTS_SUPPORT_OUT_OF_MEMORY_H

#include "renderer/base/error.h"

#include <stdbool.h>

typedef struct DipOutOfMemory {
    const char *name; // What the operation does, for messages.
    void *context;    // Passed to each function below. Functions that are NULL do nothing.
    // Makes what the operation needs. No allocation fails meanwhile.
    void (*prepare)(void *context);
    // The operation. Returns false and fills *err if it fails.
    bool (*run)(void *context, DipError *err);
    // Checks with cmocka what the operation has left. After a success, everything must be as if no
    // allocation had failed, and after a failure, as if the operation had not been tried. No
    // allocation fails meanwhile.
    void (*check)(void *context, bool succeeded);
    // Frees everything that prepare, run and check have made.
    void (*finish)(void *context);
    // The operation may only succeed while no allocation fails.
    bool needs_every_allocation;
    // Greatest number of allocations that the short test fails in each way, spread evenly over all;
    // 0: every one. With sanitizers, it fails a quarter of them. The long test fails every one.
    int short_count;
} DipOutOfMemory;

// Checks an operation. Prints how many allocations it has, how many were made to fail, and how
// often the operation succeeded nevertheless. Fails the cmocka test at the first fault.
void dip_out_of_memory_check(const DipOutOfMemory *operation);

// Fills *err with the first error of a list, for operations that fill a list, and frees the list.
// Returns whether there is none. If the list has an error that it could not keep, fails the test.
bool dip_out_of_memory_first_error(DipErrorList *faults, DipError *err);

// Tells the driver to fail every allocation. Call it before the tests if the command line has
// --long.
void dip_out_of_memory_read_options(int argc, char **argv);

#endif
