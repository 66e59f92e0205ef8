// An environment as metallic-roughness surfaces see it: docs/picture.md, "Environment". The light
// that a lobe sees is a sum over the picture, in cells that are divided until they are small beside
// the lobe and their distance from it. Sums are made when a lobe is first needed, and kept.
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { ROUGHNESSES = 17, SOFT = 0, MOST_WIDTH = 1024 };

// Sums around a grid of directions: `across` meridians, and `across / 2 + 1` parallels with both
// poles. A sum that is not made is NaN.
typedef struct Grid {
    // The first value of a direction is NAN until the others are there. Threads that need the same
    // direction at the same time compute the same values.
    _Atomic double (*sums)[3];
    int across;
} Grid;

struct DipRefEnvironment {
    const DipEnvironmentDef *def;
    // The picture, averaged to at most MOST_WIDTH columns: sums[y * (width + 1) + x] is the light
    // times the solid angle of all texels above row y and left of column x, and the solid angle.
    int width;
    int height;
    double (*sums)[4];
    // Sine and cosine of the polar angle of row k / 2, and of the azimuth of column k / 2.
    double (*rows)[2];
    double (*columns)[2];
    Grid grids[ROUGHNESSES]; // k: for roughness k / 16; SOFT: the light on matt surfaces
};

// --- the picture ---------------------------------------------------------------------------------

static void read_picture(const DipEnvironmentDef *def, const double direction[3], double rgb[3]) {
    const double u = (atan2(direction[2], direction[0]) / (2.0 * pi) + 0.5) * def->width - 0.5;
    const double polar = acos(fmin(fmax(direction[1], -1.0), 1.0));
    const double v = fmin(fmax(polar / pi * def->height - 0.5, 0.0), def->height - 1.0);
    const int x = (int)floor(u);
    const int y = (int)v;
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < 4; i++) {
        const int column = (x + (i & 1) + def->width) % def->width;
        const int row = i & 2 && y + 1 < def->height ? y + 1 : y;
        const double share = (i & 1 ? u - x : 1.0 - (u - x)) * (i & 2 ? v - y : 1.0 - (v - y));
        for (int c = 0; c < 3; c++) {
            rgb[c] += share * def->rgb_lin[3 * (row * def->width + column) + c];
        }
    }
}

// Averages the texels that fall into a column and a row of the smaller picture.
static void average(const DipRefEnvironment *environment, int x, int y, double rgb[3]) {
    const DipEnvironmentDef *def = environment->def;
    const int left = (int)((long)x * def->width / environment->width);
    const int right = (int)((long)(x + 1) * def->width / environment->width);
    const int top = (int)((long)y * def->height / environment->height);
    const int bottom = (int)((long)(y + 1) * def->height / environment->height);
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = top; i < bottom; i++) {
        for (int k = left; k < right; k++) {
            for (int c = 0; c < 3; c++) {
                rgb[c] +=
                    def->rgb_lin[3 * ((size_t)i * (size_t)def->width + (size_t)k) + (size_t)c] /
                    ((double)(bottom - top) * (right - left));
            }
        }
    }
}

static void sum_picture(DipRefEnvironment *environment) {
    const int stride = environment->width + 1;
    for (int y = 0; y < environment->height; y++) {
        const double height =
            cos(pi * y / environment->height) - cos(pi * (y + 1) / environment->height);
        const double texel = 2.0 * pi / environment->width * height;
        double row[4] = {0.0, 0.0, 0.0, 0.0};
        for (int x = 0; x < environment->width; x++) {
            double light[4] = {0.0, 0.0, 0.0, 1.0};
            average(environment, x, y, light);
            for (int c = 0; c < 4; c++) {
                row[c] += texel * light[c];
                environment->sums[(y + 1) * stride + x + 1][c] =
                    environment->sums[y * stride + x + 1][c] + row[c];
            }
        }
    }
    for (int k = 0; k <= 2 * environment->height; k++) {
        environment->rows[k][0] = sin(pi * k / (2 * environment->height));
        environment->rows[k][1] = cos(pi * k / (2 * environment->height));
    }
    for (int k = 0; k <= 2 * environment->width; k++) {
        environment->columns[k][0] = sin(pi * k / environment->width - pi);
        environment->columns[k][1] = cos(pi * k / environment->width - pi);
    }
}

// --- sums ----------------------------------------------------------------------------------------

// What a lobe around a direction collects: light and weight.
typedef struct Collector {
    const DipRefEnvironment *environment;
    const double *towards;
    double alpha; // width of the lobe; 0: the cosine of matt surfaces
    double sum[4];
} Collector;

// A part of the picture, in columns and rows. A part that is larger than a texel has whole numbers.
typedef struct Cell {
    double left, right, top, bottom;
} Cell;

static void sine_and_cosine(double (*table)[2], double twice, double angle, double out[2]) {
    if (twice == floor(twice)) {
        memcpy(out, table[(int)twice], 2 * sizeof *out);
    } else {
        out[0] = sin(angle);
        out[1] = cos(angle);
    }
}

// Reads the light of a cell times its solid angle, and the solid angle.
static void read_cell(const DipRefEnvironment *environment, const Cell *cell,
                      const double middle[3], double light[4]) {
    if (cell->right - cell->left >= 1.0 && cell->bottom - cell->top >= 1.0) {
        const int stride = environment->width + 1;
        const int left = (int)cell->left, right = (int)cell->right;
        const int top = (int)cell->top * stride, bottom = (int)cell->bottom * stride;
        for (int c = 0; c < 4; c++) {
            light[c] = environment->sums[bottom + right][c] - environment->sums[bottom + left][c] -
                       environment->sums[top + right][c] + environment->sums[top + left][c];
        }
        return;
    }
    const double angle =
        2.0 * pi * (cell->right - cell->left) / environment->width *
        (cos(pi * cell->top / environment->height) - cos(pi * cell->bottom / environment->height));
    read_picture(environment->def, middle, light);
    for (int c = 0; c < 3; c++) {
        light[c] *= angle;
    }
    light[3] = angle;
}

// Returns the weight of light that arrives at a cosine from the lobe's direction, which is view and
// normal at once: n.l times GGX's distribution.
static double weight_at(double cosine, double alpha) {
    if (alpha == 0.0) {
        return cosine;
    }
    const double spread = (1.0 + cosine) / 2.0 * (alpha * alpha - 1.0) + 1.0;
    return cosine * alpha * alpha / (spread * spread);
}

static double middle_of(double from, double to) {
    return to - from > 1.0 ? floor((from + to) / 2.0) : (from + to) / 2.0;
}

static void collect(Collector *collector, const Cell *cell) {
    const DipRefEnvironment *environment = collector->environment;
    double polar[2];
    double azimuth[2];
    sine_and_cosine(environment->rows, cell->top + cell->bottom,
                    pi * (cell->top + cell->bottom) / (2.0 * environment->height), polar);
    sine_and_cosine(environment->columns, cell->left + cell->right,
                    pi * (cell->left + cell->right) / environment->width - pi, azimuth);
    const double middle[3] = {polar[0] * azimuth[1], polar[1], polar[0] * azimuth[0]};
    const double *n = collector->towards;
    const double cosine = middle[0] * n[0] + middle[1] * n[1] + middle[2] * n[2];
    const double height = pi * (cell->bottom - cell->top) / environment->height;
    const double width = 2.0 * pi * (cell->right - cell->left) / environment->width *
                         fmin(1.0, polar[0] + height / 2.0);
    const double radius = sqrt(width * width + height * height) / 2.0;
    if (cosine < -radius) {
        return;
    }
    const double scale = collector->alpha == 0.0 ? 1.0 : 2.0 * collector->alpha;
    const double away = sqrt(fmax(0.0, 2.0 - 2.0 * cosine));
    if (radius <= 0.1 * fmax(away, scale)) {
        double light[4];
        const double weight = weight_at(fmax(cosine, 0.0), collector->alpha);
        read_cell(environment, cell, middle, light);
        for (int c = 0; c < 4; c++) {
            collector->sum[c] += weight * light[c];
        }
        return;
    }
    Cell halves[2] = {*cell, *cell};
    if (width > height && cell->right - cell->left > 1e-3) {
        halves[0].right = halves[1].left = middle_of(cell->left, cell->right);
    } else {
        halves[0].bottom = halves[1].top = middle_of(cell->top, cell->bottom);
    }
    collect(collector, &halves[0]);
    collect(collector, &halves[1]);
}

static void add_up(const DipRefEnvironment *environment, const double towards[3], double alpha,
                   double rgb[3]) {
    const Cell all = {0.0, environment->width, 0.0, environment->height};
    Collector collector = {.environment = environment, .towards = towards, .alpha = alpha};
    collect(&collector, &all);
    for (int c = 0; c < 3; c++) {
        rgb[c] = collector.sum[c] / collector.sum[3];
    }
}

// Reads a grid between its directions.
static void read_grid(const DipRefEnvironment *environment, int index, const double direction[3],
                      double rgb[3]) {
    const Grid *grid = &environment->grids[index];
    const int down = grid->across / 2;
    const double u = (atan2(direction[2], direction[0]) / (2.0 * pi) + 0.5) * grid->across;
    const double v = acos(fmin(fmax(direction[1], -1.0), 1.0)) / pi * down;
    const int x = (int)u;
    const int y = (int)fmin(v, down - 1.0);
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < 4; i++) {
        const int column = (x + (i & 1)) % grid->across;
        const int row = y + (i >> 1);
        _Atomic double *sum = grid->sums[row * grid->across + column];
        if (isnan(atomic_load_explicit(&sum[0], memory_order_acquire))) {
            double light[3];
            const double azimuth = 2.0 * pi * column / grid->across - pi;
            const double polar = pi * row / down;
            const double towards[3] = {sin(polar) * cos(azimuth), cos(polar),
                                       sin(polar) * sin(azimuth)};
            add_up(environment, towards, index == SOFT ? 0.0 : pow(index / 16.0, 2.0), light);
            for (int c = 2; c >= 0; c--) {
                atomic_store_explicit(&sum[c], light[c], memory_order_release);
            }
        }
        const double share = (i & 1 ? u - x : 1.0 - (u - x)) * (i & 2 ? v - y : 1.0 - (v - y));
        for (int c = 0; c < 3; c++) {
            rgb[c] += share * atomic_load_explicit(&sum[c], memory_order_relaxed);
        }
    }
}

void dip_reference_environment_see(const DipRefEnvironment *environment, double roughness,
                                   const double towards[3], double rgb[3]) {
    const double at = roughness * (ROUGHNESSES - 1);
    const int first = (int)fmin(at, ROUGHNESSES - 2.0);
    double next[3];
    if (first == 0) {
        read_picture(environment->def, towards, rgb);
    } else {
        read_grid(environment, first, towards, rgb);
    }
    read_grid(environment, first + 1, towards, next);
    for (int c = 0; c < 3; c++) {
        rgb[c] += (next[c] - rgb[c]) * (at - first);
    }
}

void dip_reference_environment_soften(const DipRefEnvironment *environment, const double normal[3],
                                      double rgb[3]) {
    read_grid(environment, SOFT, normal, rgb);
}

// --- creating and destroying ---------------------------------------------------------------------

static bool make_grid(Grid *grid, int across) {
    const size_t count = (size_t)across * (size_t)(across / 2 + 1);
    grid->across = across;
    grid->sums = malloc(count * sizeof *grid->sums);
    for (size_t i = 0; grid->sums && i < count; i++) {
        atomic_init(&grid->sums[i][0], NAN);
    }
    return grid->sums != NULL;
}

DipRefEnvironment *dip_reference_environment_create(const DipEnvironmentDef *def) {
    DipRefEnvironment *environment = calloc(1, sizeof *environment);
    if (!environment) {
        return NULL;
    }
    const int factor = (def->width + MOST_WIDTH - 1) / MOST_WIDTH;
    environment->def = def;
    environment->width = def->width / factor;
    environment->height = def->height / factor;
    const size_t width = (size_t)environment->width;
    const size_t height = (size_t)environment->height;
    environment->sums = calloc((width + 1) * (height + 1), sizeof *environment->sums);
    environment->rows = calloc(2 * height + 1, sizeof *environment->rows);
    environment->columns = calloc(2 * width + 1, sizeof *environment->columns);
    bool made = environment->sums && environment->rows && environment->columns;
    for (int k = 0; made && k < ROUGHNESSES; k++) {
        // The sharpest lobes have the finest grids.
        made = make_grid(&environment->grids[k], k != SOFT && k <= 4 ? 512 : 128);
    }
    if (made) {
        sum_picture(environment);
    } else {
        dip_reference_environment_destroy(&environment);
    }
    return environment;
}

void dip_reference_environment_destroy(DipRefEnvironment **environment) {
    if (!*environment) {
        return;
    }
    for (int k = 0; k < ROUGHNESSES; k++) {
        free((*environment)->grids[k].sums);
    }
    free((*environment)->sums);
    free((*environment)->rows);
    free((*environment)->columns);
    free(*environment);
    *environment = NULL;
}
