// Makes scenes of one mesh, one material and one texture, among them a relief, whose mesh is wavy.
#include "app/bench/synthetic.h"

#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTURE_SIZE = 1024 };

// Returns a hash of two numbers, which is the same on every machine.
static uint32_t hash(uint32_t x, uint32_t y) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

// Paints squares with sides of 64, 16 and 4 texels in random colours, so that mip levels 0 to 6
// have detail.
static void paint(uint8_t *rgba8) {
    for (uint32_t y = 0; y < TEXTURE_SIZE; y++) {
        for (uint32_t x = 0; x < TEXTURE_SIZE; x++) {
            uint8_t *texel = rgba8 + 4 * ((size_t)y * TEXTURE_SIZE + x);
            const uint32_t coarse = hash(x / 64, y / 64);
            const uint32_t middle = hash(x / 16 + 1000, y / 16);
            const uint32_t fine = hash(x / 4 + 2000, y / 4);
            for (int c = 0; c < 3; c++) {
                texel[c] = (uint8_t)(40 + (coarse >> 8 * c & 127) + (middle >> 8 * c & 31) +
                                     (fine >> 8 * c & 31));
            }
            texel[3] = 255;
        }
    }
}

DipSynthetic *dip_synthetic_create(uint32_t vertex_count, uint32_t index_count, DipError *err) {
    DipSynthetic *s = calloc(1, sizeof *s);
    if (s) {
        s->rgba8 = malloc((size_t)TEXTURE_SIZE * TEXTURE_SIZE * 4);
        s->positions = malloc(sizeof(float) * 3 * vertex_count);
        s->normals = malloc(sizeof(float) * 3 * vertex_count);
        s->uv = malloc(sizeof(float) * 2 * vertex_count);
        s->indices = malloc(sizeof(uint32_t) * index_count);
    }
    if (!s || !s->rgba8 || !s->positions || !s->normals || !s->uv || !s->indices) {
        dip_synthetic_destroy(&s);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
        return NULL;
    }
    paint(s->rgba8);
    s->texture = (DipTextureDef){
        .name = "squares", .width = TEXTURE_SIZE, .height = TEXTURE_SIZE, .rgba8 = s->rgba8};
    s->material = (DipMaterialDef){.name = "squares",
                                   .surface = DIP_SURFACE_OPAQUE,
                                   .base_colour_lin = {0.9f, 0.9f, 0.9f},
                                   .colour_texture = 0,
                                   .light_map = DIP_NO_TEXTURE,
                                   .normal_map = DIP_NO_TEXTURE,
                                   .light_map_scale = 1.0f};
    s->mesh = (DipMeshDef){.name = "mesh",
                           .vertex_count = vertex_count,
                           .positions = s->positions,
                           .uv0 = s->uv,
                           .index_count = index_count,
                           .indices = s->indices};
    s->object = (DipObjectDef){"object", 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    s->def = (DipSceneDef){.textures = &s->texture,
                           .materials = &s->material,
                           .meshes = &s->mesh,
                           .objects = &s->object,
                           .texture_count = 1,
                           .material_count = 1,
                           .mesh_count = 1,
                           .object_count = 1,
                           .background_lin = {0.1f, 0.2f, 0.4f},
                           .near_m = 0.1f};
    return s;
}

void dip_synthetic_destroy(DipSynthetic **synthetic) {
    DipSynthetic *s = *synthetic;
    if (s) {
        dip_campath_destroy(&s->path);
        free(s->rgba8);
        free(s->positions);
        free(s->normals);
        free(s->uv);
        free(s->indices);
        free(s);
        *synthetic = NULL;
    }
}

enum { RELIEF_DISTANCE_M = 10 };

// Sets the position, the normal and the texture coordinates of one vertex of the relief. The waves
// rise and fall by at most 0.2 m, which is 2 % of the camera's distance.
static void set_corner(DipSynthetic *s, uint32_t vertex, double x, double y) {
    const double height = 0.1 * dip_sin(3.0 * x) + 0.1 * dip_cos(4.0 * y);
    const double slope[2] = {0.3 * dip_cos(3.0 * x), -0.4 * dip_sin(4.0 * y)};
    const double length = sqrt(slope[0] * slope[0] + slope[1] * slope[1] + 1.0);
    const double position[3] = {x, y, height};
    const double normal[3] = {-slope[0] / length, -slope[1] / length, 1.0 / length};
    for (uint32_t axis = 0; axis < 3; axis++) {
        s->positions[3 * vertex + axis] = (float)position[axis];
        s->normals[3 * vertex + axis] = (float)normal[axis];
    }
    s->uv[2 * vertex] = (float)(x / 4.0);
    s->uv[2 * vertex + 1] = (float)(-y / 4.0);
}

static void set_relief(DipSynthetic *s, int columns, int rows, double half_width,
                       double half_height) {
    uint32_t *index = s->indices;
    for (int j = 0; j <= rows; j++) {
        for (int i = 0; i <= columns; i++) {
            const uint32_t corner = (uint32_t)j * (uint32_t)(columns + 1) + (uint32_t)i;
            const uint32_t above = corner + (uint32_t)(columns + 1);
            set_corner(s, corner, half_width * (2.0 * i / columns - 1.0),
                       half_height * (2.0 * j / rows - 1.0));
            if (i < columns && j < rows) {
                const uint32_t cell[6] = {corner, corner + 1, above + 1, corner, above + 1, above};
                memcpy(index, cell, sizeof cell);
                index += 6;
            }
        }
    }
}

DipSynthetic *dip_synthetic_relief(int triangle_count, double fov_y_deg, double aspect,
                                   double turn_deg, DipError *err) {
    enum { KEYS = 8 };
    const int rows = (int)fmax(1.0, floor(sqrt(triangle_count / 2 / aspect) + 0.5));
    const int columns = (int)fmax(1.0, floor(triangle_count / 2.0 / rows + 0.5));
    DipSynthetic *s = dip_synthetic_create((uint32_t)(rows + 1) * (uint32_t)(columns + 1),
                                           6 * (uint32_t)rows * (uint32_t)columns, err);
    if (!s) {
        return NULL;
    }
    // The relief is 5 % smaller than the picture, because the crests of its waves are nearer to
    // the camera, and the camera sways by 1 % of half the relief's height.
    const double half_height = 0.95 * RELIEF_DISTANCE_M * dip_tan(fov_y_deg * (DIP_PI / 360.0));
    set_relief(s, columns, rows, half_height * aspect, half_height);
    s->material.lit = true;
    s->mesh.normals = s->normals;
    const double half_turn = turn_deg * (DIP_PI / 360.0);
    DipCamKey keys[KEYS];
    for (int i = 0; i < KEYS; i++) {
        const double angle = 2.0 * DIP_PI * i / KEYS;
        keys[i] = (DipCamKey){{0.01 * half_height * dip_cos(angle),
                               0.01 * half_height * dip_sin(angle), RELIEF_DISTANCE_M},
                              {0, dip_sin(half_turn), 0, dip_cos(half_turn)}};
    }
    if (!dip_campath_create(keys, KEYS, 500000000, &s->path, err)) {
        dip_synthetic_destroy(&s);
    }
    return s;
}
