// Finds the known name that is most similar to a mistyped one, for messages that ask "did you mean
// ...?".
#ifndef DIP_RENDERER_BASE_NEAREST_H
#define DIP_RENDERER_BASE_NEAREST_H

#include "renderer/base/api.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the one of `names` with the smallest edit distance (insertions, deletions, replacements)
// to `name`. If several are equally near, returns the first of them. Upper and lower case count as
// the same letter. count is at least 1.
DIP_API const char *dip_nearest_name(const char *name, const char *const *names, size_t count);

// Returns the nearest name if the user probably meant it: its edit distance is at most 1, or at
// most a third of the known name's length. Otherwise, or if count is 0, returns NULL.
DIP_API const char *dip_nearest_likely(const char *name, const char *const *names, size_t count);

#ifdef __cplusplus
}
#endif

#endif
