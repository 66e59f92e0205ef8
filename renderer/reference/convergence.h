// Draws the converged picture (the mean of many samples per pixel) tile by tile. The result has the
// same bits as the picture of dip_reference_converge. Several threads may draw tiles at the same
// time. The functions here can also classify each pixel by what is visible in it.
#ifndef DIP_RENDERER_REFERENCE_CONVERGENCE_H
#define DIP_RENDERER_REFERENCE_CONVERGENCE_H

#include "renderer/base/api.h"
#include "renderer/reference/reference.h"
#include "renderer/reference/seen.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipConvergence DipConvergence;

// Prepares the scene as it looks from a pose at the reference's time. The reference is borrowed
// until destroy, and its time and its reflection may not be set meanwhile. Fails with RANGE (pose
// or size), RUNTIME (stopped) or MEMORY; err may be NULL.
DIP_API DipConvergence *dip_convergence_create(const DipReference *reference, const DipPose *pose,
                                               int width, int height, DipError *err);
// *convergence may be NULL and becomes NULL.
DIP_API void dip_convergence_destroy(DipConvergence **convergence);

DIP_API int dip_convergence_tile_count(const DipConvergence *convergence);

// Draws sample_count samples (a square number) in each pixel of a tile, whose number is
// 0..dip_convergence_tile_count - 1. Multiplies their mean by share and adds the result to rgb_lin,
// which has width * height * 3 values. If rgb_lin was zero and share is 1, the result is the
// picture of dip_reference_converge. classes may be NULL. Otherwise it has width * height values,
// and the tile's values are set to what the samples show (DipSeen). Other threads may add other
// tiles at the same time. Fails with RANGE (tile or sample_count) or MEMORY; then it has added
// nothing.
DIP_API bool dip_convergence_add_tile(const DipConvergence *convergence, int tile, int sample_count,
                                      uint32_t seed, double share, double *rgb_lin,
                                      uint8_t *classes, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
