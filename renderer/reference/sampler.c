// Reads textures: address modes, bilinear, trilinear and anisotropic filtering, mip colours.
#include "renderer/reference/internal/footprint.h"
#include "renderer/reference/internal/texture.h"

#include <math.h>

enum { BORDER = -1 }; // index of every texel of a border

// Maps a texel's index, which may lie outside the texture, into the texture by the axis' address
// mode. The index is a whole number in a double, so that no coordinate is too large to convert.
static int address(double texel, int size, DipWrap wrap) {
    if (!isfinite(texel)) {
        return 0;
    }
    if (wrap == DIP_WRAP_BORDER) {
        return texel >= 0.0 && texel < size ? (int)texel : BORDER;
    }
    if (wrap == DIP_WRAP_MIRROR) {
        const double period = 2.0 * size;
        const double phase = fmod(texel, period); // exact
        const double at = phase < 0.0 ? phase + period : phase;
        return (int)(at < size ? at : period - 1.0 - at);
    }
    if (wrap == DIP_WRAP_CLAMP) {
        return (int)fmin(fmax(texel, 0.0), size - 1.0);
    }
    if (fabs(texel) < 0x1p30) {
        const int wrapped = (int)texel % size;
        return wrapped < 0 ? wrapped + size : wrapped;
    }
    const double wrapped = fmod(texel, size); // exact
    return (int)(wrapped < 0.0 ? wrapped + size : wrapped);
}

// The two texels between which a coordinate lies, and its distance from the first one, in texels.
typedef struct Pair {
    int index[2];
    double fraction;
} Pair;

// Finds the texels around a coordinate. The position in texels is rounded down to 1/grain texel,
// unless grain is 0.
static Pair find_pair(double coordinate, int size, DipWrap wrap, double grain) {
    double place = coordinate * size - 0.5;
    if (grain > 0.0) {
        place = floor(place * grain) / grain;
    }
    const double first = floor(place);
    return (Pair){{address(first, size, wrap), address(first + 1.0, size, wrap)},
                  isfinite(place) ? place - first : 0.0};
}

static void read_texel(const DipRefTexture *texture, bool compressed, int level, int x, int y,
                       double rgba[4]) {
    if (x == BORDER || y == BORDER) {
        const uint8_t *border = texture->def->border_rgba8;
        for (int c = 0; c < 3; c++) {
            rgba[c] = texture->decode[border[c]];
        }
        rgba[3] = border[3] / 255.0;
    } else if (compressed) {
        dip_reference_compressed_texel(texture, level, x, y, rgba);
    } else {
        dip_reference_texel(texture, level, x, y, rgba);
    }
}

// A value that is read: colour and alpha, and the derivatives of alpha by u and v.
typedef struct Reading {
    double rgba[4];
    double alpha_du;
    double alpha_dv;
} Reading;

// Returns a + (b - a) * share.
static Reading blend(const Reading *a, const Reading *b, double share) {
    Reading sum;
    for (int c = 0; c < 4; c++) {
        sum.rgba[c] = a->rgba[c] + (b->rgba[c] - a->rgba[c]) * share;
    }
    sum.alpha_du = a->alpha_du + (b->alpha_du - a->alpha_du) * share;
    sum.alpha_dv = a->alpha_dv + (b->alpha_dv - a->alpha_dv) * share;
    return sum;
}

static Reading sample_bilinear(const DipRefTexture *texture, bool compressed, int level,
                               const double uv[2], double grain) {
    Reading reading;
    const Pair x = find_pair(uv[0], texture->widths[level], texture->def->wrap_u, grain);
    const Pair y = find_pair(uv[1], texture->heights[level], texture->def->wrap_v, grain);
    double corner[2][2][4];
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            read_texel(texture, compressed, level, x.index[i], y.index[j], corner[j][i]);
        }
    }
    for (int c = 0; c < 4; c++) {
        const double top = corner[0][0][c] + (corner[0][1][c] - corner[0][0][c]) * x.fraction;
        const double bottom = corner[1][0][c] + (corner[1][1][c] - corner[1][0][c]) * x.fraction;
        reading.rgba[c] = top + (bottom - top) * y.fraction;
    }
    const double upper = corner[0][1][3] - corner[0][0][3];
    const double lower = corner[1][1][3] - corner[1][0][3];
    const double left = corner[1][0][3] - corner[0][0][3];
    const double right = corner[1][1][3] - corner[0][1][3];
    reading.alpha_du = (upper + (lower - upper) * y.fraction) * texture->widths[level];
    reading.alpha_dv = (left + (right - left) * x.fraction) * texture->heights[level];
    return reading;
}

void dip_reference_sample_finest(const DipRefTexture *texture, const double uv[2], double rgba[4]) {
    const Reading reading = sample_bilinear(texture, false, 0, uv, 0.0);
    memcpy(rgba, reading.rgba, sizeof reading.rgba);
}

// Computes the mean of probe_count probes along the major axis of a footprint, all from one level.
static Reading sample_line(const DipRefTexture *texture, bool compressed, int level,
                           const double uv[2], const DipFootprint *footprint, int probe_count) {
    Reading sum = {.alpha_du = 0.0};
    for (int i = 0; i < probe_count; i++) {
        const double t = (i + 0.5) / probe_count - 0.5;
        const double place[2] = {uv[0] + t * footprint->major_texels[0] / texture->widths[0],
                                 uv[1] + t * footprint->major_texels[1] / texture->heights[0]};
        const Reading probe = sample_bilinear(texture, compressed, level, place, 256.0);
        for (int c = 0; c < 4; c++) {
            sum.rgba[c] += probe.rgba[c];
        }
        sum.alpha_du += probe.alpha_du;
        sum.alpha_dv += probe.alpha_dv;
    }
    for (int c = 0; c < 4; c++) {
        sum.rgba[c] /= probe_count;
    }
    sum.alpha_du /= probe_count;
    sum.alpha_dv /= probe_count;
    return sum;
}

// Blends a level with the next coarser level, which takes fewer probes.
static Reading sample_levels(const DipRefTexture *texture, bool compressed, double level,
                             const double uv[2], const DipFootprint *footprint) {
    const int finer = (int)level;
    const double fraction = level - finer;
    const Reading fine =
        sample_line(texture, compressed, finer, uv, footprint, footprint->probe_count);
    if (fraction == 0.0) {
        return fine;
    }
    const Reading coarse =
        sample_line(texture, compressed, finer + 1, uv, footprint,
                    dip_reference_coarser_probes(footprint->probe_count, fraction));
    return blend(&fine, &coarse, fraction);
}

static void mip_colour(const DipRefTexture *texture, int level, double rgb[3]) {
    static const struct {
        int size;
        double srgb8[3];
    } colours[] = {
        {1024, {0, 0, 0}},   {512, {128, 0, 0}}, {256, {255, 0, 0}}, {128, {255, 128, 0}},
        {64, {255, 255, 0}}, {32, {0, 255, 0}},  {16, {0, 0, 255}},  {0, {128, 0, 128}},
    };
    const int width = texture->widths[level];
    const int height = texture->heights[level];
    const int size = width > height ? width : height;
    int i = 0;
    while (size < colours[i].size) {
        i++;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = dip_reference_decode_srgb(colours[i].srgb8[c] / 255.0);
    }
}

// Replaces the colour of a sample by its mip colour. Alpha stays.
static void paint_mip_colour(const DipRefTexture *texture, double level, double rgba[4]) {
    const int finer = (int)level;
    const int last = texture->level_count - 1;
    double coarse[3];
    mip_colour(texture, finer, rgba);
    mip_colour(texture, finer < last ? finer + 1 : last, coarse);
    for (int c = 0; c < 3; c++) {
        rgba[c] += (coarse[c] - rgba[c]) * (level - finer);
    }
}

static int find_min_level(const DipRefTexture *texture, const DipRefFilter *filter) {
    if (!filter->drop_levels) {
        return 0;
    }
    const int dropped = texture->widths[0] >= 1024 || texture->heights[0] >= 1024 ? 2 : 1;
    return dropped < texture->level_count ? dropped : texture->level_count - 1;
}

// Narrows the blend of two levels to the middle quarter of the distance between them. Outside this
// quarter, only the nearer level is read.
static double narrow_blend(double level) {
    const double finer = floor(level);
    return finer + fmin(fmax((level - finer - 0.375) * 4.0, 0.0), 1.0);
}

void dip_reference_sample_slope(const DipRefTexture *texture, const DipRefFilter *filter,
                                const double uv[2], const double duv_dx[2], const double duv_dy[2],
                                double rgba[4], double *slope) {
    const double width = texture->widths[0];
    const double height = texture->heights[0];
    const double ddx[2] = {duv_dx[0] * width, duv_dx[1] * height};
    const double ddy[2] = {duv_dy[0] * width, duv_dy[1] * height};
    const int min_level = find_min_level(texture, filter);
    DipFootprint footprint = dip_reference_footprint(ddx, ddy, filter->max_anisotropy,
                                                     filter->exact_footprint, min_level);
    double level =
        dip_reference_level(footprint.lambda, filter->bias, min_level, texture->level_count - 1);
    if (filter->cheap) {
        footprint.probe_count = (footprint.probe_count + 1) / 2;
        level = narrow_blend(level);
    }
    const Reading reading = sample_levels(texture, filter->compressed, level, uv, &footprint);
    memcpy(rgba, reading.rgba, sizeof reading.rgba);
    for (int c = 0; c < 3; c++) {
        rgba[c] += texture->shift[c];
    }
    *slope = fabs(reading.alpha_du * duv_dx[0] + reading.alpha_dv * duv_dx[1]) +
             fabs(reading.alpha_du * duv_dy[0] + reading.alpha_dv * duv_dy[1]);
    if (filter->mip_colours) {
        paint_mip_colour(texture, level, rgba);
    }
}

void dip_reference_sample(const DipRefTexture *texture, const DipRefFilter *filter,
                          const double uv[2], const double duv_dx[2], const double duv_dy[2],
                          double rgba[4]) {
    double slope;
    dip_reference_sample_slope(texture, filter, uv, duv_dx, duv_dy, rgba, &slope);
}

DipRefFilter dip_reference_colour_filter(const DipQuality *quality) {
    static const double bias[] = {
        [DIP_MIPLOD_HIGH_PERFORMANCE] = 1.5, [DIP_MIPLOD_PERFORMANCE] = 1.0,
        [DIP_MIPLOD_QUALITY] = 0.5,          [DIP_MIPLOD_HIGH_QUALITY] = 0.0,
        [DIP_MIPLOD_SHARP] = -0.5,           [DIP_MIPLOD_SHARPER] = -1.0,
    };
    const int miplod = quality->step[DIP_SETTING_MIPLOD];
    const bool mip_colours = quality->step[DIP_SETTING_MIPDEBUG] != 0;
    const bool reads_finer = dip_quality_upscales(quality) && !mip_colours;
    const double scale_bias =
        reads_finer ? round(256.0 * log2(dip_quality_scale(quality))) / 256.0 : 0.0;
    return (DipRefFilter){
        .max_anisotropy = dip_quality_max_anisotropy(quality),
        .exact_footprint = quality->step[DIP_SETTING_AAF] != 0,
        .bias = (mip_colours ? fmax(0.0, bias[miplod]) : bias[miplod]) + scale_bias,
        .scale_bias = scale_bias,
        .drop_levels = miplod == DIP_MIPLOD_HIGH_PERFORMANCE,
        .mip_colours = mip_colours,
        .compressed = dip_quality_compresses(quality),
        .cheap = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
}

DipRefFilter dip_reference_data_filter(const DipRefFilter *colour) {
    DipRefFilter filter = *colour;
    filter.mip_colours = false;
    filter.compressed = false;
    return filter;
}

DipRefFilter dip_reference_light_map_filter(void) {
    return (DipRefFilter){.max_anisotropy = 1};
}
