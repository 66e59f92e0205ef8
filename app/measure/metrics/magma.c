// Matplotlib's palette "magma" (public domain), approximated by one polynomial of sixth degree per
// channel. Its 8-bit results differ from Matplotlib's table by at most 4.
#include "app/measure/metrics/magma.h"

void dip_magma(float error, uint8_t rgb[3]) {
    static const float coefficients[7][3] = {
        {-0.002136485f, -0.000749655f, -0.005386128f},
        {0.251660541f, 0.677523244f, 2.494026599f},
        {8.353717279f, -3.577719515f, 0.314467903f},
        {-27.668733086f, 14.264730781f, -13.649213188f},
        {52.176139812f, -27.943606072f, 12.944169442f},
        {-50.768525365f, 29.046582821f, 4.234152994f},
        {18.655705066f, -11.489773520f, -5.601961509f},
    };
    const float t = error < 0.0f ? 0.0f : error > 1.0f ? 1.0f : error;
    for (int c = 0; c < 3; c++) {
        float value = 0.0f;
        for (int k = 6; k >= 0; k--) {
            value = value * t + coefficients[k][c];
        }
        rgb[c] = (uint8_t)(value < 0.0f ? 0.0f : value > 1.0f ? 255.0f : value * 255.0f + 0.5f);
    }
}
