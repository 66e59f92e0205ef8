// Counts the memory that a test's own code and Diptych's static libraries have allocated with
// malloc, calloc, realloc, aligned_alloc and strdup, and not freed. The CMake function
// dip_count_live_blocks puts the counters before the allocator. Memory that shared libraries
// allocate is not counted. Thread-safe.
#ifndef DIP_TESTS_SUPPORT_LIVE_BLOCKS_H
#define DIP_TESTS_SUPPORT_LIVE_BLOCKS_H

#include <stddef.h>

int live_blocks(void);
size_t live_bytes(void); // As the allocator rounds them up.

#endif
