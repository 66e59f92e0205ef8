// Draws the gallery scene "phone": a mobile phone and a die behind it. It comes from seed 001;
// gallery.h says what a seed is.
//
// The phone is a box, as the die is. All faces of the phone show the same texture, which is
// therefore stretched on the narrow sides. The display is a quad just above the box. In the seed,
// the display shows a picture that the phone took. Here it shows what the phone's camera sees: a
// first pass draws the die and the table from the position of that camera, and the display's shader
// samples this picture, the photo.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"
#include "renderer/base/pages.h"

enum { PHOTO_WIDTH = 288, PHOTO_HEIGHT = 512 };
enum { DIE, TABLE, BODY, DISPLAY, OBJECTS, PHOTO_OBJECTS = BODY };

#define BODY_SIZE                                                                                  \
    { 0.92f, 1.72f, 0.10f }
static const float body_size[3] = BODY_SIZE;

typedef struct Uniforms {
    DipKitObject object;
    DipTarget photo; // The picture that the display shows.
} Uniforms;

typedef struct Content {
    DipPipeline *pipeline; // Pipeline of the photo's size.
    DipTarget photo;
} Content;

// --- shaders -------------------------------------------------------------------------------------

static void shade(DipFragmentBatch *batch) {
    static const DipKitLight lights[2] = {{.kind = DIP_KIT_DIRECTIONAL,
                                           .direction = {-0.48f, -0.64f, -0.60f},
                                           .colour = {0.92f, 0.86f, 0.76f}},
                                          {.kind = DIP_KIT_POINT,
                                           .position = {-3.0f, 2.5f, 2.5f},
                                           .colour = {0.35f, 0.5f, 0.8f},
                                           .reach = 3.0f}};
    static const DipKitMaterial white = {{1.0f, 1.0f, 1.0f}, {0.22f, 0.22f, 0.22f}, 5};
    static const float ambient[3] = {0.16f, 0.16f, 0.16f};
    static const float own_colour[3] = {1.0f, 1.0f, 1.0f};
    float light[3][DIP_FRAGMENT_BATCH];
    dip_kit_light_fragments(batch, ambient, lights, 2, &white, light);
    dip_kit_light_texture(batch, own_colour, light);
}

// Shows the photo, darkens the lower part of the photo, and shows a shutter button there.
static void shade_display(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float *u = batch->varying[DIP_KIT_UV];
    const float *v = batch->varying[DIP_KIT_UV + 1];
    batch->sample_target(batch, &uniforms->photo, u, v, batch->colour);
    for (int i = 0; i < batch->count; i++) {
        const float du = (u[i] - 0.5f) * 0.5f;
        const float dv = v[i] - 0.91f;
        const float from_button = sqrtf(du * du + dv * dv);
        const float button = dip_kit_smooth(0.040f, 0.036f, from_button) -
                             0.7f * dip_kit_smooth(0.032f, 0.030f, from_button) +
                             0.7f * dip_kit_smooth(0.027f, 0.025f, from_button);
        const float bar = v[i] > 0.82f ? 0.35f : 1.0f;
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = dip_kit_mix(batch->colour[c][i] * bar, 0.9f, button);
        }
    }
}

// --- content -------------------------------------------------------------------------------------

// Paints dark brushed metal with a lens and a lamp, as on a phone's back.
static void paint_body(float u, float v, float rgba[4]) {
    const float brushed = dip_kit_turbulence(u * 4.0f, v * 96.0f, 96, 3, 2);
    const float x = (u - 0.5f) * 0.55f;
    const float lens = sqrtf(x * x + (v - 0.14f) * (v - 0.14f));
    const float lamp = sqrtf((x - 0.1f) * (x - 0.1f) + (v - 0.14f) * (v - 0.14f));
    const float ring = dip_kit_smooth(0.060f, 0.056f, lens);
    const float glass = dip_kit_smooth(0.046f, 0.042f, lens);
    const float light = 0.17f + 0.10f * brushed;
    rgba[0] = dip_kit_mix(dip_kit_mix(light, 0.55f, ring), 0.03f, glass);
    rgba[1] = dip_kit_mix(dip_kit_mix(light, 0.55f, ring), 0.05f, glass);
    rgba[2] = dip_kit_mix(dip_kit_mix(1.1f * light, 0.57f, ring), 0.11f, glass);
    for (int c = 0; c < 3; c++) {
        rgba[c] = dip_kit_mix(rgba[c], 0.92f, dip_kit_smooth(0.018f, 0.015f, lamp));
    }
}

// Paints the planks of a table.
static void paint_table(float u, float v, float rgba[4]) {
    const float plank = u * 8.0f;
    const float edge = dip_kit_smooth(0.0f, 0.02f, dip_kit_to_edge(plank));
    const float grain = dip_kit_turbulence(u * 128.0f, v * 8.0f, 128, 4, 9);
    const float light = (0.5f + 0.2f * dip_kit_random((int)plank, 1, 1) + 0.25f * (grain - 0.5f)) *
                        (0.3f + 0.7f * edge);
    rgba[0] = 1.20f * light;
    rgba[1] = 0.86f * light;
    rgba[2] = 0.58f * light;
}

static void destroy(void *pointer) {
    Content *content = pointer;
    dip_pipeline_destroy(&content->pipeline);
    dip_lines_free(content->photo.rgba8);
}

static bool create(DipGalleryRoom *room, DipError *err) {
    Content *content = room->content;
    content->pipeline =
        dip_pipeline_create(room->def->pool, room->def->isa, PHOTO_WIDTH, PHOTO_HEIGHT, err);
    return content->pipeline &&
           dip_kit_target(&content->photo, PHOTO_WIDTH, PHOTO_HEIGHT, "phone", err);
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){.eye = {1.1 * dip_sin(turn), 1.75 + 0.25 * dip_cos(turn), 3.6},
                              .target = {0.15, 0.72, 0.0}};
}

// Returns the matrix that takes an object to world space. The phone turns to and fro, and the
// display lies on the phone.
static DipMatrix place(int object, double turn) {
    if (object == TABLE) {
        return dip_matrix_identity();
    }
    if (object == DIE) {
        return dip_kit_chain3(
            dip_matrix_translation(1.35, 0.92 + 0.12 * dip_sin(3.0 * turn), -1.35),
            dip_matrix_rotation(0, 0.7), dip_matrix_rotation(1, 2.0 * turn));
    }
    const double lift = object == DISPLAY ? 0.5 * (double)body_size[2] + 0.002 : 0.0;
    return dip_kit_chain3(dip_matrix_translation(-0.45, 0.5 * (double)body_size[1], 0.55),
                          dip_matrix_rotation(1, 0.25 + 0.45 * dip_sin(turn)),
                          dip_matrix_translation(0.0, 0.0, lift));
}

// Adds the first `count` objects to the list. The display has no texture; it shows the photo.
static void add_objects(DipKitList *list, int count, DipSampler *samplers) {
    const DipGalleryView *view = list->view;
    const Uniforms uniforms = {.photo = ((const Content *)view->content)->photo};
    for (int i = 0; i < count; i++) {
        const DipMatrix model = place(i, view->turn);
        DipDraw *draw = dip_kit_add(list, view->stock->meshes[i], &uniforms, &model,
                                    i == DISPLAY ? shade_display : shade);
        if (i != DISPLAY) {
            samplers[i] = dip_kit_sampler(view, &view->stock->textures[i]);
            draw->samplers = &samplers[i];
        }
    }
}

// Draws the photo: the die and the table as the phone's camera sees them. Always uses four samples
// per pixel.
static bool take_photo(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.30f, 0.38f, 0.50f};
    static const DipGalleryCamera from = {.eye = {-0.45, 1.45, 1.0}, .target = {1.30, 0.80, -1.35}};
    const Content *content = view->content;
    const DipPerspective lens = {
        .fov_deg = 50.0, .aspect = (double)PHOTO_WIDTH / PHOTO_HEIGHT, .near_distance = 0.1};
    DipKitList list = {.view = view, .err = err};
    DipSampler samplers[PHOTO_OBJECTS];
    list.failed = !dip_kit_look_at(&list.seen, &from, &lens, err);
    add_objects(&list, PHOTO_OBJECTS, samplers);
    DipPass pass = dip_kit_pass(view, list.draws, list.count, clear_lin);
    pass.target = content->photo;
    pass.sample_count = 4;
    pass.samples_per_group = 0;
    return !list.failed && dip_kit_draw(view, content->pipeline, &pass, err);
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.10f, 0.12f, 0.16f};
    DipSampler samplers[OBJECTS];
    DipKitList list = dip_kit_list(view, 0.1, err);
    add_objects(&list, OBJECTS, samplers);
    return take_photo(view, err) && dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_phone = {
    .info = {.name = "phone",
             .title = "Mobile phone",
             .text =
                 "A phone made of one box and one quad. Its display shows a target that another "
                 "pass has drawn.",
             DIP_KIT_LOOKS("live picture")},
    .meshes = {[DIE] = {.shape = DIP_KIT_DIE},
               [TABLE] = {DIP_KIT_PLANE, {12.0f, 12.0f, 8, 8}},
               [BODY] = {DIP_KIT_BOX, BODY_SIZE},
               [DISPLAY] = {DIP_KIT_QUAD, {0.84f, 1.50f}}},
    .textures = {[DIE] = DIP_KIT_DIE_TEXTURE,
                 [TABLE] = {"table", 512, 512, DIP_WRAP_CLAMP, paint_table},
                 [BODY] = {"body", 256, 512, DIP_WRAP_CLAMP, paint_body}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .destroy = destroy,
    .draw = draw,
};
