// Fills new blocks of memory in the wrappers that the linker puts before the allocator, and the
// unused part of the stack. With the memory sanitizer, new blocks are poisoned instead: a program
// that decides something by their content ends with a report.
#include "tests/support/filled_memory.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>

enum { STACK_BYTES = 1 << 20 };

static atomic_int fill;

#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
#include <sanitizer/msan_interface.h>
#define POISONS 1

// Libraries such as assimp are not instrumented, so the sanitizer does not see what they write to
// their blocks. It must therefore not poison the blocks itself; the wrappers poison those that
// Diptych allocates.
const char *__msan_default_options(void);
const char *__msan_default_options(void) {
    return "poison_in_malloc=0:poison_in_free=0";
}

// The sanitizer calls this for each new block, before the wrappers below poison it. A library that
// gets the block must not inherit what is known of an earlier block at the same place.
void __sanitizer_malloc_hook(const volatile void *memory, size_t size);
void __sanitizer_malloc_hook(const volatile void *memory, size_t size) {
    __msan_unpoison(memory, size);
}
#endif
#endif

void *__real_malloc(size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

void filled_memory_heap(uint8_t byte) {
    atomic_store(&fill, byte);
}

// The empty statement makes the compiler believe that the bytes are read.
__attribute__((noinline)) void filled_memory_stack(uint8_t byte) {
    uint8_t unused[STACK_BYTES];
    memset(unused, byte, sizeof unused);
    __asm__ volatile("" : : "r"(unused) : "memory");
}

// Fills a block from `from` to its end.
static void *fill_block(void *memory, size_t from) {
    const size_t size = memory ? malloc_usable_size(memory) : 0;
    if (from < size) {
#ifdef POISONS
        __msan_poison((uint8_t *)memory + from, size - from);
#else
        memset((uint8_t *)memory + from, atomic_load(&fill), size - from);
#endif
    }
    return memory;
}

void *__wrap_malloc(size_t size) {
    return fill_block(__real_malloc(size), 0);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return fill_block(__real_aligned_alloc(alignment, size), 0);
}

void *__wrap_realloc(void *memory, size_t size) {
    const size_t before = memory ? malloc_usable_size(memory) : 0;
    return fill_block(__real_realloc(memory, size), before);
}
