// Sorts draws by the nearest point of their boxes.
#include "renderer/pipeline/geometry/order.h"

#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/pipeline/merge/merge_tile.h"

#include <math.h>
#include <string.h>

// With fewer clipped draws, the pass is drawn in submission order: the order pays where clipped
// draws hide each other, since each of their fragments takes a texture read in the coverage stage.
enum { MANY_CLIPPED_DRAWS = 256 };

bool dip_draws_near_to_far(const DipPass *pass) {
    int clipped = 0;
    if (pass->draw_count < MANY_CLIPPED_DRAWS || dip_pass_is_merged(pass)) {
        return false;
    }
    for (int d = 0; d < pass->draw_count; d++) {
        clipped += pass->draws[d].clip_shader != NULL;
    }
    return clipped >= MANY_CLIPPED_DRAWS;
}

// Draws are sorted into buckets by their nearest clip coordinate w. There are eight buckets for
// each power of two: the topmost bits of a float are its exponent and then its mantissa.
enum { BUCKET_SHIFT = 20, BUCKETS = 1 << (31 - BUCKET_SHIFT) };

static uint16_t bucket_of(const DipDraw *draw) {
    const float *m = draw->bounds_to_clip;
    if (!m) {
        return 0;
    }
    const DipBox *box = &draw->mesh->box;
    float w = m[15];
    for (int c = 0; c < 3; c++) {
        w += m[12 + c] * box->centre[c] - fabsf(m[12 + c]) * box->extent[c];
    }
    uint32_t bits = 0;
    if (w > 0.0f) {
        memcpy(&bits, &w, sizeof bits);
    }
    return (uint16_t)(bits >> BUCKET_SHIFT);
}

void dip_order_draws(const DipPass *pass, uint32_t *order, uint16_t *keys) {
    uint32_t first[BUCKETS + 1] = {0};
    const uint32_t count = (uint32_t)pass->draw_count;
    for (uint32_t d = 0; d < count; d++) {
        keys[d] = bucket_of(&pass->draws[d]);
        first[keys[d] + 1]++;
    }
    for (int b = 0; b < BUCKETS; b++) {
        first[b + 1] += first[b];
    }
    for (uint32_t d = 0; d < count; d++) {
        order[first[keys[d]]++] = d;
    }
}
