// Computes the palette "cividis", which people with and without colour blindness see alike. The
// palette is by J. R. Nuñez, C. R. Anderton and R. S. Renslow ("Optimizing colormaps with
// consideration for color vision deficiency to enable accurate interpretation of scientific data",
// 2018). The table below holds every 17th of the 256 colours that Matplotlib publishes. Colours
// between them are interpolated linearly.
#include "app/preview/tools/map_colours.h"

#include <math.h>
#include <stdio.h>

enum { ANCHORS = 16 };

static const float anchors[ANCHORS][3] = {
    {0.000000f, 0.135112f, 0.304751f}, {0.000000f, 0.181610f, 0.421859f},
    {0.117612f, 0.225935f, 0.434308f}, {0.208926f, 0.272546f, 0.424809f},
    {0.279411f, 0.318677f, 0.423031f}, {0.342246f, 0.364939f, 0.428559f},
    {0.401418f, 0.411790f, 0.440708f}, {0.458366f, 0.459552f, 0.460457f},
    {0.517920f, 0.508454f, 0.472707f}, {0.582087f, 0.558670f, 0.468118f},
    {0.648222f, 0.610553f, 0.454801f}, {0.716177f, 0.664384f, 0.432386f},
    {0.785965f, 0.720438f, 0.399613f}, {0.857809f, 0.778969f, 0.353259f},
    {0.932180f, 0.840159f, 0.285880f}, {0.995737f, 0.909344f, 0.217772f},
};

void dip_cividis(float value, uint8_t rgb[3]) {
    const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    const float position = clamped * (ANCHORS - 1);
    const int first = position < ANCHORS - 2 ? (int)position : ANCHORS - 2;
    const float part = position - (float)first;
    for (int c = 0; c < 3; c++) {
        const float light = anchors[first][c] + part * (anchors[first + 1][c] - anchors[first][c]);
        rgb[c] = (uint8_t)(light * 255.0f + 0.5f);
    }
}

double dip_map_round_up(double value) {
    static const double steps[] = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
    if (!(value > 0.0)) {
        return 1.0;
    }
    const double power = pow(10.0, floor(log10(value)));
    int step = 0;
    while (step < 8 && steps[step] * power < value) {
        step++;
    }
    return steps[step] * power;
}

void dip_map_format(double value, char *text, size_t size_bytes) {
    char digits[32];
    snprintf(digits, sizeof digits,
             value < 0.0995 ? "%.3f"
             : value < 9.95 ? "%.2f"
                            : "%.0f",
             value);
    if (value < 0.0005) {
        snprintf(text, size_bytes, "0");
    } else {
        snprintf(text, size_bytes, "%s", digits[0] == '0' ? digits + 1 : digits);
    }
}
