// The known name that is most like a mistyped one, for messages that ask "did you mean ...?".
#ifndef DIP_RENDERER_BASE_NEAREST_H
#define DIP_RENDERER_BASE_NEAREST_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the name with the smallest edit distance (insertions, deletions, replacements) to `name`,
// or the first of several that are equally near. Upper and lower case count as the same letter.
// count is at least 1.
DIP_API const char *dip_nearest_name(const char *name, const char *const *names, size_t count);

// Returns the nearest name if it is near enough to be what the user meant: at most every third of
// its letters differs, or 1. Returns NULL if none is, or if count is 0.
DIP_API const char *dip_nearest_likely(const char *name, const char *const *names, size_t count);

#ifdef __cplusplus
}
#endif

#endif
