// The converged picture of dip_reference_converge, the same to the bit, tile by tile: tiles may be
// drawn by several threads, and what is seen in each pixel is told too.
#ifndef DIP_RENDERER_REFERENCE_CONVERGENCE_H
#define DIP_RENDERER_REFERENCE_CONVERGENCE_H

#include "renderer/base/api.h"
#include "renderer/reference/reference.h"

#ifdef __cplusplus
extern "C" {
#endif

// What a pixel shows; the first that holds.
// X(NAME, "name", "what it is")
#define DIP_SEEN_LIST(X)                                                                           \
    X(WATER, "reflection", "water is seen in it")                                                  \
    X(CLIPPED, "clipped", "an alpha-clipped surface is in it with nothing before, there or not")   \
    X(EDGE, "edges",                                                                               \
      "surfaces of two materials, or whose planes do not meet there, are seen in it")              \
    X(TEXTURED, "interior", "one surface with a colour texture, not sky")                          \
    X(PLAIN, "plain", "one surface without, the sky, or nothing")

typedef enum DipSeen {
#define DIP_SEEN_ENUM(NAME, name, text) DIP_SEEN_##NAME,
    DIP_SEEN_LIST(DIP_SEEN_ENUM)
#undef DIP_SEEN_ENUM
        DIP_SEEN_COUNT
} DipSeen;

typedef struct DipConvergence DipConvergence;

// Takes the scene as it is seen from a pose at the reference's time. The reference is borrowed.
DIP_API DipConvergence *dip_convergence_create(const DipReference *reference, const DipPose *pose,
                                               int width, int height, DipError *err);
DIP_API void dip_convergence_destroy(DipConvergence **convergence);

DIP_API int dip_convergence_tile_count(const DipConvergence *convergence);

// Adds share times the mean of sample_count (a square) samples of each of a tile's pixels to
// rgb_lin, width * height * 3 values. With share 1 over zeros it is dip_reference_converge's
// picture. classes: width * height values that are set to what is seen (DipSeen), by these samples;
// or NULL. Other tiles may be drawn at the same time.
DIP_API bool dip_convergence_add_tile(const DipConvergence *convergence, int tile, int sample_count,
                                      uint32_t seed, double share, double *rgb_lin,
                                      uint8_t *classes, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
