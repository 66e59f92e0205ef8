// Memory for large arrays that are read out of order.
#ifndef DIP_RENDERER_BASE_PAGES_H
#define DIP_RENDERER_BASE_PAGES_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// At least size_bytes, aligned to a cache line, to be given to free(); NULL when there is none.
// What is large is put on huge pages where the system has them to give, for fewer misses of the
// translation buffer.
DIP_API void *dip_pages_alloc(size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
