// Draws the gallery scene "prism": a tessellated and twisted prism. It comes from seed 001;
// gallery.h says what a seed is.
//
// The triangles of a plain prism are patches. Tessellation divides them, and the domain function
// turns each new vertex about the axis by an angle that grows with the vertex's height. In three of
// the five looks (the scene's variants), the factor of the tessellation rises and falls with time.
// With fractional partitioning, new vertices then slide apart instead of appearing suddenly. A lit
// wireframe of the same mesh lies over the surface.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"
#include "renderer/shapes/tessellate.h"

typedef struct Look {
    int sides;
    float factor; // Factor of the tessellation; 0 if it rises and falls with time.
    DipPartitioning partitioning;
    float line_px; // Width of the wireframe's lines in a picture of 480 rows.
} Look;

static const Look prism_looks[] = {
    {6, 0.0f, DIP_PARTITIONING_FRACTIONAL_ODD, 1.2f},
    {6, 64.0f, DIP_PARTITIONING_FRACTIONAL_ODD, 0.3f},
    {3, 0.0f, DIP_PARTITIONING_FRACTIONAL_ODD, 1.2f},
    {24, 9.0f, DIP_PARTITIONING_FRACTIONAL_ODD, 0.5f},
    {6, 0.0f, DIP_PARTITIONING_INTEGER, 1.2f},
};
enum { PRISM, FLOOR }; // Meshes.

static const float height = 3.0f;

typedef struct Uniforms {
    DipKitObject object;
    float tint[3];
    float base;     // Ambient light.
    float line_mix; // Share of `tint` in the colour, 0..1.
} Uniforms;

typedef struct Content {
    double time_s; // Time for which the prism's mesh was made.
    int look;      // Look for which the prism's mesh was made.
} Content;

// --- tessellation --------------------------------------------------------------------------------

// Interpolates the control points linearly, then twists position and normal about the y axis. The
// uniform is the twist in radians per unit of height.
static void twist(const DipDomainBatch *batch) {
    const double rate = *(const double *)batch->uniforms;
    dip_domain_linear(batch);
    for (int i = 0; i < batch->count; i++) {
        float *vertex = batch->out + (size_t)i * DIP_SHAPE_ATTRIBUTES;
        float *normal = vertex + DIP_SHAPE_NORMAL;
        const double angle = rate * (double)vertex[1];
        const float turn_cos = (float)dip_cos(angle);
        const float turn_sin = (float)dip_sin(angle);
        const float x = vertex[0] * turn_cos - vertex[2] * turn_sin;
        const float z = vertex[2] * turn_cos + vertex[0] * turn_sin;
        const float nx = normal[0] * turn_cos - normal[2] * turn_sin;
        const float nz = normal[2] * turn_cos + normal[0] * turn_sin;
        vertex[0] = x;
        vertex[2] = z;
        normal[0] = nx;
        normal[1] += (float)rate * (z * nx - x * nz);
        normal[2] = nz;
    }
}

// Makes the prism's mesh, unless the last mesh was made for the same time and look, for example by
// the other pane.
static bool prepare_mesh(const DipGalleryView *view, DipError *err) {
    Content *content = view->content;
    DipMesh **mesh = &view->stock->meshes[PRISM];
    if (*mesh && content->time_s == view->time_s && content->look == view->look) {
        return true;
    }
    const Look *look = &prism_looks[view->look];
    const float factor =
        look->factor > 0.0f ? look->factor : (float)(7.0 - 6.0 * dip_cos(2.0 * view->turn));
    const DipTessellationFactors factors = {{factor, factor, factor, factor}, {factor, factor}};
    const double rate = 0.9 * dip_sin(view->turn);
    DipShape prism;
    DipShape pieces = {0};
    if (!dip_shape_prism(&prism, 1.0f, height, look->sides, false, err)) {
        return false;
    }
    const DipTessellationDef def = {.domain = DIP_DOMAIN_TRIANGLE,
                                    .partitioning = look->partitioning,
                                    .attributes = prism.attributes,
                                    .attribute_count = prism.attribute_count,
                                    .vertex_count = prism.vertex_count,
                                    .indices = prism.indices,
                                    .index_count = prism.index_count,
                                    .factors = &factors,
                                    .same_factors = true,
                                    .function = twist,
                                    .out_attribute_count = DIP_SHAPE_ATTRIBUTES,
                                    .uniforms = &rate};
    dip_mesh_destroy(mesh);
    const bool made =
        dip_tessellate(&pieces, &def, err) && dip_kit_mesh(mesh, "prism", &pieces, err);
    dip_shape_free(&prism);
    content->time_s = view->time_s;
    content->look = view->look;
    return made;
}

// --- shaders -------------------------------------------------------------------------------------

// Shades the prism, its wireframe and the floor. With the angle around the prism's axis, red grows
// and blue falls, as in seed 001.
static void shade(DipFragmentBatch *batch) {
    static const DipKitLight lights[2] = {{.kind = DIP_KIT_DIRECTIONAL,
                                           .direction = {-0.36f, -0.48f, -0.80f},
                                           .colour = {0.95f, 0.90f, 0.82f}},
                                          {.kind = DIP_KIT_POINT,
                                           .position = {-4.0f, 1.5f, -2.0f},
                                           .colour = {0.3f, 0.6f, 1.4f},
                                           .reach = 4.0f}};
    static const DipKitMaterial white = {{1.0f, 1.0f, 1.0f}, {0.35f, 0.35f, 0.35f}, 5};
    const Uniforms *uniforms = batch->uniforms;
    const float ambient[3] = {uniforms->base, uniforms->base, uniforms->base};
    float light[3][DIP_FRAGMENT_BATCH];
    dip_kit_light_fragments(batch, ambient, lights, 2, &white, light);
    for (int i = 0; i < batch->count; i++) {
        const float around = batch->varying[DIP_KIT_UV][i];
        const float own[3] = {0.10f + 0.80f * around, 0.42f - 0.20f * around,
                              0.20f + 0.65f * (1.0f - around)};
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] =
                light[c][i] * dip_kit_mix(own[c], uniforms->tint[c], uniforms->line_mix);
        }
    }
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {5.4 * dip_sin(turn), 1.6 + 0.7 * dip_sin(turn), 5.4 * dip_cos(turn)},
        .target = {0.0, -0.1, 0.0}};
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.03f, 0.035f, 0.05f};
    static const Uniforms solid = {.base = 0.12f};
    static const Uniforms wire = {.tint = {1.0f, 0.95f, 0.8f}, .base = 0.55f, .line_mix = 0.85f};
    static const Uniforms ground = {.tint = {0.16f, 0.17f, 0.20f}, .base = 0.12f, .line_mix = 1.0f};
    const DipDrawState wireframe = {
        .depth_test = DIP_DEPTH_NEARER_OR_EQUAL,
        .fill = DIP_FILL_WIREFRAME,
        .line_width = dip_kit_clamp(
            prism_looks[view->look].line_px * (float)view->target.height / 480.0f, 0.25f, 8.0f)};
    DipMesh *const *meshes = view->stock->meshes;
    const DipMatrix identity = dip_matrix_identity();
    const DipMatrix below = dip_matrix_translation(0.0, -0.5 * height - 0.16, 0.0);
    if (!prepare_mesh(view, err)) {
        return false;
    }
    DipKitList list = dip_kit_list(view, 0.1, err);
    dip_kit_add(&list, meshes[PRISM], &solid, &identity, shade);
    dip_kit_add(&list, meshes[FLOOR], &ground, &below, shade);
    dip_kit_add(&list, meshes[PRISM], &wire, &identity, shade)->state = &wireframe;
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_prism = {
    .info = {.name = "prism",
             .title = "Tessellated prism",
             .text = "A prism whose sides are tessellated and twisted, with a lit wireframe over "
                     "it. The looks change slices and factors.",
             DIP_KIT_LOOKS("6 slices, fractional factor", "6 slices, factor 64",
                           "3 slices, fractional factor", "24 slices, factor 9",
                           "6 slices, whole factor")},
    .meshes = {[FLOOR] = {DIP_KIT_PRISM, {2.6f, 0.3f, 96, 1}}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .draw = draw,
};
