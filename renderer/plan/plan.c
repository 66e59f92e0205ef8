// Deciding a frame's effects, one function each.
#include "renderer/plan/plan.h"

#include "renderer/geometry/cull.h"
#include "renderer/plan/extent.h"
#include "renderer/scene_internal.h"

static const char forced[] = "all effects are forced";

static DipEffect run(const DipPlanInput *input, const char *why) {
    return (DipEffect){true, input->force_all ? forced : why};
}

static DipEffect skip(const char *why) {
    return (DipEffect){false, why};
}

static const DipSceneMaterial *material_of(const DipScene *scene, int object) {
    return &scene->materials[scene->meshes[scene->objects[object].mesh].material];
}

static const DipMesh *mesh_of(const DipScene *scene, int object) {
    return scene->meshes[scene->objects[object].mesh].mesh;
}

static bool object_in_view(const DipPlanInput *input, int object) {
    const DipMesh *mesh = mesh_of(input->scene, object);
    float to_clip[16];
    dip_view_place(input->view, input->scene->objects[object].transform, to_clip);
    return mesh->chunk_count && dip_cull_in_view(to_clip, &mesh->box);
}

static bool is_clipped(const DipSceneMaterial *material) {
    return material->surface == DIP_SURFACE_CLIPPED;
}

static bool is_light_mapped(const DipSceneMaterial *material) {
    return material->light_map != DIP_NO_TEXTURE;
}

// Whether an object of such a material may be in view.
static bool any_in_view(const DipPlanInput *input, bool (*is)(const DipSceneMaterial *)) {
    for (int i = 0; i < input->scene->object_count; i++) {
        if (is(material_of(input->scene, i)) && object_in_view(input, i)) {
            return true;
        }
    }
    return false;
}

// --- effects -----------------------------------------------------------------------------------

static DipEffect plan_alpha_clip(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    if (!input->scene->has_clipped) {
        return skip("the scene has no alpha-clipped surface");
    }
    return input->force_all || any_in_view(input, is_clipped)
               ? run(input, "alpha-clipped surfaces are in view")
               : skip("no alpha-clipped surface is in view");
}

static DipEffect plan_light_map(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    if (!input->scene->has_light_map) {
        return skip("the scene has no light map");
    }
    return input->force_all || any_in_view(input, is_light_mapped)
               ? run(input, "light-mapped surfaces are in view")
               : skip("no light-mapped surface is in view");
}

// Whether the eye looks down on some corner: only there does water reflect.
static bool is_below(const DipView *view, const double (*corners)[3], int count) {
    for (int i = 0; i < count; i++) {
        if (corners[i][1] < view->eye[1]) {
            return true;
        }
    }
    return false;
}

static void add_chunk_box(DipExtent *extent, const DipView *view, const float transform[12],
                          const DipBox *box) {
    double corners[8][3];
    dip_extent_place_box(transform, box, corners);
    if (is_below(view, (const double(*)[3])corners, 8)) {
        dip_extent_add_box(extent, view, (const double(*)[3])corners);
    }
}

static void place_vertex(const DipMesh *mesh, const float transform[12], uint32_t vertex,
                         double world[3]) {
    for (int axis = 0; axis < 3; axis++) {
        const float *m = transform + 4 * axis;
        world[axis] = m[3];
        for (uint32_t k = 0; k < 3; k++) {
            world[axis] += (double)m[k] * mesh->attributes[k * mesh->vertex_total + vertex];
        }
    }
}

static void add_chunk_triangles(DipExtent *extent, const DipView *view, const float transform[12],
                                const DipMesh *mesh, const DipChunk *chunk) {
    const uint8_t *corner = mesh->indices + chunk->first_index;
    const uint32_t stride = dip_corner_stride(chunk);
    for (uint32_t t = 0; t < chunk->triangle_count; t++) {
        double corners[3][3];
        for (uint32_t k = 0; k < 3; k++) {
            place_vertex(mesh, transform, chunk->first_vertex + corner[k * stride + t], corners[k]);
        }
        if (is_below(view, (const double(*)[3])corners, 3)) {
            dip_extent_add_triangle(extent, view, (const double(*)[3])corners);
        }
    }
}

enum { FEW_CHUNKS = 8 }; // of a mesh: its triangles are looked at one by one

// Where the water that the eye looks down on may be in the picture.
static DipExtent water_extent(const DipPlanInput *input) {
    DipExtent extent = dip_extent_none();
    for (int i = 0; i < input->scene->object_count; i++) {
        if (material_of(input->scene, i)->surface != DIP_SURFACE_WATER ||
            !object_in_view(input, i)) {
            continue;
        }
        const float *transform = input->scene->objects[i].transform;
        const DipMesh *mesh = mesh_of(input->scene, i);
        for (uint32_t c = 0; c < mesh->chunk_count; c++) {
            if (mesh->chunk_count <= FEW_CHUNKS) {
                add_chunk_triangles(&extent, input->view, transform, mesh, &mesh->chunks[c]);
            } else {
                add_chunk_box(&extent, input->view, transform, &mesh->chunks[c].box);
            }
        }
    }
    return extent;
}

static DipEffect plan_reflection(const DipPlanInput *input, DipFramePlan *plan) {
    const DipReflectionDef *reflection = input->reflection;
    if (!input->scene->has_water) {
        return skip("the scene has no water");
    }
    if (!reflection->width) {
        return skip("the reflection has no size");
    }
    if (!(input->view->eye[1] > reflection->level_m)) {
        return skip("the camera is not above the water");
    }
    plan->water_reflects = true;
    const DipRegion whole = {0, 0, reflection->width, reflection->height};
    if (input->force_all || reflection->show) {
        plan->mirrored_region = whole;
        return run(input, "its picture is shown whole");
    }
    const DipExtent extent = water_extent(input);
    // A bilinear read takes in the next texel; one more for what is rounded.
    return dip_extent_region(&extent, reflection->width, reflection->height, 2,
                             &plan->mirrored_region)
               ? run(input, "water is in view")
               : skip("no water is in view");
}

DipFramePlan dip_plan_frame(const DipPlanInput *input) {
    DipFramePlan plan = {.water_reflects = false};
#define PLAN_EFFECT(name, text) plan.effects.name = plan_##name(input, &plan);
    DIP_EFFECT_LIST(PLAN_EFFECT)
#undef PLAN_EFFECT
    return plan;
}
