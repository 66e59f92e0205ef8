// Draws the gallery scene "water": the transparent water in the courtyard's fountain.
//
// The courtyard is drawn with its light map, and a mosaic on the floor of the pool. The water is
// drawn last, either blended over the picture or with refraction. With refraction, it is drawn in a
// second pass, whose shader reads the first pass's picture a little beside the pixel; the waves of
// a normal map determine how far. Fresnel's term mixes in the colour of the sky. The second pass
// keeps the depths and the colours of all samples of the first pass, so that edges which the water
// crosses are as smooth as in one pass.
#include "app/gallery/kit/kit.h"
#include "assets/model.h"
#include "renderer/base/pages.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// Attributes of the courtyard's vertices: the position, the texture coordinates for the colour
// texture, and the texture coordinates for the light map.
enum { UV0 = 3, UV1 = 5, ATTRIBUTES = 7, VARYINGS = 4 };
// Varyings of the water: texture coordinates of two layers of waves, then the position.
enum { WAVE0 = 0, WAVE1 = 2, POSITION = 4, WATER_VARYINGS = 7 };

typedef struct Uniforms {
    float to_clip[16];
    float colour[3];
    float light_scale; // Factor of the light map; 0 if there is no light map.
    float cutoff;      // Fragments with less alpha are clipped.
    int samples;       // Samples per pixel with alpha to coverage, otherwise 0.
    float turns;       // Time as a share of the loop, 0..1. Used for the floor of the pool.
} Uniforms;

// An object of the courtyard. Only samplers[0], uniforms.to_clip and uniforms.samples change from
// frame to frame.
typedef struct Object {
    DipMatrix model;
    const DipMaterialDef *material;
    DipDraw draw;
    Uniforms uniforms;
    DipSampler samplers[2];
} Object;

enum { POOL_FLOOR }; // Mesh of the stock.

// Uniforms of the water.
typedef struct Water {
    float to_clip[16];
    float eye[3];
    float scroll[2];   // How far each of the two layers of waves has moved.
    DipTarget picture; // The first pass's picture.
    bool refracts;
} Water;

typedef struct Content {
    DipModel *model;
    const DipSceneDef *def;  // Belongs to the model.
    DipTexture **textures;   // The textures of `def`, followed by their compressed forms.
    DipTexture **compressed; // Points to the compressed forms in `textures`.
    DipMesh **meshes;
    Object *objects;
    DipDraw *draws; // The draws of a frame, at most all objects and the floor of the pool.
    Uniforms pool_floor;
    DipTarget picture; // The first pass's picture.
    // The first pass's depths and colours, each with an entry per number of samples.
    DipDepth *depths[DIP_MAX_SAMPLES + 1];
    DipSamples *samples[DIP_MAX_SAMPLES + 1];
    Water water;
} Content;

// --- shaders of the courtyard --------------------------------------------------------------------

static void court_vertex(const DipVertexBatch *batch) {
    dip_vertices_transform(batch, ((const Uniforms *)batch->uniforms)->to_clip, 4, batch->clip);
    dip_vertices_copy(batch, UV0, 0, VARYINGS);
}

static void shade_court(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    float light[3][DIP_FRAGMENT_BATCH];
    batch->sample_colour(batch, &batch->samplers[0], 0, batch->colour);
    if (uniforms->light_scale > 0.0f) {
        batch->sample_colour(batch, &batch->samplers[1], 2, light);
    }
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            const float lit =
                uniforms->light_scale > 0.0f ? light[c][i] * uniforms->light_scale : 0.85f;
            batch->colour[c][i] *= uniforms->colour[c] * lit;
        }
    }
}

static void clip_court(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    float alpha[DIP_FRAGMENT_BATCH], slope[DIP_FRAGMENT_BATCH];
    if (uniforms->samples) {
        batch->sample_alpha_slope(batch, &batch->samplers[0], 0, alpha, slope);
        for (int i = 0; i < batch->count; i++) {
            batch->keep[i] = (uint8_t)dip_alpha_to_coverage(alpha[i], slope[i], uniforms->cutoff,
                                                            uniforms->samples);
        }
        return;
    }
    batch->sample_alpha(batch, &batch->samplers[0], 0, alpha);
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = alpha[i] >= uniforms->cutoff;
    }
}

// Shades the sky with soft clouds, which depend on the texture coordinates.
static void shade_sky(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        const float u = batch->varying[0][i];
        const float v = batch->varying[1][i];
        const float cloud = 0.5f + 0.25f * dip_kit_wave(1.3f * u + 0.4f * v) +
                            0.25f * dip_kit_wave(2.1f * v - 0.7f * u);
        dip_kit_set(batch->colour, i, 0.16f + 0.20f * cloud, 0.30f + 0.18f * cloud,
                    0.58f + 0.12f * cloud);
    }
}

// Shades the mosaic under water, with the bright lines where waves focus the light (caustics).
static void shade_pool_floor(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float turns = uniforms->turns;
    batch->sample_colour(batch, &batch->samplers[0], 0, batch->colour);
    for (int i = 0; i < batch->count; i++) {
        const float x = 5.0f * batch->varying[0][i];
        const float z = 5.0f * batch->varying[1][i];
        const float bend = 0.22f * dip_kit_wave(0.5f * z + 4.0f * turns);
        const float a = dip_kit_wave(1.1f * x + 0.45f * z + bend + 5.0f * turns);
        const float b = dip_kit_wave(0.5f * x - 1.2f * z - bend - 6.0f * turns);
        const float c = dip_kit_wave(0.8f * (x + z) + 2.0f * bend - 3.0f * turns);
        const float line = 1.0f - fabsf(a + b + c) * 0.5f;
        const float caustic = dip_kit_power(dip_kit_greatest(line, 0.0f), 2);
        for (int k = 0; k < 3; k++) {
            batch->colour[k][i] *= 0.55f + 0.75f * caustic;
        }
    }
}

// --- shaders of the water ------------------------------------------------------------------------

static void water_vertex(const DipVertexBatch *batch) {
    const Water *water = batch->uniforms;
    dip_vertices_transform(batch, water->to_clip, 4, batch->clip);
    dip_vertices_copy(batch, 0, POSITION, 3);
    for (int i = 0; i < batch->count; i++) {
        const float x = batch->in[0][i];
        const float z = batch->in[2][i];
        batch->varying[WAVE0][i] = 0.45f * x + water->scroll[0];
        batch->varying[WAVE0 + 1][i] = 0.45f * z;
        batch->varying[WAVE1][i] = 0.35f * z + 0.31f * x;
        batch->varying[WAVE1 + 1][i] = 0.35f * x - 0.31f * z + water->scroll[1];
    }
}

// Returns the share of the light that water reflects, by Schlick's approximation. `cosine` is that
// of the angle between the normal and the vector towards the eye, which is above the water.
static inline float fresnel(float cosine) {
    const float left = 1.0f - dip_kit_clamp(cosine, 0.0f, 1.0f);
    return 0.02f + 0.98f * left * left * left * left * left;
}

// Writes to `under` the colour that each fragment shows through the water. Reads this colour from
// the picture beside the fragment, at a distance that is proportional to the slope of the waves.
static void refract_picture(DipFragmentBatch *batch, const Water *water,
                            float (*waves)[DIP_FRAGMENT_BATCH],
                            float (*under)[DIP_FRAGMENT_BATCH]) {
    float u[DIP_FRAGMENT_BATCH];
    float v[DIP_FRAGMENT_BATCH];
    const float width = (float)water->picture.width;
    const float height = (float)water->picture.height;
    for (int i = 0; i < batch->count; i++) {
        u[i] = batch->x[i] / width + 0.030f * waves[0][i];
        v[i] = batch->y[i] / height + 0.040f * waves[1][i];
    }
    batch->sample_target(batch, &water->picture, u, v, under);
}

static void shade_water(DipFragmentBatch *batch) {
    static const float deep[3] = {0.015f, 0.075f, 0.085f};
    static const float pass_share[3] = {0.62f, 0.86f, 0.88f}; // Share of light that gets through.
    static const float sun[3] = {0.46f, 0.72f, 0.52f};
    const Water *water = batch->uniforms;
    float waves[3][DIP_FRAGMENT_BATCH];
    float second[3][DIP_FRAGMENT_BATCH];
    float under[3][DIP_FRAGMENT_BATCH] = {{0}};
    batch->sample_colour(batch, &batch->samplers[0], WAVE0, waves);
    batch->sample_colour(batch, &batch->samplers[0], WAVE1, second);
    for (int c = 0; c < 2; c++) {
        for (int i = 0; i < batch->count; i++) {
            waves[c][i] = 0.45f * (waves[c][i] + second[c][i] - 1.0f);
        }
    }
    if (water->refracts) {
        refract_picture(batch, water, waves, under);
    }
    const DipKitVector eye = dip_kit_vector(water->eye);
    for (int i = 0; i < batch->count; i++) {
        const DipKitVector to_eye = dip_kit_minus(eye, dip_kit_get(batch->varying + POSITION, i));
        const DipKitVector normal = {waves[0][i], 1.0f, waves[1][i]};
        const float e = dip_kit_per_length(to_eye, 0.0f);
        const float n = dip_kit_per_length(normal, 0.0f);
        const float facing = n * e * dip_kit_dot(normal, to_eye);
        const float share = fresnel(facing);
        const DipKitVector mirrored =
            dip_kit_minus(dip_kit_times(normal, 2.0f * facing * n), dip_kit_times(to_eye, e));
        const float toward = dip_kit_dot(mirrored, dip_kit_vector(sun));
        const float glint = dip_kit_power(dip_kit_greatest(toward, 0.0f), 8);
        const float up = dip_kit_clamp(mirrored.y, 0.0f, 1.0f);
        const float sky[3] = {0.62f - 0.42f * up, 0.70f - 0.34f * up, 0.80f - 0.18f * up};
        // The bowls above the pool have no floor that could be drawn, so their water looks deep.
        const float seen = batch->varying[POSITION + 1][i] > 1.0f ? 0.25f : 1.0f;
        for (int c = 0; c < 3; c++) {
            const float through = dip_kit_mix(deep[c], under[c][i] * pass_share[c], 0.92f * seen);
            const float body = water->refracts ? through : deep[c];
            batch->colour[c][i] = dip_kit_mix(body, sky[c], share) + 1.6f * glint;
        }
        batch->alpha[i] = dip_kit_clamp(share + 1.0f - 0.72f * seen + glint, 0.0f, 1.0f);
    }
}

// --- content -------------------------------------------------------------------------------------

// Paints rings of square tiles around the pedestal: white, blue, turquoise and one ring in gold.
static void paint_mosaic(float u, float v, float rgba[4]) {
    const float tiles = 44.0f;
    const float x = u * tiles;
    const float z = v * tiles;
    const float joint =
        dip_kit_smooth(0.03f, 0.09f, dip_kit_least(dip_kit_to_edge(x), dip_kit_to_edge(z)));
    const float cx = (dip_kit_floor(x) + 0.5f) / tiles - 0.5f;
    const float cz = (dip_kit_floor(z) + 0.5f) / tiles - 0.5f;
    const float radius = sqrtf(cx * cx + cz * cz);
    const float shade_of = 0.82f + 0.18f * dip_kit_random((int)x, (int)z, 21);
    const int ring = (int)(radius * 15.0f);
    static const float colours[4][3] = {
        {0.80f, 0.84f, 0.82f}, {0.16f, 0.42f, 0.62f}, {0.30f, 0.66f, 0.70f}, {0.86f, 0.66f, 0.24f}};
    const float *own = colours[ring == 5 ? 3 : ring % 2 ? 1 : ring % 4 ? 2 : 0];
    for (int c = 0; c < 3; c++) {
        rgba[c] = dip_kit_mix(0.35f, own[c] * shade_of, joint);
    }
}

static void forget_size(Content *content) {
    for (int s = 0; s <= DIP_MAX_SAMPLES; s++) {
        dip_depth_destroy(&content->depths[s]);
        dip_samples_destroy(&content->samples[s]);
    }
    dip_lines_free(content->picture.rgba8);
    content->picture = (DipTarget){0};
}

static void destroy(void *pointer) {
    Content *content = pointer;
    const DipSceneDef *def = content->def;
    for (int t = 0; content->textures && t < 2 * def->texture_count; t++) {
        dip_texture_destroy(&content->textures[t]);
    }
    for (int m = 0; content->meshes && m < def->mesh_count; m++) {
        dip_mesh_destroy(&content->meshes[m]);
    }
    forget_size(content);
    free(content->textures);
    free(content->meshes);
    free(content->objects);
    free(content->draws);
    dip_model_destroy(&content->model);
}

static bool make_mesh(DipMesh **mesh, const DipMeshDef *def, DipError *err) {
    float *rows = calloc((size_t)def->vertex_count, ATTRIBUTES * sizeof(float));
    if (!rows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "water", "out of memory");
    }
    for (size_t v = 0; v < def->vertex_count; v++) {
        float *row = rows + v * ATTRIBUTES;
        memcpy(row, def->positions + 3 * v, 3 * sizeof(float));
        if (def->uv0) {
            memcpy(row + UV0, def->uv0 + 2 * v, 2 * sizeof(float));
        }
        if (def->uv1) {
            memcpy(row + UV1, def->uv1 + 2 * v, 2 * sizeof(float));
        }
    }
    const DipMeshData data = {def->name,         rows,         ATTRIBUTES,
                              def->vertex_count, def->indices, def->index_count};
    *mesh = dip_mesh_create(&data, err);
    free(rows);
    return *mesh != NULL;
}

// Makes the floor of the pool: a flat eight-sided prism. The attributes of its vertices begin with
// those of the courtyard's vertices.
static bool make_pool_floor(DipMesh **mesh, DipError *err) {
    DipShape prism;
    if (!dip_shape_prism(&prism, 2.74f, 0.02f, 8, false, err)) {
        return false;
    }
    const DipMatrix turn = dip_matrix_rotation(1, DIP_PI / 8.0);
    for (uint32_t v = 0; v < prism.vertex_count; v++) {
        float *row = prism.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES;
        const double point[4] = {(double)row[0], (double)row[1] + 0.31, (double)row[2], 1.0};
        double turned[4];
        dip_matrix_apply(&turn, point, turned);
        for (int i = 0; i < 3; i++) {
            row[i] = (float)turned[i];
        }
        row[UV0] = 0.5f + row[0] / 5.6f;
        row[UV0 + 1] = 0.5f + row[2] / 5.6f;
        row[UV1] = row[UV1 + 1] = 0.0f;
    }
    return dip_kit_mesh(mesh, "pool floor", &prism, err);
}

static void prepare_object(Content *content, const DipObjectDef *from, Object *object) {
    const DipMaterialDef *material =
        &content->def->materials[content->def->meshes[from->mesh].material];
    const bool lit = material->light_map != DIP_NO_TEXTURE;
    const bool textured = material->colour_texture != DIP_NO_TEXTURE;
    const bool clipped = material->surface == DIP_SURFACE_CLIPPED && textured;
    const float *t = from->transform;
    const float determinant = t[0] * (t[5] * t[10] - t[6] * t[9]) -
                              t[1] * (t[4] * t[10] - t[6] * t[8]) +
                              t[2] * (t[4] * t[9] - t[5] * t[8]);
    object->material = material;
    object->model = dip_matrix_identity();
    for (int i = 0; i < 12; i++) {
        object->model.m[i] = (double)t[i];
    }
    memcpy(object->uniforms.colour, material->base_colour_lin, sizeof object->uniforms.colour);
    object->uniforms.light_scale = lit ? material->light_map_scale : 0.0f;
    object->uniforms.cutoff = material->alpha_cutoff;
    if (lit) {
        object->samplers[1] =
            (DipSampler){.texture = content->textures[material->light_map], .max_anisotropy = 1};
    }
    object->draw = (DipDraw){
        .mesh = content->meshes[from->mesh],
        .vertex_shader = court_vertex,
        .fragment_shader =
            material->surface == DIP_SURFACE_SKY || !textured ? shade_sky : shade_court,
        .clip_shader = clipped ? clip_court : NULL,
        .varying_count = VARYINGS,
        .clip_varying_count = clipped ? 2 : 0,
        .uniforms = &object->uniforms,
        .samplers = object->samplers,
        .bounds_to_clip = object->uniforms.to_clip,
        .cull = material->double_sided ? DIP_CULL_NONE
                : determinant < 0.0f   ? DIP_CULL_FRONT
                                       : DIP_CULL_BACK,
    };
}

static bool make_textures(Content *content, DipPool *pool, DipError *err) {
    const DipSceneDef *def = content->def;
    bool *colours = calloc((size_t)def->texture_count, sizeof *colours);
    bool made = colours && dip_textures_create(def->textures, NULL, NULL, def->texture_count, pool,
                                               content->textures, err);
    for (int m = 0; made && m < def->material_count; m++) {
        const int texture = def->materials[m].colour_texture;
        if (texture != DIP_NO_TEXTURE && def->materials[m].surface != DIP_SURFACE_SKY) {
            colours[texture] = true;
        }
    }
    made = made && dip_textures_compress(content->textures, colours, def->texture_count, pool,
                                         content->compressed, err);
    free(colours);
    return made;
}

static bool create(DipGalleryRoom *room, DipError *err) {
    Content *content = room->content;
    char file[PATH_MAX];
    const char *files[1] = {file};
    const DipModelOptions options = {.normal_maps = true};
    if (!make_pool_floor(&room->stock.meshes[POOL_FLOOR], err) ||
        !dip_kit_asset(file, sizeof file, room->def, "courtyard/court.gltf", "water", err)) {
        return false;
    }
    content->model = dip_model_load_with(files, 1, &options, room->def->pool, NULL, err);
    if (!content->model) {
        return false;
    }
    const DipSceneDef *def = content->def = dip_model_scene_def(content->model);
    content->textures = calloc(2 * (size_t)def->texture_count, sizeof *content->textures);
    content->meshes = calloc((size_t)def->mesh_count, sizeof *content->meshes);
    content->objects = calloc((size_t)def->object_count, sizeof *content->objects);
    content->draws = calloc((size_t)def->object_count + 1, sizeof *content->draws);
    if (!content->textures || !content->meshes || !content->objects || !content->draws) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "water", "out of memory");
    }
    content->compressed = content->textures + def->texture_count;
    bool made = make_textures(content, room->def->pool, err);
    for (int m = 0; made && m < def->mesh_count; m++) {
        made = make_mesh(&content->meshes[m], &def->meshes[m], err);
    }
    for (int o = 0; made && o < def->object_count; o++) {
        prepare_object(content, &def->objects[o], &content->objects[o]);
    }
    return made;
}

// Makes the first pass's picture, and the depths and colours of its samples. Keeps those of earlier
// frames if they have this size and number of samples.
static bool prepare_target(Content *content, const DipTarget *size, int samples, DipError *err) {
    DipTarget *picture = &content->picture;
    if (picture->width != size->width || picture->height != size->height) {
        forget_size(content);
        if (!dip_kit_target(picture, size->width, size->height, "water", err)) {
            *picture = (DipTarget){0};
            return false;
        }
    }
    if (!content->depths[samples]) {
        content->depths[samples] = dip_depth_create(size->width, size->height, samples, err);
    }
    if (!content->samples[samples]) {
        content->samples[samples] =
            dip_samples_create(size->width, size->height, samples, size->format, err);
    }
    return content->depths[samples] && content->samples[samples];
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    const double angle = 0.785 + 0.3 * dip_sin(turn);
    const double radius = 4.7 + 0.3 * dip_cos(turn);
    return (DipGalleryCamera){
        .eye = {radius * dip_sin(angle), 2.9 + 0.4 * dip_cos(2.0 * turn), radius * dip_cos(angle)},
        .target = {0.45 * dip_cos(angle), 0.62, -0.45 * dip_sin(angle)}};
}

// Writes the draws of the courtyard and the mosaic to content->draws, but not those of the
// water. Returns their number.
static int list_court(const DipGalleryView *view, const DipKitCamera *seen,
                      const DipSampler *mosaic) {
    Content *content = view->content;
    int count = 0;
    for (int o = 0; o < content->def->object_count; o++) {
        Object *object = &content->objects[o];
        const int texture = object->material->colour_texture;
        // The mosaic takes the place of the pools' own floors.
        if (object->material->surface == DIP_SURFACE_WATER ||
            strcmp(object->material->name, "pool") == 0) {
            continue;
        }
        const DipMatrix to_clip = dip_matrix_multiply(&seen->to_clip, &object->model);
        dip_matrix_floats(&to_clip, object->uniforms.to_clip);
        object->uniforms.samples = dip_quality_covers_by_alpha(view->quality)
                                       ? dip_quality_sample_count(view->quality)
                                       : 0;
        if (texture != DIP_NO_TEXTURE) {
            const DipKitTexture both = {content->textures[texture], content->compressed[texture]};
            object->samplers[0] = dip_kit_sampler(view, &both);
        }
        content->draws[count++] = object->draw;
    }
    dip_matrix_floats(&seen->to_clip, content->pool_floor.to_clip);
    content->pool_floor.turns = view->turns;
    content->draws[count++] = (DipDraw){.mesh = view->stock->meshes[POOL_FLOOR],
                                        .vertex_shader = court_vertex,
                                        .fragment_shader = shade_pool_floor,
                                        .varying_count = 2,
                                        .uniforms = &content->pool_floor,
                                        .samplers = mosaic,
                                        .cull = DIP_CULL_BACK};
    return count;
}

// Writes the water's draws to `draws`. Returns their number.
static int list_water(const DipGalleryView *view, const DipKitCamera *seen,
                      const DipDrawState *state, DipSampler *waves, DipDraw *draws) {
    Content *content = view->content;
    Water *water = &content->water;
    int count = 0;
    dip_matrix_floats(&seen->to_clip, water->to_clip);
    memcpy(water->eye, seen->eye, sizeof water->eye);
    water->scroll[0] = view->turns;
    water->scroll[1] = -view->turns;
    water->picture = content->picture;
    water->refracts = view->look == 0;
    for (int o = 0; o < content->def->object_count; o++) {
        const DipMaterialDef *material = content->objects[o].material;
        if (material->surface != DIP_SURFACE_WATER || material->normal_map == DIP_NO_TEXTURE) {
            continue;
        }
        *waves = view->filter;
        waves->texture = content->textures[material->normal_map];
        draws[count++] = (DipDraw){.mesh = content->objects[o].draw.mesh,
                                   .vertex_shader = water_vertex,
                                   .fragment_shader = shade_water,
                                   .varying_count = WATER_VARYINGS,
                                   .value_only_varying_count = 3,
                                   .repeating_varyings = 0xf,
                                   .uniforms = water,
                                   .samplers = waves,
                                   .bounds_to_clip = water->to_clip,
                                   .cull = DIP_CULL_BACK,
                                   .state = state};
    }
    return count;
}

// Draws the courtyard into content->picture, then the courtyard and the refracting water into the
// view's picture. content->draws holds the draws of the court, and after them those of the water.
static bool draw_refracted(const DipGalleryView *view, int court_count, int water_count,
                           const float clear_lin[3], DipError *err) {
    Content *content = view->content;
    const int samples = dip_quality_sample_count(view->quality);
    DipPass court = dip_kit_pass(view, content->draws, court_count, clear_lin);
    DipPass water = dip_kit_pass(view, content->draws + court_count, water_count, clear_lin);
    court.attachments.samples = content->samples[samples];
    court.attachments.depth = content->depths[samples];
    court.target = content->picture;
    water.attachments = court.attachments;
    water.attachments.colour_load = DIP_LOAD_KEEP;
    water.attachments.depth_load = DIP_LOAD_KEEP;
    water.attachments.colour_store = DIP_STORE_DISCARD;
    water.attachments.depth_store = DIP_STORE_DISCARD;
    return dip_kit_draw(view, view->pipeline, &court, err) &&
           dip_kit_draw(view, view->pipeline, &water, err);
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.30f, 0.42f, 0.62f};
    static const DipDrawState blended = {.blend = DIP_BLEND_MODE_ALPHA, .keep_depth = true};
    Content *content = view->content;
    const bool refracts = view->look == 0;
    const DipSampler mosaic = dip_kit_sampler(view, &view->stock->textures[0]);
    DipKitCamera seen;
    if ((refracts &&
         !prepare_target(content, &view->target, dip_quality_sample_count(view->quality), err)) ||
        !dip_kit_camera(&seen, view, 0.1, err)) {
        return false;
    }
    DipSampler waves;
    const int court = list_court(view, &seen, &mosaic);
    const int water =
        list_water(view, &seen, refracts ? NULL : &blended, &waves, content->draws + court);
    if (refracts) {
        return draw_refracted(view, court, water, clear_lin, err);
    }
    const DipPass both = dip_kit_pass(view, content->draws, court + water, clear_lin);
    return dip_kit_draw(view, view->pipeline, &both, err);
}

const DipGalleryScene dip_gallery_water = {
    .info = {.name = "water",
             .title = "Water seen through",
             .text =
                 "The fountain's pool over a mosaic, with waves that refract it, or blended over "
                 "it.",
             DIP_KIT_LOOKS("refracted", "blended")},
    .textures = {{"mosaic", 512, 512, DIP_WRAP_CLAMP, paint_mosaic}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .destroy = destroy,
    .draw = draw,
};
