// Makes the draws of a render pass, one object at a time.
#include "renderer/scene/draw/draws.h"

#include "renderer/scene/resources/lighting.h"
#include "renderer/scene/mip_debug.h"
#include "renderer/scene/resources/scene_layout.h"

#include <stdlib.h>
#include <string.h>

bool dip_draw_set_make(DipDrawSet *set, const DipScene *scene, bool reflects, DipError *err) {
    const size_t room = (size_t)scene->object_count + (size_t)scene->blended_added_draws + 1;
    const size_t blended = (size_t)scene->blended_count;
    set->draws = calloc(room, sizeof *set->draws);
    set->uniforms = calloc(room, sizeof *set->uniforms);
    set->matrices = calloc(room, sizeof *set->matrices);
    set->water = reflects ? calloc(room, sizeof *set->water) : NULL;
    set->blended = blended ? calloc(blended, sizeof *set->blended) : NULL;
    set->levels = blended ? calloc(blended, sizeof *set->levels) : NULL;
    set->plain = calloc(room, sizeof *set->plain);
    set->in_view = calloc(room, sizeof *set->in_view);
    if (!set->draws || !set->uniforms || !set->matrices || (reflects && !set->water) ||
        !set->plain || !set->in_view || (blended && (!set->blended || !set->levels))) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "no memory for %d objects",
                             scene->object_count);
    }
    return true;
}

void dip_draw_set_free(DipDrawSet *set) {
    free(set->draws);
    free(set->uniforms);
    free(set->matrices);
    free(set->water);
    free(set->blended);
    free(set->levels);
    free(set->plain);
    free(set->in_view);
    *set = (DipDrawSet){0};
}

// --- textures ----------------------------------------------------------------------------------

static DipSampler colour_sampler(const DipQuality *quality, const DipTexture *shown,
                                 const DipTexture *texture) {
    DipSampler sampler = {
        .texture = texture,
        .max_anisotropy = dip_quality_max_anisotropy(quality),
        .exact_footprint = quality->step[DIP_SETTING_AAF] != 0,
        .bias_lod8 = dip_quality_bias_lod8(quality),
        .cheap = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
    if (quality->step[DIP_SETTING_MIPLOD] == DIP_MIPLOD_HIGH_PERFORMANCE) {
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
        // Blended surfaces are shaded once per pixel, whatever the settings.
        const bool all = dip_quality_groups_shade_all(quality);
        const bool has_groups =
            material->surface == DIP_SURFACE_CLIPPED || (all && !material->blended);
        const int32_t own_bias_lod8 = has_groups ? dip_quality_groups_bias_lod8(quality) : 0;
        if (material->colour_texture != DIP_NO_TEXTURE) {
            DipSampler *sampler = &samplers[i][DIP_SURFACE_SAMPLER_COLOUR];
            *sampler = colour_sampler(quality, shown, colour_texture(scene, quality, material));
            sampler->bias_lod8 += own_bias_lod8;
        }
        if (material->light_map != DIP_NO_TEXTURE) {
            samplers[i][DIP_SURFACE_SAMPLER_LIGHT_MAP] =
                (DipSampler){.texture = scene->textures[material->light_map], .max_anisotropy = 1};
        }
        const int data[DIP_SURFACE_SAMPLER_COUNT] = {
            [DIP_SURFACE_SAMPLER_COLOUR] = DIP_NO_TEXTURE,
            [DIP_SURFACE_SAMPLER_LIGHT_MAP] = DIP_NO_TEXTURE,
            [DIP_SURFACE_SAMPLER_NORMAL_MAP] = material->normal_map,
            [DIP_SURFACE_SAMPLER_METAL_ROUGH] = material->pbr.metal_rough,
            [DIP_SURFACE_SAMPLER_OCCLUSION] = material->pbr.occlusion,
            [DIP_SURFACE_SAMPLER_EMISSION] = material->pbr.emission,
        };
        for (int k = 0; k < DIP_SURFACE_SAMPLER_COUNT; k++) {
            if (data[k] != DIP_NO_TEXTURE) {
                samplers[i][k] = colour_sampler(quality, shown, scene->textures[data[k]]);
                samplers[i][k].bias_lod8 += own_bias_lod8;
                samplers[i][k].shown = NULL; // mip colours replace colour textures only
            }
        }
    }
}

// --- objects -----------------------------------------------------------------------------------

// Computes the view rays through the pixels of a target. The rows of the view for clip x, y and w
// are orthogonal vectors. So a point relative to the eye is a weighted sum of these vectors: the
// weight of a vector is its clip coordinate divided by the vector's squared length. The shift of
// the view adds multiples of w to x and y, which the vector of w takes away.
static DipViewRays view_rays(const DipView *view, int width, int height) {
    const double scale[3] = {view->scale[0], view->scale[1], -1.0};
    DipViewRays rays;
    double rows[3][3];
    double inverse2[3];
    for (int row = 0; row < 3; row++) {
        double *r = rows[row];
        for (int c = 0; c < 3; c++) {
            r[c] = scale[row] * view->axis[row][c];
        }
        inverse2[row] = 1.0 / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    }
    for (int c = 0; c < 3; c++) {
        const double right = rows[0][c] * inverse2[0];
        const double up = rows[1][c] * inverse2[1];
        const double ahead =
            rows[2][c] * inverse2[2] - right * view->shift[0] - up * view->shift[1];
        rays.origin[c] = (float)(ahead - right + up);
        rays.per_x[c] = (float)(2.0 * right / width);
        rays.per_y[c] = (float)(-2.0 * up / height);
        rays.right[c] = (float)right;
        rays.up[c] = (float)up;
        rays.ahead[c] = (float)ahead;
    }
    return rays;
}

// Adds varyings to a surface that is lit at its vertices: the depth, from which its place in the
// shadow map follows, and the light of the light with shadows. The depth needs derivatives, so it
// comes before the varyings that need none.
static void add_direct_light(DipSurfaceUniforms *uniforms, DipDraw *draw) {
    uniforms->depth_varying = uniforms->light_varying;
    uniforms->light_varying++;
    uniforms->highlight_varying++;
    uniforms->direct_varying = draw->varying_count + 1;
    draw->varying_count += 4;
    draw->value_only_varying_count = draw->varying_count - uniforms->light_varying;
}

// If the scene's lights light the mesh of a draw, finds those that reach it and sets the shaders.
// shadow: the shadows that the mesh receives, or NULL.
static void set_lights(const DipDrawInput *input, const DipSceneObject *object,
                       const DipShadowUniforms *shadow, DipSurfaceUniforms *uniforms,
                       DipDraw *draw) {
    const DipMaterialKernels *kernels = input->kernels;
    const DipSceneMesh *mesh = &input->scene->meshes[object->mesh];
    if (!mesh->lit_by_lights) {
        return;
    }
    if (!input->all_lights) {
        uniforms->lights = dip_lights_reaching(input->scene->lighting, &object->bounds);
    }
    uniforms->shadow = shadow;
    if (mesh->fragments_lit) {
        draw->vertex_shader = kernels->dip_kernel_fragment_lit_vertex;
        draw->fragment_shader = kernels->dip_kernel_phong_fragment;
        draw->value_only_varying_count = mesh->varying_count - uniforms->normal_varying;
    } else {
        draw->vertex_shader = kernels->dip_kernel_gouraud_vertex;
        draw->fragment_shader = kernels->dip_kernel_gouraud_fragment;
        if (shadow && uniforms->depth_varying == DIP_ABSENT) {
            add_direct_light(uniforms, draw);
        }
    }
}

// Draws a mesh with its metallic-roughness surface.
static void set_pbr(const DipMaterialKernels *kernels, const DipSceneMesh *mesh,
                    DipSurfaceUniforms *uniforms, DipDraw *draw) {
    draw->vertex_shader = kernels->dip_kernel_fragment_lit_vertex;
    if (uniforms->backdrop) {
        draw->fragment_shader = kernels->dip_kernel_pbr_scattering_fragment;
    } else if (uniforms->pbr->sheen || uniforms->pbr->transmission > 0.0f) {
        draw->fragment_shader = kernels->dip_kernel_pbr_layered_fragment;
    } else {
        draw->fragment_shader = uniforms->pbr->environment
                                    ? kernels->dip_kernel_pbr_environment_fragment
                                    : kernels->dip_kernel_pbr_fragment;
    }
    draw->varying_count = mesh->full_varying_count;
    // The plane of a triangle follows from the derivatives of the depth.
    const bool needs_plane = mesh->normal_mapped || uniforms->pbr->two_sided;
    const int derived = needs_plane ? uniforms->depth_varying + 1 : uniforms->normal_varying;
    draw->value_only_varying_count = mesh->full_varying_count - derived;
}

// If the mesh of a draw has an effect (metallic-roughness surface, normal map or clouds), sets the
// effect's shaders. If mip colours are on, a sky keeps the plain shader, so that the colours of its
// texture's levels can be seen.
static void set_effect(const DipDrawInput *input, const DipSceneMesh *mesh,
                       DipSurfaceUniforms *uniforms, DipDraw *draw) {
    const DipMaterialKernels *kernels = input->kernels;
    uniforms->sky = input->sky;
    if (input->plain_surfaces) {
        return;
    }
    if (mesh->pbr) {
        set_pbr(kernels, mesh, uniforms, draw);
    } else if (mesh->normal_mapped) {
        draw->vertex_shader = kernels->dip_kernel_fragment_lit_vertex;
        draw->fragment_shader = mesh->lit_by_lights ? kernels->dip_kernel_phong_fragment
                                                    : kernels->dip_kernel_normal_map_fragment;
        draw->varying_count = mesh->full_varying_count;
        draw->value_only_varying_count = 0;
    } else if (mesh->sky && !input->quality->step[DIP_SETTING_MIPDEBUG]) {
        draw->fragment_shader = kernels->dip_kernel_sky_fragment;
        draw->computed_varying_count = 2; // the coordinates of the layer of clouds
    }
}

// Turns draw `at` into reflecting water, which shows the mirrored picture.
static void set_reflecting(const DipDrawInput *input, const DipDrawView *pass, int at,
                           DipDrawSet *set) {
    DipWaterUniforms *water = &set->water[at];
    *water = (DipWaterUniforms){
        .surface = set->uniforms[at],
        .mirrored = pass->shown,
        .inverse_size = {1.0f / (float)pass->width, 1.0f / (float)pass->height},
        .schlick = pass->schlick,
    };
    set->draws[at].uniforms = water;
    set->draws[at].fragment_shader = input->kernels->dip_kernel_water_fragment;
    set->draws[at].own_shading = true; // the mirrored picture has this frame's samples
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

// Sets the matrices of draw `at`.
static void set_matrices(const DipView *view, const DipSceneObject *object, int at,
                         DipDrawSet *set) {
    static const float no_origin[3] = {0.0f, 0.0f, 0.0f};
    DipSurfaceUniforms *uniforms = &set->uniforms[at];
    DipDrawMatrices *matrices = &set->matrices[at];
    DipExactTransform *exact = &matrices->exact_to_clip;
    dip_view_object_origin(view->eye, object->transform, object->world_to_object, exact->origin);
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

static DipFragmentShader *clip_shader(const DipDrawInput *input) {
    return dip_quality_covers_by_alpha(input->quality) ? input->kernels->dip_kernel_surface_cover
                                                       : input->kernels->dip_kernel_surface_clip;
}

// A sky is nowhere near the eye, so floats are exact enough where it is cut, unless it reaches
// farther than this, in metres: the steps of floats are 1/16 m there.
#define SKY_FAR_COORDINATE 0x1p19f

// Makes draw `at` of the set, which draws the object with this index. It writes nothing of the set
// but what belongs to the draw.
static void make_draw(const DipDrawInput *input, const DipDrawView *pass, int index, int at,
                      DipDrawSet *set) {
    const DipSceneObject *object = &input->scene->objects[index];
    const DipSceneMesh *mesh = &input->scene->meshes[object->mesh];
    const DipSceneMaterial *material = &input->scene->materials[mesh->material];
    DipDraw *draw = &set->draws[at];
    DipSurfaceUniforms *uniforms = &set->uniforms[at];
    const bool full = (mesh->normal_mapped || mesh->pbr) && !input->plain_surfaces;
    *uniforms = full ? mesh->full_layout : mesh->layout;
    uniforms->sample_count = dip_quality_sample_count(input->quality);
    set_matrices(pass->view, object, at, set);
    if (input->quality->step[DIP_SETTING_MIPDEBUG] && uniforms->colour_varying != DIP_ABSENT) {
        for (int c = 0; c < 3; c++) {
            uniforms->base_colour_lin[c] = 1.0f;
        }
    }
    const int alpha_varyings = dip_surface_alpha_varyings(uniforms);
    const bool clipped = material->surface == DIP_SURFACE_CLIPPED && alpha_varyings > 0;
    *draw = (DipDraw){
        .mesh =
            input->unshared ? dip_unshared_mesh(input->unshared, input->scene, index) : mesh->mesh,
        .vertex_shader = input->kernels->dip_kernel_surface_vertex,
        .fragment_shader = input->kernels->dip_kernel_surface_fragment,
        .clip_shader = clipped ? clip_shader(input) : NULL,
        .varying_count = mesh->varying_count,
        .value_only_varying_count = mesh->layout.light_varying == DIP_ABSENT
                                        ? 0
                                        : mesh->varying_count - mesh->layout.light_varying,
        .clip_varying_count = clipped ? alpha_varyings : 0,
        .repeating_varyings = mesh->repeating_varyings,
        .uniforms = uniforms,
        .samplers = input->samplers[mesh->material],
        .bounds_to_clip = set->matrices[at].bounds_to_clip,
        .exact_to_clip = &set->matrices[at].exact_to_clip,
        .cull = cull_of(material, object, pass->mirrored),
        // Sample groups shift the level of detail.
        .own_shading = material->surface == DIP_SURFACE_CLIPPED &&
                       dip_quality_groups_bias_lod8(input->quality) != 0,
    };
    set->matrices[at].exact_to_clip.far_coordinate =
        material->surface == DIP_SURFACE_SKY ? SKY_FAR_COORDINATE : 0.0f;
    uniforms->rays = &set->rays;
    uniforms->lighting = &set->lighting;
    uniforms->lights = UINT64_MAX;
    uniforms->backdrop = full && mesh->full_layout.pbr && mesh->full_layout.pbr->scattering > 0.0f
                             ? pass->backdrop
                             : NULL;
    set_lights(input, object, pass->shadow ? &set->shadow : NULL, uniforms, draw);
    set_effect(input, mesh, uniforms, draw);
    draw->w_varyings = uniforms->depth_varying == DIP_ABSENT ? 0 : 1u << uniforms->depth_varying;
    if (pass->shown && material->surface == DIP_SURFACE_WATER) {
        set_reflecting(input, pass, at, set);
    }
}

// The alpha of the target stays 1.
static const DipDrawState draws_over = {
    .blend = DIP_BLEND_MODE_ALPHA, .kept_channels = DIP_CHANNEL_ALPHA, .keep_depth = true};
static const DipDrawState multiplies = {
    .blend = DIP_BLEND_MODE_MULTIPLICATIVE, .kept_channels = DIP_CHANNEL_ALPHA, .keep_depth = true};
static const DipDrawState adds = {
    .blend = DIP_BLEND_MODE_ADDITIVE, .kept_channels = DIP_CHANNEL_ALPHA, .keep_depth = true};

// Turns the draw that was added last into two: the first multiplies what lies behind by the share
// that the surface lets through, and the second adds the surface's own light.
static void transmit_last(const DipMaterialKernels *kernels, DipDrawSet *set) {
    DipDraw *draw = &set->draws[set->count - 1];
    draw[1] = draw[0];
    draw[0].fragment_shader = kernels->dip_kernel_transmittance_fragment;
    draw[0].state = &multiplies;
    draw[1].state = &adds;
    set->count++;
}

// Blends the draw that was added last. The shader of reflecting water computes the alpha itself,
// and that of rough glass adds what is seen through it, so that it covers what lies behind. A
// double-sided surface is drawn twice: first its back faces, then its front faces.
static void blend_last(const DipDrawInput *input, const DipDrawView *pass, int object,
                       DipDrawSet *set) {
    const DipScene *scene = input->scene;
    const DipSceneObject *shown = &scene->objects[object];
    const DipSceneMaterial *material = &scene->materials[scene->meshes[shown->mesh].material];
    const int first = set->count - 1;
    DipDraw *draw = &set->draws[first];
    DipSurfaceUniforms *uniforms = &set->uniforms[first];
    if (draw->fragment_shader != input->kernels->dip_kernel_water_fragment) {
        uniforms->colour_shader = draw->fragment_shader;
        draw->fragment_shader = input->kernels->dip_kernel_blended_fragment;
    }
    draw->state = &draws_over;
    draw->own_shading = false; // the pixels of blended surfaces are never copied
    if (uniforms->pbr && uniforms->pbr->transmission > 0.0f && !uniforms->backdrop) {
        transmit_last(input->kernels, set);
    }
    if (material->double_sided) {
        const bool reversed = shown->mirrors != pass->mirrored;
        const int count = set->count - first;
        for (int i = 0; i < count; i++) {
            draw[i].cull = reversed ? DIP_CULL_BACK : DIP_CULL_FRONT;
            draw[count + i] = draw[i];
            draw[count + i].cull = reversed ? DIP_CULL_FRONT : DIP_CULL_BACK;
        }
        set->count += count;
    }
}

static const DipSceneMaterial *material_of(const DipScene *scene, const DipSceneObject *object) {
    return &scene->materials[scene->meshes[object->mesh].material];
}

// Finds the heights of the blended water, whether or not it is in view.
static void find_levels(const DipScene *scene, DipDrawSet *set) {
    set->level_count = 0;
    for (int i = 0; scene->blended_count && scene->has_water && i < scene->object_count; i++) {
        const DipSceneMaterial *material = material_of(scene, &scene->objects[i]);
        if (material->surface == DIP_SURFACE_WATER && material->blended) {
            set->levels[set->level_count++] = scene->objects[i].bounds.centre[1];
        }
    }
}

static DipBlendedObject place_blended(const DipScene *scene, const DipView *view, int index,
                                      const DipDrawSet *set) {
    const DipSceneObject *object = &scene->objects[index];
    const bool is_water = material_of(scene, object)->surface == DIP_SURFACE_WATER;
    return (DipBlendedObject){dip_blend_layer(set->levels, set->level_count, view->eye[1],
                                              (double)object->bounds.centre[1], is_water),
                              dip_blend_depth(view, &object->bounds), index};
}

// Adds the blended objects, of which there are `count` in set->blended, from far to near.
static void add_blended(const DipDrawInput *input, const DipDrawView *pass, int count,
                        DipDrawSet *set) {
    dip_blend_sort(set->blended, count);
    for (int i = 0; i < count; i++) {
        make_draw(input, pass, set->blended[i].object, set->count++, set);
        blend_last(input, pass, set->blended[i].object, set);
    }
}

static void see_lights(const DipScene *scene, const DipView *view, DipDrawSet *set) {
    if (scene->lighting && (scene->has_lit || scene->pbr)) {
        dip_lighting_at(scene->lighting, view->eye, &set->lighting);
    } else if (scene->pbr) {
        dip_lighting_at(scene->pbr->fixed, view->eye, &set->lighting);
    }
}

// The draws of a pass that are being made, on several threads.
typedef struct Fill {
    DipDrawSet *set;
    const DipDrawInput *input;
    const DipDrawView *pass;
} Fill;

enum { OBJECTS_PER_JOB = 256, DRAWS_PER_JOB = 64 };

static int least(int a, int b) {
    return a < b ? a : b;
}

// Runs jobs for `count` things. A single job needs no other thread.
static void run_jobs(Fill *fill, int count, int per_job, DipTask job) {
    const int jobs = (count + per_job - 1) / per_job;
    dip_pool_run(jobs > 1 ? fill->input->pool : NULL, jobs, job, fill);
}

// Finds which objects of a job are in view.
static void see_objects(void *context, int job, int worker) {
    (void)worker;
    const Fill *fill = context;
    const DipScene *scene = fill->input->scene;
    const int end = least((job + 1) * OBJECTS_PER_JOB, scene->object_count);
    for (int i = job * OBJECTS_PER_JOB; i < end; i++) {
        const DipCullPlanes *seen = fill->pass->seen;
        fill->set->in_view[i] = !seen || !dip_cull_outside(seen, &scene->objects[i].bounds);
    }
}

// Makes the draws of a job, which are not blended.
static void make_draws(void *context, int job, int worker) {
    (void)worker;
    const Fill *fill = context;
    const int end = least((job + 1) * DRAWS_PER_JOB, fill->set->plain_count);
    for (int at = job * DRAWS_PER_JOB; at < end; at++) {
        make_draw(fill->input, fill->pass, fill->set->plain[at], at, fill->set);
    }
}

void dip_draw_set_fill(DipDrawSet *set, const DipDrawInput *input, const DipDrawView *pass) {
    const DipScene *scene = input->scene;
    Fill fill = {set, input, pass};
    int blended = 0;
    set->plain_count = 0;
    set->culled = 0;
    set->rays = view_rays(pass->view, pass->width, pass->height);
    see_lights(scene, pass->view, set);
    find_levels(scene, set);
    if (pass->shadow) {
        set->shadow = *pass->shadow;
    }
    run_jobs(&fill, scene->object_count, OBJECTS_PER_JOB, see_objects);
    for (int i = 0; i < scene->object_count; i++) {
        const DipSceneMaterial *material = material_of(scene, &scene->objects[i]);
        if (pass->mirrored && material->surface == DIP_SURFACE_WATER) {
            continue;
        }
        if (!set->in_view[i]) {
            set->culled++;
        } else if (material->blended) {
            set->blended[blended++] = place_blended(scene, pass->view, i, set);
        } else {
            set->plain[set->plain_count++] = i;
        }
    }
    run_jobs(&fill, set->plain_count, DRAWS_PER_JOB, make_draws);
    set->count = set->plain_count;
    add_blended(input, pass, blended, set);
}
