// Draws the gallery scene "blend": four blend modes side by side. It comes from seed 001; gallery.h
// says what a seed is.
//
// Four columns and two rows make eight fields. Each column shows one mode. In each field, a blue
// and a yellow quad (the sheets) lie over grey chequers. The upper row draws blue first and yellow
// second; the lower row draws yellow first. The two rows look the same for modes in which the order
// does not matter. All sheets lie in one plane and do not test depth, so only the order of the
// draws decides what is on top.
#include "app/gallery/kit/kit.h"

enum { MODES = 4, ROWS = 2, FIELDS = MODES * ROWS, SHEETS = 2 };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3]; // Linear light.
    float alpha;
} Uniforms;

#define SHEET_STATE(mode)                                                                          \
    { .blend = mode, .depth_test = DIP_DEPTH_ALWAYS, .keep_depth = true }
static const DipDrawState states[MODES] = {
    SHEET_STATE(DIP_BLEND_MODE_ALPHA),
    SHEET_STATE(DIP_BLEND_MODE_ADDITIVE),
    SHEET_STATE(DIP_BLEND_MODE_MULTIPLICATIVE),
    SHEET_STATE(DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE),
};

// --- shaders -------------------------------------------------------------------------------------

static void shade_chequers(DipFragmentBatch *batch) {
    batch->sample_colour(batch, &batch->samplers[0], DIP_KIT_UV, batch->colour);
}

// Shades a sheet in one colour. The rim is greyer and more opaque, so that the sheet's shape
// shows in every mode.
static void shade_sheet(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float u = fabsf(batch->varying[DIP_KIT_UV][i] - 0.5f);
        const float v = fabsf(batch->varying[DIP_KIT_UV + 1][i] - 0.5f);
        const float rim = dip_kit_smooth(0.46f, 0.48f, dip_kit_greatest(u, v));
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = dip_kit_mix(uniforms->colour[c], 0.2f, 0.5f * rim);
        }
        batch->alpha[i] = dip_kit_mix(uniforms->alpha, 1.0f, 0.5f * rim);
    }
}

static void shade_board(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        const float v = batch->varying[DIP_KIT_UV + 1][i];
        dip_kit_set(batch->colour, i, 0.020f + 0.025f * v, 0.024f + 0.035f * v,
                    0.034f + 0.060f * v);
    }
}

// --- content -------------------------------------------------------------------------------------

static void paint_chequers(float u, float v, float rgba[4]) {
    const int field = (int)(u * 8.0f) + (int)(v * 8.0f);
    rgba[0] = rgba[1] = rgba[2] = field % 2 ? 0.56f : 0.44f; // The seed's background is 0.5.
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {1.7 * dip_sin(turn), 0.6 * dip_sin(2.0 * turn), 6.7 - 0.3 * dip_cos(turn)},
        .target = {0.35 * dip_sin(turn), 0.0, 0.0}};
}

// Returns the matrix that takes a sheet to world space. The two sheets of a field circle about the
// field's middle, half a turn apart. `x` and `y` are the coordinates of this middle.
static DipMatrix sheet_matrix(double x, double y, int sheet, double turn) {
    const double angle = 2.0 * turn + DIP_PI * sheet;
    return dip_kit_chain3(
        dip_matrix_translation(x + 0.27 * dip_cos(angle), y + 0.36 * dip_sin(angle), 0.0),
        dip_matrix_rotation(2, (sheet ? -1.0 : 1.0) * turn), dip_matrix_scaling(0.45, 0.6, 1.0));
}

static Uniforms sheet_look(int sheet, const DipGalleryView *view) {
    const float breath = (float)(0.5 - 0.4 * dip_cos(3.0 * view->turn));
    const float alphas[][SHEETS] = {{1.0f, 0.5f}, {0.5f, 0.5f}, {breath, 1.0f - breath}};
    const float alpha = alphas[view->look][sheet];
    return sheet ? (Uniforms){.colour = {1.0f, 1.0f, 0.0f}, .alpha = alpha}
                 : (Uniforms){.colour = {0.0f, 0.0f, 1.0f}, .alpha = alpha};
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.012f, 0.014f, 0.02f};
    static const DipKitObject plain;
    const DipMesh *quad = view->stock->meshes[0];
    const DipSampler sampler = dip_kit_sampler(view, &view->stock->textures[0]);
    DipKitList list = dip_kit_list(view, 0.1, err);
    const DipMatrix board =
        dip_kit_chain(dip_matrix_translation(0.0, 0.0, -0.02), dip_matrix_scaling(3.5, 2.5, 1.0));
    dip_kit_add(&list, quad, &plain, &board, shade_board);
    for (int f = 0; f < FIELDS; f++) {
        const int row = f / MODES;
        const double x = 1.7 * (f % MODES) - 2.55;
        const double y = row ? -1.2 : 1.2;
        const DipMatrix field =
            dip_kit_chain(dip_matrix_translation(x, y, 0.0), dip_matrix_scaling(0.79, 1.12, 1.0));
        dip_kit_add(&list, quad, &plain, &field, shade_chequers)->samplers = &sampler;
        for (int s = 0; s < SHEETS; s++) {
            const int sheet = row ? SHEETS - 1 - s : s; // The lower row draws sheet 1 first.
            const DipMatrix model = sheet_matrix(x, y, sheet, view->turn);
            const Uniforms look = sheet_look(sheet, view);
            DipDraw *sheet_draw = dip_kit_add(&list, quad, &look, &model, shade_sheet);
            sheet_draw->state = &states[f % MODES];
            sheet_draw->cull = DIP_CULL_NONE;
        }
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_blend = {
    .info = {.name = "blend",
             .title = "Blend modes",
             .text =
                 "Alpha, additive, multiplicative and double multiplicative blending, from left "
                 "to right. The upper row draws blue before yellow, the lower row yellow "
                 "before blue.",
             DIP_KIT_LOOKS("as in the seed", "alpha 0.5 for both", "alpha that breathes")},
    .meshes = {{DIP_KIT_QUAD, {2.0f, 2.0f}}},
    .textures = {{"chequers", 256, 256, DIP_WRAP_CLAMP, paint_chequers}},
    .camera = camera,
    .draw = draw,
};
