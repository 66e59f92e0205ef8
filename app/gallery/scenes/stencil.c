// Draws the gallery scene "stencil": a mirror and an outline, made with the stencil buffer. It
// comes from seed 001; gallery.h says what a seed is.
//
// The mirror in the floor is drawn in three steps. First, its surface writes 1 into the stencil
// buffer and no colour. Then the objects are drawn upside down, but only where the stencil value is
// 1. Last, the glass is blended over the mirrored objects. For the outline, the middle object
// writes 2, and is then drawn a little larger and in one colour where the stencil value is not 2. A
// small picture in the corner, the inset, shows the stencil values that the mirror and the middle
// object write, each value in another colour.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"

#include <string.h>

enum { SPHERE, BOX, PRISM, PLANE, QUAD };
enum { OBJECTS = 5, OUTLINED = 0, MIRROR_VALUE = 1, OUTLINE_VALUE = 2 };

typedef struct Uniforms {
    DipKitObject object;
    DipKitMaterial material;
    float alpha;
} Uniforms;

#define FACE(test, result)                                                                         \
    { test, DIP_STENCIL_KEEP, DIP_STENCIL_KEEP, result }
#define STENCIL(value, test, result)                                                               \
    {                                                                                              \
        .enabled = true, .reference = value, .read_mask = 0xff, .write_mask = 0xff,                \
        .front = FACE(test, result), .back = FACE(test, result)                                    \
    }
#define EQUAL(value) STENCIL(value, DIP_COMPARE_EQUAL, DIP_STENCIL_KEEP)

enum { NO_COLOUR = DIP_CHANNEL_RED | DIP_CHANNEL_GREEN | DIP_CHANNEL_BLUE | DIP_CHANNEL_ALPHA };

// Writes the mirror's stencil value but no depth, so that the mirrored objects, which lie below the
// floor, pass the depth test.
static const DipDrawState mark_mirror = {
    .kept_channels = NO_COLOUR,
    .keep_depth = true,
    .stencil = STENCIL(MIRROR_VALUE, DIP_COMPARE_ALWAYS, DIP_STENCIL_REPLACE)};
static const DipDrawState inside_mirror = {.stencil = EQUAL(MIRROR_VALUE)};
// The glass replaces the depths of the mirrored objects by its own.
static const DipDrawState glass = {
    .blend = DIP_BLEND_MODE_ALPHA, .depth_test = DIP_DEPTH_ALWAYS, .stencil = EQUAL(MIRROR_VALUE)};
static const DipDrawState mark_object = {
    .stencil = STENCIL(OUTLINE_VALUE, DIP_COMPARE_ALWAYS, DIP_STENCIL_REPLACE)};
static const DipDrawState outside_object = {
    .blend = DIP_BLEND_MODE_ALPHA,
    .keep_depth = true,
    .stencil = STENCIL(OUTLINE_VALUE, DIP_COMPARE_NOT_EQUAL, DIP_STENCIL_KEEP)};
static const DipDrawState plain_ordered = {.ordered = true};
// The states that draw the inset. Each fills the pixels that have one particular stencil value.
static const DipDrawState fills[] = {
    {.depth_test = DIP_DEPTH_ALWAYS, .stencil = EQUAL(0)},
    {.depth_test = DIP_DEPTH_ALWAYS, .stencil = EQUAL(MIRROR_VALUE)},
    {.depth_test = DIP_DEPTH_ALWAYS, .stencil = EQUAL(OUTLINE_VALUE)}};

// --- shaders -------------------------------------------------------------------------------------

static void shade(DipFragmentBatch *batch) {
    static const DipKitLight sun = {.kind = DIP_KIT_DIRECTIONAL,
                                    .direction = {-0.48f, -0.80f, -0.36f},
                                    .colour = {0.85f, 0.80f, 0.72f}};
    static const float sky[3] = {0.20f, 0.24f, 0.30f};
    const Uniforms *uniforms = batch->uniforms;
    float normals[3][DIP_FRAGMENT_BATCH];
    const DipKitPoints points = dip_kit_fragment_points(batch, normals);
    dip_kit_light_sky(sky, 0.75f, &uniforms->material, &points, batch->colour);
    dip_kit_light_add(&sun, &uniforms->material, &points, NULL, batch->colour);
}

static void shade_flat(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = uniforms->material.diffuse[c];
        }
        batch->alpha[i] = uniforms->alpha;
    }
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {7.0 * dip_sin(turn), 4.3 + 0.5 * dip_sin(2.0 * turn), 7.0 * dip_cos(turn)},
        .target = {0.0, 0.6, 0.0}};
}

// Returns the matrix that takes object `index` to world space. Sets *mesh and *material to those of
// the object.
static DipMatrix place(int index, double turn, int *mesh, DipKitMaterial *material) {
    static const float colours[OBJECTS][3] = {{0.80f, 0.16f, 0.13f},
                                              {0.16f, 0.42f, 0.75f},
                                              {0.86f, 0.60f, 0.14f},
                                              {0.22f, 0.58f, 0.34f},
                                              {0.60f, 0.30f, 0.68f}};
    const double angle = 2.0 * DIP_PI * (index - 1) / (OBJECTS - 1) + 2.0 * turn + 0.4;
    const double radius = index == OUTLINED ? 0.0 : 2.35;
    const double height = index == OUTLINED ? 1.9 : 1.3;
    *mesh = index == OUTLINED ? PRISM : index % 2 ? SPHERE : BOX;
    *material = (DipKitMaterial){.specular = {0.5f, 0.5f, 0.5f}, .exponent_doubled = 6};
    memcpy(material->diffuse, colours[index], sizeof material->diffuse);
    return dip_kit_chain3(dip_matrix_translation(radius * dip_cos(angle),
                                                 height + 0.25 * dip_sin(3.0 * turn + 1.6 * index),
                                                 radius * dip_sin(angle)),
                          dip_matrix_rotation(1, 3.0 * turn + index),
                          dip_matrix_rotation(0, 0.5 + 2.0 * turn));
}

// Adds a draw with this state to the list and returns it.
static DipDraw *add(DipKitList *list, int mesh, const DipMatrix *model, const Uniforms *look,
                    DipFragmentShader *shader, const DipDrawState *state) {
    DipDraw *draw = dip_kit_add(list, list->view->stock->meshes[mesh], look, model, shader);
    draw->state = state;
    return draw;
}

// Adds the objects to the list. `outside` is a matrix that is applied to them last. The triangles
// of mirrored objects wind the other way round, so front faces are culled.
static void add_objects(DipKitList *list, DipMatrix outside, bool mirrored) {
    for (int i = OBJECTS - 1; i >= 0; i--) {
        int mesh;
        Uniforms look = {.alpha = 1.0f};
        const DipMatrix model =
            dip_kit_chain(outside, place(i, list->view->turn, &mesh, &look.material));
        const DipDrawState *state = mirrored        ? &inside_mirror
                                    : i == OUTLINED ? &mark_object
                                                    : &plain_ordered;
        add(list, mesh, &model, &look, shade, state)->cull =
            mirrored ? DIP_CULL_FRONT : DIP_CULL_BACK;
    }
}

static const Uniforms mirror_look = {.material = {.diffuse = {0.10f, 0.13f, 0.17f}},
                                     .alpha = 0.30f};

static bool draw_picture(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.36f, 0.43f, 0.52f};
    static const double up[3] = {0.0, 1.0, 0.0};
    static const Uniforms floor_look = {.material = {{0.52f, 0.47f, 0.40f}, {0, 0, 0}, 1}};
    static const Uniforms rim_look = {.material = {{0.10f, 0.09f, 0.08f}, {0.3f, 0.3f, 0.3f}, 4}};
    static const Uniforms outline_look = {.material = {.diffuse = {1.0f, 0.85f, 0.25f}},
                                          .alpha = 1.0f};
    const DipMatrix mirror = dip_matrix_scaling(6.2, 1.0, 6.2);
    const DipMatrix rim =
        dip_kit_chain(dip_matrix_translation(0.0, -0.06, 0.0), dip_matrix_scaling(6.6, 1.0, 6.6));
    const DipMatrix ground =
        dip_kit_chain(dip_matrix_translation(0.0, -0.12, 0.0), dip_matrix_scaling(60.0, 1.0, 60.0));
    int mesh;
    DipKitMaterial material;
    const DipMatrix grown = dip_kit_chain(place(OUTLINED, view->turn, &mesh, &material),
                                          dip_matrix_scaling(1.09, 1.09, 1.09));
    DipKitList list = dip_kit_list(view, 0.1, err);
    // The mirrored objects lie below the floor, so they must be drawn before the floor. The glass
    // then replaces their depths, so that the floor does not hide them.
    add(&list, PLANE, &mirror, &mirror_look, shade_flat, &mark_mirror);
    add_objects(&list, dip_matrix_reflection(up, 0.0), true);
    add(&list, PLANE, &mirror, &mirror_look, shade_flat, &glass);
    add(&list, PLANE, &rim, &rim_look, shade, &plain_ordered);
    add(&list, PLANE, &ground, &floor_look, shade, &plain_ordered);
    add_objects(&list, dip_matrix_identity(), false);
    add(&list, mesh, &grown, &outline_look, shade_flat, &outside_object);
    return dip_kit_show(&list, clear_lin);
}

// Shows the stencil values in a rectangle of the picture. First writes the stencil values without
// any colour, then draws a quad over the whole rectangle for each value. The quads replace the
// colour of every sample, so the pass need not know what the rectangle showed before.
static bool draw_mask(const DipGalleryView *view, const DipTargetRegion *inset, DipError *err) {
    static const DipDrawState mark_object_only = {
        .kept_channels = NO_COLOUR,
        .stencil = STENCIL(OUTLINE_VALUE, DIP_COMPARE_ALWAYS, DIP_STENCIL_REPLACE)};
    static const Uniforms looks[3] = {{.material = {.diffuse = {0.02f, 0.02f, 0.03f}}},
                                      {.material = {.diffuse = {0.20f, 0.55f, 0.85f}}},
                                      {.material = {.diffuse = {1.0f, 0.85f, 0.25f}}}};
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    const DipMatrix mirror = dip_matrix_scaling(6.2, 1.0, 6.2);
    const DipMatrix front = dip_matrix_translation(0.0, 0.0, 0.5);
    int mesh;
    Uniforms look = {.alpha = 1.0f};
    const DipMatrix outlined = place(OUTLINED, view->turn, &mesh, &look.material);
    DipKitList list = dip_kit_list(view, 0.1, err);
    add(&list, PLANE, &mirror, &mirror_look, shade_flat, &mark_mirror);
    add(&list, mesh, &outlined, &look, shade_flat, &mark_object_only);
    list.seen = (DipKitCamera){.to_clip = dip_matrix_identity()};
    for (int value = 0; value < 3; value++) {
        add(&list, QUAD, &front, &looks[value], shade_flat, &fills[value]);
    }
    DipPass pass = dip_kit_pass(view, list.draws, list.count, black);
    pass.attachments.colour_load = DIP_LOAD_DISCARD;
    pass.viewport = pass.scissor = pass.region = *inset;
    return !list.failed && dip_kit_draw(view, view->pipeline, &pass, err);
}

static bool draw(const DipGalleryView *view, DipError *err) {
    const int width = view->target.width;
    const int height = view->target.height;
    const DipTargetRegion whole = {0, 0, width, height};
    const DipTargetRegion corner = {width - width / 4 - width / 40, height / 30, width - width / 40,
                                    height / 30 + height / 4};
    const bool alone = view->look == 1 || corner.x1 <= corner.x0 || corner.y1 <= corner.y0;
    return draw_picture(view, err) && draw_mask(view, alone ? &whole : &corner, err);
}

const DipGalleryScene dip_gallery_stencil = {
    .info = {.name = "stencil",
             .title = "Stencil: mirror and outline",
             .text = "A mirror in the floor and an outline, each masked by the stencil buffer. The "
                     "inset shows the masks.",
             DIP_KIT_LOOKS("mirror, outline and mask", "the masks alone")},
    .meshes = {[SPHERE] = {DIP_KIT_SPHERE, {0.8f, 64, 32}},
               [BOX] = {DIP_KIT_BOX, {1.2f, 1.2f, 1.2f}},
               [PRISM] = {DIP_KIT_PRISM, {0.7f, 1.4f, 6, 0}},
               [PLANE] = {DIP_KIT_PLANE, {1.0f, 1.0f, 16, 16}},
               [QUAD] = {DIP_KIT_QUAD, {2.0f, 2.0f}}},
    .camera = camera,
    .draw = draw,
};
