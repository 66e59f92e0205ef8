// Building textures: decode, mip chain, pack, pad.
#include "renderer/texture/texture.h"

#include "renderer/base/assert.h"
#include "renderer/texture/mip.h"
#include "renderer/texture/srgb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TEXTURE_SIZE = 8192 };

enum { FULL_CODE16 = 65535, FULL_CODE10 = 1023 };

static uint32_t quantise(double linear, int max) {
    const double clamped = linear > 0.0 ? (linear < 1.0 ? linear : 1.0) : 0.0;
    return (uint32_t)(sqrt(clamped) * max + 0.5);
}

// The multiple of 32 that comes closest to a 16-bit code with `low` added.
static uint32_t beside(uint32_t code16, uint32_t low) {
    const uint32_t at = code16 + 16 < low ? 0 : (code16 + 16 - low) & ~31u;
    return at > 65504 ? 65504 : at;
}

// From 16-bit codes of red and green and blue's of 10 bits.
static uint32_t join_codes(uint32_t red16, uint32_t green16, uint32_t blue10) {
    const uint32_t high = blue10 >> 5;
    const uint32_t low = blue10 & 31;
    return (beside(red16, high) | high) << 16 | beside(green16, low) | low;
}

uint32_t dip_texel_pack(const double rgb_lin[3]) {
    return join_codes(quantise(rgb_lin[0], FULL_CODE16), quantise(rgb_lin[1], FULL_CODE16),
                      quantise(rgb_lin[2], FULL_CODE10));
}

static bool check_def(const DipTextureDef *def, DipError *err) {
    if (def->width < 1 || def->height < 1 || def->width > MAX_TEXTURE_SIZE ||
        def->height > MAX_TEXTURE_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, def->name, 0, "texture",
                             "%dx%d texels, accepted 1x1 to %dx%d", def->width, def->height,
                             MAX_TEXTURE_SIZE, MAX_TEXTURE_SIZE);
    }
    return true;
}

static bool has_alpha(const DipTextureDef *def) {
    const size_t count = (size_t)def->width * (size_t)def->height;
    for (size_t i = 0; i < count; i++) {
        if (def->rgba8[4 * i + 3] != 255) {
            return true;
        }
    }
    return false;
}

static bool repeats(const DipTextureDef *def) {
    return def->wrap_u == DIP_WRAP_REPEAT && def->wrap_v == DIP_WRAP_REPEAT;
}

static int floor_log2(int size) {
    return 31 - __builtin_clz((unsigned)size);
}

static bool is_power_of_two(int size) {
    return (size & (size - 1)) == 0;
}

// Appends a level's place to the table and returns the texels it takes.
static size_t place_level(DipTexture *texture, int level, int width, int height, size_t offset) {
    texture->level_width[level] = width;
    texture->level_height[level] = height;
    texture->level_offset[level] = (int32_t)offset;
    texture->level_log2_width[level] = floor_log2(width);
    texture->level_log2_height[level] = floor_log2(height);
    texture->wraps_in_bits =
        texture->wraps_in_bits && is_power_of_two(width) && is_power_of_two(height);
    return (size_t)(width + 1) * (size_t)(height + 1);
}

static void place_chain(DipTexture *texture) {
    int width = texture->width;
    int height = texture->height;
    for (;;) {
        texture->texel_count +=
            place_level(texture, texture->level_count++, width, height, texture->texel_count);
        if (width == 1 && height == 1) {
            return;
        }
        width = dip_mip_next_size(width);
        height = dip_mip_next_size(height);
    }
}

// Reads past the end by one vector element stay inside: 8 spare texels, 32 spare bytes of alpha.
static bool allocate_texels(DipTexture *texture, bool with_alpha) {
    texture->texels = malloc((texture->texel_count + 8) * sizeof *texture->texels);
    if (with_alpha) {
        texture->alpha = calloc(texture->texel_count + 32, 1);
    }
    return texture->texels && (texture->alpha || !with_alpha);
}

// What each of the 256 codes of a texture means: light for the filter, and the packed texel's
// parts.
typedef struct CodeTables {
    float colour[256];
    float alpha[256];
    uint32_t code16[256];
    uint32_t code10[256];
} CodeTables;

static void fill_code_tables(CodeTables *tables, DipEncoding encoding) {
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    for (int i = 0; i < 256; i++) {
        tables->alpha[i] = (float)(i / 255.0);
        tables->colour[i] =
            encoding == DIP_ENCODING_SRGB ? (float)srgb.linear[i] : tables->alpha[i];
        const double light = tables->colour[i];
        tables->code16[i] = quantise(light, FULL_CODE16);
        tables->code10[i] = quantise(light, FULL_CODE10);
    }
}

static void decode_level(const DipTextureDef *def, const CodeTables *tables, float *rgba) {
    const size_t count = (size_t)def->width * (size_t)def->height;
    for (size_t i = 0; i < 4 * count; i += 4) {
        for (size_t c = 0; c < 3; c++) {
            rgba[i + c] = tables->colour[def->rgba8[i + c]];
        }
        rgba[i + 3] = tables->alpha[def->rgba8[i + 3]];
    }
}

// The padding's column or row repeats the first or the last of the level.
static int padding_source(int i, int size, DipWrap wrap) {
    return i < size ? i : wrap == DIP_WRAP_REPEAT ? 0 : size - 1;
}

// Packs a picture's own texels, code by code.
static void pack_codes(DipTexture *texture, int level, const DipTextureDef *def,
                       const CodeTables *tables) {
    uint32_t *texels = texture->texels + texture->level_offset[level];
    uint8_t *alpha = texture->alpha ? texture->alpha + texture->level_offset[level] : NULL;
    for (int y = 0; y <= def->height; y++) {
        const uint8_t *row = def->rgba8 + (size_t)padding_source(y, def->height, texture->wrap_v) *
                                              (size_t)def->width * 4;
        for (int x = 0; x <= def->width; x++) {
            const uint8_t *code = row + (size_t)padding_source(x, def->width, texture->wrap_u) * 4;
            *texels++ = join_codes(tables->code16[code[0]], tables->code16[code[1]],
                                   tables->code10[code[2]]);
            if (alpha) {
                *alpha++ = code[3];
            }
        }
    }
}

// Packs a filtered level.
static void pack_level(DipTexture *texture, int level, const float *rgba) {
    const int width = texture->level_width[level];
    const int height = texture->level_height[level];
    const size_t base = (size_t)texture->level_offset[level];
    for (int y = 0; y <= height; y++) {
        const size_t row = (size_t)padding_source(y, height, texture->wrap_v) * (size_t)width;
        const size_t out = base + (size_t)y * (size_t)(width + 1);
        for (int x = 0; x <= width; x++) {
            const float *texel =
                rgba + 4 * (row + (size_t)padding_source(x, width, texture->wrap_u));
            const double rgb[3] = {texel[0], texel[1], texel[2]};
            texture->texels[out + (size_t)x] = dip_texel_pack(rgb);
            if (texture->alpha) {
                texture->alpha[out + (size_t)x] = (uint8_t)(texel[3] * 255.0f + 0.5f);
            }
        }
    }
}

// Packs level 0 and halves it until the chain ends, with two levels in memory at a time.
static bool build_chain(DipTexture *texture, const DipTextureDef *def) {
    const size_t texels = (size_t)def->width * (size_t)def->height;
    DipMipLevel from = {def->width, def->height, malloc(texels * 4 * sizeof(float))};
    DipMipLevel to = {0, 0, malloc((texels / 2 + 1) * 4 * sizeof(float))};
    const bool allocated = from.rgba && to.rgba;
    if (allocated) {
        CodeTables tables;
        fill_code_tables(&tables, def->encoding);
        decode_level(def, &tables, from.rgba);
        pack_codes(texture, 0, def, &tables);
    }
    for (int level = 1; allocated && level < texture->level_count; level++) {
        to.width = texture->level_width[level];
        to.height = texture->level_height[level];
        dip_mip_halve(&from, &to);
        pack_level(texture, level, to.rgba);
        const DipMipLevel swap = from;
        from = to;
        to = swap;
    }
    free(from.rgba);
    free(to.rgba);
    return allocated;
}

static DipTexture *out_of_memory(DipTexture *texture, const char *name, DipError *err) {
    dip_texture_destroy(&texture);
    dip_error_set(err, DIP_ERROR_MEMORY, name, 0, "texture", "out of memory");
    return NULL;
}

DipTexture *dip_texture_create(const DipTextureDef *def, DipError *err) {
    if (!check_def(def, err)) {
        return NULL;
    }
    DipTexture *texture = calloc(1, sizeof *texture);
    if (!texture) {
        return out_of_memory(NULL, def->name, err);
    }
    texture->width = def->width;
    texture->height = def->height;
    texture->wrap_u = def->wrap_u;
    texture->wrap_v = def->wrap_v;
    texture->wraps_in_bits = repeats(def);
    place_chain(texture);
    if (!allocate_texels(texture, has_alpha(def)) || !build_chain(texture, def)) {
        return out_of_memory(texture, def->name, err);
    }
    return texture;
}

DipTexture *dip_texture_create_from_levels(const DipTextureDef *levels, int level_count,
                                           DipError *err) {
    DIP_ASSERT(level_count >= 1 && level_count <= DIP_MAX_LEVELS);
    DipTexture *texture = calloc(1, sizeof *texture);
    if (!texture) {
        return out_of_memory(NULL, levels[0].name, err);
    }
    texture->width = levels[0].width;
    texture->height = levels[0].height;
    texture->wrap_u = levels[0].wrap_u;
    texture->wrap_v = levels[0].wrap_v;
    texture->wraps_in_bits = repeats(&levels[0]);
    texture->level_count = level_count;
    for (int i = 0; i < level_count; i++) {
        if (!check_def(&levels[i], err)) {
            dip_texture_destroy(&texture);
            return NULL;
        }
        texture->texel_count +=
            place_level(texture, i, levels[i].width, levels[i].height, texture->texel_count);
    }
    if (!allocate_texels(texture, false)) {
        return out_of_memory(texture, levels[0].name, err);
    }
    for (int i = 0; i < level_count; i++) {
        CodeTables tables;
        fill_code_tables(&tables, levels[i].encoding);
        pack_codes(texture, i, &levels[i], &tables);
    }
    return texture;
}

void dip_texture_destroy(DipTexture **texture) {
    if (*texture) {
        free((*texture)->texels);
        free((*texture)->alpha);
        free(*texture);
        *texture = NULL;
    }
}
