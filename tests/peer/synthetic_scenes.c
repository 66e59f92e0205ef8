// A room of a few large triangles, and a relief with vertex colours.
#include "tests/peer/synthetic_scenes.h"

#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>

// A parallelogram, given by a corner and two edges in metres. Its front is the side from which the
// turn from edge 0 to edge 1 is counter-clockwise. The texture repeats every four metres.
typedef struct Wall {
    float corner[3];
    float edge[2][3];
} Wall;

static void add_wall(DipSynthetic *s, const Wall *wall, uint32_t index) {
    static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t vertex = 4 * index + i;
        const float along[2] = {i == 1 || i == 2 ? 1.0f : 0.0f, i >= 2 ? 1.0f : 0.0f};
        for (int e = 0; e < 2; e++) {
            const float *edge = wall->edge[e];
            const float length = sqrtf(edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]);
            s->uv[2 * vertex + (uint32_t)e] = along[e] * length / 4.0f;
        }
        for (uint32_t axis = 0; axis < 3; axis++) {
            s->positions[3 * vertex + axis] = wall->corner[axis] + along[0] * wall->edge[0][axis] +
                                              along[1] * wall->edge[1][axis];
        }
    }
    for (uint32_t i = 0; i < 6; i++) {
        s->indices[6 * index + i] = 4 * index + corners[i];
    }
}

DipSynthetic *dip_peer_room(DipError *err) {
    // A box of 12 x 4 x 8 metres around the origin, facing inwards, and two screens.
    static const Wall walls[] = {
        {{-6, -2, 4}, {{12, 0, 0}, {0, 0, -8}}},   {{-6, 2, -4}, {{12, 0, 0}, {0, 0, 8}}},
        {{-6, -2, -4}, {{12, 0, 0}, {0, 4, 0}}},   {{6, -2, 4}, {{-12, 0, 0}, {0, 4, 0}}},
        {{6, -2, -4}, {{0, 0, 8}, {0, 4, 0}}},     {{-6, -2, 4}, {{0, 0, -8}, {0, 4, 0}}},
        {{-3, -1, -2.5f}, {{3, 0, 1}, {0, 2, 0}}}, {{4, -1.5f, 1}, {{-3, 0, 2}, {0.5f, 3, 0}}},
    };
    enum { WALLS = sizeof walls / sizeof *walls, KEYS = 16 };
    DipSynthetic *s = dip_synthetic_create(4 * WALLS, 6 * WALLS, err);
    if (!s) {
        return NULL;
    }
    for (uint32_t i = 0; i < WALLS; i++) {
        add_wall(s, &walls[i], i);
    }
    s->material.double_sided = true;
    DipCamKey keys[KEYS];
    for (int i = 0; i < KEYS; i++) {
        const double half_turn = DIP_PI * i / KEYS;
        keys[i] = (DipCamKey){{0.3, 0.1, 0.4}, {0, dip_sin(half_turn), 0, dip_cos(half_turn)}};
    }
    if (!dip_campath_create(keys, KEYS, 500000000, &s->path, err)) {
        dip_synthetic_destroy(&s);
    }
    return s;
}

DipSynthetic *dip_peer_coloured_relief(int triangle_count, double fov_y_deg, double aspect,
                                       double turn_deg, float **colours_lin, DipError *err) {
    DipSynthetic *s = dip_synthetic_relief(triangle_count, fov_y_deg, aspect, turn_deg, err);
    *colours_lin = s ? malloc(sizeof(float) * 3 * s->mesh.vertex_count) : NULL;
    if (s && !*colours_lin) {
        dip_synthetic_destroy(&s);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--scene", "out of memory");
    }
    for (uint32_t i = 0; s && i < 3 * s->mesh.vertex_count; i++) {
        const float *position = &s->positions[i / 3 * 3];
        const double phase = 1.5 * (double)position[0] - 2.0 * (double)position[1] + i % 3;
        (*colours_lin)[i] = (float)(0.5 + 0.4 * dip_sin(phase));
    }
    if (s) {
        s->material.colour_texture = DIP_NO_TEXTURE;
        s->mesh.uv0 = NULL;
        s->mesh.colours_lin = *colours_lin;
    }
    return s;
}
