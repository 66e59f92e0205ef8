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

#include <stdlib.h>

enum { DICE = 9, DRAWS = 1 + 2 * DICE };

typedef struct Uniforms {
    DipKitObject object;
    float colour[3];
    float height; // shadows: height of the die above the table
} Uniforms;

typedef struct Content {
    DipMesh *die;
    DipMesh *table;
    DipMesh *shadow;
    DipKitTexture faces;
    DipKitTexture felt;
    Uniforms uniforms[DRAWS];
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
    const Uniforms *uniforms = batch->uniforms;
    float normals[3][DIP_FRAGMENT_BATCH];
    float light[3][DIP_FRAGMENT_BATCH];
    const DipKitPoints points = dip_kit_fragment_points(batch, uniforms->object.eye, normals);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            light[c][i] = 0.15f;
        }
    }
    for (int l = 0; l < 2; l++) {
        dip_kit_light_add(&lights[l], &white, &points, NULL, light);
    }
    batch->sample_colour(batch, &batch->samplers[0], DIP_KIT_UV, batch->colour);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] *= uniforms->colour[c] * light[c][i];
        }
    }
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
static void paint_felt(const void *context, float u, float v, float rgba[4]) {
    (void)context;
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

static void destroy(void *pointer) {
    Content *content = pointer;
    dip_mesh_destroy(&content->die);
    dip_mesh_destroy(&content->table);
    dip_mesh_destroy(&content->shadow);
    dip_kit_texture_free(&content->faces);
    dip_kit_texture_free(&content->felt);
    free(content);
}

static void *create(const DipGalleryRoom *room, DipError *err) {
    (void)room;
    DipShape shape;
    Content *content = dip_kit_content(sizeof *content, "dice", err);
    if (!content) {
        return NULL;
    }
    content->die = dip_kit_die_mesh(err);
    content->table =
        dip_kit_mesh("table", &shape, dip_shape_plane(&shape, 16.0f, 16.0f, 16, 16, err), err);
    content->shadow =
        dip_kit_mesh("shadow", &shape, dip_shape_plane(&shape, 1.9f, 1.9f, 1, 1, err), err);
    if (!content->die || !content->table || !content->shadow ||
        !dip_kit_die_texture(&content->faces, err) ||
        !dip_kit_texture(&content->felt, "felt", 512, 512, true, paint_felt, NULL, err)) {
        destroy(content);
        return NULL;
    }
    return content;
}

// --- drawing -------------------------------------------------------------------------------------

static void camera(double phase, double eye[3], double target[3]) {
    const double turn = 2.0 * DIP_PI * phase;
    eye[0] = 6.8 * dip_sin(turn);
    eye[1] = 3.2 + 0.9 * dip_sin(2.0 * turn);
    eye[2] = 6.8 * dip_cos(turn);
    target[0] = target[2] = 0.0;
    target[1] = 0.5;
}

// The dice hop over the table in three rings; each turns about its own axes while it is in the air.
static DipMatrix place_die(int index, double time_s, double position[3]) {
    const double turn = 2.0 * DIP_PI * time_s / DIP_GALLERY_SECONDS;
    const int ring = index % 3;
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

static void set_colour(Uniforms *uniforms, const float colour[3]) {
    for (int c = 0; c < 3; c++) {
        uniforms->colour[c] = colour[c];
    }
}

static bool draw(void *pointer, const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.006f, 0.006f, 0.009f};
    static const float colours[3][3] = {
        {1.0f, 1.0f, 1.0f}, {1.0f, 0.42f, 0.36f}, {0.50f, 0.68f, 1.0f}};
    static const DipDrawState darken = {.blend = DIP_BLEND_MODE_MULTIPLICATIVE, .keep_depth = true};
    Content *content = pointer;
    DipKitCamera seen;
    DipDraw draws[DRAWS];
    const DipSampler felt = dip_kit_sampler(view, &content->felt);
    const DipSampler faces = dip_kit_sampler(view, &content->faces);
    const DipMatrix identity = dip_matrix_identity();
    Uniforms *uniforms = content->uniforms;
    set_colour(&uniforms[0], colours[0]);
    bool made =
        dip_kit_camera(&seen, view->pose, view->target.width, view->target.height, 0.1, err) &&
        dip_kit_object(&uniforms[0].object, &seen, &identity, err);
    draws[0] = dip_kit_object_draw(content->table, &uniforms[0], shade);
    draws[0].samplers = &felt;
    for (int i = 0; made && i < DICE; i++) {
        double position[3];
        Uniforms *die = &uniforms[1 + i];
        Uniforms *shadow = &uniforms[1 + DICE + i];
        const DipMatrix model = place_die(i, view->time_s, position);
        const DipMatrix under = dip_matrix_translation(position[0], 0.002 * (i + 1), position[2]);
        set_colour(die, colours[i % 3]);
        shadow->height = (float)position[1];
        made = dip_kit_object(&die->object, &seen, &model, err) &&
               dip_kit_object(&shadow->object, &seen, &under, err);
        draws[1 + i] = dip_kit_object_draw(content->die, die, shade);
        draws[1 + i].samplers = &faces;
        draws[1 + DICE + i] = dip_kit_object_draw(content->shadow, shadow, shade_shadow);
        draws[1 + DICE + i].state = &darken;
    }
    const DipPass pass = dip_kit_pass(view, draws, DRAWS, clear_lin);
    return made && dip_kit_draw(view, view->pipeline, &pass, err);
}

const DipGalleryScene dip_gallery_dice = {
    .info = {.name = "dice",
             .title = "Dice",
             .seed = "seed 001, Texturing the dice",
             .text =
                 "Dice whose six faces are parts of one texture, over a felt table with blended "
                 "shadows.",
             .looks = looks,
             .look_count = (int)DIP_ARRAY_COUNT(looks)},
    .camera = camera,
    .create = create,
    .destroy = destroy,
    .draw = draw,
};
