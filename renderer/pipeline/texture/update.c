// Reads textures back and updates them.
#include "renderer/pipeline/texture/texture_layout.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/bc1.h"

#include <stdlib.h>
#include <string.h>

// Fills codes[0..last], whose index is a square root of linear light, with the nearest 8-bit values
// of linear light.
static void fill_linear_codes(uint8_t *codes, int last) {
    for (int i = 0; i <= last; i++) {
        const double root = i / (double)last;
        codes[i] = (uint8_t)(root * root * 255.0 + 0.5);
    }
}

static void fill_codes(DipRootCodes *codes, DipEncoding encoding) {
    if (encoding == DIP_ENCODING_SRGB) {
        dip_root_codes_fill(codes);
    } else {
        fill_linear_codes(codes->of16, 65535);
        fill_linear_codes(codes->of10, 1023);
    }
}

static void read_level(const DipTexture *texture, int level, const DipRootCodes *codes,
                       uint8_t *rgba8) {
    for (int y = 0; y < texture->level_height[level]; y++) {
        const size_t row =
            (size_t)texture->level_offset[level] + (size_t)y * dip_texture_stride(texture, level);
        for (int x = 0; x < texture->level_width[level]; x++, rgba8 += 4) {
            dip_root_codes_read(codes, texture->texels[row + (size_t)x].here, rgba8);
            rgba8[3] = texture->alpha ? texture->alpha[row + (size_t)x].here : 255;
        }
    }
}

bool dip_texture_read(const DipTexture *texture, int level, DipEncoding encoding, uint8_t *rgba8,
                      DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (level < 0 || level >= texture->level_count) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "level", "%d, accepted 0..%d", level,
                             texture->level_count - 1);
    }
    if ((unsigned)encoding > DIP_ENCODING_LINEAR) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "encoding", "%d, accepted 0..%d",
                             (int)encoding, DIP_ENCODING_LINEAR);
    }
    DipRootCodes *codes = malloc(sizeof *codes);
    if (!codes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "texture", "out of memory");
    }
    fill_codes(codes, encoding);
    read_level(texture, level, codes, rgba8);
    free(codes);
    return true;
}

static bool check_update(const DipTexture *texture, const DipTextureUpdate *update, DipError *err) {
    if (texture->stored_levels || texture->shares_alpha) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "texture",
                             "a texture with %s levels",
                             texture->stored_levels ? "stored" : "compressed");
    }
    if (!update->rgba8) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "rgba8", "NULL");
    }
    if (update->x < 0 || update->y < 0 || update->width < 1 || update->height < 1 ||
        update->width > texture->width - update->x ||
        update->height > texture->height - update->y) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "width",
                             "%dx%d texels at (%d, %d), accepted a rectangle in %dx%d texels",
                             update->width, update->height, update->x, update->y, texture->width,
                             texture->height);
    }
    if (update->stride_bytes < (size_t)update->width * 4) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "stride_bytes",
                             "%zu, accepted at least %zu", update->stride_bytes,
                             (size_t)update->width * 4);
    }
    return true;
}

bool dip_texture_update(DipTexture *texture, const DipTextureUpdate *update, DipPool *pool,
                        DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!check_update(texture, update, err)) {
        return false;
    }
    const size_t stride = (size_t)texture->width * 4;
    uint8_t *rgba8 = malloc(stride * (size_t)texture->height);
    if (!rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "texture", "out of memory");
    }
    const bool whole = update->width == texture->width && update->height == texture->height;
    bool made = whole || dip_texture_read(texture, 0, texture->encoding, rgba8, err);
    if (made) {
        for (int y = 0; y < update->height; y++) {
            memcpy(rgba8 + (size_t)(update->y + y) * stride + (size_t)update->x * 4,
                   update->rgba8 + (size_t)y * update->stride_bytes, (size_t)update->width * 4);
        }
        const DipTextureDef def = {.width = texture->width,
                                   .height = texture->height,
                                   .rgba8 = rgba8,
                                   .encoding = texture->encoding,
                                   .wrap_u = texture->wrap_u,
                                   .wrap_v = texture->wrap_v};
        made = dip_texture_rebuild(texture, &def, pool, err);
    }
    free(rgba8);
    return made;
}
