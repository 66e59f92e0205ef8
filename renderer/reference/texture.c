// Decodes sRGB and builds mip chains with exact area weights.
#include "renderer/reference/internal/texture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double dip_reference_decode_srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

double dip_reference_encode_srgb(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

// Computes the mean of a level's texels over a box, whose corners from and to are in texels. Each
// texel has the weight of the part of it that the box covers.
static void average_box(const DipRefTexture *texture, int level, const double from[2],
                        const double to[2], double rgba[4]) {
    double sum[4] = {0};
    for (int y = (int)floor(from[1]); y < to[1]; y++) {
        const double weight_y = fmin(y + 1.0, to[1]) - fmax(y, from[1]);
        for (int x = (int)floor(from[0]); x < to[0]; x++) {
            const double weight = weight_y * (fmin(x + 1.0, to[0]) - fmax(x, from[0]));
            double texel[4];
            dip_reference_texel(texture, level, x, y, texel);
            for (int c = 0; c < 4; c++) {
                sum[c] += weight * texel[c];
            }
        }
    }
    const double area = (to[0] - from[0]) * (to[1] - from[1]);
    for (int c = 0; c < 4; c++) {
        rgba[c] = sum[c] / area;
    }
}

static void fill_level(DipRefTexture *texture, int level) {
    const int width = texture->widths[level];
    const int height = texture->heights[level];
    const int finer_width = texture->widths[level - 1];
    const int finer_height = texture->heights[level - 1];
    double *texel = texture->levels[level];
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++, texel += 4) {
            // x * finer_width / width is exact where it is a whole number, so even sizes average
            // whole texels.
            const double from[2] = {(double)x * finer_width / width,
                                    (double)y * finer_height / height};
            const double to[2] = {(x + 1.0) * finer_width / width,
                                  (y + 1.0) * finer_height / height};
            average_box(texture, level - 1, from, to, texel);
        }
    }
}

bool dip_reference_texture_init(DipRefTexture *texture, const DipTextureDef *def, int most_levels,
                                DipError *err) {
    memset(texture, 0, sizeof *texture);
    texture->def = def;
    if (!def->rgba8 || def->width < 1 || def->width > 8192 || def->height < 1 ||
        def->height > 8192) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, def->name,
                             "a texture of %dx%d is invalid: it needs texels, and its width and "
                             "height must be 1..8192",
                             def->width, def->height);
    }
    for (int i = 0; i < 256; i++) {
        const double code = i / 255.0;
        texture->decode[i] =
            def->encoding == DIP_ENCODING_SRGB ? dip_reference_decode_srgb(code) : code;
    }
    texture->widths[0] = def->width;
    texture->heights[0] = def->height;
    texture->level_count = 1;
    for (int l = 1; l < most_levels && ((def->width >> l) > 0 || (def->height >> l) > 0); l++) {
        texture->widths[l] = def->width >> l > 1 ? def->width >> l : 1;
        texture->heights[l] = def->height >> l > 1 ? def->height >> l : 1;
        const size_t texels = (size_t)texture->widths[l] * (size_t)texture->heights[l];
        texture->levels[l] = malloc(texels * 4 * sizeof(double));
        if (!texture->levels[l]) {
            dip_reference_texture_free(texture);
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, def->name,
                                 "no memory for its mip chain");
        }
        texture->level_count = l + 1;
        fill_level(texture, l);
    }
    return true;
}

void dip_reference_texture_free(DipRefTexture *texture) {
    for (int l = 0; l < DIP_REF_MAX_LEVELS; l++) {
        free(texture->levels[l]);
        texture->levels[l] = NULL;
        free(texture->blocks[l]);
        texture->blocks[l] = NULL;
    }
    texture->level_count = 0;
}
