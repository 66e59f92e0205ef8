// The known name nearest to a mistyped one, for messages.
#ifndef DIP_RENDERER_BASE_NEAREST_H
#define DIP_RENDERER_BASE_NEAREST_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The one of count >= 1 names with the least edit distance (insertions, deletions, replacements),
// letters compared without case; the first of equals.
DIP_API const char *dip_nearest_name(const char *name, const char *const *names, size_t count);

#ifdef __cplusplus
}
#endif

#endif
