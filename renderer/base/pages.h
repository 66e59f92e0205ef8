// Memory for large arrays that are read out of order.
#ifndef DIP_RENDERER_BASE_PAGES_H
#define DIP_RENDERER_BASE_PAGES_H

#include <stddef.h>

// At least size_bytes, aligned to a cache line, to be given to free(); NULL when there is none.
// What is large is put on huge pages where the system has them to give, for fewer misses of the
// translation buffer.
void *dip_pages_alloc(size_t size_bytes);

#endif
