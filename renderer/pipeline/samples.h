// Colours of samples that outlive a pass: a pass may start from them, leave its own there and
// average them into its target.
//
// A target keeps one colour per pixel, so a pass that keeps its target's colours (DIP_LOAD_KEEP)
// begins with equal colours in all samples of a pixel. Where a pixel shows an edge, a later draw
// behind that edge then meets the mean of both sides, which shows as a halo. A pass that keeps a
// DipSamples begins with the colour of each sample.
//
// A list of draws may be cut into several passes with the same viewport, scissor, regions and
// pattern. If each pass keeps the samples, depths and stencil values of the pass before it, the
// result has the same bits as one pass with all draws, as long as each cut lies next to an ordered
// draw (state.h). A cut between two plain draws can change colours at edges of the first one: it is
// shaded before the second one hides parts of it, so at other points within a pixel.
#ifndef DIP_RENDERER_PIPELINE_SAMPLES_H
#define DIP_RENDERER_PIPELINE_SAMPLES_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/target.h"

#ifdef __cplusplus
extern "C" {
#endif

// Red, green, blue and alpha of each sample, in linear light, as 32-bit floats: what a merged pass
// (state.h) computes with. Formats of 8 bits per channel have colours within 0..1; nothing is
// rounded to bytes. Only one pass at a time may draw to it; any number of threads may read it while
// no pass draws to it.
typedef struct DipSamples DipSamples;

// Creates colours that are all 0, with the alpha 0. width, height: 1..DIP_MAX_TARGET_SIZE.
// sample_count: 1, 2, 4, 6 or 8. format: the format of the targets of the passes that use it. It
// takes 16 bytes per sample, with width and height rounded up to multiples of 8, and a byte per 64
// pixels: 59 MB for 1280x720 pixels with 4 samples. In groups of 4x4 pixels that no edge divides, a
// pass reads and writes only one sample of each pixel. Fails with RANGE or MEMORY.
DIP_API DipSamples *dip_samples_create(int width, int height, int sample_count, DipFormat format,
                                       DipError *err);
// Frees samples that no pass uses any more. *samples may be NULL and becomes NULL.
DIP_API void dip_samples_destroy(DipSamples **samples);

DIP_API int dip_samples_width(const DipSamples *samples);
DIP_API int dip_samples_height(const DipSamples *samples);
DIP_API int dip_samples_sample_count(const DipSamples *samples);
DIP_API DipFormat dip_samples_format(const DipSamples *samples);

// Copies the colours that sample `sample` has in one row of pixels: colour[0..3][x] become the red,
// green, blue and alpha of the pixel in column x, for all columns. Row 0 is the top one. sample:
// 0..sample_count - 1.
DIP_API void dip_samples_read_row(const DipSamples *samples, int sample, int y,
                                  float *const colour[4]);

#ifdef __cplusplus
}
#endif

#endif
