// From shaded fragments to pixels: whole fragments at once, the others as sums over samples.
#ifndef DIP_RENDERER_PIPELINE_RESOLVE_RESOLVE_H
#define DIP_RENDERER_PIPELINE_RESOLVE_RESOLVE_H

#include "renderer/pipeline/shading/tile_shading.h"

// Stores the fragments of a whole list, sub-block by sub-block.
void dip_store_whole(DipTileShading *shading, const DipFragmentList *list,
                     const DipEncodedBatch *encoded);

// The list's first `count`: stores fragments that hold all their pixel's samples, adds the others
// to their pixel's sum.
void dip_store_fragments(DipTileShading *shading, const DipFragmentList *list, int count,
                         const DipEncodedBatch *encoded);

// Pixels of several surfaces: the mean over the samples in linear light, then encoded.
// srgb_code: see DipSrgbEncodeTable.
void dip_resolve_multi_fragment(DipTileShading *shading, const uint8_t *srgb_code);

#endif
