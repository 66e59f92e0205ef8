// Truths of the gallery's scenes, which the reference renderer cannot draw: the same pipeline draws
// the scene several times as wide and high, with the best settings, and the pixels are averaged in
// linear light. Such a truth shows what more samples would give. It cannot show a fault that the
// pipeline has at every size.
#ifndef DIP_APP_COST_GALLERY_TRUTH_H
#define DIP_APP_COST_GALLERY_TRUTH_H

#include "app/gallery/gallery.h"
#include "app/measure/metrics/truth.h"

typedef struct DipGalleryTruth {
    DipGallery *gallery; // borrowed
    DipIsa isa;
} DipGalleryTruth;

// The `draw` of a DipTruthDef whose context is a DipGalleryTruth. The picture has at least
// def->samples samples for each pixel, as far as the greatest size of a frame allows. The two
// halves have different sample patterns.
DipTruthDraw dip_gallery_truth_draw;

#endif
