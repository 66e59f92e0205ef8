// Computes FLIP version 1.6 in the paper's steps: opponent colours, contrast sensitivity, CIELab
// with Hunt's effect, HyAB distance, edges and points, error.
#include "app/measure/metrics/flip.h"

#include "app/measure/metrics/internal/filters.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/srgb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// White point D65 in XYZ, the reference white of both the opponent colours and CIELab.
static const float white[3] = {0.950428545f, 1.0f, 1.088900371f};

// The matrix that takes linear sRGB to XYZ. It follows from sRGB's primaries and D65; its entries
// are exact fractions.
static const float rgb_to_xyz[3][3] = {
    {(float)(10135552.0 / 24577794.0), (float)(8788810.0 / 24577794.0),
     (float)(4435075.0 / 24577794.0)},
    {(float)(2613072.0 / 12288897.0), (float)(8788810.0 / 12288897.0),
     (float)(887015.0 / 12288897.0)},
    {(float)(1425312.0 / 73733382.0), (float)(8788810.0 / 73733382.0),
     (float)(70074185.0 / 73733382.0)}};

// Planes of a DipFlipAnalysis.
enum {
    PLANE_L,
    PLANE_A,
    PLANE_B,
    PLANE_EDGE_X,
    PLANE_EDGE_Y,
    PLANE_POINT_X,
    PLANE_POINT_Y,
    PLANE_COUNT
};

// --- memory ------------------------------------------------------------------------------------

// The scratch memory holds, for one block with its margin, six planes for filtering, the planes
// of the analysis, and then one padded row.
enum { SCRATCH_PLANES = 6 + PLANE_COUNT };

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// block_width returns the width in pixels of the largest block with its margin, and block_size
// returns the number of its pixels.
static size_t block_width(const DipFlip *flip) {
    return (size_t)smaller(flip->width, DIP_PICTURE_BLOCK + 2 * flip->reach_px);
}

static size_t block_size(const DipFlip *flip) {
    return block_width(flip) *
           (size_t)smaller(flip->height, DIP_PICTURE_BLOCK + 2 * flip->reach_px);
}

static int reach_px(const DipFlipKernels *k) {
    const int radii[] = {k->luma.radius,  k->red_green.radius, k->blue[0].radius, k->blue[1].radius,
                         k->gauss.radius, k->edge.radius,      k->point.radius};
    int reach = 0;
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        reach = radii[i] > reach ? radii[i] : reach;
    }
    return reach;
}

bool dip_flip_init(DipFlip *flip, int width, int height, double pixels_per_degree) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(pixels_per_degree);
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    *flip = (DipFlip){.width = width, .height = height};
    // Comparisons with NaN are false. More pixels per degree need longer kernels than there is room
    // for.
    if (width < 1 || height < 1 ||
        !(pixels_per_degree >= DIP_FLIP_MIN_PIXELS_PER_DEGREE &&
          pixels_per_degree <= DIP_FLIP_MAX_PIXELS_PER_DEGREE)) {
        return false;
    }
    flip->kernels = malloc(sizeof *flip->kernels);
    if (!flip->kernels) {
        return false;
    }
    *flip->kernels = dip_flip_kernels(pixels_per_degree);
    flip->reach_px = reach_px(flip->kernels);
    for (int i = 0; i < 256; i++) {
        flip->light[i] = (float)srgb.linear[i];
    }
    const size_t padded = block_width(flip) + 2 * DIP_KERNEL_MAX_RADIUS;
    flip->scratch = malloc((SCRATCH_PLANES * block_size(flip) + padded) * sizeof(float));
    return flip->scratch != NULL;
}

void dip_flip_free(DipFlip *flip) {
    free(flip->kernels);
    free(flip->scratch);
    flip->kernels = NULL;
    flip->scratch = NULL;
}

bool dip_flip_analysis_init(const DipFlip *flip, DipFlipAnalysis *analysis) {
    const size_t plane = (size_t)flip->width * (size_t)flip->height;
    analysis->memory = malloc(PLANE_COUNT * plane * sizeof(float));
    for (size_t i = 0; i < PLANE_COUNT; i++) {
        analysis->planes[i] = analysis->memory ? analysis->memory + i * plane : NULL;
    }
    return analysis->memory != NULL;
}

void dip_flip_analysis_free(DipFlipAnalysis *analysis) {
    free(analysis->memory);
    *analysis = (DipFlipAnalysis){0};
}

// --- analysing a picture -----------------------------------------------------------------------

// Returns row . (x, y, z).
static float multiply(const float row[3], const float v[3]) {
    return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
}

// Converts linear sRGB to the opponent colours Y, Cx, Cz.
static void to_opponent(const float rgb[3], float *luma, float *red_green, float *blue) {
    float xyz[3];
    for (int i = 0; i < 3; i++) {
        xyz[i] = multiply(rgb_to_xyz[i], rgb) / white[i];
    }
    *luma = 116.0f * xyz[1] - 16.0f;
    *red_green = 500.0f * (xyz[0] - xyz[1]);
    *blue = 200.0f * (xyz[1] - xyz[2]);
}

// Returns the value of CIELab's compressive function at x.
static float lightness(float x) {
    const float limit = 6.0f / 29.0f;
    return x > limit * limit * limit ? cbrtf(x) : x / (3.0f * limit * limit) + 4.0f / 29.0f;
}

// Converts filtered opponent colours to CIELab. The linear light of the colours is clamped to 0..1,
// since a screen shows no other values. Chroma is scaled by lightness, since dark colours look less
// colourful (Hunt's effect).
static void to_lab(float luma, float red_green, float blue, float lab[3]) {
    static const float to_rgb[3][3] = {{3.241003275f, -1.537398934f, -0.498615861f},
                                       {-0.969224334f, 1.875930071f, 0.041554224f},
                                       {0.055639423f, -0.204011202f, 1.057148933f}};
    const float y = (luma + 16.0f) / 116.0f;
    const float xyz[3] = {(y + red_green / 500.0f) * white[0], y * white[1],
                          (y - blue / 200.0f) * white[2]};
    float rgb[3], f[3];
    for (int i = 0; i < 3; i++) {
        const float value = multiply(to_rgb[i], xyz);
        rgb[i] = value < 0.0f ? 0.0f : value > 1.0f ? 1.0f : value;
    }
    for (int i = 0; i < 3; i++) {
        f[i] = lightness(multiply(rgb_to_xyz[i], rgb) / white[i]);
    }
    lab[0] = 116.0f * f[1] - 16.0f;
    lab[1] = 500.0f * (f[0] - f[1]) * (0.01f * lab[0]);
    lab[2] = 200.0f * (f[1] - f[2]) * (0.01f * lab[0]);
}

// A block that is being analysed, and its planes in the scratch memory. A plane has one value for
// each pixel of the block with its margin, rows packed.
typedef struct Block {
    DipPixelRect own;   // Without the margin.
    DipPixelRect whole; // With the margin.
    float *opponent[3];
    float *rows;
    float *other;
    float *grey;
    float *padded;
    DipFlipAnalysis out;
} Block;

static Block block_of(const DipFlip *flip, int block) {
    const size_t plane = block_size(flip);
    float *at = flip->scratch;
    Block b = {
        .own = dip_picture_block(flip->width, flip->height, block),
        .whole = dip_picture_block_with_margin(flip->width, flip->height, block, flip->reach_px),
        .opponent = {at, at + plane, at + 2 * plane},
        .rows = at + 3 * plane,
        .other = at + 4 * plane,
        .grey = at + 5 * plane,
        .padded = at + SCRATCH_PLANES * plane,
    };
    for (size_t i = 0; i < PLANE_COUNT; i++) {
        b.out.planes[i] = at + (6 + i) * plane;
    }
    return b;
}

static void filter(const Block *b, const DipKernel1D *across, const DipKernel1D *down,
                   const float *in, float *out) {
    dip_convolve_rows(across, in, b->whole.width, b->whole.height, b->padded, b->rows);
    dip_convolve_columns(down, b->rows, b->whole.width, b->whole.height, out);
}

static void analyse_colours(const DipFlipKernels *k, const Block *b) {
    float *const *lab = b->out.planes;
    filter(b, &k->luma, &k->luma, b->opponent[0], lab[0]);
    filter(b, &k->red_green, &k->red_green, b->opponent[1], lab[1]);
    filter(b, &k->blue[0], &k->blue[0], b->opponent[2], lab[2]);
    filter(b, &k->blue[1], &k->blue[1], b->opponent[2], b->other);
}

// Each feature detector is a derivative along one axis and a Gaussian along the other.
static void analyse_features(const DipFlipKernels *k, const Block *b) {
    float *const *out = b->out.planes;
    filter(b, &k->edge, &k->gauss, b->grey, out[PLANE_EDGE_X]);
    filter(b, &k->point, &k->gauss, b->grey, out[PLANE_POINT_X]);
    filter(b, &k->gauss, &k->edge, b->grey, out[PLANE_EDGE_Y]);
    dip_convolve_columns(&k->point, b->rows, b->whole.width, b->whole.height, out[PLANE_POINT_Y]);
}

// Returns the index, in a plane of the block, of the block's own first pixel (without the margin)
// in row `y` of the picture.
static size_t row_in_block(const Block *b, int y) {
    return (size_t)(y - b->whole.y) * (size_t)b->whole.width + (size_t)(b->own.x - b->whole.x);
}

// Returns the index, in a plane of the picture, of the block's own first pixel in row `y` of the
// picture.
static size_t row_in_picture(const DipFlip *flip, const Block *b, int y) {
    return (size_t)y * (size_t)flip->width + (size_t)b->own.x;
}

// Fills in the planes of the block. Converts only the block's own pixels, not those of the margin,
// to CIELab.
static void analyse(const DipFlip *flip, const DipSrgbPicture *picture, const Block *b) {
    size_t i = 0;
    for (int y = b->whole.y; y < b->whole.y + b->whole.height; y++) {
        const uint8_t *row = picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * b->whole.x;
        for (int x = 0; x < b->whole.width; x++, i++) {
            const float rgb[3] = {flip->light[row[4 * x]], flip->light[row[4 * x + 1]],
                                  flip->light[row[4 * x + 2]]};
            to_opponent(rgb, &b->opponent[0][i], &b->opponent[1][i], &b->opponent[2][i]);
            b->grey[i] = (b->opponent[0][i] + 16.0f) / 116.0f;
        }
    }
    analyse_colours(flip->kernels, b);
    analyse_features(flip->kernels, b);
    float *const *lab = b->out.planes;
    for (int y = b->own.y; y < b->own.y + b->own.height; y++) {
        i = row_in_block(b, y);
        for (const size_t end = i + (size_t)b->own.width; i < end; i++) {
            float pixel[3];
            to_lab(lab[0][i], lab[1][i], lab[2][i] + b->other[i], pixel);
            lab[0][i] = pixel[0];
            lab[1][i] = pixel[1];
            lab[2][i] = pixel[2];
        }
    }
}

void dip_flip_analyse_block(DipFlip *flip, const DipSrgbPicture *picture, int block,
                            DipFlipAnalysis *analysis) {
    DIP_FP_MODE_SCOPE();
    const Block b = block_of(flip, block);
    analyse(flip, picture, &b);
    for (int y = b.own.y; y < b.own.y + b.own.height; y++) {
        for (int i = 0; i < PLANE_COUNT; i++) {
            memcpy(analysis->planes[i] + row_in_picture(flip, &b, y),
                   b.out.planes[i] + row_in_block(&b, y), (size_t)b.own.width * sizeof(float));
        }
    }
}

void dip_flip_analyse(DipFlip *flip, const DipSrgbPicture *picture, DipFlipAnalysis *analysis) {
    const int blocks = dip_picture_block_count(flip->width, flip->height);
    for (int block = 0; block < blocks; block++) {
        dip_flip_analyse_block(flip, picture, block, analysis);
    }
}

// --- comparing ---------------------------------------------------------------------------------

static const float colour_exponent = 0.7f;
static const float feature_exponent = 0.5f;

// Returns the colour distance between green and blue, raised to colour_exponent. No two colours
// have a greater distance.
static float greatest_distance(void) {
    const float primaries[2][3] = {{0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    float lab[2][3];
    for (int i = 0; i < 2; i++) {
        float opponent[3];
        to_opponent(primaries[i], &opponent[0], &opponent[1], &opponent[2]);
        to_lab(opponent[0], opponent[1], opponent[2], lab[i]);
    }
    return powf(fabsf(lab[0][0] - lab[1][0]) + hypotf(lab[0][1] - lab[1][1], lab[0][2] - lab[1][2]),
                colour_exponent);
}

static float length(float x, float y) {
    return sqrtf(x * x + y * y);
}

// Maps the colour distance of a pixel, raised to colour_exponent, to 0..1. Values up to 0.4 times
// `greatest` map to 0..0.95, and greater values to 0.95..1 (the paper's p_c and p_t). The pixel is
// pixel i of `a` and pixel k of `b`.
static float colour_error(const DipFlipAnalysis *a, size_t i, const DipFlipAnalysis *b, size_t k,
                          float greatest) {
    const float share = 0.4f, used = 0.95f;
    const float distance = fabsf(a->planes[PLANE_L][i] - b->planes[PLANE_L][k]) +
                           length(a->planes[PLANE_A][i] - b->planes[PLANE_A][k],
                                  a->planes[PLANE_B][i] - b->planes[PLANE_B][k]);
    const float powered = powf(distance, colour_exponent);
    const float limit = share * greatest;
    return powered < limit ? powered * used / limit
                           : used + (powered - limit) / (greatest - limit) * (1.0f - used);
}

static float feature_error(const DipFlipAnalysis *a, size_t i, const DipFlipAnalysis *b, size_t k) {
    const float edge = fabsf(length(a->planes[PLANE_EDGE_X][i], a->planes[PLANE_EDGE_Y][i]) -
                             length(b->planes[PLANE_EDGE_X][k], b->planes[PLANE_EDGE_Y][k]));
    const float point = fabsf(length(a->planes[PLANE_POINT_X][i], a->planes[PLANE_POINT_Y][i]) -
                              length(b->planes[PLANE_POINT_X][k], b->planes[PLANE_POINT_Y][k]));
    return powf(fmaxf(edge, point) / sqrtf(2.0f), feature_exponent);
}

void dip_flip_compare_block(DipFlip *flip, const DipSrgbPicture *picture, int block,
                            const DipFlipAnalysis *with, float *map) {
    DIP_FP_MODE_SCOPE();
    const Block b = block_of(flip, block);
    const float greatest = greatest_distance();
    analyse(flip, picture, &b);
    for (int y = b.own.y; y < b.own.y + b.own.height; y++) {
        size_t i = row_in_block(&b, y), k = row_in_picture(flip, &b, y);
        for (const size_t end = k + (size_t)b.own.width; k < end; i++, k++) {
            const float colour = colour_error(&b.out, i, with, k, greatest);
            map[k] = colour > 0.0f ? powf(colour, 1.0f - feature_error(&b.out, i, with, k)) : 0.0f;
        }
    }
}

void dip_flip_compare(DipFlip *flip, const DipSrgbPicture *picture, const DipFlipAnalysis *with,
                      float *map) {
    const int blocks = dip_picture_block_count(flip->width, flip->height);
    for (int block = 0; block < blocks; block++) {
        dip_flip_compare_block(flip, picture, block, with, map);
    }
}

// --- the palette of maps -------------------------------------------------------------------------

// Approximates Matplotlib's palette "magma" (public domain) by one polynomial of sixth degree per
// channel. The 8-bit results differ from Matplotlib's table by at most 4.
void dip_magma(float error, uint8_t rgb[3]) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(error);
    static const float coefficients[7][3] = {
        {-0.002136485f, -0.000749655f, -0.005386128f},
        {0.251660541f, 0.677523244f, 2.494026599f},
        {8.353717279f, -3.577719515f, 0.314467903f},
        {-27.668733086f, 14.264730781f, -13.649213188f},
        {52.176139812f, -27.943606072f, 12.944169442f},
        {-50.768525365f, 29.046582821f, 4.234152994f},
        {18.655705066f, -11.489773520f, -5.601961509f},
    };
    const float t = error > 0.0f ? (error < 1.0f ? error : 1.0f) : 0.0f; // NaN becomes 0, too
    for (int c = 0; c < 3; c++) {
        float value = 0.0f;
        for (int k = 6; k >= 0; k--) {
            value = value * t + coefficients[k][c];
        }
        rgb[c] = (uint8_t)(value < 0.0f ? 0.0f : value > 1.0f ? 255.0f : value * 255.0f + 0.5f);
    }
}
