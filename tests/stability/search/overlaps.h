// Finds the pixels in which blended surfaces overlap.
//
// The reference blends the surfaces of each sample in the order of their depths, and the fast
// renderer those of whole objects (docs/picture.md, Blending). Where a sample has more than one,
// their pictures may differ.
#ifndef DIP_TESTS_STABILITY_SEARCH_OVERLAPS_H
#define DIP_TESTS_STABILITY_SEARCH_OVERLAPS_H

#include "tests/stability/search/check.h"
#include "renderer/catalogue/stability.h"

// Makes the scene of the choices and sets overlaps[p] for each pixel p that has, or is near, a
// sample of two or more blended surfaces. Water that one sees through counts as one. Returns false
// if drawing fails; run->broken_why then says why.
bool search_find_overlaps(StabilityRun *run, Choices *choices, bool *overlaps);

#endif
