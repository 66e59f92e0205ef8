// The known name nearest to a mistyped one, for messages.
#ifndef DIP_RENDERER_BASE_NEAREST_H
#define DIP_RENDERER_BASE_NEAREST_H

#include <stddef.h>

// The one of count >= 1 names with the least edit distance (insertions, deletions, replacements),
// letters compared without case; the first of equals.
const char *dip_nearest_name(const char *name, const char *const *names, size_t count);

#endif
