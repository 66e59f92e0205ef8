// Fills the levels of a backdrop in whole numbers, so that they have the same bits everywhere.
#include "renderer/scene/draw/backdrop.h"

#include "renderer/base/pages.h"
#include "renderer/base/srgb.h"

#include <string.h>

enum {
    CODES = 256,
    ROWS = 16, // rows of a level in a job of the pool
};

bool dip_backdrop_make(DipBackdropParts *backdrop, int width, int height, DipError *err) {
    *backdrop = (DipBackdropParts){.target = {.width = width, .height = height}};
    DipTarget *target = &backdrop->target;
    DipBackdrop *levels = &backdrop->levels;
    dip_backdrop_lay_out(levels, width, height);
    const size_t texel_bytes = dip_backdrop_texels(levels) * 2 * sizeof *levels->texels;
    target->stride_bytes = (size_t)width * 4;
    target->rgba8 = dip_lines_alloc(target->stride_bytes * (size_t)height);
    levels->texels = dip_pages_alloc(texel_bytes);
    backdrop->light16 = dip_lines_alloc(CODES * sizeof *backdrop->light16);
    if (!target->rgba8 || !levels->texels || !backdrop->light16) {
        dip_backdrop_free(backdrop);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             width, height);
    }
    memset(target->rgba8, 0, target->stride_bytes * (size_t)height);
    memset(levels->texels, 0, texel_bytes);
    DipSrgbDecodeTable decode;
    dip_srgb_decode_table(&decode);
    for (int code = 0; code < CODES; code++) {
        backdrop->light16[code] = (uint16_t)(decode.linear[code] * DIP_LINEAR16_MAX + 0.5);
    }
    return true;
}

void dip_backdrop_free(DipBackdropParts *backdrop) {
    dip_lines_free(backdrop->target.rgba8);
    dip_lines_free(backdrop->levels.texels);
    dip_lines_free(backdrop->light16);
    *backdrop = (DipBackdropParts){.light16 = NULL};
}

// --- filling -------------------------------------------------------------------------------------

// A level that is being filled.
typedef struct Filling {
    const DipBackdropParts *backdrop;
    int level;
    DipTargetRegion region; // of the level, in texels
} Filling;

static void store(int32_t *texel, const uint32_t light[3]) {
    texel[0] = (int32_t)(light[0] | light[1] << 16);
    texel[1] = (int32_t)light[2];
}

static void decode_row(const Filling *filling, int y) {
    const DipBackdropParts *backdrop = filling->backdrop;
    const DipTarget *target = &backdrop->target;
    const uint8_t *pixels = target->rgba8 + (size_t)y * target->stride_bytes;
    int32_t *row = backdrop->levels.texels + 2 * (size_t)y * (size_t)target->width;
    for (int x = filling->region.x0; x < filling->region.x1; x++) {
        uint32_t light[3];
        for (int c = 0; c < 3; c++) {
            light[c] = backdrop->light16[pixels[4 * x + c]];
        }
        store(row + 2 * (size_t)x, light);
    }
}

static int lesser(int a, int b) {
    return a < b ? a : b;
}

// The texels of a finer level that a texel overlaps along an axis, and by how much, in whole
// numbers whose sum is `total`.
typedef struct Overlaps {
    int first;
    int count;
    uint32_t part[3];
    uint32_t total;
} Overlaps;

// size: of the finer level. If it is odd, 2 m + 1, texel i reaches from 2 i + i / m on over 2 + 1 /
// m texels.
static Overlaps overlaps_of(int size, int i) {
    const uint32_t half = (uint32_t)size / 2;
    if (size == 1) {
        return (Overlaps){0, 1, {1}, 1};
    }
    if (size % 2 == 0) {
        return (Overlaps){2 * i, 2, {1, 1}, 2};
    }
    return (Overlaps){2 * i, 3, {half - (uint32_t)i, half, (uint32_t)i + 1}, (uint32_t)size};
}

// Returns the mean, rounded, halves up.
static uint32_t mean_of(uint64_t sum, uint64_t total) {
    return (uint32_t)(total == 4 ? (sum + 2) >> 2 : (2 * sum + total) / (2 * total));
}

static void halve_row(const Filling *filling, int y) {
    const DipBackdrop *levels = &filling->backdrop->levels;
    const int finer = filling->level - 1;
    const size_t stride = 2 * (size_t)levels->width[finer];
    const int32_t *from = levels->texels + 2 * (size_t)levels->first[finer];
    const Overlaps down = overlaps_of(levels->height[finer], y);
    int32_t *row = levels->texels + 2 * ((size_t)levels->first[finer + 1] +
                                         (size_t)y * (size_t)levels->width[finer + 1]);
    for (int x = filling->region.x0; x < filling->region.x1; x++) {
        const Overlaps across = overlaps_of(levels->width[finer], x);
        uint64_t sum[3] = {0, 0, 0};
        for (int j = 0; j < down.count; j++) {
            const int32_t *texels =
                from + (size_t)(down.first + j) * stride + 2 * (size_t)across.first;
            for (int i = 0; i < across.count; i++) {
                const uint64_t part = (uint64_t)down.part[j] * across.part[i];
                const uint32_t words[2] = {(uint32_t)texels[2 * i], (uint32_t)texels[2 * i + 1]};
                sum[0] += part * (words[0] & 65535U);
                sum[1] += part * (words[0] >> 16);
                sum[2] += part * words[1];
            }
        }
        const uint64_t total = (uint64_t)down.total * across.total;
        const uint32_t light[3] = {mean_of(sum[0], total), mean_of(sum[1], total),
                                   mean_of(sum[2], total)};
        store(row + 2 * (size_t)x, light);
    }
}

static void fill_rows(void *context, int job, int worker) {
    (void)worker;
    const Filling *filling = context;
    const int begin = filling->region.y0 + job * ROWS;
    const int end = lesser(begin + ROWS, filling->region.y1);
    for (int y = begin; y < end; y++) {
        if (filling->level) {
            halve_row(filling, y);
        } else {
            decode_row(filling, y);
        }
    }
}

// Finds the texels of a level that a range of pixels touches. size: of the picture.
static void find_part(int size, int texels, int begin, int end, int *first, int *last) {
    *first = (int)((int64_t)begin * texels / size);
    *last = (int)(((int64_t)end * texels + size - 1) / size);
}

uint64_t dip_backdrop_fill(const DipBackdropParts *backdrop, const DipTargetRegion *region,
                           DipPool *pool) {
    const DipBackdrop *levels = &backdrop->levels;
    Filling filling = {.backdrop = backdrop};
    DipTargetRegion *part = &filling.region;
    uint64_t texels = 0;
    for (; filling.level < levels->count; filling.level++) {
        find_part(levels->width[0], levels->width[filling.level], region->x0, region->x1, &part->x0,
                  &part->x1);
        find_part(levels->height[0], levels->height[filling.level], region->y0, region->y1,
                  &part->y0, &part->y1);
        const int rows = part->y1 - part->y0;
        texels += (uint64_t)(part->x1 - part->x0) * (uint64_t)rows;
        dip_pool_run(pool, (rows + ROWS - 1) / ROWS, fill_rows, &filling);
    }
    return texels;
}

uint64_t dip_backdrop_bytes(const DipBackdropParts *backdrop) {
    const DipTarget *target = &backdrop->target;
    return target->stride_bytes * (uint64_t)target->height +
           (uint64_t)dip_backdrop_texels(&backdrop->levels) * 2 * sizeof *backdrop->levels.texels;
}
