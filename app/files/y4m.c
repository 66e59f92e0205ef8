// Writes the header of a YUV4MPEG2 stream, and converts RGB to the stream's planes Y, Cb and Cr.
//
// BT.709 weighs the channels by Kr = .2126, Kg = .7152 and Kb = .0722. With R, G and B in 0..255,
// luma is l = (2126 R + 7152 G + 722 B) / 10000, and
//
//     Y  =  16 + 219/255 l
//     Cb = 128 + 224/255 (B - l) / (2 (1 - Kb))
//     Cr = 128 + 224/255 (R - l) / (2 (1 - Kr))
//
// With w = 10000 l, each value is a ratio of integers, which is rounded to the nearest integer:
//
//     Y  =  16 + 219 w / 2550000
//     Cb = 128 + 224 (10000 B - w) / 4731780          4731780 = 255 * 10000 * 1.8556
//     Cr = 128 + 224 (10000 R - w) / 4015740          4015740 = 255 * 10000 * 1.5748
#include "app/files/y4m.h"

#include <inttypes.h>
#include <stdio.h>

DipFrameRate dip_frame_rate_reduce(DipFrameRate rate) {
    int64_t a = rate.frames;
    int64_t b = rate.seconds;
    while (b != 0) { // Euclid's algorithm: a becomes the greatest common divisor.
        const int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return (DipFrameRate){rate.frames / a, rate.seconds / a};
}

size_t dip_y4m_header(int width, int height, DipFrameRate rate, char header[DIP_Y4M_HEADER_SIZE]) {
    const DipFrameRate least = dip_frame_rate_reduce(rate);
    const int length =
        snprintf(header, DIP_Y4M_HEADER_SIZE,
                 "YUV4MPEG2 W%d H%d F%" PRId64 ":%" PRId64 " Ip A1:1 C444 XCOLORRANGE=LIMITED\n",
                 width, height, least.frames, least.seconds);
    return (size_t)length;
}

// Returns offset + numerator / denominator, rounded to the nearest integer. The denominator is
// even. The offset makes the dividend positive, so that the integer division rounds down.
static uint8_t round_ratio(int32_t numerator, int32_t denominator, int32_t offset) {
    return (uint8_t)((numerator + offset * denominator + denominator / 2) / denominator);
}

void dip_y4m_planes(const uint8_t *rgb, size_t count, uint8_t *planes) {
    uint8_t *luma = planes;
    uint8_t *blue = planes + count;
    uint8_t *red = planes + 2 * count;
    for (size_t i = 0; i < count; i++) {
        const int32_t r = rgb[3 * i];
        const int32_t g = rgb[3 * i + 1];
        const int32_t b = rgb[3 * i + 2];
        const int32_t weighted = 2126 * r + 7152 * g + 722 * b;
        luma[i] = round_ratio(219 * weighted, 2550000, 16);
        blue[i] = round_ratio(224 * (10000 * b - weighted), 4731780, 128);
        red[i] = round_ratio(224 * (10000 * r - weighted), 4015740, 128);
    }
}
