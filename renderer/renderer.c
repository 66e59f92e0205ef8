// The renderer: a scene, a pose and settings become the draws of one pass.
#include "renderer/renderer.h"

#include "renderer/base/assert.h"
#include "renderer/base/trig.h"
#include "renderer/instancing.h"
#include "renderer/pipeline.h"
#include "renderer/raster/kernels.h"
#include "renderer/scene_internal.h"
#include "renderer/sky.h"
#include "renderer/texture/mip_debug.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ALIGN = 64 };

struct DipRenderer {
    DipPool *pool;
    DipIsa isa;
    int width;
    int height;
    DipQuality quality;
    uint64_t frame_index;
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    bool plain_surfaces;
    DipTexture *mip_colours; // levels 1024 .. 8 of mip debugging
    DipViewRays rays;        // of the frame, where a shader needs them
    DipSkyUniforms sky;      // likewise

    // For the scene drawn last.
    uint64_t scene_serial;
    DipDraw *draws;                                    // per object
    DipSurfaceUniforms *uniforms;                      // per object
    DipSampler (*samplers)[DIP_SURFACE_SAMPLER_COUNT]; // per material
    DipExpanded *expanded;                             // gi=off; else NULL
};

DipRendererDef dip_renderer_default_def(void) {
    return (DipRendererDef){
        .isa = dip_isa_best(),
        .width = 640,
        .height = 480,
        .quality = dip_quality_default(),
    };
}

// Makes the pipeline and the pixels of a size into *pipeline and *rgba8, or neither.
static bool make_target(DipPool *pool, DipIsa isa, int width, int height, DipPipeline **pipeline,
                        uint8_t **rgba8, size_t *stride_bytes, DipError *err) {
    *pipeline = dip_pipeline_create(pool, isa, width, height, err);
    if (!*pipeline) {
        return false;
    }
    *stride_bytes = ((size_t)width * 4 + PIXEL_ALIGN - 1) / PIXEL_ALIGN * PIXEL_ALIGN;
    *rgba8 = aligned_alloc(PIXEL_ALIGN, *stride_bytes * (size_t)height);
    if (!*rgba8) {
        dip_pipeline_destroy(pipeline);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "size", "no memory for %dx%d pixels",
                             width, height);
    }
    return true;
}

DipRenderer *dip_renderer_create(const DipRendererDef *def, DipError *err) {
    if (!dip_quality_check(&def->quality, err)) {
        return NULL;
    }
    DipRenderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "renderer", "out of memory");
        return NULL;
    }
    renderer->pool = def->pool;
    renderer->isa = def->isa;
    renderer->width = def->width;
    renderer->height = def->height;
    renderer->quality = def->quality;
    renderer->plain_surfaces = def->plain_surfaces;
    renderer->mip_colours = dip_mip_debug_create(NULL, err);
    if (!renderer->mip_colours ||
        !make_target(def->pool, def->isa, def->width, def->height, &renderer->pipeline,
                     &renderer->rgba8, &renderer->stride_bytes, err)) {
        dip_renderer_destroy(&renderer);
    }
    return renderer;
}

void dip_renderer_destroy(DipRenderer **renderer_pointer) {
    DipRenderer *renderer = *renderer_pointer;
    if (!renderer) {
        return;
    }
    dip_pipeline_destroy(&renderer->pipeline);
    dip_texture_destroy(&renderer->mip_colours);
    free(renderer->rgba8);
    free(renderer->draws);
    free(renderer->uniforms);
    free(renderer->samplers);
    dip_expanded_destroy(&renderer->expanded);
    free(renderer);
    *renderer_pointer = NULL;
}

bool dip_renderer_set_quality(DipRenderer *renderer, const DipQuality *quality, DipError *err) {
    if (!dip_quality_check(quality, err)) {
        return false;
    }
    renderer->quality = *quality;
    return true;
}

DipQuality dip_renderer_quality(const DipRenderer *renderer) {
    return renderer->quality;
}

void dip_renderer_set_frame_index(DipRenderer *renderer, uint64_t frame_index) {
    renderer->frame_index = frame_index;
}

bool dip_renderer_resize(DipRenderer *renderer, int width, int height, DipError *err) {
    if (width == renderer->width && height == renderer->height) {
        return true;
    }
    DipPipeline *pipeline;
    uint8_t *rgba8;
    size_t stride_bytes;
    if (!make_target(renderer->pool, renderer->isa, width, height, &pipeline, &rgba8, &stride_bytes,
                     err)) {
        return false;
    }
    dip_pipeline_destroy(&renderer->pipeline);
    free(renderer->rgba8);
    renderer->pipeline = pipeline;
    renderer->rgba8 = rgba8;
    renderer->stride_bytes = stride_bytes;
    renderer->width = width;
    renderer->height = height;
    return true;
}

bool dip_renderer_set_mip_pictures(DipRenderer *renderer,
                                   const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                   DipError *err) {
    DipTexture *colours = dip_mip_debug_create(pictures, err);
    if (!colours) {
        return false;
    }
    dip_texture_destroy(&renderer->mip_colours);
    renderer->mip_colours = colours;
    return true;
}

// --- a frame's draws ---------------------------------------------------------------------------

// World to clip space, row-major, in double: see docs/picture.md, Camera.
static void view_projection(const DipPose *pose, const DipScene *scene, double aspect,
                            double m[16]) {
    const double x = pose->orientation[0];
    const double y = pose->orientation[1];
    const double z = pose->orientation[2];
    const double w = pose->orientation[3];
    // Rows of the world-to-camera rotation are the camera's axes in the world.
    const double axis[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
    };
    const double half_fov = pose->fov_y_deg * (3.14159265358979323846 / 360.0);
    const double f = dip_cos(half_fov) / dip_sin(half_fov);
    const double scale[4] = {f / aspect, f, 0.0, -1.0};
    const int camera_axis[4] = {0, 1, 0, 2};
    for (int row = 0; row < 4; row++) {
        const double *a = axis[camera_axis[row]];
        double shift = 0.0;
        for (int c = 0; c < 3; c++) {
            m[4 * row + c] = scale[row] * a[c];
            shift -= a[c] * pose->position_world[c];
        }
        m[4 * row + 3] = scale[row] * shift;
    }
    m[11] = (double)scene->near_m; // clip z is the near distance everywhere
}

// product = m * transform, with transform's last row (0, 0, 0, 1).
static void place(const double m[16], const float transform[12], float product[16]) {
    for (int row = 0; row < 4; row++) {
        for (int c = 0; c < 4; c++) {
            double sum = c == 3 ? m[4 * row + 3] : 0.0;
            for (int k = 0; k < 3; k++) {
                sum += m[4 * row + k] * (double)transform[4 * k + c];
            }
            product[4 * row + c] = (float)sum;
        }
    }
}

// The cofactors of the transform's 3x3 part, which turn normals as the inverse transpose does but
// for length and, where the transform mirrors, sign.
static void cofactors(const float t[12], double n[9]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            const float *a = t + 4 * ((r + 1) % 3);
            const float *b = t + 4 * ((r + 2) % 3);
            n[3 * r + c] =
                (double)a[(c + 1) % 3] * b[(c + 2) % 3] - (double)a[(c + 2) % 3] * b[(c + 1) % 3];
        }
    }
}

static bool mirrors(const float t[12]) {
    double n[9];
    cofactors(t, n);
    return (t[0] * n[0] + t[1] * n[1]) + t[2] * n[2] < 0.0;
}

// Scaled to a greatest element of 1, so that the shader may normalise what it turns, however small
// the object is.
static void normal_matrix(const float t[12], float out[9]) {
    double n[9];
    cofactors(t, n);
    double greatest = 0.0;
    for (int i = 0; i < 9; i++) {
        const double size = n[i] < 0.0 ? -n[i] : n[i];
        greatest = size > greatest ? size : greatest;
    }
    const double scale = greatest > 0.0 ? (mirrors(t) ? -1.0 : 1.0) / greatest : 0.0;
    for (int i = 0; i < 9; i++) {
        out[i] = (float)(n[i] * scale);
    }
}

// The rays through the target's places. The rows of x, y and w are at right angles in their first
// three elements, so that a point is the sum of them, each times its coordinate over its squared
// length.
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
    }
    return rays;
}

static DipSampler colour_sampler(const DipRenderer *renderer, const DipTexture *texture) {
    // Per step of miplod, from high performance to high quality: bias in levels, times 256.
    static const int32_t bias_lod8[] = {384, 256, 128, 0};
    const int miplod = renderer->quality.step[DIP_SETTING_MIPLOD];
    DipSampler sampler = {
        .texture = texture,
        .max_anisotropy = dip_quality_max_anisotropy(&renderer->quality),
        .advanced = renderer->quality.step[DIP_SETTING_AAF] != 0,
        .bias_lod8 = bias_lod8[miplod],
        .cheap = renderer->quality.step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
    if (miplod == DIP_MIPLOD_HIGH_PERFORMANCE) {
        sampler.min_lod8 = texture->width >= 1024 || texture->height >= 1024 ? 512 : 256;
    }
    if (renderer->quality.step[DIP_SETTING_MIPDEBUG]) {
        sampler.shown = renderer->mip_colours;
        dip_mip_debug_levels(texture, sampler.shown_level);
    }
    return sampler;
}

// A pass' share of the pixel is smaller, so it may read finer levels: by log2(sqrt(passes)), which
// keeps thin parts of clip maps from being averaged away.
static int32_t pass_bias_lod8(const DipQuality *quality) {
    static const int32_t bias_lod8[DIP_MAX_SAMPLES + 1] = {
        [2] = -128, [3] = -203, [4] = -256, [6] = -331, [8] = -384};
    return bias_lod8[dip_quality_sample_count(quality) / dip_quality_samples_per_pass(quality)];
}

static const DipTexture *colour_texture(const DipRenderer *renderer, const DipScene *scene,
                                        const DipSceneMaterial *material) {
    const bool compressed =
        dip_quality_compresses(&renderer->quality) && material->surface != DIP_SURFACE_SKY;
    return compressed ? dip_late_texture(scene->late, material->colour_texture)
                      : scene->textures[material->colour_texture];
}

static void set_samplers(DipRenderer *renderer, const DipScene *scene) {
    for (int i = 0; i < scene->material_count; i++) {
        const DipSceneMaterial *material = &scene->materials[i];
        if (material->colour_texture != DIP_NO_TEXTURE) {
            DipSampler *sampler = &renderer->samplers[i][DIP_SURFACE_SAMPLER_COLOUR];
            *sampler = colour_sampler(renderer, colour_texture(renderer, scene, material));
            if (material->surface == DIP_SURFACE_CLIPPED) {
                sampler->bias_lod8 += pass_bias_lod8(&renderer->quality);
            }
        }
        if (material->light_map != DIP_NO_TEXTURE) {
            renderer->samplers[i][DIP_SURFACE_SAMPLER_LIGHT_MAP] =
                (DipSampler){.texture = scene->textures[material->light_map], .max_anisotropy = 1};
        }
        if (material->normal_map != DIP_NO_TEXTURE) {
            DipSampler *sampler = &renderer->samplers[i][DIP_SURFACE_SAMPLER_NORMAL_MAP];
            *sampler = colour_sampler(renderer, scene->textures[material->normal_map]);
            sampler->shown = NULL; // mip debugging colours the colour texture
        }
    }
}

// Turns a draw into one with an effect's shaders. Mip debugging shows a sky's own texture.
static void set_effect(const DipRenderer *renderer, const DipSceneMesh *mesh,
                       DipSurfaceUniforms *uniforms, DipDraw *draw) {
    const DipKernels *kernels = dip_kernels(renderer->isa);
    if (renderer->plain_surfaces) {
        return;
    }
    if (mesh->normal_mapped) {
        draw->vertex_shader = kernels->dip_kernel_normal_map_vertex;
        draw->fragment_shader = kernels->dip_kernel_normal_map_fragment;
        draw->slot_count = mesh->mapped_slot_count;
        draw->plain_slot_count = 0;
    } else if (mesh->sky && !renderer->quality.step[DIP_SETTING_MIPDEBUG]) {
        draw->fragment_shader = kernels->dip_kernel_sky_fragment;
    }
    uniforms->rays = &renderer->rays;
    uniforms->sky = &renderer->sky;
}

static void set_draw(DipRenderer *renderer, const DipScene *scene, int index,
                     const double world_to_clip[16]) {
    const DipKernels *kernels = dip_kernels(renderer->isa);
    const DipSceneObject *object = &scene->objects[index];
    const DipSceneMesh *mesh = &scene->meshes[object->mesh];
    const DipSceneMaterial *material = &scene->materials[mesh->material];
    DipSurfaceUniforms *uniforms = &renderer->uniforms[index];
    *uniforms =
        mesh->normal_mapped && !renderer->plain_surfaces ? mesh->mapped_layout : mesh->layout;
    place(world_to_clip, object->transform, uniforms->to_clip);
    normal_matrix(object->transform, uniforms->normal_to_world);
    if (renderer->quality.step[DIP_SETTING_MIPDEBUG] && uniforms->colour_slot != DIP_NO_SLOT) {
        for (int c = 0; c < 3; c++) {
            uniforms->base_colour_lin[c] = 1.0f;
        }
    }
    const bool clipped =
        material->surface == DIP_SURFACE_CLIPPED && uniforms->colour_slot != DIP_NO_SLOT;
    renderer->draws[index] = (DipDraw){
        .mesh = renderer->expanded ? dip_expanded_mesh(renderer->expanded, index) : mesh->mesh,
        .vertex_shader = kernels->dip_kernel_surface_vertex,
        .fragment_shader = kernels->dip_kernel_surface_fragment,
        .clip_shader = clipped ? kernels->dip_kernel_surface_clip : NULL,
        .slot_count = mesh->slot_count,
        .plain_slot_count =
            mesh->layout.light_slot == DIP_NO_SLOT ? 0 : mesh->slot_count - mesh->layout.light_slot,
        .clip_slot_count = clipped ? uniforms->colour_slot + 2 : 0,
        .uniforms = uniforms,
        .samplers = renderer->samplers[mesh->material],
        .bounds_to_clip = uniforms->to_clip,
        .cull = material->double_sided       ? DIP_CULL_NONE
                : mirrors(object->transform) ? DIP_CULL_FRONT
                                             : DIP_CULL_BACK,
    };
    set_effect(renderer, mesh, uniforms, &renderer->draws[index]);
}

// Makes the arrays for a scene not drawn before.
static bool adopt_scene(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    if (renderer->scene_serial == scene->serial) {
        return true;
    }
    renderer->scene_serial = 0;
    free(renderer->draws);
    free(renderer->uniforms);
    free(renderer->samplers);
    dip_expanded_destroy(&renderer->expanded);
    const size_t objects = (size_t)scene->object_count + 1;
    renderer->draws = calloc(objects, sizeof *renderer->draws);
    renderer->uniforms = calloc(objects, sizeof *renderer->uniforms);
    renderer->samplers = calloc((size_t)scene->material_count + 1, sizeof *renderer->samplers);
    if (!renderer->draws || !renderer->uniforms || !renderer->samplers) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "no memory for %d objects",
                             scene->object_count);
    }
    renderer->scene_serial = scene->serial;
    return true;
}

// Makes what the settings need of the scene beside it, or gives it back.
static bool follow_settings(DipRenderer *renderer, const DipScene *scene, DipError *err) {
    const DipQuality *quality = &renderer->quality;
    if (dip_quality_compresses(quality) &&
        !dip_scene_compress_textures(scene, renderer->pool, err)) {
        return false;
    }
    if (quality->step[DIP_SETTING_GI]) {
        dip_expanded_destroy(&renderer->expanded);
    } else if (!renderer->expanded) {
        renderer->expanded = dip_expanded_create(scene, renderer->pool, err);
        return renderer->expanded != NULL;
    }
    return true;
}

static DipEffects effects_of(const DipScene *scene, const DipCounters *counters) {
    DipEffects effects;
    effects.light_map = scene->has_light_map
                            ? (DipEffect){true, "the scene has light-mapped surfaces"}
                            : (DipEffect){false, "the scene has no light map"};
    if (!scene->has_clipped) {
        effects.alpha_clip = (DipEffect){false, "the scene has no alpha-clipped surface"};
    } else if (!counters->fragments_clip_tested) {
        effects.alpha_clip = (DipEffect){false, "no alpha-clipped surface is in view"};
    } else {
        effects.alpha_clip = (DipEffect){true, "alpha-clipped surfaces are in view"};
    }
    effects.normal_map = !scene->has_normal_map
                             ? (DipEffect){false, "the scene has no normal-mapped surface"}
                         : !counters->fragments_normal_mapped
                             ? (DipEffect){false, "no normal-mapped surface is in view"}
                             : (DipEffect){true, "normal-mapped surfaces are in view"};
    effects.sky = !scene->has_sky ? (DipEffect){false, "the scene has no sky with clouds"}
                  : !counters->fragments_sky
                      ? (DipEffect){false, "no sky is in view, or it is drawn plain"}
                      : (DipEffect){true, "sky is in view"};
    return effects;
}

static DipEffect adaptive_aa_of(const DipQuality *quality, DipEffect alpha_clip) {
    if (!quality->step[DIP_SETTING_AAA]) {
        return (DipEffect){false, "adaptive AA is off"};
    }
    if (dip_quality_samples_per_pass(quality) == dip_quality_sample_count(quality)) {
        return (DipEffect){false, "one pass holds all samples"};
    }
    return alpha_clip.run ? (DipEffect){true, "alpha-clipped surfaces are drawn in several passes"}
                          : alpha_clip;
}

static bool check_pose(const DipPose *pose, DipError *err) {
    bool finite = isfinite(pose->fov_y_deg);
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(pose->position_world[i]);
    }
    for (int i = 0; i < 4; i++) {
        finite = finite && isfinite(pose->orientation[i]);
    }
    if (!finite || pose->fov_y_deg < 1.0 || pose->fov_y_deg > 170.0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "a pose with a field of view of %g degrees, accepted finite numbers "
                             "and 1..170",
                             pose->fov_y_deg);
    }
    return true;
}

bool dip_renderer_draw(DipRenderer *renderer, const DipScene *scene, const DipPose *pose,
                       int64_t time_ns, DipFrame *frame, DipError *err) {
    if (!check_pose(pose, err) || !adopt_scene(renderer, scene, err) ||
        !follow_settings(renderer, scene, err)) {
        return false;
    }
    double world_to_clip[16];
    view_projection(pose, scene, (double)renderer->width / renderer->height, world_to_clip);
    set_samplers(renderer, scene);
    if (scene->has_normal_map || scene->has_sky) {
        renderer->rays = view_rays(world_to_clip, renderer->width, renderer->height);
        renderer->sky = dip_sky_at(&scene->sky, time_ns);
    }
    for (int i = 0; i < scene->object_count; i++) {
        set_draw(renderer, scene, i, world_to_clip);
    }
    DipPass pass = {
        .draws = renderer->draws,
        .draw_count = scene->object_count,
        .sample_count = dip_quality_sample_count(&renderer->quality),
        .pattern =
            dip_pattern_kind(renderer->quality.step[DIP_SETTING_TAA] != 0, renderer->frame_index),
        .samples_per_pass = dip_quality_samples_per_pass(&renderer->quality),
        .target = {renderer->rgba8, renderer->stride_bytes, renderer->width, renderer->height},
    };
    memcpy(pass.clear_lin, scene->background_lin, sizeof pass.clear_lin);
    *frame = (DipFrame){
        .rgba8 = renderer->rgba8,
        .stride_bytes = renderer->stride_bytes,
        .width = renderer->width,
        .height = renderer->height,
    };
    if (!dip_pipeline_draw(renderer->pipeline, &pass, &frame->counters, &frame->stages, err)) {
        return false;
    }
    dip_count_geometry(scene, renderer->expanded, &frame->counters);
    frame->effects = effects_of(scene, &frame->counters);
    frame->effects.adaptive_aa = adaptive_aa_of(&renderer->quality, frame->effects.alpha_clip);
    return true;
}
