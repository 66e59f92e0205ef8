// Makes the draws of the shadow map, one for each object that may cast a shadow into it.
#include "renderer/scene/draw/shadow_map.h"

#include "renderer/scene/resources/scene_layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

bool dip_shadows_make(DipShadows *shadows, const DipScene *scene, DipPool *pool, DipIsa isa,
                      int size, DipError *err) {
    const DipQuality trilinear = dip_quality_default();
    const DipShadowFit fit = dip_shadow_fit(scene, NULL, 0, size);
    DipPass pass;
    shadows->samplers = calloc((size_t)scene->material_count + 1, sizeof *shadows->samplers);
    if (!shadows->samplers) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "shadows",
                             "no memory for %d materials", scene->material_count);
    }
    dip_set_samplers(scene, &trilinear, NULL, shadows->samplers);
    shadows->pipeline = dip_pipeline_create(pool, isa, size, size, err);
    shadows->depth = shadows->pipeline ? dip_depth_create(size, size, 1, err) : NULL;
    if (!shadows->depth || !dip_draw_set_make(&shadows->set, scene, false, err)) {
        return false;
    }
    dip_shadows_fill(shadows, scene, dip_material_kernels(isa), &fit, &pass);
    return dip_pipeline_reserve(shadows->pipeline, &pass, err);
}

void dip_shadows_free(DipShadows *shadows) {
    dip_pipeline_destroy(&shadows->pipeline);
    dip_depth_destroy(&shadows->depth);
    dip_draw_set_free(&shadows->set);
    free(shadows->samplers);
    *shadows = (DipShadows){0};
}

// The camera of the light. Its eye is the middle of the map.
typedef struct LightCamera {
    double eye[3];
    double at_eye[4]; // clip position of the eye
    double to_clip[16];
} LightCamera;

static LightCamera light_camera(const DipShadowFit *fit) {
    LightCamera camera = {.at_eye = {0.0, 0.0, 0.5, 1.0}};
    double middle[3];
    double *m = camera.to_clip;
    for (int i = 0; i < 3; i++) {
        const double length = i < 2 ? fit->size * fit->texel[i] : fit->range;
        middle[i] = fit->low[i] + 0.5 * length;
        for (int k = 0; k < 3; k++) {
            camera.eye[k] += middle[i] * fit->axis[i][k];
            m[4 * i + k] = fit->axis[i][k] * (i < 2 ? 2.0 : 1.0) / length;
        }
        m[4 * i + 3] = camera.at_eye[i] - (i < 2 ? 2.0 : 1.0) * middle[i] / length;
    }
    m[15] = 1.0;
    return camera;
}

static void round_matrix(const double matrix[16], float rounded[16]) {
    for (int i = 0; i < 16; i++) {
        rounded[i] = (float)matrix[i];
    }
}

// Adds the draw of an object. Both sides of all surfaces cast shadows.
static void add_caster(DipShadows *shadows, const DipScene *scene,
                       const DipMaterialKernels *kernels, const LightCamera *camera, int index) {
    static const float no_origin[3] = {0.0f, 0.0f, 0.0f};
    // A read compares with texels whose middles lie up to 1.5 texels away along each axis. Their
    // depths are moved away from the light by as much as a surface can rise over that distance.
    static const DipDrawState moved_away = {.depth_bias = {.slope = -3.0f, .constant = -0x1p-20f}};
    DipDrawSet *set = &shadows->set;
    const DipSceneObject *object = &scene->objects[index];
    const DipSceneMesh *mesh = &scene->meshes[object->mesh];
    DipSurfaceUniforms *uniforms = &set->uniforms[set->count];
    DipDrawMatrices *matrices = &set->matrices[set->count];
    DipExactTransform *exact = &matrices->exact_to_clip;
    exact->far_coordinate = 0.0f;
    double bounds_to_clip[16];
    dip_view_object_origin(camera->eye, object->transform, object->world_to_object, exact->origin);
    dip_object_to_clip(camera->to_clip, camera->eye, camera->at_eye, object->transform,
                       exact->origin, exact->to_clip);
    dip_object_to_clip(camera->to_clip, camera->eye, camera->at_eye, object->transform, no_origin,
                       bounds_to_clip);
    round_matrix(bounds_to_clip, matrices->bounds_to_clip);
    *uniforms = mesh->layout;
    round_matrix(exact->to_clip, uniforms->to_clip);
    memcpy(uniforms->origin, exact->origin, sizeof uniforms->origin);
    const int alpha_varyings = dip_surface_alpha_varyings(uniforms);
    const bool clipped =
        scene->materials[mesh->material].surface == DIP_SURFACE_CLIPPED && alpha_varyings > 0;
    const int varyings = clipped ? alpha_varyings : 0;
    uniforms->copied_varying_count = varyings;
    uniforms->light_varying = DIP_ABSENT;
    set->draws[set->count++] = (DipDraw){
        .mesh = mesh->mesh,
        .vertex_shader = kernels->dip_kernel_surface_vertex,
        .clip_shader = clipped ? kernels->dip_kernel_surface_clip : NULL,
        .varying_count = varyings,
        .clip_varying_count = varyings,
        .repeating_varyings = mesh->repeating_varyings & ((1u << varyings) - 1),
        .uniforms = uniforms,
        .samplers = shadows->samplers[mesh->material],
        .bounds_to_clip = matrices->bounds_to_clip,
        .exact_to_clip = exact,
        .cull = DIP_CULL_NONE,
        .state = &moved_away,
    };
}

void dip_shadows_fill(DipShadows *shadows, const DipScene *scene, const DipMaterialKernels *kernels,
                      const DipShadowFit *fit, DipPass *pass) {
    const LightCamera camera = light_camera(fit);
    DipDrawSet *set = &shadows->set;
    *pass = (DipPass){.sample_count = 1,
                      .target = {.width = fit->size, .height = fit->size},
                      .attachments = {.depth = shadows->depth,
                                      .stencil_load = DIP_LOAD_DISCARD,
                                      .stencil_store = DIP_STORE_DISCARD}};
    const DipCullPlanes seen = dip_cull_pass_planes(pass, camera.to_clip);
    set->count = 0;
    set->culled = 0;
    for (int i = 0; i < scene->object_count; i++) {
        const DipSceneMesh *mesh = &scene->meshes[scene->objects[i].mesh];
        if (!scene->materials[mesh->material].casts) {
            continue;
        }
        if (dip_cull_outside(&seen, &scene->objects[i].bounds)) {
            set->culled++;
        } else {
            add_caster(shadows, scene, kernels, &camera, i);
        }
    }
    pass->draws = set->draws;
    pass->draw_count = set->count;
}

void dip_shadow_at(const DipShadows *shadows, const DipScene *scene, const DipShadowFit *fit,
                   const double eye[3], DipShadowUniforms *uniforms) {
    *uniforms = (DipShadowUniforms){
        .map = {shadows->depth, DIP_SHADOW_WIDE},
        .light = scene->lighting->shadow_light,
    };
    for (int i = 0; i < 3; i++) {
        const double length = i < 2 ? fit->size * fit->texel[i] : fit->range;
        const double at_eye = (dot(fit->axis[i], eye) - fit->low[i]) / length;
        for (int k = 0; k < 3; k++) {
            // v runs downwards.
            uniforms->to_map[i][k] = (float)((i == 1 ? -1.0 : 1.0) * fit->axis[i][k] / length);
            uniforms->rise[i][k] =
                (float)(i < 2 ? fit->axis[i][k] * fit->texel[i] / fit->range : fit->axis[i][k]);
        }
        uniforms->to_map[i][3] = (float)(i == 1 ? 1.0 - at_eye : at_eye);
    }
}
