// Vectors in double precision, for tests that compute light and shadows by themselves.
#ifndef DIP_TESTS_RENDERER_SCENE_VEC_H
#define DIP_TESTS_RENDERER_SCENE_VEC_H

#include <math.h>

typedef double Vec[3];

static inline double dot(const Vec a, const Vec b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Sets `product` to a x b. It must be another vector than a and b.
static inline void cross(const Vec a, const Vec b, Vec product) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        product[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static inline double length(const Vec v) {
    return sqrt(dot(v, v));
}

// Gives a vector the length 1.
static inline void unit(Vec v) {
    const double divisor = length(v);
    for (int i = 0; i < 3; i++) {
        v[i] /= divisor;
    }
}

#endif
