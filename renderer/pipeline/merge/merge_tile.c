// The colours of a merged pass's tile, and what plain draws leave in them.
#include "renderer/pipeline/merge/merge_tile.h"

#include "renderer/base/pages.h"
#include "renderer/pipeline/merge/sample_blocks.h"

#include <string.h>

enum { CHANNELS = 4, TILE_SAMPLES = DIP_TILE_PIXELS * DIP_MAX_SAMPLES };

static bool is_set(const DipTargetRegion *region) {
    return region->x0 || region->y0 || region->x1 || region->y1;
}

static bool has_ordered_draws(const DipPass *pass) {
    for (int d = 0; d < pass->draw_count; d++) {
        if (dip_state_is_ordered(pass->draws[d].state)) {
            return true;
        }
    }
    return false;
}

static bool has_target(const DipTarget *target) {
    return target->format == DIP_FORMAT_CALLER || target->rgba8;
}

bool dip_pass_stores_target(const DipPass *pass) {
    const DipAttachments *a = &pass->attachments;
    return a->samples ? !a->keep_target
                      : has_target(&pass->target) && a->colour_store == DIP_STORE_KEEP;
}

bool dip_pass_has_colours(const DipPass *pass) {
    return pass->attachments.samples || has_target(&pass->target);
}

bool dip_pass_merges_all_tiles(const DipPass *pass) {
    const DipAttachments *a = &pass->attachments;
    return pass->target.format != DIP_FORMAT_SRGB8 || !has_target(&pass->target) || a->samples ||
           a->colour_load != DIP_LOAD_CLEAR || a->colour_store != DIP_STORE_KEEP ||
           a->clear_transparent || a->depth || a->clear_depth > 0.0f || is_set(&pass->viewport) ||
           is_set(&pass->scissor);
}

bool dip_pass_is_merged(const DipPass *pass) {
    return dip_pass_merges_all_tiles(pass) || has_ordered_draws(pass);
}

bool dip_pass_hands_light(const DipPass *pass) {
    return pass->tile_done && !dip_pass_merges_all_tiles(pass);
}

static void cut(DipTargetRegion *region, const DipTargetRegion *by) {
    if (is_set(by)) {
        region->x0 = by->x0 > region->x0 ? by->x0 : region->x0;
        region->y0 = by->y0 > region->y0 ? by->y0 : region->y0;
        region->x1 = by->x1 < region->x1 ? by->x1 : region->x1;
        region->y1 = by->y1 < region->y1 ? by->y1 : region->y1;
    }
}

static bool tests_stencil(const DipPass *pass) {
    for (int d = 0; d < pass->draw_count; d++) {
        if (pass->draws[d].state && pass->draws[d].state->stencil.enabled) {
            return true;
        }
    }
    return false;
}

// Returns the clear colour as a pixel of 8 bits per channel.
static uint32_t clear_code(const DipMergePass *merge) {
    uint32_t rgba8 = 0;
    for (int c = 0; c < CHANNELS; c++) {
        const int32_t linear16 = (int32_t)(merge->clear[c] * 65535.0f + 0.5f);
        const bool encodes = c < 3 && merge->pass->target.format == DIP_FORMAT_SRGB8;
        const uint32_t code = encodes ? dip_srgb_code(merge->srgb, linear16)
                                      : ((uint32_t)linear16 * 255u + 32767u) / 65535u;
        rgba8 |= code << (8 * c);
    }
    return rgba8;
}

void dip_merge_pass_begin(DipMergePass *merge, const DipPass *pass) {
    const DipAttachments *a = &pass->attachments;
    const DipFormat format = pass->target.format;
    merge->pass = pass;
    merge->has_colours = dip_pass_has_colours(pass);
    merge->resolves = dip_pass_stores_target(pass);
    merge->clamps = format == DIP_FORMAT_SRGB8 || format == DIP_FORMAT_LINEAR8;
    merge->uses_stencil = (a->depth && a->stencil_store == DIP_STORE_KEEP) || tests_stencil(pass);
    merge->starts_from_depth =
        (a->depth && a->depth_load == DIP_LOAD_KEEP) || a->clear_depth > 0.0f;
    merge->stored = (DipTargetRegion){0, 0, pass->target.width, pass->target.height};
    cut(&merge->stored, &pass->viewport);
    cut(&merge->stored, &pass->scissor);
    for (int c = 0; c < 3; c++) {
        const float light = pass->clear_lin[c];
        merge->clear[c] = !merge->clamps ? light : light > 0.0f ? (light < 1.0f ? light : 1.0f) : 0;
    }
    merge->clear[3] = a->clear_transparent ? 0.0f : 1.0f;
    merge->clear_rgba8 = merge->clamps ? clear_code(merge) : 0;
}

// --- memory --------------------------------------------------------------------------------------

bool dip_merge_tile_allocate(DipMergeTile *merge) {
    if (merge->scratch) {
        return true;
    }
    bool done = true;
    for (int c = 0; c < CHANNELS; c++) {
        merge->colours.channel[c] =
            dip_lines_alloc(TILE_SAMPLES * sizeof *merge->colours.channel[c]);
        done = done && merge->colours.channel[c];
    }
    merge->stencil = dip_lines_alloc(TILE_SAMPLES * sizeof *merge->stencil);
    merge->scratch = dip_lines_alloc(DIP_TILE_PIXELS * sizeof *merge->scratch);
    if (!done || !merge->stencil || !merge->scratch) {
        dip_merge_tile_free(merge);
        return false;
    }
    return true;
}

void dip_merge_tile_free(DipMergeTile *merge) {
    for (int c = 0; c < CHANNELS; c++) {
        dip_lines_free(merge->colours.channel[c]);
        merge->colours.channel[c] = NULL;
    }
    dip_lines_free(merge->stencil);
    dip_lines_free(merge->scratch);
    merge->stencil = NULL;
    merge->scratch = NULL;
}

// --- a tile --------------------------------------------------------------------------------------

void dip_merge_begin(const DipMergePass *pass, DipMergeTile *merge, DipTile *tile) {
    DipTileColours *colours = &merge->colours;
    colours->sample_count = tile->pattern->count;
    colours->clamps = pass->clamps;
    colours->ready = 0;
    memset(colours->split, 0, sizeof colours->split);
    merge->draw = -1;
    merge->plain_left = false;
    merge->ordered.stencil = merge->stencil;
    for (int i = 0; i < DIP_ORDERED_BATCHES; i++) {
        merge->ordered.batches[i].list.count = 0;
        merge->ordered.batches[i].count = 0;
    }
    merge->ordered.full = 0;
    if (pass->starts_from_depth) {
        dip_load_depths(pass, tile);
    }
    if (pass->uses_stencil) {
        dip_load_stencil(pass, tile, merge->stencil);
    }
}

void dip_split(DipTileColours *colours, int sub_block) {
    const int block = sub_block / 4;
    const int first =
        block * colours->sample_count * DIP_BLOCK_PIXELS + sub_block % 4 * DIP_SUB_BLOCK_PIXELS;
    for (int c = 0; c < CHANNELS; c++) {
        float *channel = colours->channel[c] + first;
        for (int s = 1; s < colours->sample_count; s++) {
            memcpy(channel + s * DIP_BLOCK_PIXELS, channel, DIP_SUB_BLOCK_PIXELS * sizeof *channel);
        }
    }
    colours->split[sub_block / 64] |= (uint64_t)1 << sub_block % 64;
}

void dip_merge_load_block(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                          int block) {
    const DipAttachments *a = &pass->pass->attachments;
    DipTileColours *colours = &merge->colours;
    colours->ready |= (uint64_t)1 << block;
    if (a->samples && a->colour_load == DIP_LOAD_KEEP) {
        dip_samples_load_block(a->samples, tile, block, colours);
        return;
    }
    float *to[CHANNELS];
    for (int c = 0; c < CHANNELS; c++) {
        to[c] = colours->channel[c] + dip_tile_index(tile, block, 0);
    }
    dip_load_colours(pass, tile, block, to);
}

void dip_merge_clear_ids(DipTile *tile) {
    const size_t count = (size_t)tile->pattern->count * DIP_BLOCK_PIXELS;
    for (uint64_t left = tile->touched; left; left &= left - 1) {
        const int block = __builtin_ctzll(left);
        memset(tile->id + (size_t)block * count, 0, count * sizeof *tile->id);
    }
    tile->grouped = 0;
}

// --- plain draws ---------------------------------------------------------------------------------

// Where a pixel of the tile lies in the arrays of a tile.
typedef struct Place {
    int block;
    int first; // index of the pixel's sub-block in sample 0's values
    int lane;  // the pixel within its sub-block
} Place;

static Place place_of(const DipTile *tile, uint32_t pixel) {
    const int x = (int)(pixel % DIP_TILE);
    const int y = (int)(pixel / DIP_TILE);
    const int block = y / DIP_BLOCK * DIP_TILE_BLOCKS + x / DIP_BLOCK;
    const int quarter = y % DIP_BLOCK / DIP_SUB_BLOCK * 2 + x % DIP_BLOCK / DIP_SUB_BLOCK;
    return (Place){block, dip_tile_index(tile, block, 0) + quarter * DIP_SUB_BLOCK_PIXELS,
                   y % DIP_SUB_BLOCK * DIP_SUB_BLOCK + x % DIP_SUB_BLOCK};
}

// Returns a colour as the target stores it. A NaN becomes 0 where colours are clamped.
static float bounded(const DipMergePass *pass, float light) {
    return !pass->clamps ? light : light > 0.0f ? (light < 1.0f ? light : 1.0f) : 0.0f;
}

static void store_fragment(const DipMergePass *pass, DipTileColours *colours, const Place *place,
                           uint32_t samples, const float light[CHANNELS]) {
    const int number = dip_sub_block_number(place->first, colours->sample_count);
    const uint32_t all = (1u << colours->sample_count) - 1;
    if (!dip_is_split(colours, number)) {
        if (samples == all) {
            samples = 1;
        } else {
            dip_split(colours, number);
        }
    }
    for (uint32_t left = samples; left; left &= left - 1) {
        const int at = place->first + __builtin_ctz(left) * DIP_BLOCK_PIXELS + place->lane;
        for (int c = 0; c < CHANNELS; c++) {
            colours->channel[c][at] = bounded(pass, light[c]);
        }
    }
}

void dip_merge_store_fragments(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                               const DipFragmentList *list, int count,
                               const DipFragmentBatch *batch) {
    for (int i = 0; i < count; i++) {
        const Place place = place_of(tile, list->position[i] & DIP_POSITION_PIXEL);
        const float light[CHANNELS] = {batch->colour[0][i], batch->colour[1][i],
                                       batch->colour[2][i], 1.0f};
        dip_merge_ready_block(pass, merge, tile, place.block);
        store_fragment(pass, &merge->colours, &place, list->samples[i], light);
    }
}

void dip_merge_store_whole(const DipMergePass *pass, DipMergeTile *merge, const DipTile *tile,
                           const DipFragmentList *list, const DipFragmentBatch *batch) {
    DipTileColours *colours = &merge->colours;
    for (int i = 0; i < list->count; i += DIP_SUB_BLOCK_PIXELS) {
        const Place place = place_of(tile, list->position[i] & DIP_POSITION_PIXEL);
        dip_merge_ready_block(pass, merge, tile, place.block);
        const int number = dip_sub_block_number(place.first, colours->sample_count);
        colours->split[number / 64] &= ~((uint64_t)1 << number % 64);
        for (int k = 0; k < DIP_SUB_BLOCK_PIXELS; k++) {
            for (int c = 0; c < 3; c++) {
                colours->channel[c][place.first + k] = bounded(pass, batch->colour[c][i + k]);
            }
            colours->channel[3][place.first + k] = 1.0f;
        }
    }
}
