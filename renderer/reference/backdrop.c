// Blurs what lies behind rough glass: averages of the picture, read by a cubic B-spline.
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_LEVELS = 16 };

// The blur is that of a picture of this width whose levels are read at log2(width) * roughness.
static const double full_width = 5120.0;

typedef struct Level {
    int width;
    int height;
    double *rgb;
} Level;

struct DipRefBackdrop {
    Level levels[MAX_LEVELS];
    int count;
};

// Returns the colour of a texel; beyond the border, the last one is repeated.
static const double *texel_at(const Level *level, int x, int y) {
    const int column = x < 0 ? 0 : x < level->width ? x : level->width - 1;
    const int row = y < 0 ? 0 : y < level->height ? y : level->height - 1;
    return level->rgb + 3 * ((size_t)row * (size_t)level->width + (size_t)column);
}

static bool make_level(Level *level, int width, int height) {
    *level = (Level){width, height, malloc((size_t)width * (size_t)height * 3 * sizeof(double))};
    return level->rgb != NULL;
}

// Adds the mean of the area of `from` that a texel of `to` covers.
static void add_area(const Level *from, const Level *to, int x, int y, double rgb[3]) {
    const double wide = (double)from->width / to->width;
    const double high = (double)from->height / to->height;
    for (int j = (int)(y * high); j < from->height && j < (y + 1) * high; j++) {
        const double part_y = fmin(j + 1.0, (y + 1) * high) - fmax(j, y * high);
        for (int i = (int)(x * wide); i < from->width && i < (x + 1) * wide; i++) {
            const double part_x = fmin(i + 1.0, (x + 1) * wide) - fmax(i, x * wide);
            for (int c = 0; c < 3; c++) {
                rgb[c] += part_x * part_y / (wide * high) * texel_at(from, i, j)[c];
            }
        }
    }
}

static bool halve(const Level *from, Level *to) {
    if (!make_level(to, from->width > 1 ? from->width / 2 : 1,
                    from->height > 1 ? from->height / 2 : 1)) {
        return false;
    }
    for (int y = 0; y < to->height; y++) {
        for (int x = 0; x < to->width; x++) {
            double *rgb = to->rgb + 3 * ((size_t)y * (size_t)to->width + (size_t)x);
            rgb[0] = rgb[1] = rgb[2] = 0.0;
            add_area(from, to, x, y, rgb);
        }
    }
    return true;
}

DipRefBackdrop *dip_reference_backdrop_create(const double *rgb_lin, int width, int height) {
    DipRefBackdrop *backdrop = calloc(1, sizeof *backdrop);
    if (!backdrop) {
        return NULL;
    }
    Level *levels = backdrop->levels;
    bool made = make_level(&levels[0], width, height);
    for (size_t i = 0; made && i < (size_t)width * (size_t)height * 3; i++) {
        levels[0].rgb[i] = rgb_lin[i];
    }
    backdrop->count = 1;
    while (made &&
           (levels[backdrop->count - 1].width > 1 || levels[backdrop->count - 1].height > 1)) {
        made = halve(&levels[backdrop->count - 1], &levels[backdrop->count]);
        backdrop->count++;
    }
    if (!made) {
        dip_reference_backdrop_destroy(&backdrop);
    }
    return backdrop;
}

void dip_reference_backdrop_destroy(DipRefBackdrop **backdrop) {
    for (int i = 0; *backdrop && i < MAX_LEVELS; i++) {
        free((*backdrop)->levels[i].rgb);
    }
    free(*backdrop);
    *backdrop = NULL;
}

// The uniform cubic B-spline.
static double spline(double x) {
    const double a = fabs(x);
    if (a < 1.0) {
        return 2.0 / 3.0 - a * a + 0.5 * a * a * a;
    }
    return a < 2.0 ? pow(2.0 - a, 3.0) / 6.0 : 0.0;
}

// u, v: fractions of the picture's width and height.
static void add_level(const Level *level, double u, double v, double share, double rgb[3]) {
    const double x = u * level->width - 0.5;
    const double y = v * level->height - 0.5;
    const int first_x = (int)floor(x) - 1;
    const int first_y = (int)floor(y) - 1;
    for (int j = first_y; j < first_y + 4; j++) {
        for (int i = first_x; i < first_x + 4; i++) {
            const double weight = share * spline(x - i) * spline(y - j);
            for (int c = 0; c < 3; c++) {
                rgb[c] += weight * texel_at(level, i, j)[c];
            }
        }
    }
}

void dip_reference_backdrop_read(const DipRefBackdrop *backdrop, const DipRefPosition *place,
                                 double roughness, double rgb[3]) {
    const double wanted = log2(backdrop->levels[0].width) - (1.0 - roughness) * log2(full_width);
    const double level = fmin(fmax(wanted, 0.0), backdrop->count - 1.0);
    const int finer = (int)level;
    const int coarser = finer + 1 < backdrop->count ? finer + 1 : finer;
    const double u = place->x / (256.0 * backdrop->levels[0].width);
    const double v = place->y / (256.0 * backdrop->levels[0].height);
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    add_level(&backdrop->levels[finer], u, v, 1.0 - (level - finer), rgb);
    add_level(&backdrop->levels[coarser], u, v, level - finer, rgb);
}
