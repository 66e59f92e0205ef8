// The die's mesh and texture.
#include "app/gallery/kit/die.h"

enum { FACES = 6, FACE_TEXELS = 128 };

bool dip_kit_die(DipMesh **mesh, DipError *err) {
    // The texture's square for each face of a box: +x, -x, +y, -y, +z, -z.
    static const int squares[FACES] = {0, 5, 1, 4, 2, 3};
    static const float size[3] = {1.0f, 1.0f, 1.0f};
    const float width = 1.0f / FACES;
    DipShape box;
    if (!dip_shape_box(&box, size, err)) {
        return false;
    }
    for (uint32_t v = 0; v < box.vertex_count; v++) {
        float *u = box.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES + DIP_SHAPE_TEXTURE;
        *u = width * ((float)squares[v / 4] + *u);
    }
    return dip_kit_mesh(mesh, "die", &box, err);
}

// Returns how deep the nearest pip of a face is at a point of the face: 1 within it, 0 outside.
static float pip_at(int pips, float u, float v) {
    // Bit 3 * row + column of a 3x3 grid, for one to six pips.
    static const int patterns[FACES] = {0x010, 0x101, 0x111, 0x145, 0x155, 0x16d};
    float deepest = 0.0f;
    for (int place = 0; place < 9; place++) {
        if (patterns[pips - 1] >> place & 1) {
            const float du = u - (0.24f + 0.26f * (float)(place % 3));
            const float dv = v - (0.24f + 0.26f * (float)(place / 3));
            const float depth = dip_kit_smooth(0.100f, 0.086f, sqrtf(du * du + dv * dv));
            deepest = depth > deepest ? depth : deepest;
        }
    }
    return deepest;
}

static void paint(float u, float v, float rgba[4]) {
    const int face = (int)(u * FACES);
    const float along = u * FACES - (float)face;
    const float to_u = along < 0.5f ? along : 1.0f - along;
    const float to_v = v < 0.5f ? v : 1.0f - v;
    const float edge = to_u < to_v ? to_u : to_v;
    const float pip = pip_at(face + 1, along, v);
    const float body = 0.80f + 0.12f * dip_kit_smooth(0.0f, 0.07f, edge);
    rgba[0] = dip_kit_mix(body, face ? 0.07f : 0.62f, pip); // the single pip is red
    rgba[1] = dip_kit_mix(0.98f * body, 0.06f, pip);
    rgba[2] = dip_kit_mix(0.93f * body, 0.08f, pip);
}

bool dip_kit_die_texture(DipKitTexture *texture, DipError *err) {
    return dip_kit_texture(texture, "die", FACES * FACE_TEXELS, FACE_TEXELS, true, paint, err);
}
