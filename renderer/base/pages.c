// Allocation of large arrays, with the advice to put them on huge pages.
#define _DEFAULT_SOURCE // madvise
#include "renderer/base/pages.h"

#include <stdlib.h>
#include <sys/mman.h>

enum { CACHE_LINE = 64, HUGE_PAGE = 2 << 20, LARGE = 1 << 20 };

static size_t round_up(size_t size_bytes, size_t unit) {
    return (size_bytes / unit + 1) * unit;
}

void *dip_pages_alloc(size_t size_bytes) {
    if (size_bytes < LARGE) {
        return aligned_alloc(CACHE_LINE, round_up(size_bytes, CACHE_LINE));
    }
    const size_t room_bytes = round_up(size_bytes, HUGE_PAGE);
    void *memory = aligned_alloc(HUGE_PAGE, room_bytes);
#ifdef MADV_HUGEPAGE
    if (memory) {
        // This is only advice; small pages work too.
        (void)madvise(memory, room_bytes, MADV_HUGEPAGE);
    }
#endif
    return memory;
}
