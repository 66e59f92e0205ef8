// sRGB transfer functions and tables.
#include "renderer/base/srgb.h"

#include "renderer/base/fp_mode.h"

#include <math.h>
#include <string.h>

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
    // Entry i belongs to the linear light i / 65535. The first entry with code c is the first whose
    // light is at least the light of the sRGB value (c - 1/2) / 255. It is looked for from just
    // below that light on.
    int first = 0;
    for (int code = 0; code < 255; code++) {
        const double end = decode((code + 0.5) / 255.0);
        int next = (int)(end * DIP_LINEAR16_MAX) - 1;
        next = next < first ? first : next;
        while (next / (double)DIP_LINEAR16_MAX < end) {
            next++;
        }
        memset(table->code + first, code, (size_t)(next - first));
        first = next;
    }
    memset(table->code + first, 255, (size_t)(DIP_LINEAR16_MAX + 1 - first));
    for (int i = 1; i <= 3; i++) {
        table->code[DIP_LINEAR16_MAX + i] = 255;
    }
}
