// The gallery scene "dice": textured dice, as in seed 001.
//
// One texture holds the six faces side by side. The texture coordinates of each face are those of a
// whole picture, mapped to its sixth of the width. Small mip levels therefore mix neighbouring
// faces, which shows on the far dice with a strong mip bias. The soft shadows on the felt are quads
// with multiplicative blending.
#include "app/gallery/kit/die.h"
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"

#include <string.h>

enum { DIE, TABLE, SHADOW }; // Meshes.
enum { FACES, FELT };        // Textures.
enum { DICE = 9, RINGS = 3 };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3];
    float height; // shadows: height of the die above the table
} Uniforms;

typedef struct Content {
    DipKitStock stock;
    Uniforms table;
    Uniforms dice[DICE];
    Uniforms shadows[DICE];
} Content;

static const char *const looks[] = {"rolling dice"};

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

// The product with the target's colour darkens it: 1 leaves it as it is.
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

// Green felt with a fine grain and a printed border.
static void paint_felt(float u, float v, float rgba[4]) {
    const float grain = dip_kit_turbulence(u * 64.0f, v * 64.0f, 64, 3, 11);
    const float x = fabsf(u - 0.5f);
    const float z = fabsf(v - 0.5f);
    const float out = x > z ? x : z;
    const float line = dip_kit_smooth(0.004f, 0.002f, fabsf(out - 0.40f)) +
                       dip_kit_smooth(0.002f, 0.001f, fabsf(out - 0.412f));
    const float light = 0.80f + 0.28f * (grain - 0.5f);
    const float shown = line > 1.0f ? 1.0f : line;
    rgba[0] = dip_kit_mix(0.10f, 0.85f, shown) * light;
    rgba[1] = dip_kit_mix(0.46f, 0.78f, shown) * light;
    rgba[2] = dip_kit_mix(0.27f, 0.45f, shown) * light;
}

static bool create(void *content, const DipGalleryRoom *room, DipError *err) {
    DipKitStock *stock = content;
    (void)room;
    return dip_kit_die(&stock->meshes[DIE], err) &&
           dip_kit_plane(&stock->meshes[TABLE], 16.0f, 16.0f, 16, 16, err) &&
           dip_kit_plane(&stock->meshes[SHADOW], 1.9f, 1.9f, 1, 1, err) &&
           dip_kit_die_texture(&stock->textures[FACES], err) &&
           dip_kit_texture(&stock->textures[FELT], "felt", 512, 512, true, paint_felt, err);
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {6.8 * dip_sin(turn), 3.2 + 0.9 * dip_sin(2.0 * turn), 6.8 * dip_cos(turn)},
        .target = {0.0, 0.5, 0.0}};
}

// The dice hop over the table in three rings; each turns about its own axes while it is in the air.
static DipMatrix place_die(int index, double turn, double position[3]) {
    const int ring = index % RINGS;
    const double angle = (ring == 1 ? -turn : turn) + 2.0 * DIP_PI * index / DICE;
    const double radius = 1.1 + 1.25 * ring;
    const double hop = dip_sin(5.0 * turn + 2.1 * index);
    position[0] = radius * dip_cos(angle);
    position[1] = 0.90 + 1.3 * hop * hop;
    position[2] = radius * dip_sin(angle);
    const DipMatrix move = dip_matrix_translation(position[0], position[1], position[2]);
    const DipMatrix spin_x = dip_matrix_rotation(0, (2.0 + ring) * turn + index);
    const DipMatrix spin_z = dip_matrix_rotation(2, 3.0 * turn + 0.7 * index);
    return dip_matrix_multiply3(&move, &spin_x, &spin_z);
}

static bool draw(void *pointer, const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.006f, 0.006f, 0.009f};
    static const float colours[RINGS][3] = {
        {1.0f, 1.0f, 1.0f}, {1.0f, 0.42f, 0.36f}, {0.50f, 0.68f, 1.0f}};
    static const DipDrawState darken = {.blend = DIP_BLEND_MODE_MULTIPLICATIVE, .keep_depth = true};
    Content *content = pointer;
    DipMesh *const *meshes = content->stock.meshes;
    DipMatrix under[DICE];
    const DipSampler felt = dip_kit_sampler(view, &content->stock.textures[FELT]);
    const DipSampler faces = dip_kit_sampler(view, &content->stock.textures[FACES]);
    const DipMatrix identity = dip_matrix_identity();
    DipKitList list = dip_kit_list(view, 0.1, err);
    memcpy(content->table.colour, colours[0], sizeof colours[0]);
    dip_kit_add(&list, meshes[TABLE], &content->table, &identity, shade)->samplers = &felt;
    for (int i = 0; i < DICE; i++) {
        double position[3];
        Uniforms *die = &content->dice[i];
        const DipMatrix model = place_die(i, view->turn, position);
        under[i] = dip_matrix_translation(position[0], 0.002 * (i + 1), position[2]);
        memcpy(die->colour, colours[i % RINGS], sizeof die->colour);
        content->shadows[i].height = (float)position[1];
        dip_kit_add(&list, meshes[DIE], die, &model, shade)->samplers = &faces;
    }
    for (int i = 0; i < DICE; i++) {
        dip_kit_add(&list, meshes[SHADOW], &content->shadows[i], &under[i], shade_shadow)->state =
            &darken;
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_dice = {
    .info = {.name = "dice",
             .title = "Dice",
             .text =
                 "Dice whose six faces are parts of one texture, over a felt table with blended "
                 "shadows.",
             .looks = looks,
             .look_count = (int)DIP_ARRAY_COUNT(looks)},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .draw = draw,
};
