// The converged picture of dip_reference_converge, the same to the bit, tile by tile: tiles may be
// drawn by several threads, and what is seen in each pixel is told too.
#ifndef DIP_RENDERER_REFERENCE_CONVERGENCE_H
#define DIP_RENDERER_REFERENCE_CONVERGENCE_H

#include "renderer/reference/reference.h"
#include "renderer/reference/seen.h"

typedef struct DipConvergence DipConvergence;

// Takes the scene as it is seen from a pose at the reference's time. The reference is borrowed.
DipConvergence *dip_convergence_create(const DipReference *reference, const DipPose *pose,
                                       int width, int height, DipError *err);
void dip_convergence_destroy(DipConvergence **convergence);

int dip_convergence_tile_count(const DipConvergence *convergence);

// Adds share times the mean of sample_count (a square) samples of each of a tile's pixels to
// rgb_lin, width * height * 3 values. With share 1 over zeros it is dip_reference_converge's
// picture. classes: width * height values that are set to what is seen (DipSeen), by these samples;
// or NULL. Other tiles may be drawn at the same time.
bool dip_convergence_add_tile(const DipConvergence *convergence, int tile, int sample_count,
                              uint32_t seed, double share, double *rgb_lin, uint8_t *classes,
                              DipError *err);

#endif
