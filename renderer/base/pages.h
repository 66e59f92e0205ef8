// Memory for large arrays that are read out of order.
#ifndef DIP_RENDERER_BASE_PAGES_H
#define DIP_RENDERER_BASE_PAGES_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Allocates at least size_bytes bytes, aligned to a cache line. The caller frees the block with
// free(). Returns NULL if memory runs out. Blocks of 1 MiB and more get huge pages if the system
// has free ones, which saves TLB misses. Thread-safe.
DIP_API void *dip_pages_alloc(size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
