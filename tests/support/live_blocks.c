// Counts live blocks of memory in the wrappers that the linker puts before the allocator.
#include "tests/support/live_blocks.h"

#include <malloc.h>
#include <stdatomic.h>

static atomic_int blocks;
static atomic_size_t bytes;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);
void __wrap_free(void *memory);

int live_blocks(void) {
    return atomic_load(&blocks);
}

size_t live_bytes(void) {
    return atomic_load(&bytes);
}

static void *count_block(void *memory) {
    if (memory) {
        atomic_fetch_add(&blocks, 1);
        atomic_fetch_add(&bytes, malloc_usable_size(memory));
    }
    return memory;
}

void *__wrap_malloc(size_t size) {
    return count_block(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
    return count_block(__real_calloc(count, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return count_block(__real_aligned_alloc(alignment, size));
}

void *__wrap_realloc(void *memory, size_t size) {
    const size_t before = memory ? malloc_usable_size(memory) : 0;
    void *moved = __real_realloc(memory, size);
    if (moved && memory) {
        atomic_fetch_sub(&bytes, before);
        atomic_fetch_add(&bytes, malloc_usable_size(moved));
        return moved;
    }
    return count_block(moved);
}

char *__wrap_strdup(const char *text) {
    return count_block(__real_strdup(text));
}

void __wrap_free(void *memory) {
    if (memory) {
        atomic_fetch_sub(&blocks, 1);
        atomic_fetch_sub(&bytes, malloc_usable_size(memory));
    }
    __real_free(memory);
}
