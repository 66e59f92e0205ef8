// Writes the samples of a tile to a readback (pipeline/readback.h). Only tiles of passes that are
// not merged have readbacks.
#ifndef DIP_RENDERER_PIPELINE_RESOLVE_READBACK_H
#define DIP_RENDERER_PIPELINE_RESOLVE_READBACK_H

#include "renderer/pipeline/readback.h"
#include "renderer/pipeline/shading/tile_shading.h"

// Gives all samples of the readback's pixels in the tile the background's colour.
void dip_readback_begin(const DipSampleReadback *readback, const DipTileShading *shading);

// Writes the samples of the first `count` fragments of a list. whole: the list is one of whole
// sub-blocks, whose fragments hold all samples of their pixels.
void dip_readback_fragments(const DipSampleReadback *readback, const DipTileShading *shading,
                            const DipFragmentList *list, int count, bool whole,
                            const DipEncodedBatch *encoded);

#endif
