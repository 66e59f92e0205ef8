// Draws the blended surfaces of one sample of a converged picture in their order: from far to near.
#include "renderer/reference/internal/internal.h"

#include <math.h>

enum { NOTHING = -1 };

DipRefPeel dip_reference_peel_begin(const double rgb[3], double depth) {
    // A blended surface at the depth of the opaque one is hidden.
    return (DipRefPeel){
        .rgb = {rgb[0], rgb[1], rgb[2]}, .depth = depth, .last = INT32_MAX, .next = NOTHING};
}

void dip_reference_peel_offer(DipRefPeel *peel, double depth, int32_t triangle) {
    const bool is_left = depth > peel->depth || (depth == peel->depth && triangle > peel->last);
    const bool is_first = peel->next == NOTHING || depth < peel->next_depth ||
                          (depth == peel->next_depth && triangle < peel->next);
    if (is_left && is_first) {
        peel->next_depth = depth;
        peel->next = triangle;
    }
}

void dip_reference_blend(const double layer[DIP_REF_LAYER], double rgb[3]) {
    for (int c = 0; c < 3; c++) {
        rgb[c] = fmin(layer[3] * layer[c] + layer[4 + c] * rgb[c], 1.0);
    }
}

void dip_reference_peel_blend(DipRefPeel *peel, const double layer[DIP_REF_LAYER]) {
    dip_reference_blend(layer, peel->rgb);
    peel->depth = peel->next_depth;
    peel->last = peel->next;
    peel->next = NOTHING;
}
