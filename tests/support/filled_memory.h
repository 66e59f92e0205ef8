// Fills memory that a program has not written yet: new blocks of the heap, and the stack. A result
// that changes with the fill depends on undefined memory. dip_fill_memory in tests/CMakeLists.txt
// lets a test use these functions.
#ifndef DIP_TESTS_SUPPORT_FILLED_MEMORY_H
#define DIP_TESTS_SUPPORT_FILLED_MEMORY_H

#include <stdint.h>

// Sets the byte that fills blocks of malloc, aligned_alloc and realloc from now on, in all threads.
void filled_memory_heap(uint8_t byte);

// Fills the part of the stack that the calls after this one use: 1 MiB below the caller's frame.
void filled_memory_stack(uint8_t byte);

#endif
