// Blurs an environment. The picture first becomes an octahedral map, of which each level of the
// result is a weighted mean: 256 samples of the lobe read the map or, where they stand far apart,
// a smaller one, so that none of a bright spot is missed. All operations are + - * / and sqrt, and
// each texel is computed by itself in one order.
#include "renderer/scene/resources/environment.h"

#include "renderer/base/trig.h"
#include "renderer/scene/materials/pbr.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SOURCE_WIDTH = 1024, // greatest width of the picture that the maps are made from
    FIRST_CELLS = 256,   // of the sharpest map
    MAPS = 6,            // each has half the cells of the one before
    ROWS_OF_TASK = 8,
};

static const int level_cells[DIP_ENVIRONMENT_LEVELS] = {256, 128, 128, 64, 32, 32, 16, 16, 16};

// The picture, made smaller if it was large.
typedef struct Source {
    float *rgb;
    int width;
    int height;
} Source;

// An octahedral map of three floats per texel; see DipEnvironmentMap.
typedef struct Octahedron {
    float *rgb;
    int cells;
} Octahedron;

// A sample of a lobe around (0, 0, 1).
typedef struct LobeSample {
    double at[3];
    double weight;
    int map; // the map that it reads
} LobeSample;

typedef struct Lobe {
    LobeSample samples[DIP_PBR_SAMPLES];
    int count;
} Lobe;

typedef struct Maker {
    Source source;
    Octahedron maps[MAPS];
    Lobe lobes[DIP_ENVIRONMENT_LEVELS]; // the first one is not used
    DipEnvironmentMap *out;
    int level; // the level that is made
} Maker;

// --- the picture ---------------------------------------------------------------------------------

static bool shrink(const DipEnvironmentDef *def, Source *source) {
    const int factor = (def->width + SOURCE_WIDTH - 1) / SOURCE_WIDTH;
    source->width = def->width / factor;
    source->height = def->height / factor;
    source->rgb = malloc(3 * (size_t)source->width * (size_t)source->height * sizeof(float));
    float *to = source->rgb;
    for (int y = 0; to && y < source->height; y++) {
        const int top = (int)((int64_t)y * def->height / source->height);
        const int bottom = (int)((int64_t)(y + 1) * def->height / source->height);
        for (int x = 0; x < source->width; x++) {
            const int left = (int)((int64_t)x * def->width / source->width);
            const int right = (int)((int64_t)(x + 1) * def->width / source->width);
            double sum[3] = {0.0, 0.0, 0.0};
            for (int i = top; i < bottom; i++) {
                const float *from = def->rgb_lin + 3 * ((size_t)i * (size_t)def->width);
                for (int k = 3 * left; k < 3 * right; k++) {
                    sum[k % 3] += (double)from[k];
                }
            }
            for (int c = 0; c < 3; c++) {
                *to++ = (float)(sum[c] / ((bottom - top) * (right - left)));
            }
        }
    }
    return source->rgb != NULL;
}

// Adds what the picture shows in a direction (unit), bilinearly.
static void add_source(const Source *source, const double towards[3], double sum[3]) {
    const double turn = dip_atan2(towards[2], towards[0]) / (2.0 * DIP_PI) + 0.5;
    const double cosine = fmin(fmax(towards[1], -1.0), 1.0);
    const double u = turn * source->width - 0.5;
    const double v =
        fmin(fmax(dip_acos(cosine) / DIP_PI * source->height - 0.5, 0.0), source->height - 1.0);
    const int column = u < 0.0 ? -1 : (int)u;
    const int row = (int)v;
    const int columns[2] = {column < 0 ? source->width - 1 : column % source->width,
                            (column + 1) % source->width};
    const int rows[2] = {row, row + 1 < source->height ? row + 1 : row};
    for (int i = 0; i < 4; i++) {
        const double across = i & 1 ? u - column : 1.0 - (u - column);
        const double down = i & 2 ? v - row : 1.0 - (v - row);
        const float *from = source->rgb + 3 * ((size_t)rows[i >> 1] * (size_t)source->width +
                                               (size_t)columns[i & 1]);
        for (int c = 0; c < 3; c++) {
            sum[c] += across * down * (double)from[c];
        }
    }
}

// Projects the picture on spherical harmonics of order 2, and scales them to the light on a matt
// surface: "An efficient representation for irradiance environment maps" (Ramamoorthi and Hanrahan
// 2001).
static void make_soft_light(const Source *source, float soft_lin[9][3]) {
    static const double scales[9] = {1.0 / 4.0,   1.0 / 2.0,   1.0 / 2.0,   1.0 / 2.0, 15.0 / 16.0,
                                     15.0 / 16.0, 15.0 / 16.0, 15.0 / 64.0, 5.0 / 64.0};
    double sums[9][3] = {{0.0}};
    for (int row = 0; row < source->height; row++) {
        const double middle = DIP_PI * (row + 0.5) / source->height;
        const double y = dip_cos(middle);
        const double around = dip_sin(middle);
        const double top = dip_cos(DIP_PI * row / source->height);
        const double bottom = dip_cos(DIP_PI * (row + 1) / source->height);
        const double share = 2.0 * (top - bottom) / source->width; // of a texel, times 1 / pi
        double row_sums[9][3] = {{0.0}};
        for (int column = 0; column < source->width; column++) {
            const double angle = 2.0 * DIP_PI * ((column + 0.5) / source->width - 0.5);
            const double x = around * dip_cos(angle);
            const double z = around * dip_sin(angle);
            const double terms[9] = {
                1.0, x, y, z, x * y, y * z, x * z, x * x - y * y, 3.0 * z * z - 1.0};
            const float *from =
                source->rgb + 3 * ((size_t)row * (size_t)source->width + (size_t)column);
            for (int t = 0; t < 9; t++) {
                for (int c = 0; c < 3; c++) {
                    row_sums[t][c] += terms[t] * (double)from[c];
                }
            }
        }
        for (int t = 0; t < 9; t++) {
            for (int c = 0; c < 3; c++) {
                sums[t][c] += row_sums[t][c] * share;
            }
        }
    }
    for (int t = 0; t < 9; t++) {
        for (int c = 0; c < 3; c++) {
            soft_lin[t][c] = (float)(sums[t][c] * scales[t]);
        }
    }
}

// --- octahedral maps -----------------------------------------------------------------------------

// Returns the direction (unit) of a point of the square -1..1. Points a little beyond its edges are
// on the other side of the fold.
static void unfold(double x, double z, double direction[3]) {
    if (fabs(x) > 1.0) {
        x = (x < 0.0 ? -2.0 : 2.0) - x;
        z = -z;
    }
    if (fabs(z) > 1.0) {
        z = (z < 0.0 ? -2.0 : 2.0) - z;
        x = -x;
    }
    const double y = 1.0 - fabs(x) - fabs(z);
    const double folded_x = (1.0 - fabs(z)) * (x < 0.0 ? -1.0 : 1.0);
    const double folded_z = (1.0 - fabs(x)) * (z < 0.0 ? -1.0 : 1.0);
    direction[0] = y < 0.0 ? folded_x : x;
    direction[1] = y;
    direction[2] = y < 0.0 ? folded_z : z;
    const double length = sqrt(direction[0] * direction[0] + y * y + direction[2] * direction[2]);
    for (int i = 0; i < 3; i++) {
        direction[i] /= length;
    }
}

// Adds what a map shows in a direction of any length, bilinearly.
static void add_map(const Octahedron *map, const double towards[3], double weight, double sum[3]) {
    const double length = fabs(towards[0]) + fabs(towards[1]) + fabs(towards[2]);
    double x = towards[0] / length;
    double z = towards[2] / length;
    if (towards[1] < 0.0) {
        const double folded_x = (1.0 - fabs(z)) * (x < 0.0 ? -1.0 : 1.0);
        z = (1.0 - fabs(x)) * (z < 0.0 ? -1.0 : 1.0);
        x = folded_x;
    }
    // Rounding may lead a little below 0, which a cast rounds to 0, too.
    const double u = (x + 1.0) * 0.5 * map->cells;
    const double v = (z + 1.0) * 0.5 * map->cells;
    const int column = u < map->cells ? (int)u : map->cells - 1;
    const int row = v < map->cells ? (int)v : map->cells - 1;
    const double right = u - column;
    const double below = v - row;
    const float *from = map->rgb + 3 * ((size_t)row * (size_t)(map->cells + 1) + (size_t)column);
    const float *next = from + 3 * (size_t)(map->cells + 1);
    for (int c = 0; c < 3; c++) {
        const double upper = (1.0 - right) * (double)from[c] + right * (double)from[c + 3];
        const double lower = (1.0 - right) * (double)next[c] + right * (double)next[c + 3];
        sum[c] += weight * ((1.0 - below) * upper + below * lower);
    }
}

// Computes some rows of the sharpest map: the mean of the picture around each texel.
static void make_first_rows(void *context, int task, int worker) {
    (void)worker;
    const Maker *maker = context;
    const Octahedron *map = &maker->maps[0];
    const int steps = maker->source.width <= 2 * FIRST_CELLS ? 2 : 4;
    for (int row = task * ROWS_OF_TASK; row < (task + 1) * ROWS_OF_TASK && row <= map->cells;
         row++) {
        float *to = map->rgb + 3 * (size_t)row * (size_t)(map->cells + 1);
        for (int column = 0; column <= map->cells; column++) {
            double sum[3] = {0.0, 0.0, 0.0};
            for (int i = 0; i < steps * steps; i++) {
                const double across = column + (i % steps + 0.5) / steps - 0.5;
                const double down = row + (i / steps + 0.5) / steps - 0.5;
                double direction[3];
                unfold(2.0 * across / map->cells - 1.0, 2.0 * down / map->cells - 1.0, direction);
                add_source(&maker->source, direction, sum);
            }
            for (int c = 0; c < 3; c++) {
                *to++ = (float)(sum[c] / (steps * steps));
            }
        }
    }
}

// Makes a map from one of twice its cells. Each texel is a mean of the nine texels there, of which
// the middle one counts most.
static void halve(const Octahedron *from, Octahedron *to) {
    static const double shares[3] = {0.25, 0.5, 0.25};
    float *out = to->rgb;
    for (int i = 0; i < (to->cells + 1) * (to->cells + 1); i++) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < 9; k++) {
            const double across = 2.0 * (i % (to->cells + 1)) + (k % 3 - 1);
            const double down = 2.0 * (i / (to->cells + 1)) + (k / 3 - 1);
            double direction[3];
            unfold(2.0 * across / from->cells - 1.0, 2.0 * down / from->cells - 1.0, direction);
            add_map(from, direction, shares[k % 3] * shares[k / 3], sum);
        }
        for (int c = 0; c < 3; c++) {
            *out++ = (float)sum[c];
        }
    }
}

static bool make_maps(Maker *maker, DipPool *pool) {
    for (int m = 0; m < MAPS; m++) {
        Octahedron *map = &maker->maps[m];
        map->cells = FIRST_CELLS >> m;
        const size_t texels = (size_t)(map->cells + 1) * (size_t)(map->cells + 1);
        map->rgb = malloc(3 * texels * sizeof *map->rgb);
        if (!map->rgb) {
            return false;
        }
    }
    dip_pool_run(pool, FIRST_CELLS / ROWS_OF_TASK + 1, make_first_rows, maker);
    for (int m = 1; m < MAPS; m++) {
        halve(&maker->maps[m - 1], &maker->maps[m]);
    }
    return true;
}

// --- lobes ---------------------------------------------------------------------------------------

// Samples the lobe of a roughness for view, normal and lobe in one direction, and weights each
// light by its cosine. A sample stands for a part of the sphere, and reads a map whose texels are
// about as large.
static void make_lobe(const DipPbrSample points[DIP_PBR_SAMPLES], double roughness, Lobe *lobe) {
    const double alpha2 = roughness * roughness * roughness * roughness;
    double total = 0.0;
    lobe->count = 0;
    for (int i = 0; i < DIP_PBR_SAMPLES; i++) {
        const double u = points[i].u;
        const double cosine2 = (1.0 - u) / (1.0 + (alpha2 - 1.0) * u);
        const double height = 2.0 * cosine2 - 1.0;
        if (height <= 0.0) {
            continue;
        }
        const double around = 2.0 * sqrt(cosine2 * (1.0 - cosine2));
        const double spread = cosine2 * (alpha2 - 1.0) + 1.0;
        const double density = alpha2 / (4.0 * DIP_PI * spread * spread);
        const double texels = 4.0 * DIP_PI * DIP_PBR_SAMPLES * density; // of the sample's size
        int map = 0;
        while (map + 1 < MAPS && (double)(FIRST_CELLS >> map) * (FIRST_CELLS >> map) > texels) {
            map++;
        }
        lobe->samples[lobe->count++] = (LobeSample){
            .at = {around * points[i].cosine, around * points[i].sine, height},
            .weight = height,
            .map = map,
        };
        total += height;
    }
    for (int i = 0; i < lobe->count; i++) {
        lobe->samples[i].weight /= total;
    }
}

// Finds two directions that are perpendicular to a direction and to each other: "Building an
// orthonormal basis, revisited" (Duff et al. 2017).
static void make_basis(const double n[3], double a[3], double b[3]) {
    const double sign = n[2] < 0.0 ? -1.0 : 1.0;
    const double p = -1.0 / (sign + n[2]);
    const double q = n[0] * n[1] * p;
    a[0] = 1.0 + sign * n[0] * n[0] * p;
    a[1] = sign * q;
    a[2] = -sign * n[0];
    b[0] = q;
    b[1] = sign + n[1] * n[1] * p;
    b[2] = -n[1];
}

static void blur(const Maker *maker, const double n[3], double sum[3]) {
    const Lobe *lobe = &maker->lobes[maker->level];
    double a[3];
    double b[3];
    make_basis(n, a, b);
    for (int i = 0; i < lobe->count; i++) {
        const LobeSample *sample = &lobe->samples[i];
        double towards[3];
        for (int k = 0; k < 3; k++) {
            towards[k] = (a[k] * sample->at[0] + b[k] * sample->at[1]) + n[k] * sample->at[2];
        }
        add_map(&maker->maps[sample->map], towards, sample->weight, sum);
    }
}

// Returns a power of two.
static float power_of_two(int exponent) {
    const int32_t bits = (exponent + 127) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

// Encodes a texel with the least exponent for which the greatest channel fits in 9 bits.
static int32_t encode(const double rgb[3]) {
    uint32_t exponent = 0;
    const double greatest = fmax(fmax(rgb[0], rgb[1]), rgb[2]);
    while (exponent < 31 && greatest / (double)power_of_two((int)exponent - 24) >= 511.5) {
        exponent++;
    }
    uint32_t texel = exponent << 27;
    for (int c = 0; c < 3; c++) {
        const double mantissa = rgb[c] / (double)power_of_two((int)exponent - 24) + 0.5;
        texel |= (uint32_t)fmin(fmax(mantissa, 0.0), 511.0) << (9 * c);
    }
    int32_t encoded;
    memcpy(&encoded, &texel, sizeof encoded);
    return encoded;
}

// Computes some rows of a level.
static void make_level_rows(void *context, int task, int worker) {
    (void)worker;
    const Maker *maker = context;
    const int cells = level_cells[maker->level];
    for (int row = task * ROWS_OF_TASK; row < (task + 1) * ROWS_OF_TASK && row <= cells; row++) {
        for (int column = 0; column <= cells; column++) {
            double direction[3];
            double sum[3] = {0.0, 0.0, 0.0};
            unfold(2.0 * column / cells - 1.0, 2.0 * row / cells - 1.0, direction);
            if (maker->level) {
                blur(maker, direction, sum);
            } else {
                add_map(&maker->maps[0], direction, 1.0, sum);
            }
            maker->out->texels[maker->out->first[maker->level] + row * (cells + 1) + column] =
                encode(sum);
        }
    }
}

static bool make(const DipEnvironmentDef *def, DipPool *pool, Maker *maker) {
    DipPbrSample points[DIP_PBR_SAMPLES];
    if (!shrink(def, &maker->source) || !make_maps(maker, pool)) {
        return false;
    }
    make_soft_light(&maker->source, maker->out->soft_lin);
    dip_pbr_samples_make(points);
    for (int level = 0; level < DIP_ENVIRONMENT_LEVELS; level++) {
        const double steps = DIP_ENVIRONMENT_LEVELS - 1;
        maker->level = level;
        make_lobe(points, level / steps, &maker->lobes[level]); // the first one stays unused
        dip_pool_run(pool, level_cells[level] / ROWS_OF_TASK + 1, make_level_rows, maker);
    }
    return true;
}

DipEnvironmentMap *dip_environment_map_create(const DipEnvironmentDef *def, DipPool *pool) {
    size_t texels = 0;
    for (int level = 0; level < DIP_ENVIRONMENT_LEVELS; level++) {
        texels += (size_t)(level_cells[level] + 1) * (size_t)(level_cells[level] + 1);
    }
    Maker *maker = calloc(1, sizeof *maker);
    DipEnvironmentMap *map = calloc(1, sizeof *map + texels * sizeof *map->texels);
    bool made = maker && map;
    if (made) {
        int32_t first = 0;
        for (int level = 0; level < DIP_ENVIRONMENT_LEVELS; level++) {
            map->cells[level] = level_cells[level];
            map->first[level] = first;
            first += (level_cells[level] + 1) * (level_cells[level] + 1);
        }
        maker->out = map;
        made = make(def, pool, maker);
    }
    for (int m = 0; maker && m < MAPS; m++) {
        free(maker->maps[m].rgb);
    }
    free(maker ? maker->source.rgb : NULL);
    free(maker);
    if (!made) {
        free(map);
        map = NULL;
    }
    return map;
}
