// Makes the draws of a render pass, one object at a time.
#include "renderer/scene/draw/draws.h"

#include "renderer/scene/resources/lighting.h"
#include "renderer/scene/resources/mip_debug.h"
#include "renderer/scene/resources/scene_layout.h"

#include <stdlib.h>
#include <string.h>

bool dip_draw_set_make(DipDrawSet *set, int object_count, bool reflects, DipError *err) {
    const size_t room = (size_t)object_count + 1;
    set->draws = calloc(room, sizeof *set->draws);
    set->uniforms = calloc(room, sizeof *set->uniforms);
    set->matrices = calloc(room, sizeof *set->matrices);
    set->water = reflects ? calloc(room, sizeof *set->water) : NULL;
    if (!set->draws || !set->uniforms || !set->matrices || (reflects && !set->water)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "no memory for %d objects",
                             object_count);
    }
    return true;
}

void dip_draw_set_free(DipDrawSet *set) {
    free(set->draws);
    free(set->uniforms);
    free(set->matrices);
    free(set->water);
    *set = (DipDrawSet){0};
}

// --- textures ----------------------------------------------------------------------------------

static DipSampler colour_sampler(const DipQuality *quality, const DipTexture *shown,
                                 const DipTexture *texture) {
    // Bias of each step of miplod, from high-performance to high-quality, in 1/256 level.
    static const int32_t bias_lod8[] = {384, 256, 128, 0};
    const int miplod = quality->step[DIP_SETTING_MIPLOD];
    DipSampler sampler = {
        .texture = texture,
        .max_anisotropy = dip_quality_max_anisotropy(quality),
        .exact_footprint = quality->step[DIP_SETTING_AAF] != 0,
        .bias_lod8 = bias_lod8[miplod],
        .cheap = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
    if (miplod == DIP_MIPLOD_HIGH_PERFORMANCE) {
        int width;
        int height;
        dip_texture_level_size(texture, 0, &width, &height);
        sampler.min_lod8 = width >= 1024 || height >= 1024 ? 512 : 256;
    }
    if (quality->step[DIP_SETTING_MIPDEBUG]) {
        sampler.shown = shown;
        dip_mip_debug_levels(texture, sampler.shown_level);
    }
    return sampler;
}

// Level-of-detail bias of a clipped surface, in 1/256 level: -log2(sqrt(groups)). A sample group
// (samples of a pixel that are clipped and shaded together) covers only a part of the pixel, so it
// reads finer levels than a whole pixel would. Finer levels still show the thin parts of clip maps;
// coarser levels average these parts away.
static int32_t group_bias_lod8(const DipQuality *quality) {
    static const int32_t bias_lod8[DIP_MAX_SAMPLES + 1] = {
        [2] = -128, [3] = -203, [4] = -256, [6] = -331, [8] = -384};
    return bias_lod8[dip_quality_sample_count(quality) / dip_quality_samples_per_group(quality)];
}

static const DipTexture *colour_texture(const DipScene *scene, const DipQuality *quality,
                                        const DipSceneMaterial *material) {
    const bool compressed = dip_quality_compresses(quality) && material->surface != DIP_SURFACE_SKY;
    return compressed ? dip_late_texture(scene->late, material->colour_texture)
                      : scene->textures[material->colour_texture];
}

void dip_set_samplers(const DipScene *scene, const DipQuality *quality, const DipTexture *shown,
                      DipMaterialSamplers *samplers) {
    for (int i = 0; i < scene->material_count; i++) {
        const DipSceneMaterial *material = &scene->materials[i];
        const int32_t clipped_bias_lod8 =
            material->surface == DIP_SURFACE_CLIPPED ? group_bias_lod8(quality) : 0;
        if (material->colour_texture != DIP_NO_TEXTURE) {
            DipSampler *sampler = &samplers[i][DIP_SURFACE_SAMPLER_COLOUR];
            *sampler = colour_sampler(quality, shown, colour_texture(scene, quality, material));
            sampler->bias_lod8 += clipped_bias_lod8;
        }
        if (material->light_map != DIP_NO_TEXTURE) {
            samplers[i][DIP_SURFACE_SAMPLER_LIGHT_MAP] =
                (DipSampler){.texture = scene->textures[material->light_map], .max_anisotropy = 1};
        }
        if (material->normal_map != DIP_NO_TEXTURE) {
            DipSampler *sampler = &samplers[i][DIP_SURFACE_SAMPLER_NORMAL_MAP];
            *sampler = colour_sampler(quality, shown, scene->textures[material->normal_map]);
            sampler->bias_lod8 += clipped_bias_lod8;
            sampler->shown = NULL; // mip colours replace colour textures only
        }
    }
}

// --- objects -----------------------------------------------------------------------------------

// Computes the view rays through the pixels of a target from the world-to-clip matrix. The first
// three elements of the rows for x, y and w are orthogonal vectors. So a point relative to the eye
// is a weighted sum of these vectors: the weight of a vector is its clip coordinate divided by the
// vector's squared length.
static DipViewRays view_rays(const double m[16], int width, int height) {
    DipViewRays rays;
    double inverse2[4];
    for (int row = 0; row < 4; row++) {
        const double *r = m + 4 * row;
        inverse2[row] = row == 2 ? 0.0 : 1.0 / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    }
    for (int c = 0; c < 3; c++) {
        const double right = m[c] * inverse2[0];
        const double up = m[4 + c] * inverse2[1];
        const double ahead = m[12 + c] * inverse2[3];
        rays.origin[c] = (float)(ahead - right + up);
        rays.per_x[c] = (float)(2.0 * right / width);
        rays.per_y[c] = (float)(-2.0 * up / height);
        rays.right[c] = (float)right;
        rays.up[c] = (float)up;
        rays.ahead[c] = (float)ahead;
    }
    return rays;
}

// If the scene's lights light the mesh of a draw, gives them to the draw and sets its shaders.
static void set_lights(const DipDrawInput *input, const DipDrawSet *set,
                       const DipSceneObject *object, DipSurfaceUniforms *uniforms, DipDraw *draw) {
    const DipMaterialKernels *kernels = input->kernels;
    const DipSceneMesh *mesh = &input->scene->meshes[object->mesh];
    if (!mesh->lit_by_lights) {
        return;
    }
    uniforms->lighting = &set->lighting;
    uniforms->lights = input->all_lights
                           ? UINT64_MAX
                           : dip_lights_reaching(input->scene->lighting, &object->bounds);
    if (mesh->fragments_lit) {
        draw->vertex_shader = kernels->dip_kernel_fragment_lit_vertex;
        draw->fragment_shader = kernels->dip_kernel_phong_fragment;
        draw->value_only_varying_count = mesh->varying_count - uniforms->normal_varying;
    } else {
        draw->vertex_shader = kernels->dip_kernel_gouraud_vertex;
        draw->fragment_shader = kernels->dip_kernel_gouraud_fragment;
    }
}

// If the mesh of a draw has an effect (normal map or clouds), sets the effect's shaders. If mip
// colours are on, a sky keeps the plain shader, so that the colours of its texture's levels can be
// seen.
static void set_effect(const DipDrawInput *input, const DipSceneMesh *mesh,
                       DipSurfaceUniforms *uniforms, DipDraw *draw) {
    const DipMaterialKernels *kernels = input->kernels;
    uniforms->sky = input->sky;
    if (input->plain_surfaces) {
        return;
    }
    if (mesh->normal_mapped) {
        draw->vertex_shader = kernels->dip_kernel_fragment_lit_vertex;
        draw->fragment_shader = mesh->lit_by_lights ? kernels->dip_kernel_phong_fragment
                                                    : kernels->dip_kernel_normal_map_fragment;
        draw->varying_count = mesh->mapped_varying_count;
        draw->value_only_varying_count = 0;
    } else if (mesh->sky && !input->quality->step[DIP_SETTING_MIPDEBUG]) {
        draw->fragment_shader = kernels->dip_kernel_sky_fragment;
        draw->computed_varying_count = 2; // the coordinates of the layer of clouds
    }
}

// Turns the draw that was added last into reflecting water, which shows the mirrored picture.
static void set_reflecting(const DipDrawInput *input, const DipDrawView *pass, DipDrawSet *set) {
    const int last = set->count - 1;
    DipWaterUniforms *water = &set->water[last];
    *water = (DipWaterUniforms){
        .surface = set->uniforms[last],
        .mirrored = pass->shown,
        .inverse_size = {1.0f / (float)pass->width, 1.0f / (float)pass->height},
        .schlick = pass->schlick,
    };
    set->draws[last].uniforms = water;
    set->draws[last].fragment_shader = input->kernels->dip_kernel_water_fragment;
    set->draws[last].own_shading = true; // the mirrored picture has this frame's samples
}

static DipCull cull_of(const DipSceneMaterial *material, const DipSceneObject *object,
                       bool mirrored) {
    if (material->double_sided) {
        return DIP_CULL_NONE;
    }
    return object->mirrors != mirrored ? DIP_CULL_FRONT : DIP_CULL_BACK;
}

static void round_matrix(const double matrix[16], float rounded[16]) {
    for (int i = 0; i < 16; i++) {
        rounded[i] = (float)matrix[i];
    }
}

// Sets the matrices of the draw that was added last.
static void set_matrices(const DipView *view, const DipSceneObject *object, DipDrawSet *set) {
    static const float no_origin[3] = {0.0f, 0.0f, 0.0f};
    DipSurfaceUniforms *uniforms = &set->uniforms[set->count - 1];
    DipDrawMatrices *matrices = &set->matrices[set->count - 1];
    DipExactTransform *exact = &matrices->exact_to_clip;
    dip_view_object_origin(view, object->transform, object->world_to_object, exact->origin);
    dip_view_object_to_clip(view, object->transform, exact->origin, exact->to_clip);
    round_matrix(exact->to_clip, uniforms->to_clip);
    memcpy(uniforms->origin, exact->origin, sizeof uniforms->origin);
    memcpy(matrices->bounds_to_clip, uniforms->to_clip, sizeof uniforms->to_clip);
    if (exact->origin[0] != 0.0f || exact->origin[1] != 0.0f || exact->origin[2] != 0.0f) {
        double bounds_to_clip[16];
        dip_view_object_to_clip(view, object->transform, no_origin, bounds_to_clip);
        round_matrix(bounds_to_clip, matrices->bounds_to_clip);
    }
    memcpy(uniforms->normal_to_world, object->normal_to_world, sizeof uniforms->normal_to_world);
}

static void add_draw(const DipDrawInput *input, const DipDrawView *pass, int index,
                     DipDrawSet *set) {
    const DipSceneObject *object = &input->scene->objects[index];
    const DipSceneMesh *mesh = &input->scene->meshes[object->mesh];
    const DipSceneMaterial *material = &input->scene->materials[mesh->material];
    DipDraw *draw = &set->draws[set->count];
    DipSurfaceUniforms *uniforms = &set->uniforms[set->count++];
    *uniforms = mesh->normal_mapped && !input->plain_surfaces ? mesh->mapped_layout : mesh->layout;
    set_matrices(pass->view, object, set);
    if (input->quality->step[DIP_SETTING_MIPDEBUG] && uniforms->colour_varying != DIP_ABSENT) {
        for (int c = 0; c < 3; c++) {
            uniforms->base_colour_lin[c] = 1.0f;
        }
    }
    const bool clipped =
        material->surface == DIP_SURFACE_CLIPPED && uniforms->colour_varying != DIP_ABSENT;
    *draw = (DipDraw){
        .mesh = input->unshared ? dip_unshared_mesh(input->unshared, index) : mesh->mesh,
        .vertex_shader = input->kernels->dip_kernel_surface_vertex,
        .fragment_shader = input->kernels->dip_kernel_surface_fragment,
        .clip_shader = clipped ? input->kernels->dip_kernel_surface_clip : NULL,
        .varying_count = mesh->varying_count,
        .value_only_varying_count = mesh->layout.light_varying == DIP_ABSENT
                                        ? 0
                                        : mesh->varying_count - mesh->layout.light_varying,
        .clip_varying_count = clipped ? uniforms->colour_varying + 2 : 0,
        .repeating_varyings = mesh->repeating_varyings,
        .uniforms = uniforms,
        .samplers = input->samplers[mesh->material],
        .bounds_to_clip = set->matrices[set->count - 1].bounds_to_clip,
        // A sky is nowhere near the eye, so floats are exact enough for it.
        .exact_to_clip = material->surface == DIP_SURFACE_SKY
                             ? NULL
                             : &set->matrices[set->count - 1].exact_to_clip,
        .cull = cull_of(material, object, pass->mirrored),
        // Sample groups shift the level of detail.
        .own_shading =
            material->surface == DIP_SURFACE_CLIPPED && group_bias_lod8(input->quality) != 0,
    };
    uniforms->rays = &set->rays;
    set_lights(input, set, object, uniforms, draw);
    set_effect(input, mesh, uniforms, draw);
    if (pass->shown && material->surface == DIP_SURFACE_WATER) {
        set_reflecting(input, pass, set);
    }
}

void dip_draw_set_fill(DipDrawSet *set, const DipDrawInput *input, const DipDrawView *pass) {
    const DipScene *scene = input->scene;
    set->count = 0;
    set->culled = 0;
    set->rays = view_rays(pass->view->world_to_clip, pass->width, pass->height);
    if (scene->has_lit) {
        dip_lighting_at(scene->lighting, pass->view->eye, &set->lighting);
    }
    for (int i = 0; i < scene->object_count; i++) {
        const DipSceneObject *object = &scene->objects[i];
        const bool water =
            scene->materials[scene->meshes[object->mesh].material].surface == DIP_SURFACE_WATER;
        if (pass->mirrored && water) {
            continue;
        }
        if (pass->seen && dip_cull_outside(pass->seen, &object->bounds)) {
            set->culled++;
        } else {
            add_draw(input, pass, i, set);
        }
    }
}
