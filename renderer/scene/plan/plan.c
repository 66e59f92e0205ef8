// Decides the effects of a frame, with one function for each effect.
#include "renderer/scene/plan/plan.h"

#include "renderer/scene/materials/backdrop.h"
#include "renderer/scene/resources/scene_layout.h"
#include "renderer/scene/view/extent.h"

static const char forced[] = "all effects are forced";
static const char plain[] = "surfaces are drawn plain";

static DipEffect run(const DipPlanInput *input, const char *why) {
    return (DipEffect){true, input->force_all ? forced : why};
}

static DipEffect skip(const char *why) {
    return (DipEffect){false, why};
}

static const DipSceneMesh *mesh_of(const DipScene *scene, int object) {
    return &scene->meshes[scene->objects[object].mesh];
}

static const DipSceneMaterial *material_of(const DipScene *scene, int object) {
    return &scene->materials[mesh_of(scene, object)->material];
}

static bool object_in_view(const DipScene *scene, const DipCullPlanes *seen, int object) {
    return dip_mesh_triangle_count(mesh_of(scene, object)->mesh) &&
           !dip_cull_outside(seen, &scene->objects[object].bounds);
}

// --- what is in view ---------------------------------------------------------------------------

// Whether an effect concerns an object.
typedef bool ObjectHasEffect(const DipScene *scene, int object);

static bool is_clipped(const DipScene *scene, int object) {
    return material_of(scene, object)->surface == DIP_SURFACE_CLIPPED;
}

static bool is_light_mapped(const DipScene *scene, int object) {
    return material_of(scene, object)->light_map != DIP_NO_TEXTURE;
}

static bool is_lit(const DipScene *scene, int object) {
    return mesh_of(scene, object)->lit_by_lights;
}

static bool is_normal_mapped(const DipScene *scene, int object) {
    return mesh_of(scene, object)->normal_mapped;
}

static bool is_pbr(const DipScene *scene, int object) {
    return mesh_of(scene, object)->pbr;
}

static bool is_occluded(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->occlusion_varying != DIP_ABSENT;
}

static bool is_emitting(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->emits;
}

static bool is_coated(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->coat > 0.0f;
}

static bool has_sheen(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->sheen;
}

static bool transmits(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->transmission > 0.0f;
}

static bool scatters(const DipScene *scene, int object) {
    const DipPbrUniforms *pbr = mesh_of(scene, object)->full_layout.pbr;
    return pbr && pbr->scattering > 0.0f;
}

static bool is_blended(const DipScene *scene, int object) {
    return material_of(scene, object)->blended;
}

static bool is_clouded(const DipScene *scene, int object) {
    return mesh_of(scene, object)->sky;
}

// Whether an object with the effect may be visible, in the picture itself or in the water's
// reflection. The reflection must have been planned before.
static bool any_in_view(const DipPlanInput *input, const DipFramePlan *plan,
                        ObjectHasEffect *has_effect) {
    for (int i = 0; i < input->scene->object_count; i++) {
        if (has_effect(input->scene, i) &&
            (object_in_view(input->scene, input->seen, i) ||
             (plan->effects.reflection.run &&
              object_in_view(input->scene, input->seen_mirrored, i)))) {
            return true;
        }
    }
    return false;
}

// --- the reflection ----------------------------------------------------------------------------

// Whether any of the corners lies below the eye. Water reflects only where the eye looks down on
// it.
static bool is_below(const DipView *view, const double (*corners)[3], int count) {
    for (int i = 0; i < count; i++) {
        if (corners[i][1] < view->eye[1]) {
            return true;
        }
    }
    return false;
}

static void add_chunk_box(DipExtent *extent, const DipPlanInput *input, const float transform[12],
                          const DipBox *box) {
    double corners[8][3];
    dip_extent_box_corners(transform, box, corners);
    if (is_below(input->view, (const double(*)[3])corners, 8)) {
        dip_extent_add_box(extent, input->view, (const double(*)[3])corners);
        dip_parts_add_box(input->parts, input->view, (const double(*)[3])corners);
    }
}

static void transform_point(const float transform[12], const float point[3], double world[3]) {
    for (int axis = 0; axis < 3; axis++) {
        const float *m = transform + 4 * axis;
        world[axis] = m[3];
        for (int k = 0; k < 3; k++) {
            world[axis] += (double)m[k] * point[k];
        }
    }
}

static void add_chunk_triangles(DipExtent *extent, const DipPlanInput *input,
                                const float transform[12], const DipMesh *mesh, uint32_t chunk) {
    const uint32_t count = dip_mesh_chunk_triangle_count(mesh, chunk);
    for (uint32_t t = 0; t < count; t++) {
        float points[3][3];
        double corners[3][3];
        dip_mesh_chunk_triangle(mesh, chunk, t, points);
        for (int k = 0; k < 3; k++) {
            transform_point(transform, points[k], corners[k]);
        }
        if (is_below(input->view, (const double(*)[3])corners, 3)) {
            dip_extent_add_triangle(extent, input->view, (const double(*)[3])corners);
            dip_parts_add_triangle(input->parts, input->view, (const double(*)[3])corners);
        }
    }
}

// A mesh of up to this many chunks is bounded by its triangles. A larger mesh is bounded by the
// boxes of its chunks.
enum { FEW_CHUNKS = 8 };

// Returns the extent of the water that the eye looks down on, and adds this water to input->parts.
static DipExtent water_extent(const DipPlanInput *input) {
    DipExtent extent = dip_extent_none();
    for (int i = 0; i < input->scene->object_count; i++) {
        if (material_of(input->scene, i)->surface != DIP_SURFACE_WATER ||
            !object_in_view(input->scene, input->seen, i)) {
            continue;
        }
        const float *transform = input->scene->objects[i].transform;
        const DipMesh *mesh = mesh_of(input->scene, i)->mesh;
        const uint32_t chunks = dip_mesh_chunk_count(mesh);
        for (uint32_t c = 0; c < chunks; c++) {
            if (chunks <= FEW_CHUNKS) {
                add_chunk_triangles(&extent, input, transform, mesh, c);
            } else {
                const DipBox box = dip_mesh_chunk_box(mesh, c);
                add_chunk_box(&extent, input, transform, &box);
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
    if (input->plain_surfaces) {
        return skip(plain);
    }
    if (!reflection->width) {
        return skip("the reflection's size is 0");
    }
    if (!(input->view->eye[1] > reflection->level_m)) {
        return skip("the camera is not above the water");
    }
    plan->water_reflects = true;
    const DipTargetRegion whole = {0, 0, reflection->width, reflection->height};
    if (input->force_all || reflection->show) {
        plan->mirrored_region = whole;
        return run(input, "the mirrored picture is shown in the corner");
    }
    plan->mirrored_parts = true;
    dip_parts_clear(input->parts);
    const DipExtent extent = water_extent(input);
    return dip_extent_region(&extent, reflection->width, reflection->height, input->parts->margin,
                             &plan->mirrored_region)
               ? run(input, "water is in view")
               : skip("no water is in view");
}

// --- the other effects -------------------------------------------------------------------------

static DipEffect plan_alpha_clip(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->has_clipped) {
        return skip("the scene has no alpha-clipped surface");
    }
    return input->force_all || any_in_view(input, plan, is_clipped)
               ? run(input, "alpha-clipped surfaces are in view")
               : skip("no alpha-clipped surface is in view");
}

// Sample groups cost time only in tiles with alpha-clipped triangles; the pipeline ensures this.
static DipEffect plan_adaptive_aa(const DipPlanInput *input, DipFramePlan *plan) {
    const int sample_count = dip_quality_sample_count(input->quality);
    plan->samples_per_group = sample_count;
    if (!input->quality->step[DIP_SETTING_AAA]) {
        return skip("aaa is off");
    }
    if (dip_quality_groups_shade_all(input->quality)) {
        plan->samples_per_group = dip_quality_samples_per_group(input->quality);
        return run(input, "all surfaces are drawn per sample group");
    }
    if (dip_quality_covers_by_alpha(input->quality)) {
        return plan->effects.alpha_clip.run
                   ? run(input, "alpha decides how many samples a clipped surface covers")
                   : plan->effects.alpha_clip;
    }
    if (dip_quality_samples_per_group(input->quality) == sample_count) {
        return skip("one sample group holds all samples");
    }
    if (!plan->effects.alpha_clip.run) {
        return plan->effects.alpha_clip;
    }
    plan->samples_per_group = dip_quality_samples_per_group(input->quality);
    return run(input, "alpha-clipped surfaces are drawn per sample group");
}

static DipEffect plan_light_map(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->has_light_map) {
        return skip("the scene has no light map");
    }
    return input->force_all || any_in_view(input, plan, is_light_mapped)
               ? run(input, "light-mapped surfaces are in view")
               : skip("no light-mapped surface is in view");
}

// Where an object is lit, the lights that cannot reach it are left out (dip_lights_reaching).
static DipEffect plan_lights(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->lighting) {
        return skip("the scene has no lights of its own");
    }
    if (!input->scene->has_lit) {
        return skip("the scene's lights light no surface");
    }
    return input->force_all || any_in_view(input, plan, is_lit)
               ? run(input, "surfaces that the scene's lights light are in view")
               : skip("no surface that the scene's lights light is in view");
}

static DipEffect plan_shadows(const DipPlanInput *input, DipFramePlan *plan) {
    const DipSceneLighting *lighting = input->scene->lighting;
    if (!input->quality->step[DIP_SETTING_SHADOWS]) {
        return skip("shadows is off");
    }
    if (!lighting || lighting->shadow_light < 0) {
        return skip("the scene has no directional light");
    }
    if (!input->scene->has_lit) {
        return skip("the scene's lights light no surface");
    }
    if (!input->scene->has_caster) {
        return skip("no surface of the scene casts a shadow");
    }
    if (input->plain_surfaces) {
        return skip(plain);
    }
    return input->force_all || any_in_view(input, plan, is_lit)
               ? run(input, "surfaces that the directional light lights are in view")
               : skip("no surface that the directional light lights is in view");
}

// A mesh without a normal map always has the plain shader.
static DipEffect plan_normal_map(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->has_normal_map) {
        return skip("the scene has no normal-mapped surface");
    }
    if (input->plain_surfaces) {
        return skip(plain);
    }
    return input->force_all || any_in_view(input, plan, is_normal_mapped)
               ? run(input, "normal-mapped surfaces are in view")
               : skip("no normal-mapped surface is in view");
}

static DipEffect plan_pbr(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->pbr) {
        return skip("the scene has no metallic-roughness surface");
    }
    if (input->plain_surfaces) {
        return skip(plain);
    }
    return input->force_all || any_in_view(input, plan, is_pbr)
               ? run(input, "metallic-roughness surfaces are in view")
               : skip("no metallic-roughness surface is in view");
}

// Occlusion, emission, coats, sheens, transmission and scattering are parts of metallic-roughness
// surfaces: without `pbr`, none runs.
static DipEffect plan_occlusion(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    if (!input->scene->has_occlusion) {
        return skip("no metallic-roughness surface has an occlusion map");
    }
    return input->force_all || any_in_view(input, plan, is_occluded)
               ? run(input, "surfaces with an occlusion map are in view")
               : skip("no surface with an occlusion map is in view");
}

static DipEffect plan_emission(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    if (!input->scene->has_emission) {
        return skip("no metallic-roughness surface sends out light");
    }
    return input->force_all || any_in_view(input, plan, is_emitting)
               ? run(input, "surfaces that send out light are in view")
               : skip("no surface that sends out light is in view");
}

static DipEffect plan_coat(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    if (!input->scene->has_coat) {
        return skip("no metallic-roughness surface has a clear coat");
    }
    return input->force_all || any_in_view(input, plan, is_coated)
               ? run(input, "surfaces with a clear coat are in view")
               : skip("no surface with a clear coat is in view");
}

static DipEffect plan_sheen(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    if (!input->scene->has_sheen) {
        return skip("no metallic-roughness surface has a sheen");
    }
    return input->force_all || any_in_view(input, plan, has_sheen)
               ? run(input, "surfaces with a sheen are in view")
               : skip("no surface with a sheen is in view");
}

static DipEffect plan_transmission(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    if (!input->scene->has_transmission) {
        return skip("no metallic-roughness surface transmits light");
    }
    return input->force_all || any_in_view(input, plan, transmits)
               ? run(input, "surfaces that transmit light are in view")
               : skip("no surface that transmits light is in view");
}

// Finds the part of the backdrop that rough glass may read. In the water's reflection, glass shows
// what lies behind it sharp.
static bool find_backdrop_region(const DipPlanInput *input, DipTargetRegion *region) {
    DipExtent extent = dip_extent_none();
    int margin = 0;
    for (int i = 0; i < input->scene->object_count; i++) {
        if (scatters(input->scene, i) && object_in_view(input->scene, input->seen, i)) {
            const DipPbrUniforms *pbr = mesh_of(input->scene, i)->full_layout.pbr;
            const int own = dip_backdrop_margin(input->backdrop_width, input->backdrop_height,
                                                (double)pbr->roughness * (double)pbr->scattering);
            static const float in_world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
            double corners[8][3];
            dip_extent_box_corners(in_world, &input->scene->objects[i].bounds, corners);
            dip_extent_add_box(&extent, input->view, (const double(*)[3])corners);
            margin = own > margin ? own : margin;
        }
    }
    return dip_extent_region(&extent, input->backdrop_width, input->backdrop_height, margin,
                             region);
}

static DipEffect plan_scattering(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.transmission.run) {
        return plan->effects.transmission;
    }
    if (!input->scene->has_scattering) {
        return skip("no surface blurs what is seen through it");
    }
    if (input->force_all) {
        plan->backdrop_region =
            (DipTargetRegion){0, 0, input->backdrop_width, input->backdrop_height};
        return run(input, forced);
    }
    return find_backdrop_region(input, &plan->backdrop_region)
               ? run(input, "surfaces that blur what is seen through them are in view")
               : skip("no surface that blurs what is seen through it is in view");
}

// All metallic-roughness surfaces of a scene with an environment see it.
static DipEffect plan_environment(const DipPlanInput *input, DipFramePlan *plan) {
    if (!plan->effects.pbr.run) {
        return plan->effects.pbr;
    }
    return input->scene->pbr->environment
               ? run(input, "metallic-roughness surfaces that see the environment are in view")
               : skip("the scene has no environment");
}

static DipEffect plan_blend(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->blended_count) {
        return skip("the scene has no blended surface");
    }
    return input->force_all || any_in_view(input, plan, is_blended)
               ? run(input, "blended surfaces are in view")
               : skip("no blended surface is in view");
}

// This function need not find out what covers the sky: the visibility buffer keeps covered sky from
// being shaded.
static DipEffect plan_sky(const DipPlanInput *input, DipFramePlan *plan) {
    if (!input->scene->has_sky) {
        return skip("the scene has no sky with clouds");
    }
    if (input->plain_surfaces) {
        return skip(plain);
    }
    if (input->quality->step[DIP_SETTING_MIPDEBUG]) {
        return skip("mip colours replace the clouds");
    }
    return input->force_all || any_in_view(input, plan, is_clouded) ? run(input, "sky is in view")
                                                                    : skip("no sky is in view");
}

// Filters of the finished picture run wherever the settings ask for them.
static DipEffect plan_history(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    return dip_quality_has_history(input->quality)
               ? run(input, "each frame is blended with the frames before it")
               : skip("taa is not history");
}

static DipEffect plan_post(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    return input->quality->step[DIP_SETTING_POST]
               ? run(input, "the finished picture is searched for edges")
               : skip("post is off");
}

static DipEffect plan_upscale(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    return dip_quality_upscales(input->quality)
               ? run(input, "a smaller picture is drawn and enlarged")
               : skip("scale is not below 1");
}

static DipEffect plan_sharpen(const DipPlanInput *input, DipFramePlan *plan) {
    (void)plan;
    return input->quality->step[DIP_SETTING_SHARPEN]
               ? run(input, "the finished picture is sharpened")
               : skip("sharpen is off");
}

DipFramePlan dip_plan_frame(const DipPlanInput *input) {
    DipFramePlan plan = {.water_reflects = false};
#define PLAN_EFFECT(name, text) plan.effects.name = plan_##name(input, &plan);
    DIP_EFFECT_LIST(PLAN_EFFECT)
#undef PLAN_EFFECT
    return plan;
}

static void settle(DipEffect *effect, uint64_t work) {
    if (effect->run && !work) {
        *effect = skip("no fragment of it is visible");
    }
}

void dip_plan_settle(const DipPlanInput *input, const DipCounters *counters,
                     const DipCounters *copied, DipEffects *effects) {
    static const DipCounters none;
    const DipCounters *more = copied ? copied : &none;
    if (input->force_all) {
        return;
    }
    settle(&effects->alpha_clip, counters->fragments_clip_tested);
    if (!dip_quality_groups_shade_all(input->quality)) {
        settle(&effects->adaptive_aa, counters->clip_sample_groups);
    }
    settle(&effects->lights, counters->fragments_lit + more->fragments_lit);
    settle(&effects->shadows, counters->fragments_shadowed + more->fragments_shadowed);
    settle(&effects->normal_map, counters->fragments_normal_mapped + more->fragments_normal_mapped);
    settle(&effects->pbr, counters->fragments_pbr + more->fragments_pbr);
    settle(&effects->occlusion, counters->fragments_occluded + more->fragments_occluded);
    settle(&effects->emission, counters->fragments_emitting + more->fragments_emitting);
    settle(&effects->coat, counters->fragments_coated + more->fragments_coated);
    settle(&effects->sheen, counters->fragments_sheen + more->fragments_sheen);
    settle(&effects->transmission, counters->fragments_transmitting + more->fragments_transmitting);
    settle(&effects->scattering, counters->fragments_scattering + more->fragments_scattering);
    settle(&effects->environment, counters->fragments_surrounded + more->fragments_surrounded);
    settle(&effects->sky, counters->fragments_sky + more->fragments_sky);
    settle(&effects->blend, counters->fragments_blended);
}

bool dip_plan_shades_alike(const DipQuality *a, const DipQuality *b) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        switch ((DipSetting)s) {
        case DIP_SETTING_AA:
        case DIP_SETTING_TAA:
        case DIP_SETTING_AAA: // surfaces with sample groups have own_shading
        case DIP_SETTING_ASD:
            break;
        default:
            if (a->step[s] != b->step[s]) {
                return false;
            }
        }
    }
    // Alpha to coverage and supersampling shade at other positions, and a larger picture also needs
    // the light that is not in the pixels.
    const bool same_light =
        a->step[DIP_SETTING_AAA] != DIP_AAA_COVERAGE &&
        b->step[DIP_SETTING_AAA] != DIP_AAA_COVERAGE && a->step[DIP_SETTING_AAA] != DIP_AAA_ALL &&
        b->step[DIP_SETTING_AAA] != DIP_AAA_ALL && a->step[DIP_SETTING_SCALE] <= DIP_SCALE_1;
    // Each frame of a history is shaded at a place of its own.
    const bool shifted = dip_quality_has_history(a) || dip_quality_has_history(b);
    return same_light && !shifted && !a->step[DIP_SETTING_MIPDEBUG];
}
