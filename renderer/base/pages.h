// Aligned memory: cache lines, and huge pages for large arrays that are read out of order.
#ifndef DIP_RENDERER_BASE_PAGES_H
#define DIP_RENDERER_BASE_PAGES_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_CACHE_LINE = 64 }; // bytes

// Allocates at least size_bytes bytes, aligned to a cache line. The caller frees the block with
// dip_lines_free. Returns NULL if memory runs out. Thread-safe.
DIP_API void *dip_lines_alloc(size_t size_bytes);

// Does the same. Blocks of 1 MiB and more get huge pages if the system has free ones, which saves
// TLB misses.
DIP_API void *dip_pages_alloc(size_t size_bytes);

// Frees a block of either kind. block may be NULL.
DIP_API void dip_lines_free(void *block);

#ifdef __cplusplus
}
#endif

#endif
