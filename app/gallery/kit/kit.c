// Matrices, passes, the common vertex shader, and painted textures.
#include "app/gallery/kit/kit.h"

#include "renderer/base/assert.h"

#include <stdlib.h>
#include <string.h>

// --- cameras and passes --------------------------------------------------------------------------

// Writes the rotation from world space to the view space of a camera with this orientation. The
// quaternion's length must not be 0.
static void rotate_to_view(const double q[4], DipMatrix *view) {
    const double x = q[0];
    const double y = q[1];
    const double z = q[2];
    const double w = q[3];
    const double s = 2.0 / (x * x + y * y + z * z + w * w);
    const double rows[3][3] = {
        {1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
        {s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
        {s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)},
    };
    *view = dip_matrix_identity();
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            view->m[4 * r + c] = rows[r][c];
        }
    }
}

bool dip_kit_camera(DipKitCamera *camera, const DipPose *pose, int width, int height,
                    double near_distance, DipError *err) {
    const DipPerspective lens = {.fov_deg = pose->fov_y_deg,
                                 .aspect = (double)width / height,
                                 .near_distance = near_distance};
    const double *eye = pose->position_world;
    DipMatrix projection;
    DipMatrix rotation;
    if (!dip_camera_perspective(&projection, &lens, err)) {
        return false;
    }
    rotate_to_view(pose->orientation, &rotation);
    const DipMatrix move = dip_matrix_translation(-eye[0], -eye[1], -eye[2]);
    camera->view = dip_matrix_multiply(&rotation, &move);
    camera->to_clip = dip_matrix_multiply(&projection, &camera->view);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = (float)eye[i];
    }
    return true;
}

bool dip_kit_look_at(DipKitCamera *camera, const double eye[3], const double target[3],
                     const DipPerspective *lens, DipError *err) {
    static const double up[3] = {0.0, 1.0, 0.0};
    DipMatrix projection;
    if (!dip_camera_perspective(&projection, lens, err) ||
        !dip_camera_look_at(&camera->view, eye, target, up, err)) {
        return false;
    }
    camera->to_clip = dip_matrix_multiply(&projection, &camera->view);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = (float)eye[i];
    }
    return true;
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
    memcpy(pass.clear_lin, clear_lin, sizeof pass.clear_lin);
    return pass;
}

bool dip_kit_draw(const DipGalleryView *view, DipPipeline *pipeline, const DipPass *pass,
                  DipError *err) {
    return dip_pipeline_draw(pipeline, pass, view->counters, view->times, err);
}

// --- objects -------------------------------------------------------------------------------------

bool dip_kit_object(DipKitObject *object, const DipKitCamera *camera, const DipMatrix *model,
                    DipError *err) {
    const DipMatrix to_clip = dip_matrix_multiply(&camera->to_clip, model);
    dip_matrix_floats(&to_clip, object->to_clip);
    dip_matrix_floats(model, object->to_world);
    memcpy(object->eye, camera->eye, sizeof object->eye);
    return dip_matrix_normals(object->normals, model, err);
}

// Writes row . (x, y, z, w) of each vertex.
static void transform_row(const DipVertexBatch *batch, int first, const float row[3], float last,
                          float *out) {
    const float *x = batch->in[first];
    const float *y = batch->in[first + 1];
    const float *z = batch->in[first + 2];
    for (int i = 0; i < batch->count; i++) {
        out[i] = row[0] * x[i] + row[1] * y[i] + row[2] * z[i] + last;
    }
}

void dip_kit_vertex(const DipVertexBatch *batch) {
    const DipKitObject *object = batch->uniforms;
    for (int r = 0; r < 4; r++) {
        const float *row = object->to_clip + 4 * r;
        transform_row(batch, DIP_SHAPE_POSITION, row, row[3], batch->clip[r]);
    }
    for (int r = 0; r < 3; r++) {
        const float *row = object->to_world + 4 * r;
        transform_row(batch, DIP_SHAPE_POSITION, row, row[3], batch->varying[DIP_KIT_WORLD + r]);
        transform_row(batch, DIP_SHAPE_NORMAL, object->normals + 3 * r, 0.0f,
                      batch->varying[DIP_KIT_NORMAL + r]);
    }
    for (int c = 0; c < 2; c++) {
        memcpy(batch->varying[DIP_KIT_UV + c], batch->in[DIP_SHAPE_TEXTURE + c],
               (size_t)batch->count * sizeof(float));
    }
}

DipDraw dip_kit_object_draw(const DipMesh *mesh, const void *uniforms,
                            DipFragmentShader *fragment_shader) {
    return (DipDraw){
        .mesh = mesh,
        .vertex_shader = dip_kit_vertex,
        .fragment_shader = fragment_shader,
        .varying_count = DIP_KIT_VARYINGS,
        .value_only_varying_count = DIP_KIT_VALUES_ONLY,
        .uniforms = uniforms,
        .bounds_to_clip = ((const DipKitObject *)uniforms)->to_clip,
        .cull = DIP_CULL_BACK,
    };
}

DipMesh *dip_kit_mesh(const char *name, DipShape *shape, bool made, DipError *err) {
    if (!made) {
        return NULL;
    }
    const DipMeshData data = dip_shape_data(shape, name);
    DipMesh *mesh = dip_mesh_create(&data, err);
    dip_shape_free(shape);
    return mesh;
}

void *dip_kit_content(size_t size_bytes, const char *scene, DipError *err) {
    void *content = calloc(1, size_bytes);
    if (!content) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, scene, "out of memory");
    }
    return content;
}

// --- textures ------------------------------------------------------------------------------------

static uint8_t code_of(float value) {
    return (uint8_t)(dip_kit_clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

bool dip_kit_texture(DipKitTexture *texture, const char *name, int width, int height, bool clamps,
                     DipKitPaint *paint, const void *context, DipError *err) {
    uint8_t *rgba8 = malloc((size_t)width * (size_t)height * 4);
    if (!rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, name, "out of memory");
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            uint8_t *texel = rgba8 + ((size_t)y * (size_t)width + (size_t)x) * 4;
            float rgba[4] = {0.0f, 0.0f, 0.0f, 1.0f};
            paint(context, ((float)x + 0.5f) / (float)width, ((float)y + 0.5f) / (float)height,
                  rgba);
            for (int c = 0; c < 4; c++) {
                texel[c] = code_of(rgba[c]);
            }
        }
    }
    const DipWrap wrap = clamps ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
    const DipTextureDef def = {.name = name,
                               .width = width,
                               .height = height,
                               .rgba8 = rgba8,
                               .encoding = DIP_ENCODING_SRGB,
                               .wrap_u = wrap,
                               .wrap_v = wrap};
    const bool wanted = true;
    texture->plain = dip_texture_create(&def, err);
    free(rgba8);
    if (texture->plain &&
        !dip_textures_compress(&texture->plain, &wanted, 1, NULL, &texture->compressed, err)) {
        dip_texture_destroy(&texture->plain);
    }
    return texture->plain != NULL;
}

void dip_kit_texture_free(DipKitTexture *texture) {
    dip_texture_destroy(&texture->compressed);
    dip_texture_destroy(&texture->plain);
}

// Finds the level of the mip colours for each level of a texture, by the longer side in texels.
static void find_shown_levels(const DipTexture *texture, int last_colour,
                              int32_t shown_level[DIP_LEVEL_TABLE]) {
    const int last = dip_texture_level_count(texture) - 1;
    for (int level = 0; level < DIP_LEVEL_TABLE; level++) {
        int width;
        int height;
        int shown = 0;
        dip_texture_level_size(texture, level < last ? level : last, &width, &height);
        while (shown < last_colour && (width > height ? width : height) < 1024 >> shown) {
            shown++;
        }
        shown_level[level] = shown;
    }
}

void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view) {
    sampler->shown = view->mip_colours;
    find_shown_levels(sampler->texture, dip_texture_level_count(view->mip_colours) - 1,
                      sampler->shown_level);
}

DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture) {
    DipSampler sampler = view->filter;
    const bool compressed = texture->compressed && dip_quality_compresses(view->quality);
    sampler.texture = compressed ? texture->compressed : texture->plain;
    if (view->quality->step[DIP_SETTING_MIPLOD] == DIP_MIPLOD_HIGH_PERFORMANCE) {
        int width;
        int height;
        dip_texture_level_size(texture->plain, 0, &width, &height);
        sampler.min_lod8 = width >= 1024 || height >= 1024 ? 512 : 256;
    }
    if (view->quality->step[DIP_SETTING_MIPDEBUG]) {
        dip_kit_show_mip_colours(&sampler, view);
    }
    return sampler;
}

// --- numbers -------------------------------------------------------------------------------------

static int wrap(int i, int period) {
    const int left = i % period;
    return left < 0 ? left + period : left;
}

float dip_kit_noise(float x, float y, int period, int seed) {
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
        sum += size * dip_kit_noise(x, y, period, seed + o);
        total += size;
        size *= 0.5f;
        x *= 2.0f;
        y *= 2.0f;
        period *= 2;
    }
    return sum / total;
}
