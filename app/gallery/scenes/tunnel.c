// Draws the gallery scene "tunnel", which shows what anisotropic filtering does. Seed 002 asks for
// the filtering settings; gallery.h says what a seed is.
//
// The camera flies through a long tube of stone. The wall appears in the picture at every angle,
// and far away its texels look very long and narrow. In two of the three looks (the scene's
// variants), the colours show which mip level each pixel reads: dark red is the sharpest, then red,
// orange, yellow, green, blue and purple. With anisotropic filtering, the sharp levels reach
// farther. Without advanced filtering (aaf=off), the sharp levels reach less far at the diagonals,
// because the level then depends on the angle. With advanced filtering, every ring has one colour.
#include "app/gallery/kit/kit.h"

enum { SIDES = 96, ROUND = 6 };

// The tube lies along z. Its texture repeats ROUND times around it and once in each unit of length.
static const float length = 120.0f;

typedef struct Uniforms {
    DipKitObject object;
    float tint; // 0 for stone, 0.5 for mip colours over stone, 1.5 for mip colours.
} Uniforms;

// --- shaders -------------------------------------------------------------------------------------

// Reads the stone's texture and the mip colours in one call. The light weakens with the distance
// from the camera.
static void shade(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const DipSampler *const samplers[2] = {&batch->samplers[0], &batch->samplers[1]};
    float levels[3][DIP_FRAGMENT_BATCH];
    float(*const out[2])[DIP_FRAGMENT_BATCH] = {batch->colour, levels};
    batch->sample_colours(batch, samplers, DIP_KIT_UV, out);
    const float *z = batch->varying[DIP_KIT_WORLD + 2];
    for (int i = 0; i < batch->count; i++) {
        const float distance = uniforms->object.eye[2] - z[i];
        const float light = 1.25f / (1.0f + 0.0035f * distance * distance);
        const float stone =
            (batch->colour[0][i] + batch->colour[1][i] + batch->colour[2][i]) * 1.1f;
        for (int c = 0; c < 3; c++) {
            const float tinted = levels[c][i] * dip_kit_mix(stone, 0.8f, uniforms->tint - 0.5f);
            const float shown = uniforms->tint > 0.0f ? tinted : batch->colour[c][i];
            batch->colour[c][i] = shown * light;
        }
    }
}

// --- content -------------------------------------------------------------------------------------

// Paints rows of stone blocks with dark joints. Each block has another brightness.
static void paint_stone(float u, float v, float rgba[4]) {
    const int course = (int)(v * 4.0f);
    const float along = u * 4.0f + (course % 2 ? 0.5f : 0.0f);
    const float edge = dip_kit_least(dip_kit_to_edge(along), dip_kit_to_edge(v * 4.0f));
    const float block = dip_kit_random((int)along % 4, course, 7);
    const float grain = dip_kit_turbulence(u * 16.0f, v * 16.0f, 16, 5, 3);
    const float light =
        (0.50f + 0.22f * block + 0.35f * (grain - 0.5f)) * dip_kit_smooth(0.01f, 0.06f, edge) +
        0.12f;
    rgba[0] = light * 1.03f;
    rgba[1] = light * 0.97f;
    rgba[2] = light * 0.88f;
}

// Makes the tube from the sides of a prism, which are turned to lie along z.
static bool create(DipGalleryRoom *room, DipError *err) {
    DipShape shape;
    if (!dip_shape_prism(&shape, 1.0f, length, SIDES, true, err)) {
        return false;
    }
    shape.vertex_count = 4 * SIDES; // The two bases come after the sides.
    shape.index_count = 6 * SIDES;
    for (uint32_t v = 0; v < shape.vertex_count; v++) {
        float *vertex = shape.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES;
        const float along = vertex[1];
        vertex[1] = vertex[2];
        vertex[2] = -along - 0.5f * length + 2.0f;
        vertex[DIP_SHAPE_TEXTURE] *= ROUND;
        vertex[DIP_SHAPE_TEXTURE + 1] *= length;
    }
    return dip_kit_mesh(&room->stock.meshes[0], "tube", &shape, err);
}

// --- drawing -------------------------------------------------------------------------------------

// Returns a camera near the axis of the tube that looks along the axis, a little to the side. The
// tube moves instead of the camera. In one loop the tube moves by a whole number of the texture's
// repeats.
static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){.eye = {0.25 * dip_cos(turn), 0.25 * dip_sin(turn), 0.0},
                              .target = {0.6 * dip_sin(turn), 0.4 * dip_sin(2.0 * turn), -10.0}};
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.0f, 0.0f, 0.0f};
    static const float tints[] = {0.5f, 0.0f, 1.5f};
    const Uniforms uniforms = {.tint = tints[view->look]};
    const double travelled = 12.0 * view->time_s / DIP_GALLERY_SECONDS;
    const DipMatrix model =
        dip_kit_chain(dip_matrix_translation(0.0, 0.0, travelled - (int)travelled),
                      dip_matrix_rotation(2, view->turn));
    DipKitList list = dip_kit_list(view, 0.02, err);
    DipSampler samplers[2];
    samplers[0] = samplers[1] = dip_kit_sampler(view, &view->stock->textures[0]);
    dip_kit_show_mip_colours(&samplers[1], view);
    DipDraw *tube = dip_kit_add(&list, view->stock->meshes[0], &uniforms, &model, shade);
    tube->cull = DIP_CULL_FRONT; // The camera sees the tube from inside.
    tube->repeating_varyings = 1u << DIP_KIT_UV | 1u << (DIP_KIT_UV + 1);
    tube->samplers = samplers;
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_tunnel = {
    .info = {.name = "tunnel",
             .title = "Anisotropy tunnel",
             .text = "A tube whose colours show the mip level of each pixel. Compare af=16 with "
                     "af=none, and af=16,aaf=on with af=16.",
             DIP_KIT_LOOKS("mip colours over stone", "stone", "mip colours")},
    .textures = {{"stone", 512, 512, DIP_WRAP_REPEAT, paint_stone}},
    .camera = camera,
    .create = create,
    .draw = draw,
};
