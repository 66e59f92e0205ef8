// What allocation.c offers to the redirected calls in failing_calls.c.
#ifndef DIP_TESTS_SUPPORT_ALLOCATION_PRIVATE_H
#define DIP_TESTS_SUPPORT_ALLOCATION_PRIVATE_H

#include <dirent.h>
#include <stdbool.h>
#include <stddef.h>

// Counts an allocation. Returns whether it must fail, and then sets errno to error_number.
bool dip_allocation_fails(int error_number);

// Records a new block, which may be NULL, and returns it.
void *dip_allocation_hold(void *block, size_t size_bytes);

// Forgets a block that is about to be freed. Returns its size; 0 if a library has allocated it.
size_t dip_allocation_release(const void *block);

// Records that a thread was started (1) or joined (-1).
void dip_allocation_thread(int change);

// The libc's own function, which is not redirected.
DIR *__real_opendir(const char *folder);

#endif
