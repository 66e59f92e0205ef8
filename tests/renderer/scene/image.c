// Reads the pixels of a drawn frame, and compares them with the picture that is expected.
#include "tests/renderer/scene/image.h"

#include "tests/support/srgb.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

static uint8_t to_byte(double linear) {
    return (uint8_t)floor(255.0 * srgb_encode(fmin(fmax(linear, 0.0), 1.0)) + 0.5);
}

// Decodes a code of 8 bits.
static double decode_code(uint8_t code) {
    static double decoded[256];
    if (decoded[255] == 0.0) {
        for (int i = 0; i < 256; i++) {
            decoded[i] = srgb_light(i);
        }
    }
    return decoded[code];
}

const uint8_t *dip_image_pixel(const DipFrame *frame, int x, int y) {
    return frame->rgba8 + (size_t)y * frame->stride_bytes + 4 * (size_t)x;
}

const uint8_t *dip_image_centre(const DipFrame *frame) {
    return dip_image_pixel(frame, frame->width / 2, frame->height / 2);
}

void dip_image_copy(const DipFrame *frame, void *rgba8) {
    const size_t row_bytes = (size_t)frame->width * 4;
    for (int y = 0; y < frame->height; y++) {
        memcpy((uint8_t *)rgba8 + (size_t)y * row_bytes, dip_image_pixel(frame, 0, y), row_bytes);
    }
}

// Compares a frame without its PSNR, for which every expected value would have to be encoded.
static DipImageError compare_light(const double *rgb_lin, const DipFrame *frame, double pixel_lin) {
    DipImageError error = {.first_x = -1, .first_y = -1};
    double squares = 0.0;
    const double count = 3.0 * frame->width * frame->height;
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            double worst = 0.0;
            for (int c = 0; c < 3; c++) {
                const double expected =
                    rgb_lin[3 * ((size_t)y * (size_t)frame->width + (size_t)x) + (size_t)c];
                const double difference =
                    fabs(decode_code(dip_image_pixel(frame, x, y)[c]) - expected);
                worst = fmax(worst, difference);
                squares += difference * difference;
                error.mean_lin += difference / count;
            }
            error.max_lin = fmax(error.max_lin, worst);
            if (!(worst <= pixel_lin)) {
                if (error.over_count++ == 0) {
                    error.first_x = x;
                    error.first_y = y;
                }
            }
        }
    }
    error.rms_lin = sqrt(squares / count);
    return error;
}

static double psnr_db(const double *rgb_lin, const DipFrame *frame) {
    double squares = 0.0;
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < 3 * frame->width; x++) {
            const double expected = *rgb_lin++;
            const double difference =
                dip_image_pixel(frame, x / 3, y)[x % 3] - (double)to_byte(expected);
            squares += difference * difference;
        }
    }
    return 10.0 * log10(255.0 * 255.0 * (3.0 * frame->width * frame->height) / squares);
}

DipImageError dip_image_compare(const double *rgb_lin, const DipFrame *frame, double pixel_lin) {
    DipImageError error = compare_light(rgb_lin, frame, pixel_lin);
    error.psnr_db = psnr_db(rgb_lin, frame);
    return error;
}

double dip_image_rms(const double *a, const double *b, size_t value_count) {
    double squares = 0.0;
    for (size_t i = 0; i < value_count; i++) {
        squares += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return sqrt(squares / (double)value_count);
}

typedef enum Picture { EXPECTED, GOT, DIFFERENCE, PICTURES } Picture;

static uint8_t byte_of(Picture picture, double expected, uint8_t got) {
    switch (picture) {
    case EXPECTED:
        return to_byte(expected);
    case GOT:
        return got;
    default:
        return to_byte(16.0 * fabs(decode_code(got) - expected));
    }
}

static void write_picture(const char *name, Picture picture, const double *rgb_lin,
                          const DipFrame *frame) {
    static const char *const kinds[PICTURES] = {"expected", "got", "difference"};
    uint8_t *rgb8 = malloc((size_t)frame->width * (size_t)frame->height * 3);
    if (!rgb8) {
        return;
    }
    uint8_t *out = rgb8;
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            for (int c = 0; c < 3; c++) {
                *out++ = byte_of(picture, *rgb_lin++, dip_image_pixel(frame, x, y)[c]);
            }
        }
    }
    char path[256];
    snprintf(path, sizeof path, "%s_%s.png", name, kinds[picture]);
    if (stbi_write_png(path, frame->width, frame->height, 3, rgb8, 3 * frame->width)) {
        fprintf(stderr, "  wrote %s\n", path);
    }
    free(rgb8);
}

static void report(const char *name, const double *rgb_lin, const DipFrame *frame,
                   const DipImageBounds *bounds, const DipImageError *error) {
    fprintf(stderr,
            "%s: rms %.6f (accepted %.6f), max %.4f (accepted %.4f), psnr %.2f dB; %zu pixels over "
            "%.4f (accepted %.0f)\n",
            name, error->rms_lin, bounds->rms_lin, error->max_lin, bounds->over_max_lin,
            psnr_db(rgb_lin, frame), error->over_count, bounds->pixel_lin,
            floor(bounds->over_share * frame->width * frame->height));
    if (error->over_count) {
        const uint8_t *got = dip_image_pixel(frame, error->first_x, error->first_y);
        const double *expected =
            rgb_lin + 3 * ((size_t)error->first_y * (size_t)frame->width + (size_t)error->first_x);
        fprintf(stderr, "  first at (%d, %d): expected sRGB %u %u %u, got %u %u %u\n",
                error->first_x, error->first_y, to_byte(expected[0]), to_byte(expected[1]),
                to_byte(expected[2]), got[0], got[1], got[2]);
    }
    for (int picture = 0; picture < PICTURES; picture++) {
        write_picture(name, (Picture)picture, rgb_lin, frame);
    }
}

bool dip_image_check(const char *name, const double *rgb_lin, const DipFrame *frame,
                     const DipImageBounds *bounds) {
    const DipImageError error = compare_light(rgb_lin, frame, bounds->pixel_lin);
    const bool kept = error.rms_lin <= bounds->rms_lin && error.max_lin <= bounds->over_max_lin &&
                      (double)error.over_count <= bounds->over_share * frame->width * frame->height;
    if (!kept) {
        report(name, rgb_lin, frame, bounds, &error);
    }
    return kept;
}
