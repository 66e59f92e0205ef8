// sRGB transfer functions and tables.
#include "renderer/base/srgb.h"

#include "renderer/base/fp_mode.h"

// Returns x^(1/5) for 0 < x <= 1.2, by Newton's method. The iteration starts above the root and
// falls monotonically to the root.
static double fifth_root(double x) {
    double y = 1.1;
    for (int i = 0; i < 200; i++) {
        const double y4 = y * y * y * y;
        const double next = (4.0 * y + x / y4) / 5.0;
        if (next >= y) {
            break;
        }
        y = next;
    }
    return y;
}

static double decode(double encoded) {
    if (encoded <= 0.04045) {
        return encoded / 12.92;
    }
    const double base = (encoded + 0.055) / 1.055;
    const double root = fifth_root(base);
    return base * base * root * root; // base^2.4
}

double dip_srgb_decode(double encoded) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(encoded);
    double linear = decode(encoded);
    DIP_FP_PIN(linear);
    return linear;
}

void dip_srgb_decode_table(DipSrgbDecodeTable *table) {
    DIP_FP_MODE_SCOPE();
    for (int i = 0; i < 256; i++) {
        table->linear[i] = decode(i / 255.0);
    }
}

void dip_srgb_encode_table(DipSrgbEncodeTable *table) {
    DIP_FP_MODE_SCOPE();
    // Entry r covers the linear light from 16 r / 65535 on. The first light with code c is the
    // first that is at least the light of the sRGB value (c - 1/2) / 255. It is looked for from
    // just below that light on.
    enum { RUNS = (DIP_LINEAR16_MAX + 1) / DIP_SRGB_RUN };
    int run = 0;
    for (int code = 0; code < 255; code++) {
        const double end = decode((code + 0.5) / 255.0);
        int next = (int)(end * DIP_LINEAR16_MAX) - 1;
        while (next / (double)DIP_LINEAR16_MAX < end) {
            next++;
        }
        while (run < next / DIP_SRGB_RUN) {
            table->runs[run++] = (uint16_t)(code * DIP_SRGB_RUN);
        }
        const int with_next_code = DIP_SRGB_RUN - next % DIP_SRGB_RUN;
        table->runs[run++] = (uint16_t)(code * DIP_SRGB_RUN + with_next_code);
    }
    while (run <= RUNS) {
        table->runs[run++] = 255 * DIP_SRGB_RUN;
    }
}
