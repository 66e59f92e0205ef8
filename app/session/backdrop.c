// Makes the sphere that shows an environment. The positions of its vertices are computed with
// renderer/base/trig.h, so the sphere is the same on every machine.
#include "app/session/backdrop.h"

#include "app/session/added_surface.h"
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
static void fill_vertices(const DipExtent *extent, float *positions) {
    float *uv = positions + 3 * VERTICES;
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
            rgba8[4 * i + c] = codes->code[(int)(light * DIP_LINEAR16_MAX + 0.5)];
        }
        rgba8[4 * i + 3] = 255;
    }
}

static void add_sphere(DipBackdrop *backdrop, const DipEnvironmentDef *environment) {
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    dip_scene_def_add_surface(&backdrop->def,
                              &(DipTextureDef){.name = "environment",
                                               .width = environment->width,
                                               .height = environment->height,
                                               .rgba8 = backdrop->rgba8,
                                               .encoding = DIP_ENCODING_SRGB,
                                               .wrap_u = DIP_WRAP_REPEAT,
                                               .wrap_v = DIP_WRAP_CLAMP},
                              white,
                              &(DipMeshDef){.name = "environment",
                                            .vertex_count = VERTICES,
                                            .positions = backdrop->positions,
                                            .uv0 = backdrop->positions + 3 * VERTICES,
                                            .index_count = 6 * ROWS * COLUMNS,
                                            .indices = backdrop->indices});
}

DipBackdrop *dip_backdrop_create(const DipSceneDef *def, const DipExtent *extent, DipError *err) {
    const DipEnvironmentDef *environment = def->environment;
    const size_t texels = (size_t)environment->width * (size_t)environment->height;
    DipBackdrop *backdrop = calloc(1, sizeof *backdrop);
    DipSrgbEncodeTable *codes = malloc(sizeof *codes);
    bool made = backdrop && codes && dip_scene_def_begin_surface(def, &backdrop->def);
    if (made) {
        backdrop->rgba8 = malloc(4 * texels);
        backdrop->positions = malloc(5 * VERTICES * sizeof *backdrop->positions);
        backdrop->indices = malloc((size_t)6 * ROWS * COLUMNS * sizeof *backdrop->indices);
        made = backdrop->rgba8 && backdrop->positions && backdrop->indices;
    }
    if (made) {
        dip_srgb_encode_table(codes);
        fill_vertices(extent, backdrop->positions);
        fill_indices(backdrop->indices);
        fill_picture(environment, codes, backdrop->rgba8);
        add_sphere(backdrop, environment);
    } else {
        dip_backdrop_destroy(&backdrop);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "environment", "out of memory");
    }
    free(codes);
    return backdrop;
}

void dip_backdrop_destroy(DipBackdrop **backdrop) {
    if (*backdrop) {
        dip_scene_def_free_surface(&(*backdrop)->def);
        free((*backdrop)->rgba8);
        free((*backdrop)->positions);
        free((*backdrop)->indices);
        free(*backdrop);
        *backdrop = NULL;
    }
}
