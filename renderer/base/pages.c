// Allocation of aligned memory, with the advice to put large arrays on huge pages.
#define _DEFAULT_SOURCE // madvise
#include "renderer/base/pages.h"

#include <stdint.h>
#include <stdlib.h>
#ifdef _WIN32
#include <malloc.h>
#else
#include <sys/mman.h>
#endif

enum { HUGE_PAGE = 2 << 20, LARGE = 1 << 20 };

// Returns the next greater multiple of a unit, or 0 if there is none.
static size_t round_up(size_t size_bytes, size_t unit) {
    return size_bytes < SIZE_MAX - unit ? (size_bytes / unit + 1) * unit : 0;
}

#ifdef _WIN32
// Windows has no aligned_alloc, and its aligned blocks need a free of their own.
static void *alloc(size_t alignment, size_t size_bytes) {
    return _aligned_malloc(size_bytes, alignment);
}

void dip_lines_free(void *block) {
    _aligned_free(block);
}
#else
static void *alloc(size_t alignment, size_t size_bytes) {
    return aligned_alloc(alignment, size_bytes);
}

void dip_lines_free(void *block) {
    free(block);
}
#endif

void *dip_lines_alloc(size_t size_bytes) {
    const size_t room_bytes = round_up(size_bytes, DIP_CACHE_LINE);
    return room_bytes ? alloc(DIP_CACHE_LINE, room_bytes) : NULL;
}

void *dip_pages_alloc(size_t size_bytes) {
    if (size_bytes < LARGE) {
        return dip_lines_alloc(size_bytes);
    }
    const size_t room_bytes = round_up(size_bytes, HUGE_PAGE);
    void *memory = room_bytes ? alloc(HUGE_PAGE, room_bytes) : NULL;
#ifdef MADV_HUGEPAGE
    if (memory) {
        // This is only advice; small pages work too.
        (void)madvise(memory, room_bytes, MADV_HUGEPAGE);
    }
#endif
    return memory;
}
