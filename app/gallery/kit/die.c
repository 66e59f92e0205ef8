// Makes the shape of a die and paints its texture.
#include "app/gallery/kit/kit.h"

enum { FACES = 6 };

bool dip_kit_die_shape(DipShape *box, DipError *err) {
    // Index of the square of the texture that each face of the box shows: +x, -x, +y, -y, +z, -z.
    static const int squares[FACES] = {0, 5, 1, 4, 2, 3};
    static const float size[3] = {1.0f, 1.0f, 1.0f};
    const float width = 1.0f / FACES;
    const bool made = dip_shape_box(box, size, err);
    for (uint32_t v = 0; v < box->vertex_count; v++) {
        float *u = box->attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES + DIP_SHAPE_TEXTURE;
        *u = width * ((float)squares[v / 4] + *u);
    }
    return made;
}

// Returns how deep a face with `pips` pips is at the point u, v: 1 within a pip, 0 outside of all
// pips.
static float pip_at(int pips, float u, float v) {
    // [pips - 1]: bit 3 * row + column is set if that cell of a 3x3 grid has a pip.
    static const int patterns[FACES] = {0x010, 0x101, 0x111, 0x145, 0x155, 0x16d};
    float deepest = 0.0f;
    for (int cell = 0; cell < 9; cell++) {
        if (patterns[pips - 1] >> cell & 1) {
            const float du = u - (0.24f + 0.26f * (float)(cell % 3));
            const float dv = v - (0.24f + 0.26f * (float)(cell / 3));
            const float depth = dip_kit_smooth(0.100f, 0.086f, sqrtf(du * du + dv * dv));
            deepest = dip_kit_greatest(depth, deepest);
        }
    }
    return deepest;
}

void dip_kit_paint_die(float u, float v, float rgba[4]) {
    const int face = (int)(u * FACES);
    const float along = u * FACES - (float)face;
    const float edge = dip_kit_least(dip_kit_to_edge(along), dip_kit_to_edge(v));
    const float pip = pip_at(face + 1, along, v);
    const float body = 0.80f + 0.12f * dip_kit_smooth(0.0f, 0.07f, edge);
    rgba[0] = dip_kit_mix(body, face ? 0.07f : 0.62f, pip); // The single pip is red.
    rgba[1] = dip_kit_mix(0.98f * body, 0.06f, pip);
    rgba[2] = dip_kit_mix(0.93f * body, 0.08f, pip);
}
