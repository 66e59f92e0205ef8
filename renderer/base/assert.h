// DIP_ASSERT: our own mistakes stop the program in debug and CI builds and cost nothing otherwise.
#ifndef DIP_RENDERER_BASE_ASSERT_H
#define DIP_RENDERER_BASE_ASSERT_H

#include "renderer/base/api.h"

#if defined(DIP_ASSERTS) && DIP_ASSERTS
// Prints the condition and its place, then aborts. Does not return.
_Noreturn DIP_API void dip_assert_failed(const char *condition, const char *file, int line);
#define DIP_ASSERT(condition)                                                                      \
    ((condition) ? (void)0 : dip_assert_failed(#condition, __FILE__, __LINE__))
#else
#define DIP_ASSERT(condition) ((void)sizeof(condition))
#endif

#define DIP_ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
