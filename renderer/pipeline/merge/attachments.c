// Loads what a tile starts from, and stores what outlives its pass.
#include "renderer/pipeline/merge/depth_planes.h"
#include "renderer/pipeline/merge/merge_tile.h"
#include "renderer/pipeline/merge/sample_blocks.h"

#include <string.h>

enum { CHANNELS = 4 };

static int least(int a, int b) {
    return a < b ? a : b;
}

static int greatest(int a, int b) {
    return a > b ? a : b;
}

// A row of a block's pixels, cut to the pixels that the pass may change.
typedef struct Row {
    int x; // column and row of the first pixel in the target
    int y;
    int from; // first and last + 1 of the block's columns
    int to;
} Row;

static inline Row row_of(const DipMergePass *pass, const DipTile *tile, int block, int y) {
    const DipTargetRegion *stored = &pass->stored;
    const int x0 = tile->x0 + block % DIP_TILE_BLOCKS * DIP_BLOCK;
    const int row = tile->y0 + block / DIP_TILE_BLOCKS * DIP_BLOCK + y;
    Row found = {.y = row, .from = 0, .to = DIP_BLOCK};
    found.from = stored->x0 > x0 ? stored->x0 - x0 : 0;
    found.to = stored->x1 < x0 + DIP_BLOCK ? stored->x1 - x0 : DIP_BLOCK;
    if (row < stored->y0 || row >= stored->y1 || found.from > found.to) {
        found.to = found.from;
    }
    found.x = x0 + found.from;
    return found;
}

// Copies a row's values of 4 bytes out of a block's order, or into it. `of_block`: the values of
// the block's 64 pixels; `of_row`: those of the row's pixels.
static inline void copy_row_out(const Row *row, int y, const void *of_block, void *of_row) {
    const uint32_t *from = of_block;
    uint32_t *to = of_row;
    if (row->to - row->from == DIP_BLOCK) {
        memcpy(to, from + dip_block_pixel(0, y), DIP_SUB_BLOCK * sizeof *to);
        memcpy(to + DIP_SUB_BLOCK, from + dip_block_pixel(DIP_SUB_BLOCK, y),
               DIP_SUB_BLOCK * sizeof *to);
        return;
    }
    for (int x = row->from; x < row->to; x++) {
        to[x - row->from] = from[dip_block_pixel(x, y)];
    }
}

static void copy_row_in(const Row *row, int y, const void *of_row, void *of_block) {
    const uint32_t *from = of_row;
    uint32_t *to = of_block;
    if (row->to - row->from == DIP_BLOCK) {
        memcpy(to + dip_block_pixel(0, y), from, DIP_SUB_BLOCK * sizeof *to);
        memcpy(to + dip_block_pixel(DIP_SUB_BLOCK, y), from + DIP_SUB_BLOCK,
               DIP_SUB_BLOCK * sizeof *to);
        return;
    }
    for (int x = row->from; x < row->to; x++) {
        to[dip_block_pixel(x, y)] = from[x - row->from];
    }
}

static char *target_row(const DipTarget *target, int y) {
    return (char *)target->rgba8 + (size_t)y * target->stride_bytes;
}

// --- colours -------------------------------------------------------------------------------------

// Reads one row into light[c][0..count-1].
static void load_row(const DipMergePass *pass, const Row *row, float light[CHANNELS][DIP_BLOCK]) {
    const DipTarget *target = &pass->pass->target;
    const int count = row->to - row->from;
    if (target->format == DIP_FORMAT_CALLER) {
        float *const rows[CHANNELS] = {light[0], light[1], light[2], light[3]};
        target->load(target->context, row->x, row->y, count, rows);
        return;
    }
    const char *from = target_row(target, row->y);
    for (int i = 0; i < count; i++) {
        const uint8_t *codes = (const uint8_t *)from + 4 * (size_t)(row->x + i);
        const float *floats = (const float *)(const void *)from;
        for (int c = 0; c < CHANNELS; c++) {
            switch (target->format) {
            case DIP_FORMAT_SRGB8:
                light[c][i] = c < 3 ? pass->srgb_light[codes[c]] : (float)codes[c] / 255.0f;
                break;
            case DIP_FORMAT_LINEAR8:
                light[c][i] = (float)codes[c] / 255.0f;
                break;
            case DIP_FORMAT_RGBA32F:
                light[c][i] = floats[4 * (row->x + i) + c];
                break;
            default:
                light[c][i] = c == 0 ? floats[row->x + i] : c == 3 ? 1.0f : 0.0f;
                break;
            }
        }
    }
}

void dip_load_colours(const DipMergePass *pass, const DipTile *tile, int block,
                      float *const light[CHANNELS]) {
    for (int c = 0; c < CHANNELS; c++) {
        for (int i = 0; i < DIP_BLOCK_PIXELS; i++) {
            light[c][i] = pass->clear[c];
        }
    }
    for (int y = 0; pass->pass->attachments.colour_load == DIP_LOAD_KEEP && y < DIP_BLOCK; y++) {
        const Row row = row_of(pass, tile, block, y);
        float held[CHANNELS][DIP_BLOCK];
        if (row.to > row.from) {
            load_row(pass, &row, held);
        }
        for (int c = 0; c < CHANNELS; c++) {
            copy_row_in(&row, y, held[c], light[c]);
        }
    }
}

static void store_codes(const DipMergePass *pass, const DipTile *tile, int block,
                        const uint32_t rgba8[DIP_BLOCK_PIXELS]) {
    const DipTarget *target = &pass->pass->target;
    for (int y = 0; y < DIP_BLOCK; y++) {
        const Row row = row_of(pass, tile, block, y);
        if (row.to <= row.from) {
            continue;
        }
        copy_row_out(&row, y, rgba8, (uint32_t *)(void *)target_row(target, row.y) + row.x);
    }
}

static void store_light(const DipMergePass *pass, const DipTile *tile, int block,
                        const DipBlockLight *light) {
    const DipTarget *target = &pass->pass->target;
    for (int y = 0; y < DIP_BLOCK; y++) {
        const Row row = row_of(pass, tile, block, y);
        const int count = row.to - row.from;
        if (count <= 0) {
            continue;
        }
        float line[CHANNELS][DIP_BLOCK];
        for (int c = 0; c < CHANNELS; c++) {
            copy_row_out(&row, y, light->channel[c], line[c]);
        }
        if (target->format == DIP_FORMAT_CALLER) {
            const float *const rows[CHANNELS] = {line[0], line[1], line[2], line[3]};
            target->store(target->context, row.x, row.y, count, rows);
            continue;
        }
        const int channels = target->format == DIP_FORMAT_RGBA32F ? CHANNELS : 1;
        float *to = (float *)(void *)target_row(target, row.y) + (size_t)(row.x * channels);
        for (int i = 0; i < count; i++) {
            for (int c = 0; c < channels; c++) {
                to[i * channels + c] = line[c][i];
            }
        }
    }
}

static void store_clear(const DipMergePass *pass, const DipTile *tile, int block) {
    uint32_t rgba8[DIP_BLOCK_PIXELS];
    for (int i = 0; i < DIP_BLOCK_PIXELS; i++) {
        rgba8[i] = pass->clear_rgba8;
    }
    store_codes(pass, tile, block, rgba8);
}

// Stores the mean of each pixel's samples in the light of the tile.
static void resolve_to_light16(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                               int block, uint16_t *light16) {
    DipBlockLight16 means;
    dip_merge_ready_block(pass, merge, tile, block);
    pass->kernels->dip_kernel_resolve_light16(&merge->colours, block, &means);
    light16 += block / DIP_TILE_BLOCKS * DIP_BLOCK * DIP_TILE + block % DIP_TILE_BLOCKS * DIP_BLOCK;
    for (int c = 0; c < 3; c++, light16 += DIP_TILE_PIXELS) {
        for (int y = 0; y < DIP_BLOCK; y++) {
            for (int x = 0; x < DIP_BLOCK; x++) {
                light16[y * DIP_TILE + x] = (uint16_t)means.channel[c][dip_block_pixel(x, y)];
            }
        }
    }
}

// Stores the mean of each pixel's samples in the target.
static void resolve_colours(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                            int block) {
    const DipAttachments *a = &pass->pass->attachments;
    const bool ready = merge->colours.ready >> block & 1;
    const bool kept = a->colour_load == DIP_LOAD_KEEP;
    if (!ready && kept && !a->samples) {
        return; // the target holds these colours
    }
    if (!ready && !kept && pass->clamps) {
        store_clear(pass, tile, block);
        return;
    }
    dip_merge_ready_block(pass, merge, tile, block);
    if (pass->clamps) {
        const bool srgb = pass->pass->target.format == DIP_FORMAT_SRGB8;
        uint32_t rgba8[DIP_BLOCK_PIXELS];
        pass->kernels->dip_kernel_resolve_codes(&merge->colours, block, srgb ? pass->srgb : NULL,
                                                rgba8);
        store_codes(pass, tile, block, rgba8);
    } else {
        DipBlockLight light;
        pass->kernels->dip_kernel_resolve_light(&merge->colours, block, &light);
        store_light(pass, tile, block, &light);
    }
}

// Stores the colours of a block's samples.
static void store_samples(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                          int block) {
    const DipAttachments *a = &pass->pass->attachments;
    const bool ready = merge->colours.ready >> block & 1;
    if (ready || a->colour_load != DIP_LOAD_KEEP) {
        dip_merge_ready_block(pass, merge, tile, block);
        dip_samples_store_block(a->samples, &pass->stored, tile, block, &merge->colours);
    }
}

// --- depths and stencil values -------------------------------------------------------------------

void dip_load_depths(const DipMergePass *pass, DipTile *tile) {
    const DipAttachments *a = &pass->pass->attachments;
    const int count = tile->pattern->count;
    const size_t values = (size_t)DIP_BLOCKS * (size_t)count * DIP_BLOCK_PIXELS;
    for (size_t i = 0; i < values; i++) {
        tile->depth[i] = a->clear_depth;
    }
    memset(tile->id, 0, values * sizeof *tile->id);
    tile->touched = ~(uint64_t)0;
    if (!a->depth || a->depth_load != DIP_LOAD_KEEP) {
        return;
    }
    for (int block = 0; block < DIP_BLOCKS; block++) {
        for (int y = 0; dip_block_is_drawn(tile, block) && y < DIP_BLOCK; y++) {
            const Row row = row_of(pass, tile, block, y);
            for (int s = 0; row.to > row.from && s < count; s++) {
                const float *from = a->depth->depth + dip_depth_row_index(a->depth, s, row.y);
                copy_row_in(&row, y, from + row.x, tile->depth + dip_tile_index(tile, block, s));
            }
        }
    }
}

void dip_load_stencil(const DipMergePass *pass, const DipTile *tile, uint8_t *stencil) {
    const DipAttachments *a = &pass->pass->attachments;
    const int count = tile->pattern->count;
    memset(stencil, a->clear_stencil, (size_t)DIP_BLOCKS * (size_t)count * DIP_BLOCK_PIXELS);
    if (!a->depth || a->stencil_load != DIP_LOAD_KEEP) {
        return;
    }
    for (int block = 0; block < DIP_BLOCKS; block++) {
        for (int y = 0; dip_block_is_drawn(tile, block) && y < DIP_BLOCK; y++) {
            const Row row = row_of(pass, tile, block, y);
            for (int s = 0; row.to > row.from && s < count; s++) {
                const uint8_t *from = a->depth->stencil + dip_depth_row_index(a->depth, s, row.y);
                uint8_t *to = stencil + dip_tile_index(tile, block, s);
                for (int x = row.from; x < row.to; x++) {
                    to[dip_block_pixel(x, y)] = from[row.x + x - row.from];
                }
            }
        }
    }
}

// Stores the depths of sample s in one row of the tile, in columns x0..x1-1. `to` is where the
// depth of the tile's column 0 goes. Blocks that no triangle has touched have the depth 0.
static void store_depth_row(const DipTile *tile, int s, int y, int x0, int x1, float *to) {
    for (int x = x0; x < x1; x = (x / DIP_BLOCK + 1) * DIP_BLOCK) {
        const int block = y / DIP_BLOCK * DIP_TILE_BLOCKS + x / DIP_BLOCK;
        const bool touched = tile->touched >> block & 1;
        const int end = (x / DIP_BLOCK + 1) * DIP_BLOCK;
        const float *from = tile->depth + dip_tile_index(tile, block, s);
        if (x % DIP_BLOCK || end > x1) {
            for (int i = x; i < end && i < x1; i++) {
                to[i] = touched ? from[dip_block_pixel(i % DIP_BLOCK, y % DIP_BLOCK)] : 0.0f;
            }
        } else if (touched) {
            const float *row = from + dip_block_pixel(0, y % DIP_BLOCK);
            memcpy(to + x, row, DIP_SUB_BLOCK * sizeof *to);
            memcpy(to + x + DIP_SUB_BLOCK, row + DIP_SUB_BLOCK_PIXELS, DIP_SUB_BLOCK * sizeof *to);
        } else {
            memset(to + x, 0, DIP_BLOCK * sizeof *to);
        }
    }
}

void dip_store_pass_depths(const DipPass *pass, const DipTile *tile) {
    const DipTarget *target = &pass->target;
    const int x1 = least(target->width - tile->x0, DIP_TILE - tile->right);
    const int y1 = least(target->height - tile->y0, DIP_TILE - tile->bottom);
    for (int y = greatest(tile->top, 0); y < y1; y++) {
        float *row = pass->depths + (size_t)(tile->y0 + y) * (size_t)target->width;
        store_depth_row(tile, 0, y, greatest(tile->left, 0), x1, row + tile->x0);
    }
}

// Stores the depths of the tile's drawn blocks, row by row of the tile, because rows are whole in
// the memory of a DipDepth.
static void store_depths(const DipMergePass *pass, const DipTile *tile) {
    const DipTargetRegion *stored = &pass->stored;
    DipDepth *depth = pass->pass->attachments.depth;
    const int x0 = greatest(stored->x0 - tile->x0, tile->left);
    const int y0 = greatest(stored->y0 - tile->y0, tile->top);
    const int x1 = least(stored->x1 - tile->x0, DIP_TILE - tile->right);
    const int y1 = least(stored->y1 - tile->y0, DIP_TILE - tile->bottom);
    for (int s = 0; s < tile->pattern->count; s++) {
        for (int y = y0; y < y1; y++) {
            const size_t row = dip_depth_row_index(depth, s, tile->y0 + y);
            store_depth_row(tile, s, y, x0, x1, depth->depth + row + (size_t)tile->x0);
        }
    }
}

static void store_stencil(const DipMergePass *pass, const DipMergeTile *merge, const DipTile *tile,
                          int block) {
    DipDepth *depth = pass->pass->attachments.depth;
    for (int y = 0; y < DIP_BLOCK; y++) {
        const Row row = row_of(pass, tile, block, y);
        for (int s = 0; row.to > row.from && s < tile->pattern->count; s++) {
            const uint8_t *from = merge->stencil + dip_tile_index(tile, block, s);
            uint8_t *to = depth->stencil + dip_depth_row_index(depth, s, row.y) + row.x;
            for (int x = row.from; x < row.to; x++) {
                to[x - row.from] = from[dip_block_pixel(x, y)];
            }
        }
    }
}

void dip_store_attachments(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                           uint16_t *light16) {
    const DipAttachments *a = &pass->pass->attachments;
    if (a->depth && a->depth_store == DIP_STORE_KEEP) {
        store_depths(pass, tile);
    }
    for (int block = 0; block < DIP_BLOCKS; block++) {
        if (!dip_block_is_drawn(tile, block)) {
            continue;
        }
        if (light16) {
            resolve_to_light16(pass, merge, tile, block, light16);
        } else if (pass->resolves) {
            resolve_colours(pass, merge, tile, block);
        }
        if (a->samples && a->colour_store == DIP_STORE_KEEP) {
            store_samples(pass, merge, tile, block);
        }
        if (a->depth && a->stencil_store == DIP_STORE_KEEP) {
            store_stencil(pass, merge, tile, block);
        }
    }
}
