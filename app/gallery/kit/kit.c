// Implements the kit (kit.h): makes meshes, textures, matrices, passes and samplers for scenes, and
// has the vertex shader that most scenes use.
#include "app/gallery/kit/kit.h"

#include "renderer/base/assert.h"
#include "renderer/base/pages.h"
#include "renderer/scene/mip_debug.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- cameras and passes --------------------------------------------------------------------------

// Returns the rotation from world space to the view space of a camera whose orientation is the
// quaternion q. The quaternion's length must not be 0.
static DipMatrix rotation_to_view(const double q[4]) {
    const double x = q[0];
    const double y = q[1];
    const double z = q[2];
    const double w = q[3];
    const double s = 2.0 / (x * x + y * y + z * z + w * w);
    return (DipMatrix){{1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w), 0.0,
                        s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w), 0.0,
                        s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y), 0.0,
                        0.0, 0.0, 0.0, 1.0}};
}

// Sets the projection and the eye of a camera whose view is known.
static bool set_lens(DipKitCamera *camera, const double eye[3], const DipPerspective *lens,
                     DipError *err) {
    DipMatrix projection;
    if (!dip_camera_perspective(&projection, lens, err)) {
        return false;
    }
    camera->to_clip = dip_matrix_multiply(&projection, &camera->view);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = (float)eye[i];
    }
    return true;
}

bool dip_kit_camera(DipKitCamera *camera, const DipGalleryView *view, double near_distance,
                    DipError *err) {
    const DipPerspective lens = {.fov_deg = view->pose->fov_y_deg,
                                 .aspect = (double)view->target.width / view->target.height,
                                 .near_distance = near_distance};
    const double *eye = view->pose->position_world;
    camera->view = dip_kit_chain(rotation_to_view(view->pose->orientation),
                                 dip_matrix_translation(-eye[0], -eye[1], -eye[2]));
    return set_lens(camera, eye, &lens, err);
}

bool dip_kit_look_at(DipKitCamera *camera, const DipGalleryCamera *from, const DipPerspective *lens,
                     DipError *err) {
    static const double up[3] = {0.0, 1.0, 0.0};
    return dip_camera_look_at(&camera->view, from->eye, from->target, up, err) &&
           set_lens(camera, from->eye, lens, err);
}

DipMatrix dip_kit_chain(DipMatrix a, DipMatrix b) {
    return dip_matrix_multiply(&a, &b);
}

DipMatrix dip_kit_chain3(DipMatrix a, DipMatrix b, DipMatrix c) {
    return dip_matrix_multiply3(&a, &b, &c);
}

DipPass dip_kit_pass(const DipGalleryView *view, const DipDraw *draws, int draw_count,
                     const float clear_lin[3]) {
    DipPass pass = {
        .draws = draws,
        .draw_count = draw_count,
        .sample_count = dip_quality_sample_count(view->quality),
        .pattern = view->pattern,
        .target = view->target,
    };
    const int group = dip_quality_samples_per_group(view->quality);
    pass.samples_per_group = group < pass.sample_count ? group : 0;
    pass.groups_shade_all = dip_quality_groups_shade_all(view->quality);
    pass.alpha_to_coverage = dip_quality_covers_by_alpha(view->quality);
    memcpy(pass.clear_lin, clear_lin, sizeof pass.clear_lin);
    return pass;
}

bool dip_kit_draw(const DipGalleryView *view, DipPipeline *pipeline, const DipPass *pass,
                  DipError *err) {
    return dip_pipeline_draw(pipeline, pass, view->counters, view->times, err);
}

// --- objects -------------------------------------------------------------------------------------

void dip_kit_screen_vertex(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->clip[0][i] = batch->in[0][i];
        batch->clip[1][i] = batch->in[1][i];
        batch->clip[2][i] = 0.5f;
        batch->clip[3][i] = 1.0f;
    }
}

void dip_kit_vertex(const DipVertexBatch *batch) {
    const DipKitObject *object = batch->uniforms;
    dip_vertices_transform(batch, object->to_clip, 4, batch->clip);
    dip_vertices_transform(batch, object->to_world, 3, batch->varying + DIP_KIT_WORLD);
    dip_vertices_turn(batch, DIP_SHAPE_NORMAL, object->normals, batch->varying + DIP_KIT_NORMAL);
    dip_vertices_copy(batch, DIP_SHAPE_TEXTURE, DIP_KIT_UV, 2);
}

DipKitList dip_kit_list(const DipGalleryView *view, double near_distance, DipError *err) {
    DipKitList list = {.view = view, .err = err};
    list.failed = !dip_kit_camera(&list.seen, view, near_distance, err);
    return list;
}

DipDraw *dip_kit_add_bytes(DipKitList *list, const DipMesh *mesh, const void *uniforms,
                           size_t size_bytes, const DipMatrix *model,
                           DipFragmentShader *fragment_shader) {
    DIP_ASSERT(list->count < DIP_KIT_MAX_DRAWS && size_bytes <= sizeof list->uniforms[0]);
    DipKitObject *object = memcpy(list->uniforms[list->count], uniforms, size_bytes);
    const DipMatrix to_clip = dip_matrix_multiply(&list->seen.to_clip, model);
    dip_matrix_floats(&to_clip, object->to_clip);
    dip_matrix_floats(model, object->to_world);
    memcpy(object->eye, list->seen.eye, sizeof object->eye);
    list->failed = list->failed || !dip_matrix_normals(object->normals, model, list->err);
    DipDraw *draw = &list->draws[list->count++];
    *draw = (DipDraw){
        .mesh = mesh,
        .vertex_shader = dip_kit_vertex,
        .fragment_shader = fragment_shader,
        .varying_count = DIP_KIT_VARYINGS,
        .value_only_varying_count = DIP_KIT_VALUES_ONLY,
        .uniforms = object,
        .bounds_to_clip = object->to_clip,
        .cull = DIP_CULL_BACK,
    };
    return draw;
}

bool dip_kit_show(const DipKitList *list, const float clear_lin[3]) {
    const DipPass pass = dip_kit_pass(list->view, list->draws, list->count, clear_lin);
    return !list->failed && dip_kit_draw(list->view, list->view->pipeline, &pass, list->err);
}

// --- the die -------------------------------------------------------------------------------------

enum { FACES = 6 };

// Makes the shape DIP_KIT_DIE.
static bool make_die(DipShape *box, DipError *err) {
    // Index of the square of the texture that each face of the box shows: +x, -x, +y, -y, +z, -z.
    static const int squares[FACES] = {0, 5, 1, 4, 2, 3};
    static const float size[3] = {1.0f, 1.0f, 1.0f};
    const float width = 1.0f / FACES;
    const bool made = dip_shape_box(box, size, err);
    for (uint32_t v = 0; v < box->vertex_count; v++) {
        float *u = box->attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES + DIP_SHAPE_TEXTURE;
        *u = width * ((float)squares[v / 4] + *u);
    }
    return made;
}

// Returns how deep a face with `pips` pips is at the point u, v: 1 within a pip, 0 outside of all
// pips.
static float pip_at(int pips, float u, float v) {
    // [pips - 1]: bit 3 * row + column is set if that cell of a 3x3 grid has a pip.
    static const int patterns[FACES] = {0x010, 0x101, 0x111, 0x145, 0x155, 0x16d};
    float deepest = 0.0f;
    for (int cell = 0; cell < 9; cell++) {
        if (patterns[pips - 1] >> cell & 1) {
            const float du = u - (0.24f + 0.26f * (float)(cell % 3));
            const float dv = v - (0.24f + 0.26f * (float)(cell / 3));
            const float depth = dip_kit_smooth(0.100f, 0.086f, sqrtf(du * du + dv * dv));
            deepest = dip_kit_greatest(depth, deepest);
        }
    }
    return deepest;
}

void dip_kit_paint_die(float u, float v, float rgba[4]) {
    const int face = (int)(u * FACES);
    const float along = u * FACES - (float)face;
    const float edge = dip_kit_least(dip_kit_to_edge(along), dip_kit_to_edge(v));
    const float pip = pip_at(face + 1, along, v);
    const float body = 0.80f + 0.12f * dip_kit_smooth(0.0f, 0.07f, edge);
    rgba[0] = dip_kit_mix(body, face ? 0.07f : 0.62f, pip); // The single pip is red.
    rgba[1] = dip_kit_mix(0.98f * body, 0.06f, pip);
    rgba[2] = dip_kit_mix(0.93f * body, 0.08f, pip);
}

// --- meshes --------------------------------------------------------------------------------------

bool dip_kit_mesh(DipMesh **mesh, const char *name, DipShape *shape, DipError *err) {
    const DipMeshData data = dip_shape_data(shape, name);
    *mesh = dip_mesh_create(&data, err);
    dip_shape_free(shape);
    return *mesh != NULL;
}

static bool make_shape(DipShape *shape, const DipKitMeshDef *def, DipError *err) {
    const float *a = def->arguments;
    switch (def->shape) {
    case DIP_KIT_SPHERE:
        return dip_shape_sphere(shape, a[0], (int)a[1], (int)a[2], err);
    case DIP_KIT_BOX:
        return dip_shape_box(shape, a, err);
    case DIP_KIT_PRISM:
        return dip_shape_prism(shape, a[0], a[1], (int)a[2], a[3] > 0.0f, err);
    case DIP_KIT_PLANE:
        return dip_shape_plane(shape, a[0], a[1], (int)a[2], (int)a[3], err);
    case DIP_KIT_QUAD:
        return dip_shape_quad(shape, a[0], a[1], err);
    default:
        return make_die(shape, err);
    }
}

// --- textures ------------------------------------------------------------------------------------

static uint8_t code_of(float value) {
    return (uint8_t)(dip_kit_clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

static bool make_texture(DipKitTexture *texture, const DipKitTextureDef *made, DipError *err) {
    const size_t count = (size_t)made->width * (size_t)made->height;
    uint8_t *rgba8 = malloc(count * 4);
    if (!rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, made->name, "out of memory");
    }
    for (size_t i = 0; i < count; i++) {
        const float x = (float)(i % (size_t)made->width);
        const float y = (float)(i / (size_t)made->width);
        float rgba[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        made->paint((x + 0.5f) / (float)made->width, (y + 0.5f) / (float)made->height, rgba);
        for (int c = 0; c < 4; c++) {
            rgba8[4 * i + (size_t)c] = code_of(rgba[c]);
        }
    }
    const DipTextureDef def = {.name = made->name,
                               .width = made->width,
                               .height = made->height,
                               .rgba8 = rgba8,
                               .encoding = DIP_ENCODING_SRGB,
                               .wrap_u = made->wrap,
                               .wrap_v = made->wrap};
    const bool wanted = true;
    texture->plain = dip_texture_create(&def, err);
    free(rgba8);
    if (texture->plain &&
        !dip_textures_compress(&texture->plain, &wanted, 1, NULL, &texture->compressed, err)) {
        dip_texture_destroy(&texture->plain);
    }
    return texture->plain != NULL;
}

bool dip_kit_stock_create(DipKitStock *stock, const DipGalleryScene *scene, DipError *err) {
    static const char *const names[] = {"", "sphere", "box", "prism", "plane", "quad", "die"};
    bool made = true;
    for (int m = 0; made && m < DIP_KIT_MESHES; m++) {
        const DipKitMeshDef *def = &scene->meshes[m];
        DipShape shape;
        made = def->shape == DIP_KIT_NO_SHAPE ||
               (make_shape(&shape, def, err) &&
                dip_kit_mesh(&stock->meshes[m], names[def->shape], &shape, err));
    }
    for (int t = 0; made && t < DIP_KIT_TEXTURES; t++) {
        made = !scene->textures[t].paint ||
               make_texture(&stock->textures[t], &scene->textures[t], err);
    }
    return made;
}

void dip_kit_stock_free(DipKitStock *stock) {
    for (int m = 0; m < DIP_KIT_MESHES; m++) {
        dip_mesh_destroy(&stock->meshes[m]);
    }
    for (int t = 0; t < DIP_KIT_TEXTURES; t++) {
        dip_texture_destroy(&stock->textures[t].compressed);
        dip_texture_destroy(&stock->textures[t].plain);
    }
}

void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view) {
    sampler->shown = view->mip_colours;
    dip_mip_debug_levels(sampler->texture, sampler->shown_level);
}

DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture) {
    DipSampler sampler = view->filter;
    const bool compressed = texture->compressed && dip_quality_compresses(view->quality);
    sampler.texture = compressed ? texture->compressed : texture->plain;
    if (view->quality->step[DIP_SETTING_MIPLOD] == DIP_MIPLOD_HIGH_PERFORMANCE) {
        int width, height;
        dip_texture_level_size(texture->plain, 0, &width, &height);
        sampler.min_lod8 = width >= 1024 || height >= 1024 ? 512 : 256;
    }
    if (view->quality->step[DIP_SETTING_MIPDEBUG]) {
        dip_kit_show_mip_colours(&sampler, view);
    }
    return sampler;
}

void dip_kit_light_texture(DipFragmentBatch *batch, const float colour[3],
                           float (*light)[DIP_FRAGMENT_BATCH]) {
    batch->sample_colour(batch, &batch->samplers[0], DIP_KIT_UV, batch->colour);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            batch->colour[c][i] *= colour[c] * light[c][i];
        }
    }
}

bool dip_kit_asset(char *file, size_t size_bytes, const DipGalleryDef *def, const char *asset,
                   const char *scene, DipError *err) {
    const int length = snprintf(file, size_bytes, "%s/%s", def->assets, asset);
    return (length >= 0 && (size_t)length < size_bytes) ||
           dip_error_set(err, DIP_ERROR_OVERSIZED, def->assets, 0, scene,
                         "the name of the folder is too long");
}

bool dip_kit_target(DipTarget *target, int width, int height, const char *key, DipError *err) {
    *target = (DipTarget){.width = width, .height = height};
    target->stride_bytes =
        ((size_t)width * 4 + DIP_CACHE_LINE - 1) / DIP_CACHE_LINE * DIP_CACHE_LINE;
    target->rgba8 = dip_lines_alloc(target->stride_bytes * (size_t)height);
    return target->rgba8 || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, key,
                                          "no memory for %dx%d pixels", width, height);
}

// --- numbers -------------------------------------------------------------------------------------

static int wrap(int i, int period) {
    const int left = i % period;
    return left < 0 ? left + period : left;
}

// Returns smooth noise, 0..1. It repeats along x and y after `period` units.
static float noise(float x, float y, int period, int seed) {
    const float x0 = dip_kit_floor(x);
    const float y0 = dip_kit_floor(y);
    const float u = x - x0;
    const float v = y - y0;
    const float su = u * u * (3.0f - 2.0f * u);
    const float sv = v * v * (3.0f - 2.0f * v);
    const int left = wrap((int)x0, period);
    const int right = wrap((int)x0 + 1, period);
    const int top = wrap((int)y0, period);
    const int bottom = wrap((int)y0 + 1, period);
    const float upper =
        dip_kit_mix(dip_kit_random(left, top, seed), dip_kit_random(right, top, seed), su);
    const float lower =
        dip_kit_mix(dip_kit_random(left, bottom, seed), dip_kit_random(right, bottom, seed), su);
    return dip_kit_mix(upper, lower, sv);
}

float dip_kit_turbulence(float x, float y, int period, int octaves, int seed) {
    float sum = 0.0f;
    float size = 0.5f;
    float total = 0.0f;
    for (int o = 0; o < octaves; o++) {
        sum += size * noise(x, y, period, seed + o);
        total += size;
        size *= 0.5f;
        x *= 2.0f;
        y *= 2.0f;
        period *= 2;
    }
    return sum / total;
}
