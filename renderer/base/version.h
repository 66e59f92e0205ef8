// The version of Diptych. Releases with the same major and minor number can replace each other: a
// program that was compiled with one of them runs with every other one.
#ifndef DIP_RENDERER_BASE_VERSION_H
#define DIP_RENDERER_BASE_VERSION_H

#include "renderer/base/api.h"

#ifdef __cplusplus
extern "C" {
#endif

// The version of these headers.
#define DIP_VERSION_MAJOR 0
#define DIP_VERSION_MINOR 1
#define DIP_VERSION_PATCH 0

// Returns the version of the library that the program runs with: "MAJOR.MINOR.PATCH".
DIP_API const char *dip_version(void);

#ifdef __cplusplus
}
#endif

#endif
