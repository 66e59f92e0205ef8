// DIP_ASSERT checks for mistakes in Diptych's own code. A failed check stops the program in debug
// and CI builds; in other builds the check costs nothing.
#ifndef DIP_RENDERER_BASE_ASSERT_H
#define DIP_RENDERER_BASE_ASSERT_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

// Prints the condition, the file and the line, then aborts.
DIP_NORETURN DIP_API void dip_assert_failed(const char *condition, const char *file, int line);

#ifdef __cplusplus
}
#endif

#if defined(DIP_ASSERTS) && DIP_ASSERTS
#define DIP_ASSERT(condition)                                                                      \
    ((condition) ? (void)0 : dip_assert_failed(#condition, __FILE__, __LINE__))
#else
#define DIP_ASSERT(condition) ((void)sizeof(condition))
#endif

// Number of elements of an array. `array` must not be a pointer.
#define DIP_ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
