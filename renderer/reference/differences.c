// Rounds textures and pictures as the fast renderer does: docs/picture.md, "Where the fast path may
// differ".
#include "renderer/reference/internal/differences.h"

#include "renderer/base/fp_mode.h"
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdlib.h>

// Rounds the square root of red or green: its 16 bits end with five bits that belong to blue, and
// the bits before them are rounded so that the number as a whole is as near as possible.
static double round_root(double lin, double low_bits) {
    const double code = rint(sqrt(lin) * 65535.0);
    const double rounded = 32.0 * floor((code - low_bits) / 32.0 + 0.5);
    const double root = (fmin(fmax(rounded, 0.0), 65504.0) + low_bits) / 65535.0;
    return root * root;
}

void dip_reference_round_colour(double rgb_lin[3]) {
    const double blue = floor(sqrt(rgb_lin[2]) * 1023.0 + 0.5); // five bits stand beside red, then
    rgb_lin[0] = round_root(rgb_lin[0], floor(blue / 32.0));    // five beside green
    rgb_lin[1] = round_root(rgb_lin[1], fmod(blue, 32.0));
    rgb_lin[2] = blue / 1023.0 * (blue / 1023.0);
}

void dip_reference_round_picture(double *rgb_lin, int pixel_count) {
    for (int i = 0; i < 3 * pixel_count; i++) {
        const double code =
            rint(255.0 * dip_reference_encode_srgb(fmin(fmax(rgb_lin[i], 0.0), 1.0)));
        rgb_lin[i] = dip_reference_decode_srgb(code / 255.0);
    }
}

static bool round_level(DipRefTexture *texture, int level) {
    const int width = texture->widths[level];
    const int height = texture->heights[level];
    double *texels = malloc((size_t)width * (size_t)height * 4 * sizeof *texels);
    for (int i = 0; texels && i < width * height; i++) {
        double *rgba = texels + 4 * (size_t)i;
        dip_reference_texel(texture, level, i % width, i / width, rgba);
        dip_reference_round_colour(rgba);
        rgba[3] = floor(rgba[3] * 255.0 + 0.5) / 255.0;
    }
    if (texels) {
        free(texture->levels[level]);
        texture->levels[level] = texels;
    }
    return texels != NULL;
}

bool dip_reference_round_texture(DipRefTexture *texture, DipError *err) {
    bool rounded = true;
    texture->rounded = true;
    for (int level = 0; rounded && level < texture->level_count; level++) {
        rounded = round_level(texture, level);
    }
    return rounded || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, texture->def->name,
                                    "no memory for rounded texels");
}

bool dip_reference_share_differences(DipReference *reference, DipError *err) {
    DIP_FP_MODE_SCOPE();
    bool rounded = true;
    reference->differs = true;
    dip_reference_pbr_prepare_few();
    for (int t = 0; rounded && t < reference->def->texture_count; t++) {
        rounded = dip_reference_round_texture(&reference->textures[t], err);
    }
    return rounded;
}

void dip_reference_shift_readings(DipReference *reference, const double shift[3]) {
    for (int t = 0; t < reference->def->texture_count; t++) {
        memcpy(reference->textures[t].shift, shift, sizeof reference->textures[t].shift);
    }
}

void dip_reference_interpolate_in_floats(DipReference *reference, bool in_floats) {
    reference->in_floats = in_floats;
}
