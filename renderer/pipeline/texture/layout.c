// Lays out the levels of textures in memory and fills their padding.
#include "renderer/pipeline/texture/texture_layout.h"

#include "renderer/base/pages.h"

#include <stdlib.h>
#include <string.h>

enum { BORDER = -1 }; // a padding column or row that repeats no other one

void dip_texture_set_wrap(DipTexture *texture, const DipTextureDef *def) {
    const bool has_border = def->wrap_u == DIP_WRAP_BORDER || def->wrap_v == DIP_WRAP_BORDER;
    texture->wrap_u = def->wrap_u;
    texture->wrap_v = def->wrap_v;
    texture->padding = has_border ? 3 : 1;
    texture->special_wrap =
        has_border || def->wrap_u == DIP_WRAP_MIRROR || def->wrap_v == DIP_WRAP_MIRROR;
    texture->wraps_in_bits = def->wrap_u == DIP_WRAP_REPEAT && def->wrap_v == DIP_WRAP_REPEAT;
}

static int floor_log2(int size) {
    return 31 - __builtin_clz((unsigned)size);
}

static bool is_power_of_two(int size) {
    return (size & (size - 1)) == 0;
}

// Returns the number of padding columns (or rows) before a level's first column (or row).
static int leading_padding(const DipTexture *texture) {
    return texture->padding / 2;
}

void dip_texture_add_level(DipTexture *texture, int width, int height) {
    const int level = texture->level_count++;
    texture->level_width[level] = width;
    texture->level_height[level] = height;
    const size_t stride = dip_texture_stride(texture, level);
    texture->level_offset[level] =
        (int32_t)(texture->texel_count + (size_t)leading_padding(texture) * (stride + 1));
    texture->level_log2_width[level] = floor_log2(width);
    texture->level_log2_height[level] = floor_log2(height);
    texture->wraps_in_bits =
        texture->wraps_in_bits && is_power_of_two(width) && is_power_of_two(height);
    texture->texel_count += stride * (size_t)(height + texture->padding);
}

uint8_t *dip_texture_allocate_alpha(const DipTexture *texture) {
    return calloc(texture->texel_count + 32, 1);
}

// Reads may run past the last texel; 8 spare texels and 32 spare bytes of alpha keep such reads
// inside the arrays.
bool dip_texture_allocate(DipTexture *texture, bool with_alpha) {
    texture->texels = dip_pages_alloc((texture->texel_count + 8) * sizeof *texture->texels);
    if (with_alpha) {
        texture->alpha = dip_texture_allocate_alpha(texture);
    }
    return texture->texels && (texture->alpha || !with_alpha);
}

// Returns the column (or row) of a level from which the padding column (or row) i takes its texels,
// or BORDER.
static int padding_source(int i, int size, DipWrap wrap) {
    if (wrap == DIP_WRAP_BORDER) {
        return BORDER;
    }
    if (wrap == DIP_WRAP_REPEAT) {
        return i < 0 ? size - 1 : 0;
    }
    return i < 0 ? 0 : size - 1;
}

// Copies `count` texels of one row or column to another position.
static void copy_texels(DipTexture *texture, size_t to, size_t from, size_t count) {
    memcpy(texture->texels + to, texture->texels + from, count * sizeof *texture->texels);
    if (texture->alpha) {
        memcpy(texture->alpha + to, texture->alpha + from, count);
    }
}

static void fill_border(DipTexture *texture, size_t to, size_t count) {
    for (size_t i = 0; i < count; i++) {
        texture->texels[to + i] = texture->border;
    }
    if (texture->alpha) {
        memset(texture->alpha + to, texture->border_alpha, count);
    }
}

// Padding columns (or rows) have the indices -leading_padding .. -1 and size .. last. This function
// returns the one after i.
static int next_padding(int i, int size) {
    return i == -1 ? size : i + 1;
}

void dip_texture_pad_row(DipTexture *texture, int level, int y) {
    const int width = texture->level_width[level];
    const int height = texture->level_height[level];
    const int lead = leading_padding(texture);
    const int first = lead ? -lead : width;
    const size_t stride = dip_texture_stride(texture, level);
    const size_t origin = (size_t)texture->level_offset[level];
    const size_t row = origin + (size_t)y * stride;
    for (int x = first; x < width + texture->padding - lead; x = next_padding(x, width)) {
        const int source = padding_source(x, width, texture->wrap_u);
        const size_t to = row + (size_t)(ptrdiff_t)x;
        if (source == BORDER) {
            fill_border(texture, to, 1);
        } else {
            copy_texels(texture, to, row + (size_t)source, 1);
        }
    }
    for (int below = lead ? -lead : height; below < height + texture->padding - lead;
         below = next_padding(below, height)) {
        const int source = padding_source(below, height, texture->wrap_v);
        const size_t to = origin - (size_t)lead + (size_t)(ptrdiff_t)below * stride;
        if (source == BORDER && y == 0) {
            fill_border(texture, to, stride);
        } else if (source == y) {
            copy_texels(texture, to, row - (size_t)lead, stride);
        }
    }
}
