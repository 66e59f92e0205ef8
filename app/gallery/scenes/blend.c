// The gallery scene "blend": the blend modes of seed 001, side by side.
//
// Four columns show four modes. In each field lie a blue sheet and a yellow one with the seed's
// colours and alphas, over grey chequers. The upper row draws blue first and yellow second; the
// lower row draws them the other way round. The two rows look the same where the order does not
// matter, and differ where it does. All sheets lie in one plane, so they do not test depth: the
// picture shows submission order alone.
#include "app/gallery/kit/kit.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"

#include <string.h>

enum { MODES = 4, ROWS = 2, FIELDS = MODES * ROWS, SHEETS = 2, DRAWS = 1 + FIELDS * (1 + SHEETS) };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3]; // linear light
    float alpha;
} Uniforms;

typedef struct Content {
    DipKitStock stock; // A quad of 2 by 2 units, facing +z, and the chequers' texture.
    Uniforms uniforms[DRAWS];
} Content;

static const DipBlend modes[MODES] = {
    DIP_BLEND_MODE_ALPHA,
    DIP_BLEND_MODE_ADDITIVE,
    DIP_BLEND_MODE_MULTIPLICATIVE,
    DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE,
};

static const char *const looks[] = {"as in the seed", "alpha 0.5 for both", "alpha that breathes"};

// --- shaders -------------------------------------------------------------------------------------

static void shade_chequers(DipFragmentBatch *batch) {
    batch->sample_colour(batch, &batch->samplers[0], DIP_KIT_UV, batch->colour);
}

// A sheet has one colour. Its rim is a little more opaque, so that its shape shows in every mode.
static void shade_sheet(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float u = fabsf(batch->varying[DIP_KIT_UV][i] - 0.5f);
        const float v = fabsf(batch->varying[DIP_KIT_UV + 1][i] - 0.5f);
        const float rim = dip_kit_smooth(0.46f, 0.48f, u > v ? u : v);
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = dip_kit_mix(uniforms->colour[c], 0.2f, 0.5f * rim);
        }
        batch->alpha[i] = dip_kit_mix(uniforms->alpha, 1.0f, 0.5f * rim);
    }
}

static void shade_board(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        const float v = batch->varying[DIP_KIT_UV + 1][i];
        batch->colour[0][i] = 0.020f + 0.025f * v;
        batch->colour[1][i] = 0.024f + 0.035f * v;
        batch->colour[2][i] = 0.034f + 0.060f * v;
    }
}

// --- content -------------------------------------------------------------------------------------

static void paint_chequers(float u, float v, float rgba[4]) {
    const int field = (int)(u * 8.0f) + (int)(v * 8.0f);
    const float grey = field % 2 ? 0.56f : 0.44f; // about the seed's background of 0.5
    for (int c = 0; c < 3; c++) {
        rgba[c] = grey;
    }
}

static bool create(void *content, const DipGalleryRoom *room, DipError *err) {
    DipKitStock *stock = content;
    (void)room;
    return dip_kit_quad(&stock->meshes[0], 2.0f, 2.0f, err) &&
           dip_kit_texture(&stock->textures[0], "chequers", 256, 256, true, paint_chequers, err);
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {1.7 * dip_sin(turn), 0.6 * dip_sin(2.0 * turn), 6.7 - 0.3 * dip_cos(turn)},
        .target = {0.35 * dip_sin(turn), 0.0, 0.0}};
}

// Returns where a sheet lies in its field: both circle about the field's middle, half a turn apart.
static DipMatrix sheet_matrix(double x, double y, int sheet, double turn) {
    const double angle = 2.0 * turn + DIP_PI * sheet;
    const DipMatrix move =
        dip_matrix_translation(x + 0.27 * dip_cos(angle), y + 0.36 * dip_sin(angle), 0.0);
    const DipMatrix rotation = dip_matrix_rotation(2, (sheet ? -1.0 : 1.0) * turn);
    const DipMatrix size = dip_matrix_scaling(0.45, 0.6, 1.0);
    return dip_matrix_multiply3(&move, &rotation, &size);
}

static void set_sheet(Uniforms *uniforms, int sheet, const DipGalleryView *view) {
    static const float colours[SHEETS][3] = {{0.0f, 0.0f, 1.0f}, {1.0f, 1.0f, 0.0f}};
    const float breath = (float)(0.5 - 0.4 * dip_cos(3.0 * view->turn));
    const float alphas[SHEETS] = {view->look == 0   ? 1.0f
                                  : view->look == 1 ? 0.5f
                                                    : breath,
                                  view->look == 2 ? 1.0f - breath : 0.5f};
    memcpy(uniforms->colour, colours[sheet], sizeof uniforms->colour);
    uniforms->alpha = alphas[sheet];
}

static bool draw(void *pointer, const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.012f, 0.014f, 0.02f};
    Content *content = pointer;
    const DipMesh *quad = content->stock.meshes[0];
    const DipSampler sampler = dip_kit_sampler(view, &content->stock.textures[0]);
    DipKitList list = dip_kit_list(view, 0.1, err);
    DipDrawState states[MODES];
    for (int m = 0; m < MODES; m++) {
        states[m] =
            (DipDrawState){.blend = modes[m], .depth_test = DIP_DEPTH_ALWAYS, .keep_depth = true};
    }
    const DipMatrix back = dip_matrix_translation(0.0, 0.0, -0.02);
    const DipMatrix wide = dip_matrix_scaling(3.5, 2.5, 1.0);
    const DipMatrix board = dip_matrix_multiply(&back, &wide);
    Uniforms *uniforms = content->uniforms;
    dip_kit_add(&list, quad, uniforms++, &board, shade_board);
    for (int f = 0; f < FIELDS; f++) {
        const int row = f / MODES;
        const double x = 1.7 * (f % MODES) - 2.55;
        const double y = row ? -1.2 : 1.2;
        const DipMatrix move = dip_matrix_translation(x, y, 0.0);
        const DipMatrix size = dip_matrix_scaling(0.79, 1.12, 1.0);
        const DipMatrix field = dip_matrix_multiply(&move, &size);
        dip_kit_add(&list, quad, uniforms++, &field, shade_chequers)->samplers = &sampler;
        for (int s = 0; s < SHEETS; s++, uniforms++) {
            const int sheet = row ? SHEETS - 1 - s : s; // The lower row draws sheet 1 first.
            const DipMatrix model = sheet_matrix(x, y, sheet, view->turn);
            DipDraw *sheet_draw = dip_kit_add(&list, quad, uniforms, &model, shade_sheet);
            set_sheet(uniforms, sheet, view);
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
             .looks = looks,
             .look_count = (int)DIP_ARRAY_COUNT(looks)},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .draw = draw,
};
