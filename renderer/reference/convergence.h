// Draws the converged picture of dip_reference_converge tile by tile, the same to the bit. Several
// threads may draw tiles at the same time. It can also classify each pixel by what is visible in
// it.
#ifndef DIP_RENDERER_REFERENCE_CONVERGENCE_H
#define DIP_RENDERER_REFERENCE_CONVERGENCE_H

#include "renderer/base/api.h"
#include "renderer/reference/reference.h"

#ifdef __cplusplus
extern "C" {
#endif

// What is visible in a pixel. The first class that applies is the pixel's.
// X(NAME, "name", "what it is")
#define DIP_SEEN_LIST(X)                                                                           \
    X(WATER, "reflection", "water is visible in it")                                               \
    X(CLIPPED, "clipped",                                                                          \
      "an alpha-clipped surface covers a sample with nothing in front, kept by alpha or not")      \
    X(EDGE, "edges",                                                                               \
      "surfaces of two materials, or on planes that do not meet there, are visible in it")         \
    X(TEXTURED, "interior", "one surface with a colour texture, not the sky, fills it")            \
    X(PLAIN, "plain", "one surface without a colour texture, the sky, or nothing fills it")

typedef enum DipSeen {
#define DIP_SEEN_ENUM(NAME, name, text) DIP_SEEN_##NAME,
    DIP_SEEN_LIST(DIP_SEEN_ENUM)
#undef DIP_SEEN_ENUM
        DIP_SEEN_COUNT
} DipSeen;

typedef struct DipConvergence DipConvergence;

// Prepares the scene as it looks from a pose at the reference's time. The reference is borrowed
// until destroy.
DIP_API DipConvergence *dip_convergence_create(const DipReference *reference, const DipPose *pose,
                                               int width, int height, DipError *err);
DIP_API void dip_convergence_destroy(DipConvergence **convergence);

DIP_API int dip_convergence_tile_count(const DipConvergence *convergence);

// Draws sample_count (a square) samples in each pixel of a tile, and adds share times their mean to
// rgb_lin, which has width * height * 3 values. If rgb_lin was zero and share is 1, the result is
// the picture of dip_reference_converge. classes has width * height values, which are set to what
// the samples show (DipSeen); it may be NULL. Other threads may add other tiles at the same time.
DIP_API bool dip_convergence_add_tile(const DipConvergence *convergence, int tile, int sample_count,
                                      uint32_t seed, double share, double *rgb_lin,
                                      uint8_t *classes, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
