// Draws the gallery scene "toon": toon shading with outlines. It comes from seed 001; gallery.h
// says what a seed is.
//
// The fragment shader replaces the smooth intensity of the light by steps: the seed's four, or a
// number of equal bands. The highlight has steps, too. Outlines need no stencil: the back faces
// of each object but the floor are drawn once more, a little larger and in a dark colour.
#include "app/gallery/kit/kit.h"

#include <string.h>

enum { KNOT, SPHERE, COLUMN, FLOOR, OBJECTS = 6, ALONG = 320, AROUND = 24 };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3];
    float light[3]; // Unit vector towards the light.
    int step_size;  // Size of the bands that divide 256 intensities; 0 for the seed's four steps.
    float grow;     // How far the outline moves vertices along their normals, at depth 1.
} Uniforms;

static const int step_sizes[] = {0, 32, 52, 16};

// --- shaders -------------------------------------------------------------------------------------

// Returns the seed's step for an intensity. The seed's author chose the steps by trying.
static float four_steps(float intensity) {
    return intensity > 0.95f ? 0.75f : intensity > 0.5f ? 0.7f : intensity > 0.1f ? 0.35f : 0.05f;
}

// Rounds an intensity 0..1 down to a multiple of step_size / 256, as the seed's variable banding
// does. An intensity less than 0.1 / 256 below a multiple counts as this multiple.
static float banded(float intensity, int step_size) {
    const int band = (int)(intensity * 256.0f + 0.1f) / step_size;
    return (float)(band * step_size) / 256.0f;
}

static void shade(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const DipKitVector eye = dip_kit_vector(uniforms->object.eye);
    const DipKitVector light = dip_kit_vector(uniforms->light);
    for (int i = 0; i < batch->count; i++) {
        const DipKitVector normal = dip_kit_get(batch->varying + DIP_KIT_NORMAL, i);
        const float unit = dip_kit_per_length(normal, 1e-30f);
        const float toward = unit * dip_kit_dot(normal, light);
        const DipKitVector to_eye =
            dip_kit_minus(eye, dip_kit_get(batch->varying + DIP_KIT_WORLD, i));
        const float e = dip_kit_per_length(to_eye, 0.0f);
        // The highlight depends on the cosine between the vector towards the eye and the mirrored
        // vector towards the light, 2 (n.l) n - l.
        const float along = unit * dip_kit_dot(normal, to_eye) * e;
        const float across = dip_kit_dot(light, to_eye) * e;
        const float mirrored = 2.0f * toward * along - across;
        const float peak = dip_kit_power(dip_kit_greatest(mirrored, 0.0f), 5);
        const float lit = dip_kit_greatest(toward, 0.0f);
        const int step = uniforms->step_size;
        const float diffuse = step ? banded(lit, step) : four_steps(lit);
        const float highlight = step ? banded(peak, step) : peak > 0.1f ? four_steps(peak) : 0.0f;
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] =
                uniforms->colour[c] * (0.18f + 0.95f * diffuse) + 0.55f * highlight;
        }
    }
}

static void shade_outline(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        dip_kit_set(batch->colour, i, 0.012f, 0.010f, 0.022f);
    }
}

// Moves each vertex along its normal, in proportion to its depth (w in clip space), so that
// outlines have the same width everywhere in the picture.
static void outline_vertex(const DipVertexBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float *m = uniforms->object.to_clip;
    for (int i = 0; i < batch->count; i++) {
        const float w =
            m[12] * batch->in[0][i] + m[13] * batch->in[1][i] + m[14] * batch->in[2][i] + m[15];
        const float grow = uniforms->grow * w;
        const float x = batch->in[0][i] + grow * batch->in[DIP_SHAPE_NORMAL][i];
        const float y = batch->in[1][i] + grow * batch->in[DIP_SHAPE_NORMAL + 1][i];
        const float z = batch->in[2][i] + grow * batch->in[DIP_SHAPE_NORMAL + 2][i];
        for (int r = 0; r < 4; r++) {
            batch->clip[r][i] = m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3];
        }
    }
}

// --- content -------------------------------------------------------------------------------------

// Writes a point of the trefoil knot's centre line.
static void knot_point(double t, double p[3]) {
    const double radius = 1.0 + 0.42 * dip_cos(3.0 * t);
    p[0] = radius * dip_cos(2.0 * t);
    p[1] = radius * dip_sin(2.0 * t);
    p[2] = 0.62 * dip_sin(3.0 * t);
}

static void normalise(double v[3]) {
    const double scale = 1.0 / sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        v[i] *= scale;
    }
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

// Writes a ring of vertices around the point t of the knot's centre line.
static void knot_ring(double t, float (*vertices)[DIP_SHAPE_ATTRIBUTES]) {
    double middle[3];
    double ahead[3];
    double side[3];
    double up[3];
    knot_point(t, middle);
    knot_point(t + 0.001, ahead);
    for (int i = 0; i < 3; i++) {
        side[i] = ahead[i] + middle[i]; // Points away from the knot's middle.
        ahead[i] -= middle[i];
    }
    cross(ahead, side, up);
    normalise(up);
    cross(up, ahead, side);
    normalise(side);
    for (int a = 0; a <= AROUND; a++) {
        const double angle = 2.0 * DIP_PI * a / AROUND;
        float *vertex = vertices[a];
        for (int i = 0; i < 3; i++) {
            const double out = dip_cos(angle) * side[i] + dip_sin(angle) * up[i];
            vertex[i] = (float)(middle[i] + 0.26 * out);
            vertex[DIP_SHAPE_NORMAL + i] = (float)out;
        }
        vertex[DIP_SHAPE_TEXTURE] = (float)(t / (2.0 * DIP_PI));
        vertex[DIP_SHAPE_TEXTURE + 1] = (float)a / AROUND;
    }
}

static bool create(DipGalleryRoom *room, DipError *err) {
    enum { COLUMNS = AROUND + 1 };
    static float vertices[(ALONG + 1) * COLUMNS][DIP_SHAPE_ATTRIBUTES];
    static uint32_t indices[ALONG * AROUND * 6];
    uint32_t count = 0;
    for (int l = 0; l <= ALONG; l++) {
        knot_ring(2.0 * DIP_PI * l / ALONG, vertices + l * COLUMNS);
    }
    for (uint32_t l = 0; l < ALONG; l++) {
        for (uint32_t a = 0; a < AROUND; a++) {
            const uint32_t corner = l * COLUMNS + a;
            const uint32_t quad[6] = {corner,     corner + 1,           corner + COLUMNS,
                                      corner + 1, corner + COLUMNS + 1, corner + COLUMNS};
            memcpy(indices + count, quad, sizeof quad);
            count += 6;
        }
    }
    const DipMeshData data = {
        "knot", &vertices[0][0], DIP_SHAPE_ATTRIBUTES, (ALONG + 1) * COLUMNS, indices, count};
    room->stock.meshes[KNOT] = dip_mesh_create(&data, err);
    return room->stock.meshes[KNOT] != NULL;
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){.eye = {1.8 * dip_sin(turn), 1.7 + 0.4 * dip_cos(turn), 6.4},
                              .target = {0.0, 0.55, 0.0}};
}

static DipMatrix place(int index, double turn, int *mesh, float colour[3]) {
    static const float colours[OBJECTS][3] = {{0.78f, 0.07f, 0.05f}, {0.05f, 0.28f, 0.75f},
                                              {0.90f, 0.48f, 0.03f}, {0.08f, 0.45f, 0.13f},
                                              {0.28f, 0.18f, 0.48f}, {0.60f, 0.68f, 0.70f}};
    memcpy(colour, colours[index], sizeof colours[index]);
    if (index == 0) {
        *mesh = KNOT;
        return dip_kit_chain3(dip_matrix_translation(0.0, 1.05, 0.0), dip_matrix_rotation(1, turn),
                              dip_matrix_rotation(0, 0.5 * dip_sin(turn)));
    }
    if (index < 4) {
        const double angle = -turn + 2.0 * DIP_PI * index / 3.0;
        const double jump = dip_sin(4.0 * turn + index);
        *mesh = SPHERE;
        return dip_matrix_translation(2.5 * dip_cos(angle), -0.45 + 0.7 * jump * jump,
                                      2.5 * dip_sin(angle));
    }
    *mesh = index == 4 ? COLUMN : FLOOR;
    return dip_matrix_translation(0.0, index == 4 ? -0.75 : -1.0, 0.0);
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.62f, 0.74f, 0.80f};
    DipKitList list = dip_kit_list(view, 0.1, err);
    const double side = 0.55 * dip_sin(view->turn);
    const double size = sqrt(side * side + 0.64 + 0.49);
    for (int i = 0; i < OBJECTS; i++) {
        Uniforms uniforms = {
            .light = {(float)(side / size), (float)(0.8 / size), (float)(0.7 / size)},
            .step_size = step_sizes[view->look],
            .grow = 0.0042f};
        int index;
        const DipMatrix model = place(i, view->turn, &index, uniforms.colour);
        const DipMesh *mesh = view->stock->meshes[index];
        dip_kit_add(&list, mesh, &uniforms, &model, shade);
        if (index != FLOOR) {
            DipDraw *outline = dip_kit_add(&list, mesh, &uniforms, &model, shade_outline);
            outline->vertex_shader = outline_vertex;
            outline->varying_count = outline->value_only_varying_count = 0;
            outline->bounds_to_clip = NULL; // The moved vertices leave the mesh's box, so the draw
                                            // is not culled by this box.
            outline->cull = DIP_CULL_FRONT;
        }
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_toon = {
    .info = {.name = "toon",
             .title = "Toon shading",
             .text = "Light in steps: the seed's four, or a number of equal bands, for the diffuse "
                     "part and for the highlight. Outlines are grown back faces.",
             DIP_KIT_LOOKS("four steps", "8 bands", "5 bands", "16 bands")},
    .meshes = {[SPHERE] = {DIP_KIT_SPHERE, {0.55f, 64, 32}},
               [COLUMN] = {DIP_KIT_PRISM, {1.3f, 0.5f, 48, 1}},
               [FLOOR] = {DIP_KIT_PLANE, {40.0f, 40.0f, 8, 8}}},
    .camera = camera,
    .create = create,
    .draw = draw,
};
