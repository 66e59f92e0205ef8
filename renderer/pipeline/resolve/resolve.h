// Resolve: turns shaded fragments into pixels. A fragment that holds all samples of its pixel
// becomes the pixel's colour at once. Other fragments are added to a sum over the pixel's samples.
#ifndef DIP_RENDERER_PIPELINE_RESOLVE_RESOLVE_H
#define DIP_RENDERER_PIPELINE_RESOLVE_RESOLVE_H

#include "renderer/base/srgb.h"
#include "renderer/pipeline/shading/tile_shading.h"

// Stores the fragments of a list of whole sub-blocks (DipTileShading.whole_lists).
void dip_store_whole(DipTileShading *shading, const DipFragmentList *list,
                     const DipEncodedBatch *encoded);

// Handles the first `count` fragments of a list. Stores the fragments that hold all samples of
// their pixel. Adds the other fragments to the sums of their pixels, weighted by their numbers of
// samples.
void dip_store_fragments(DipTileShading *shading, const DipFragmentList *list, int count,
                         const DipEncodedBatch *encoded);

// Stores the pixels that several fragments share. Such a pixel gets the mean of its samples in
// linear light, encoded to sRGB.
void dip_resolve_multi_fragment(DipTileShading *shading, const DipSrgbEncodeTable *srgb);

#endif
