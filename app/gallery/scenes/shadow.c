// Draws the gallery scene "shadow": objects in the light of a moving lamp, with shadow mapping. It
// comes from seed 000; gallery.h says what a seed is.
//
// A first pass draws the scene as the lamp sees it. This pass has no colour target and stores only
// depths, the shadow map. The second pass draws the picture. Its fragment shader takes each point
// to the lamp's clip space and compares the point's depth there with the stored depth. The looks
// (the scene's variants) change the map's resolution and its filter: the nearest filter shows the
// texels of the map, and the linear filter averages four comparisons.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"

#include <string.h>

enum { SPHERE, BOX, COLUMN, FLOOR, OBJECTS = 12 };

typedef struct Look {
    int texels;
    DipShadowFilter filter;
} Look;

static const Look shadow_looks[] = {
    {1024, DIP_SHADOW_LINEAR},
    {256, DIP_SHADOW_LINEAR},
    {256, DIP_SHADOW_NEAREST},
    {2048, DIP_SHADOW_NEAREST},
};
// The lamp and its shadow map. All objects of a frame share the lamp.
typedef struct Lamp {
    float to_clip[16]; // From world space to the lamp's clip space.
    DipKitLight light;
    DipShadowMap map;
} Lamp;

typedef struct Uniforms {
    DipKitObject object;
    DipKitMaterial material;
    const Lamp *lamp;
} Uniforms;

typedef struct Content {
    DipPipeline *pipeline; // Pipeline of the shadow map's size.
    DipDepth *depth;
} Content;

// --- shaders -------------------------------------------------------------------------------------

// Returns row . (x, y, z, 1).
static inline float row_at(const float row[4], DipKitVector p) {
    return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
}

// Writes the share of the lamp's light that reaches each fragment.
static void find_lit(DipFragmentBatch *batch, const Lamp *lamp, float *lit) {
    float u[DIP_FRAGMENT_BATCH];
    float v[DIP_FRAGMENT_BATCH];
    float depth[DIP_FRAGMENT_BATCH];
    const float *m = lamp->to_clip;
    for (int i = 0; i < batch->count; i++) {
        const DipKitVector p = dip_kit_get(batch->varying + DIP_KIT_WORLD, i);
        const float w = row_at(m + 12, p);
        const float scale = 1.0f / dip_kit_greatest(w, 0.01f);
        u[i] = 0.5f + 0.5f * scale * row_at(m, p);
        v[i] = 0.5f - 0.5f * scale * row_at(m + 4, p);
        depth[i] = scale * row_at(m + 8, p);
    }
    batch->sample_shadow(batch, &lamp->map, u, v, depth, lit);
}

static void shade(DipFragmentBatch *batch) {
    static const float sky[3] = {0.14f, 0.18f, 0.30f};
    const Uniforms *uniforms = batch->uniforms;
    float normals[3][DIP_FRAGMENT_BATCH];
    float lit[DIP_FRAGMENT_BATCH];
    const DipKitPoints points = dip_kit_fragment_points(batch, normals);
    find_lit(batch, uniforms->lamp, lit);
    dip_kit_light_sky(sky, 0.7f, &uniforms->material, &points, batch->colour);
    dip_kit_light_add(&uniforms->lamp->light, &uniforms->material, &points, lit, batch->colour);
}

// --- content -------------------------------------------------------------------------------------

static void destroy(void *pointer) {
    Content *content = pointer;
    dip_pipeline_destroy(&content->pipeline);
    dip_depth_destroy(&content->depth);
}

// Makes a shadow map of texels x texels, unless the last frame had a map of this size.
static bool prepare_map(const DipGalleryView *view, int texels, DipError *err) {
    Content *content = view->content;
    if (content->depth && dip_depth_width(content->depth) == texels) {
        return true;
    }
    destroy(content);
    content->pipeline = dip_pipeline_create(view->def->pool, view->def->isa, texels, texels, err);
    content->depth = content->pipeline ? dip_depth_create(texels, texels, 1, err) : NULL;
    return content->depth != NULL;
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    const double angle = 0.6 * dip_sin(turn);
    return (DipGalleryCamera){
        .eye = {8.5 * dip_sin(angle), 4.6 + 0.8 * dip_cos(turn), 8.5 * dip_cos(angle)},
        .target = {0.0, 0.7, 0.0}};
}

// Returns the matrix that takes object `index` to world space. Sets *mesh and *material to those of
// the object.
static DipMatrix place(int index, double turn, int *mesh, DipKitMaterial *material) {
    static const float colours[][3] = {
        {0.80f, 0.30f, 0.16f}, {0.18f, 0.42f, 0.72f}, {0.85f, 0.62f, 0.20f}, {0.30f, 0.55f, 0.28f}};
    *material = (DipKitMaterial){{0.62f, 0.60f, 0.56f}, {0.1f, 0.1f, 0.1f}, 5};
    if (index == 0) {
        *mesh = FLOOR;
        return dip_matrix_identity();
    }
    if (index < 9) { // A ring of columns.
        const double angle = 2.0 * DIP_PI * (index - 1) / 8.0;
        *mesh = COLUMN;
        return dip_kit_chain(
            dip_matrix_translation(3.6 * dip_cos(angle), 1.1, 3.6 * dip_sin(angle)),
            dip_matrix_scaling(0.2, 2.2, 0.2));
    }
    *material = (DipKitMaterial){.specular = {0.5f, 0.5f, 0.5f}, .exponent_doubled = 5};
    memcpy(material->diffuse, colours[index - 9], sizeof material->diffuse);
    const double angle = turn + 2.0 * DIP_PI * (index - 9) / 3.0;
    const double height = 0.95 + 0.35 * dip_sin(3.0 * turn + 2.0 * index);
    const double size = index == 9 ? 0.62 : index == 10 ? 0.95 : 0.5;
    *mesh = index == 9 ? SPHERE : index == 10 ? BOX : COLUMN;
    return dip_kit_chain3(
        dip_matrix_translation(1.5 * dip_cos(angle), height, 1.5 * dip_sin(angle)),
        dip_kit_chain(dip_matrix_rotation(1, 2.0 * turn), dip_matrix_rotation(0, 3.0 * turn)),
        dip_matrix_scaling(size, index == 11 ? 1.1 : size, size));
}

// Sets the lamp, which moves on a circle above the ring of columns and shines at the ring's middle.
static bool set_lamp(Lamp *lamp, double turn, DipKitCamera *from_lamp, DipError *err) {
    const DipGalleryCamera at = {.eye = {4.4 * dip_cos(-turn), 6.2, 4.4 * dip_sin(-turn)},
                                 .target = {0.0, 0.4, 0.0}};
    const DipPerspective lens = {.fov_deg = 84.0, .aspect = 1.0, .near_distance = 0.5};
    double way[3];
    double squared = 0.0;
    lamp->light = (DipKitLight){.kind = DIP_KIT_SPOT,
                                .colour = {3.4f, 3.0f, 2.4f},
                                .reach = 7.0f,
                                .inner_cos = 0.86f,
                                .outer_cos = 0.76f};
    for (int i = 0; i < 3; i++) {
        way[i] = at.target[i] - at.eye[i];
        squared += way[i] * way[i];
    }
    for (int i = 0; i < 3; i++) {
        lamp->light.position[i] = (float)at.eye[i];
        lamp->light.direction[i] = (float)(way[i] / sqrt(squared));
    }
    const bool made = dip_kit_look_at(from_lamp, &at, &lens, err);
    dip_matrix_floats(&from_lamp->to_clip, lamp->to_clip);
    return made;
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.015f, 0.02f, 0.035f};
    static const DipKitObject plain;
    // A comparison with 2x2 texels needs this bias: twice the slope of the surface, and a few units
    // for rounding.
    static const DipDrawState caster = {.depth_bias = {.slope = -2.0f, .relative = -8.0f}};
    const Look *look = &shadow_looks[view->look];
    const Content *content = view->content;
    Lamp lamp;
    DipKitList list = dip_kit_list(view, 0.1, err);
    DipKitList shadows = {.view = view, .err = err};
    if (!prepare_map(view, look->texels, err) || !set_lamp(&lamp, view->turn, &shadows.seen, err)) {
        return false;
    }
    lamp.map = (DipShadowMap){content->depth, look->filter};
    for (int i = 0; i < OBJECTS; i++) {
        Uniforms uniforms = {.lamp = &lamp};
        int mesh;
        const DipMatrix model = place(i, view->turn, &mesh, &uniforms.material);
        dip_kit_add(&list, view->stock->meshes[mesh], &uniforms, &model, shade);
        dip_kit_add(&shadows, view->stock->meshes[mesh], &plain, &model, NULL)->state = &caster;
    }
    const DipPass shadow_pass = {
        .draws = shadows.draws,
        .draw_count = OBJECTS,
        .sample_count = 1,
        .target = {.width = look->texels, .height = look->texels},
        .attachments = {.depth = content->depth},
    };
    return !shadows.failed && dip_kit_draw(view, content->pipeline, &shadow_pass, err) &&
           dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_shadow = {
    .info = {.name = "shadow",
             .title = "Shadow mapping",
             .text = "Shadows of a moving lamp from a depth-only pass. The looks change the map's "
                     "resolution and filter.",
             DIP_KIT_LOOKS("map of 1024x1024, 2x2 filter", "map of 256x256, 2x2 filter",
                           "map of 256x256, nearest", "map of 2048x2048, nearest")},
    .meshes = {[SPHERE] = {DIP_KIT_SPHERE, {1.0f, 64, 32}},
               [BOX] = {DIP_KIT_BOX, {1.0f, 1.0f, 1.0f}},
               [COLUMN] = {DIP_KIT_PRISM, {1.0f, 1.0f, 32, 1}},
               [FLOOR] = {DIP_KIT_PLANE, {40.0f, 40.0f, 20, 20}}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .destroy = destroy,
    .draw = draw,
};
