// Makes the sphere that shows an environment. The positions of its vertices are computed with
// renderer/base/trig.h, so the sphere is the same on every machine.
#include "app/session/backdrop.h"

#include "renderer/base/srgb.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>

// Columns and rows of the sphere's grid. In the middle between two vertices, the picture is off by
// up to 0.02 degrees.
enum { COLUMNS = 128, ROWS = 64, VERTICES = (COLUMNS + 1) * (ROWS + 1) };

// The sphere's radius, in sizes of the scene. From a camera that is 5 sizes away from the middle,
// the picture is off by up to 0.3 degrees.
static const double radius_in_sizes = 1000.0;

// Fills the rows of vertices from the top of the picture to its bottom.
static void fill_vertices(const DipExtent *extent, float *positions, float *uv) {
    double size2 = 0.0;
    for (int i = 0; i < 3; i++) {
        const double side = extent->high[i] - extent->low[i];
        size2 += side * side;
    }
    const double radius = radius_in_sizes * (size2 > 0.0 ? sqrt(size2) : 1.0);
    for (int v = 0; v < VERTICES; v++) {
        const double turn = (double)(v % (COLUMNS + 1)) / COLUMNS;
        const double fall = (double)(v / (COLUMNS + 1)) / ROWS;
        const double azimuth = 2.0 * DIP_PI * (turn - 0.5);
        const double across = dip_sin(DIP_PI * fall);
        const double towards[3] = {across * dip_cos(azimuth), dip_cos(DIP_PI * fall),
                                   across * dip_sin(azimuth)};
        for (int i = 0; i < 3; i++) {
            const double middle = 0.5 * (extent->low[i] + extent->high[i]);
            positions[3 * v + i] = (float)(middle + radius * towards[i]);
        }
        uv[2 * v] = (float)turn;
        uv[2 * v + 1] = (float)fall;
    }
}

static void fill_indices(uint32_t *indices) {
    for (uint32_t row = 0; row < ROWS; row++) {
        for (uint32_t column = 0; column < COLUMNS; column++) {
            const uint32_t left = row * (COLUMNS + 1) + column;
            const uint32_t below = left + COLUMNS + 1;
            const uint32_t corners[6] = {left, below, left + 1, left + 1, below, below + 1};
            for (int i = 0; i < 6; i++) {
                *indices++ = corners[i];
            }
        }
    }
}

static void fill_picture(const DipEnvironmentDef *environment, const DipSrgbEncodeTable *codes,
                         uint8_t *rgba8) {
    const size_t texels = (size_t)environment->width * (size_t)environment->height;
    for (size_t i = 0; i < texels; i++) {
        for (size_t c = 0; c < 3; c++) {
            const double light = fmin((double)environment->rgb_lin[3 * i + c], 1.0);
            rgba8[4 * i + c] = dip_srgb_code(codes, (int)(light * DIP_LINEAR16_MAX + 0.5));
        }
        rgba8[4 * i + 3] = 255;
    }
}

DipAddedSurface *dip_backdrop_create(const DipSceneDef *def, const DipExtent *extent,
                                     DipError *err) {
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    const DipEnvironmentDef *environment = def->environment;
    const DipTextureDef picture = {.name = "environment",
                                   .width = environment->width,
                                   .height = environment->height,
                                   .encoding = DIP_ENCODING_SRGB,
                                   .wrap_u = DIP_WRAP_REPEAT,
                                   .wrap_v = DIP_WRAP_CLAMP};
    const DipMeshDef sphere = {
        .name = "environment", .vertex_count = VERTICES, .index_count = 6 * ROWS * COLUMNS};
    DipAddedSurface *backdrop = dip_added_surface_create(def, &picture, white, &sphere, err);
    if (!backdrop) {
        return NULL;
    }
    DipSrgbEncodeTable *codes = malloc(sizeof *codes);
    if (codes) {
        dip_srgb_encode_table(codes);
        fill_vertices(extent, backdrop->positions, backdrop->uv);
        fill_indices(backdrop->indices);
        fill_picture(environment, codes, backdrop->rgba8);
    } else {
        dip_added_surface_destroy(&backdrop);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, sphere.name, "out of memory");
    }
    free(codes);
    return backdrop;
}
