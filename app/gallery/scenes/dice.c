// Draws the gallery scene "dice": textured dice that hop over a table. It comes from seed 001;
// gallery.h says what a seed is.
//
// One texture holds the six faces side by side, and each face reads a sixth of the texture's width.
// Small mip levels therefore mix neighbouring faces, which shows on the far dice if the mip bias is
// strong. The soft shadows on the felt are quads with multiplicative blending.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"

enum { DIE, TABLE, SHADOW }; // Meshes.
enum { FACES, FELT };        // Textures.
enum { DICE = 9, RINGS = 3 };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3];
    float height; // Height of the die's middle above the table. Used for shadows.
} Uniforms;

// --- shaders -------------------------------------------------------------------------------------

static void shade(DipFragmentBatch *batch) {
    static const DipKitLight lights[2] = {{.kind = DIP_KIT_SPOT,
                                           .position = {2.5f, 7.0f, 3.0f},
                                           .direction = {-0.3122f, -0.8742f, -0.3746f},
                                           .colour = {3.1f, 2.8f, 2.3f},
                                           .reach = 8.0f,
                                           .inner_cos = 0.90f,
                                           .outer_cos = 0.70f},
                                          {.kind = DIP_KIT_POINT,
                                           .position = {-5.0f, 3.0f, 4.0f},
                                           .colour = {0.25f, 0.35f, 0.6f},
                                           .reach = 6.0f}};
    static const DipKitMaterial white = {{1.0f, 1.0f, 1.0f}, {0.28f, 0.28f, 0.28f}, 6};
    static const float ambient[3] = {0.15f, 0.15f, 0.15f};
    float light[3][DIP_FRAGMENT_BATCH];
    dip_kit_light_fragments(batch, ambient, lights, 2, &white, light);
    dip_kit_light_texture(batch, ((const Uniforms *)batch->uniforms)->colour, light);
}

// Shades a shadow. Blending multiplies the target's colour by this colour, so values less than 1
// darken it.
static void shade_shadow(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float depth = 0.95f / (1.0f + 0.25f * uniforms->height);
    for (int i = 0; i < batch->count; i++) {
        const float u = 2.0f * batch->varying[DIP_KIT_UV][i] - 1.0f;
        const float v = 2.0f * batch->varying[DIP_KIT_UV + 1][i] - 1.0f;
        const float dark = depth * dip_kit_smooth(1.0f, 0.15f, sqrtf(u * u + v * v));
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = 1.0f - dark;
        }
    }
}

// --- content -------------------------------------------------------------------------------------

// Paints green felt with a fine grain and a printed border.
static void paint_felt(float u, float v, float rgba[4]) {
    const float grain = dip_kit_turbulence(u * 64.0f, v * 64.0f, 64, 3, 11);
    const float out = dip_kit_greatest(fabsf(u - 0.5f), fabsf(v - 0.5f));
    const float line = dip_kit_smooth(0.004f, 0.002f, fabsf(out - 0.40f)) +
                       dip_kit_smooth(0.002f, 0.001f, fabsf(out - 0.412f));
    const float light = 0.80f + 0.28f * (grain - 0.5f);
    const float shown = dip_kit_least(line, 1.0f);
    rgba[0] = dip_kit_mix(0.10f, 0.85f, shown) * light;
    rgba[1] = dip_kit_mix(0.46f, 0.78f, shown) * light;
    rgba[2] = dip_kit_mix(0.27f, 0.45f, shown) * light;
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {6.8 * dip_sin(turn), 3.2 + 0.9 * dip_sin(2.0 * turn), 6.8 * dip_cos(turn)},
        .target = {0.0, 0.5, 0.0}};
}

// Returns the matrix that takes a die to world space. The dice hop over the table in three rings
// and turn about two of their axes.
static DipMatrix place_die(int index, double turn, double position[3]) {
    const int ring = index % RINGS;
    const double angle = (ring == 1 ? -turn : turn) + 2.0 * DIP_PI * index / DICE;
    const double radius = 1.1 + 1.25 * ring;
    const double hop = dip_sin(5.0 * turn + 2.1 * index);
    position[0] = radius * dip_cos(angle);
    position[1] = 0.90 + 1.3 * hop * hop;
    position[2] = radius * dip_sin(angle);
    return dip_kit_chain3(dip_matrix_translation(position[0], position[1], position[2]),
                          dip_matrix_rotation(0, (2.0 + ring) * turn + index),
                          dip_matrix_rotation(2, 3.0 * turn + 0.7 * index));
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.006f, 0.006f, 0.009f};
    static const Uniforms looks[RINGS] = {{.colour = {1.0f, 1.0f, 1.0f}},
                                          {.colour = {1.0f, 0.42f, 0.36f}},
                                          {.colour = {0.50f, 0.68f, 1.0f}}};
    static const DipDrawState darken = {.blend = DIP_BLEND_MODE_MULTIPLICATIVE, .keep_depth = true};
    DipMesh *const *meshes = view->stock->meshes;
    double positions[DICE][3];
    const DipSampler felt = dip_kit_sampler(view, &view->stock->textures[FELT]);
    const DipSampler faces = dip_kit_sampler(view, &view->stock->textures[FACES]);
    const DipMatrix identity = dip_matrix_identity();
    DipKitList list = dip_kit_list(view, 0.1, err);
    dip_kit_add(&list, meshes[TABLE], &looks[0], &identity, shade)->samplers = &felt;
    for (int i = 0; i < DICE; i++) {
        const DipMatrix model = place_die(i, view->turn, positions[i]);
        dip_kit_add(&list, meshes[DIE], &looks[i % RINGS], &model, shade)->samplers = &faces;
    }
    for (int i = 0; i < DICE; i++) {
        const Uniforms shadow = {.height = (float)positions[i][1]};
        const DipMatrix under =
            dip_matrix_translation(positions[i][0], 0.002 * (i + 1), positions[i][2]);
        dip_kit_add(&list, meshes[SHADOW], &shadow, &under, shade_shadow)->state = &darken;
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_dice = {
    .info = {.name = "dice",
             .title = "Dice",
             .text =
                 "Dice whose six faces are parts of one texture, over a felt table with blended "
                 "shadows.",
             DIP_KIT_LOOKS("rolling dice")},
    .meshes = {[DIE] = {.shape = DIP_KIT_DIE},
               [TABLE] = {DIP_KIT_PLANE, {16.0f, 16.0f, 16, 16}},
               [SHADOW] = {DIP_KIT_PLANE, {1.9f, 1.9f, 1, 1}}},
    .textures =
        {[FACES] = DIP_KIT_DIE_TEXTURE, [FELT] = {"felt", 512, 512, DIP_WRAP_CLAMP, paint_felt}},
    .camera = camera,
    .draw = draw,
};
