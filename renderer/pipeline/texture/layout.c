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
    texture->texel_count += stride * (size_t)(height + texture->padding - 1);
}

// The quad of zeroes takes two pairs.
enum { SPARE_PAIRS = 2 };

DipAlphaPair *dip_texture_allocate_alpha(const DipTexture *texture) {
    return calloc(texture->texel_count + SPARE_PAIRS, sizeof *texture->alpha);
}

bool dip_texture_allocate(DipTexture *texture) {
    const size_t count = texture->texel_count;
    texture->texels = dip_pages_alloc((count + SPARE_PAIRS) * sizeof *texture->texels);
    if (texture->texels) {
        memset(texture->texels + count, 0, SPARE_PAIRS * sizeof *texture->texels);
    }
    return texture->texels != NULL;
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

// Returns the index of a row's first column, padding included.
static size_t row_start(const DipTexture *texture, int level, int y) {
    const ptrdiff_t stride = (ptrdiff_t)dip_texture_stride(texture, level);
    return (size_t)(texture->level_offset[level] - leading_padding(texture) + y * stride);
}

// Padding columns (or rows) have the indices -leading_padding .. -1 and size .. last. This function
// returns the first one.
static int first_padding(const DipTexture *texture, int size) {
    return leading_padding(texture) ? -leading_padding(texture) : size;
}

static int next_padding(int i, int size) {
    return i == -1 ? size : i + 1;
}

// Returns the last padding column (or row).
static int last_padding(const DipTexture *texture, int size) {
    return size + texture->padding - leading_padding(texture) - 1;
}

// Sets `count` texels to the border's colour.
static void fill_border(DipTexture *texture, size_t to, size_t count) {
    for (size_t i = to; i < to + count; i++) {
        texture->texels[i].here = texture->border;
    }
    for (size_t i = to; texture->alpha && i < to + count; i++) {
        texture->alpha[i].here = texture->border_alpha;
    }
}

static void copy_texels(DipTexture *texture, size_t to, size_t from, size_t count) {
    for (size_t i = 0; i < count; i++) {
        texture->texels[to + i].here = texture->texels[from + i].here;
    }
    for (size_t i = 0; texture->alpha && i < count; i++) {
        texture->alpha[to + i].here = texture->alpha[from + i].here;
    }
}

// Enters `count` texels below the texels of another row.
static void copy_below(DipTexture *texture, size_t to, size_t from, size_t count) {
    for (size_t i = 0; i < count; i++) {
        texture->texels[to + i].below = texture->texels[from + i].here;
    }
    for (size_t i = 0; texture->alpha && i < count; i++) {
        texture->alpha[to + i].below = texture->alpha[from + i].here;
    }
}

static void pad_columns(DipTexture *texture, int level, int y) {
    const int width = texture->level_width[level];
    const size_t row = row_start(texture, level, y) + (size_t)leading_padding(texture);
    const int last = last_padding(texture, width);
    for (int x = first_padding(texture, width); x <= last; x = next_padding(x, width)) {
        const int source = padding_source(x, width, texture->wrap_u);
        const size_t to = row + (size_t)(ptrdiff_t)x;
        if (source == BORDER) {
            fill_border(texture, to, 1);
        } else {
            copy_texels(texture, to, row + (size_t)source, 1);
        }
    }
}

// Gives row `to` of a level the texels of row `from`, which may be the same row: as its own texels,
// if they are stored, and as the texels below those of the row above it, if there is one.
static void place_row(DipTexture *texture, int level, int to, int from) {
    const size_t stride = dip_texture_stride(texture, level);
    const size_t source = row_start(texture, level, from);
    const size_t row = row_start(texture, level, to);
    if (to != from && to != last_padding(texture, texture->level_height[level])) {
        copy_texels(texture, row, source, stride);
    }
    if (to > -leading_padding(texture)) {
        copy_below(texture, row - stride, source, stride);
    }
}

void dip_texture_finish_row(DipTexture *texture, int level, int y) {
    const int height = texture->level_height[level];
    const int last = last_padding(texture, height);
    pad_columns(texture, level, y);
    place_row(texture, level, y, y);
    for (int to = first_padding(texture, height); to <= last; to = next_padding(to, height)) {
        const int source = padding_source(to, height, texture->wrap_v);
        if (source == y) {
            place_row(texture, level, to, y);
        } else if (source == BORDER && y == 0) {
            // The first row with the border's colour is row -1.
            if (to == -1) {
                fill_border(texture, row_start(texture, level, to),
                            dip_texture_stride(texture, level));
            }
            place_row(texture, level, to, -1);
        }
    }
}
