// An allocator that fails on request. A test that links dip_failing_allocator redirects its own and
// Diptych's calls of the functions below to this allocator, by the linker's option --wrap. It
// counts the calls, makes chosen calls fail as a machine without memory would, and keeps a record
// of what is held, so that a test can see whether a failed operation leaks.
//
// Redirected calls, which are all called "allocations" here: malloc, calloc, realloc,
// aligned_alloc, posix_memalign, strdup, strndup, fopen, fdopen, open_memstream (and each growth of
// its text), getline (where it allocates its buffer), opendir, mmap, memfd_create, pipe, pipe2,
// posix_spawn, its file actions, and pthread_create. Calls inside the libraries of third parties
// and inside libc are not redirected, except in libraries that are compiled into Diptych (stb). A
// test can give cJSON this allocator by cJSON_InitHooks.
//
// All threads may allocate at the same time. The functions below are called from one thread, while
// no other thread allocates.
#ifndef DIP_TESTS_SUPPORT_ALLOCATION_H
#define DIP_TESTS_SUPPORT_ALLOCATION_H

#include <stdbool.h>
#include <stdint.h>

// Which allocations fail.
typedef enum DipFailing {
    DIP_FAIL_NONE,     // No allocation: they are only counted.
    DIP_FAIL_ONE,      // One allocation alone.
    DIP_FAIL_ALL_FROM, // This allocation and all that follow.
} DipFailing;

// Starts to count allocations at 0, and makes allocation `number` fail (or `number` and all later
// ones). The first allocation has number 0.
void dip_allocation_arm(DipFailing failing, int64_t number);

// Stops failing. Returns the number of allocations since dip_allocation_arm.
int64_t dip_allocation_disarm(void);

// Number of allocations since the last call of dip_allocation_arm, or since the program's start.
int64_t dip_allocation_count(void);

// Number of allocations that failed since the last call of dip_allocation_arm.
int64_t dip_allocation_failed(void);

// Prints the call stack of the first allocation that failed since dip_allocation_arm, as addresses
// for addr2line.
void dip_allocation_print_failed(void);

// What the process holds.
typedef struct DipHoldings {
    int64_t blocks;  // Blocks and mapped regions that were allocated here and not freed.
    int64_t bytes;   // Their size, as their callers asked for it.
    int threads;     // Threads that were started here and not joined.
    int descriptors; // Open file descriptors.
} DipHoldings;

DipHoldings dip_allocation_holdings(void);

#endif
