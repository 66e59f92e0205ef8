// Draws the gallery scene "model": an MD2 model with key-frame animation, lit in several ways. It
// comes from seed 000; gallery.h says what a seed is.
//
// Gouraud and Phong shading differ only in their vertex and fragment shaders. Flat shading uses
// Gouraud's shaders with other meshes, whose triangles share no vertices. A directional, a point
// and a spot light shine on the model. The looks (the scene's variants) show the model textured,
// plain, and as a lit wireframe. Each vertex of a mesh holds its positions and normals in two
// successive key frames, and the vertex shader blends them.
#include "app/gallery/kit/kit.h"
#include "app/gallery/kit/light.h"
#include "assets/animation.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FRAMES = 64, COPIES = 3, LIGHTS = 3 };
// Attributes of a vertex: position and normal in a key frame, position and normal in the next key
// frame, and u, v.
enum { NEXT = 6, UV = 12, ATTRIBUTES = 14 };
// Varyings of Gouraud and flat shading: u, v, then the light.
enum { LIGHT = 2, LIT_VARYINGS = 5 };

typedef struct Uniforms {
    DipKitObject object;
    float blend; // Weight of the next key frame, 0..1.
    DipKitMaterial material;
    DipKitLight lights[LIGHTS];
    bool textured;
} Uniforms;

typedef struct Content {
    DipAnimatedModel *model;
    DipAnimatedPose *pose;
    // [0: smooth, 1: flat][key frame]: a mesh for this key frame and the next one. Triangles of
    // flat meshes share no vertices.
    DipMesh *meshes[2][MAX_FRAMES];
} Content;

typedef struct Look {
    bool flat;
    bool gouraud; // True to compute light at the vertices, false to compute it at the fragments.
    bool textured;
    bool wireframe;
} Look;

static const Look model_looks[] = {{false, false, true, false}, {false, true, true, false},
                                   {true, true, true, false},   {false, false, false, false},
                                   {true, true, false, false},  {false, false, true, true}};
// --- shaders -------------------------------------------------------------------------------------

// Blends two key frames, takes positions to clip space, and writes positions and normals in world
// space.
static void blend_frames(const DipVertexBatch *batch, float *const world[3],
                         float *const normal[3]) {
    const Uniforms *uniforms = batch->uniforms;
    const DipKitObject *object = &uniforms->object;
    const float share = uniforms->blend;
    for (int i = 0; i < batch->count; i++) {
        float p[6];
        for (int a = 0; a < 6; a++) {
            p[a] = dip_kit_mix(batch->in[a][i], batch->in[NEXT + a][i], share);
        }
        for (int r = 0; r < 4; r++) {
            const float *row = object->to_clip + 4 * r;
            batch->clip[r][i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        }
        for (int r = 0; r < 3; r++) {
            const float *row = object->to_world + 4 * r;
            const float *turn = object->normals + 3 * r;
            world[r][i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
            normal[r][i] = turn[0] * p[3] + turn[1] * p[4] + turn[2] * p[5];
        }
        batch->varying[DIP_KIT_UV][i] = batch->in[UV][i];
        batch->varying[DIP_KIT_UV + 1][i] = batch->in[UV + 1][i];
    }
}

// Vertex shader for Phong shading: position and normal become varyings, and the fragment shader
// computes the light.
static void phong_vertex(const DipVertexBatch *batch) {
    blend_frames(batch, batch->varying + DIP_KIT_WORLD, batch->varying + DIP_KIT_NORMAL);
}

static void add_lights(const Uniforms *uniforms, const DipKitPoints *points,
                       float (*out)[DIP_FRAGMENT_BATCH]) {
    const DipKitMaterial *material = &uniforms->material;
    const float ambient[3] = {0.10f * material->diffuse[0], 0.12f * material->diffuse[1],
                              0.16f * material->diffuse[2]};
    dip_kit_light_all(ambient, uniforms->lights, LIGHTS, material, points, out);
}

// Vertex shader for Gouraud shading: the light is computed at the vertices and becomes a varying.
// It also serves flat shading, because each vertex of a flat mesh belongs to one triangle only and
// has the triangle's normal.
static void gouraud_vertex(const DipVertexBatch *batch) {
    static const int slice = DIP_FRAGMENT_BATCH;
    const Uniforms *uniforms = batch->uniforms;
    float values[6][DIP_VERTEX_BATCH];
    float *const world[3] = {values[0], values[1], values[2]};
    float *const normal[3] = {values[3], values[4], values[5]};
    blend_frames(batch, world, normal);
    for (int first = 0; first < batch->count; first += slice) {
        float unit[3][DIP_FRAGMENT_BATCH];
        float light[3][DIP_FRAGMENT_BATCH];
        const int count = batch->count - first < slice ? batch->count - first : slice;
        const float *const in[3] = {normal[0] + first, normal[1] + first, normal[2] + first};
        dip_kit_normalise(in, count, unit);
        const DipKitPoints points = {
            .count = count,
            .position = {world[0] + first, world[1] + first, world[2] + first},
            .normal = {unit[0], unit[1], unit[2]},
            .eye = uniforms->object.eye};
        add_lights(uniforms, &points, light);
        for (int c = 0; c < 3; c++) {
            memcpy(batch->varying[LIGHT + c] + first, light[c], (size_t)count * sizeof(float));
        }
    }
}

static void multiply_by_skin(DipFragmentBatch *batch, float (*light)[DIP_FRAGMENT_BATCH]) {
    const Uniforms *uniforms = batch->uniforms;
    if (uniforms->textured) {
        batch->sample_colour(batch, &batch->samplers[0], DIP_KIT_UV, batch->colour);
    }
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < batch->count; i++) {
            const float own = uniforms->textured ? batch->colour[c][i] : 0.62f;
            batch->colour[c][i] = own * light[c][i];
        }
    }
}

static void shade_phong(DipFragmentBatch *batch) {
    float normals[3][DIP_FRAGMENT_BATCH];
    float light[3][DIP_FRAGMENT_BATCH];
    const DipKitPoints points = dip_kit_fragment_points(batch, normals);
    add_lights(batch->uniforms, &points, light);
    multiply_by_skin(batch, light);
}

static void shade_gouraud(DipFragmentBatch *batch) {
    float light[3][DIP_FRAGMENT_BATCH];
    for (int c = 0; c < 3; c++) {
        memcpy(light[c], batch->varying[LIGHT + c], (size_t)batch->count * sizeof(float));
    }
    multiply_by_skin(batch, light);
}

// --- content -------------------------------------------------------------------------------------

// Writes a vertex in two key frames. `flat_normals` holds the face's normal in both key frames; if
// it is NULL, the vertex's own normals are written.
static void write_vertex(const DipAnimatedMesh *mesh, uint32_t v, int frame, int next,
                         const float flat_normals[2][3], float *out) {
    const int frames[2] = {frame, next};
    for (int f = 0; f < 2; f++) {
        const size_t at = ((size_t)frames[f] * mesh->vertex_count + v) * 3;
        memcpy(out + NEXT * f, mesh->positions + at, 3 * sizeof(float));
        memcpy(out + NEXT * f + 3, flat_normals ? flat_normals[f] : mesh->normals + at,
               3 * sizeof(float));
    }
    out[UV] = mesh->uv0 ? mesh->uv0[2 * v] : 0.0f;
    out[UV + 1] = mesh->uv0 ? mesh->uv0[2 * v + 1] : 0.0f;
}

static void face_normal(const DipAnimatedMesh *mesh, const uint32_t corner[3], int frame,
                        float normal[3]) {
    const float *all = mesh->positions + (size_t)frame * mesh->vertex_count * 3;
    const DipKitVector first = dip_kit_vector(all + 3 * corner[0]);
    const DipKitVector a = dip_kit_minus(dip_kit_vector(all + 3 * corner[1]), first);
    const DipKitVector b = dip_kit_minus(dip_kit_vector(all + 3 * corner[2]), first);
    const DipKitVector c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const DipKitVector unit = dip_kit_times(c, dip_kit_per_length(c, 1e-30f));
    normal[0] = unit.x;
    normal[1] = unit.y;
    normal[2] = unit.z;
}

// Makes the smooth or the flat mesh of a key frame and the next one.
static bool make_mesh(DipMesh **to, const DipAnimatedMesh *mesh, int frame, int next, bool flat,
                      DipError *err) {
    const uint32_t count = flat ? mesh->index_count : mesh->vertex_count;
    float *rows = malloc((size_t)count * ATTRIBUTES * sizeof *rows);
    uint32_t *order = malloc(mesh->index_count * sizeof *order);
    for (uint32_t v = 0; rows && order && v < count; v++) {
        float normals[2][3];
        if (flat) {
            face_normal(mesh, mesh->indices + v - v % 3, frame, normals[0]);
            face_normal(mesh, mesh->indices + v - v % 3, next, normals[1]);
        }
        write_vertex(mesh, flat ? mesh->indices[v] : v, frame, next,
                     flat ? (const float(*)[3])normals : NULL, rows + (size_t)v * ATTRIBUTES);
    }
    for (uint32_t k = 0; order && k < mesh->index_count; k++) {
        order[k] = flat ? k : mesh->indices[k];
    }
    const DipMeshData data = {flat ? "flat" : "smooth", rows, ATTRIBUTES, count, order,
                              mesh->index_count};
    if (rows && order) {
        *to = dip_mesh_create(&data, err);
    } else {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "model", "out of memory");
    }
    free(rows);
    free(order);
    return *to != NULL;
}

static void destroy(void *pointer) {
    Content *content = pointer;
    for (int f = 0; f < MAX_FRAMES; f++) {
        dip_mesh_destroy(&content->meshes[0][f]);
        dip_mesh_destroy(&content->meshes[1][f]);
    }
    dip_animated_pose_destroy(&content->pose);
    dip_animated_model_destroy(&content->model);
}

static bool create(DipGalleryRoom *room, DipError *err) {
    Content *content = room->content;
    char file[PATH_MAX];
    if (!dip_kit_asset(file, sizeof file, room->def, "gallery/penguin.md2", "model", err)) {
        return false;
    }
    content->model = dip_animated_model_load(file, NULL, NULL, err);
    content->pose = content->model ? dip_animated_pose_create(content->model, err) : NULL;
    if (!content->pose) {
        return false;
    }
    const DipAnimatedDef *def = dip_animated_model_def(content->model);
    if (def->texture_count < 1 || def->key_frame_count < 1 || def->key_frame_count > MAX_FRAMES) {
        return dip_error_set(err, DIP_ERROR_RANGE, file, 0, "model",
                             "the model needs a skin and 1 to %d key frames", MAX_FRAMES);
    }
    DipTextureDef skin = def->textures[0];
    skin.wrap_u = skin.wrap_v = DIP_WRAP_CLAMP;
    room->stock.textures[0].plain = dip_texture_create(&skin, err);
    bool made = room->stock.textures[0].plain != NULL;
    for (int f = 0; made && f < 2 * def->key_frame_count; f++) {
        const int frame = f / 2;
        made = make_mesh(&content->meshes[f % 2][frame], &def->meshes[0], frame,
                         (frame + 1) % def->key_frame_count, f % 2 == 1, err);
    }
    return made;
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    const double angle = 0.5 * dip_sin(turn);
    return (DipGalleryCamera){
        .eye = {3.9 * dip_sin(angle), 1.6 + 0.3 * dip_cos(turn), 3.9 * dip_cos(angle)},
        .target = {0.0, 0.78, 0.0}};
}

// Sets a white light from above, an orange point light that circles, and a blue spot light that
// sweeps over the floor.
static void set_lights(DipKitLight lights[LIGHTS], double turn) {
    lights[0] = (DipKitLight){.kind = DIP_KIT_DIRECTIONAL,
                              .direction = {-0.36f, -0.80f, -0.48f},
                              .colour = {0.75f, 0.74f, 0.70f}};
    lights[1] = (DipKitLight){
        .kind = DIP_KIT_POINT,
        .position = {(float)(2.0 * dip_cos(2.0 * turn)), 1.1f, (float)(2.0 * dip_sin(2.0 * turn))},
        .colour = {1.6f, 0.75f, 0.25f},
        .reach = 1.2f};
    lights[2] = (DipKitLight){.kind = DIP_KIT_SPOT,
                              .position = {-2.0f, 4.0f, 1.0f},
                              .colour = {0.5f, 1.0f, 2.6f},
                              .reach = 5.0f,
                              .inner_cos = 0.975f,
                              .outer_cos = 0.94f};
    const double x = 2.0 + 1.4 * dip_sin(turn);
    const double z = -1.0 + 0.5 * dip_cos(3.0 * turn);
    const double size = sqrt(x * x + 16.0 + z * z);
    lights[2].direction[0] = (float)(x / size);
    lights[2].direction[1] = (float)(-4.0 / size);
    lights[2].direction[2] = (float)(z / size);
}

static Uniforms uniforms_of(const DipGalleryView *view, bool is_floor) {
    Uniforms uniforms = {
        .textured = !is_floor && model_looks[view->look].textured,
        .material = is_floor ? (DipKitMaterial){{0.36f, 0.44f, 0.54f}, {0.25f, 0.25f, 0.3f}, 5}
                             : (DipKitMaterial){{1.0f, 1.0f, 1.0f}, {0.55f, 0.55f, 0.55f}, 5}};
    set_lights(uniforms.lights, view->turn);
    return uniforms;
}

// Adds one copy of the model to the list. Each copy shows another time of the animation.
static DipDraw *add_copy(int copy, DipKitList *list) {
    const DipGalleryView *view = list->view;
    const Content *content = view->content;
    const Look *look = &model_looks[view->look];
    dip_animated_pose_set(content->pose, 0, view->time_s + 0.37 * copy);
    const DipObjectPose *posed = dip_animated_pose_object(content->pose, 0);
    const double angle = -0.5 * DIP_PI + 0.6 * dip_sin(view->turn + copy) - 0.3 * (copy - 1);
    DipMatrix own = dip_matrix_identity();
    for (int i = 0; i < 12; i++) {
        own.m[i] = (double)posed->transform[i];
    }
    const DipMatrix model =
        dip_kit_chain3(dip_matrix_translation(1.45 * (copy - 1), 0.0, copy == 1 ? 0.4 : -0.5),
                       dip_matrix_rotation(1, angle), own); // The model itself looks along +x.
    Uniforms uniforms = uniforms_of(view, false);
    uniforms.blend = posed->blend;
    DipDraw *draw = dip_kit_add(list, content->meshes[look->flat][posed->key_frame], &uniforms,
                                &model, look->gouraud ? shade_gouraud : shade_phong);
    draw->vertex_shader = look->gouraud ? gouraud_vertex : phong_vertex;
    draw->varying_count = look->gouraud ? LIT_VARYINGS : DIP_KIT_VARYINGS;
    draw->value_only_varying_count = look->gouraud ? 3 : DIP_KIT_VALUES_ONLY;
    draw->bounds_to_clip = NULL; // The mesh's box holds only the first of its two key frames, so
                                 // the draw is not culled by this box.
    return draw;
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.05f, 0.07f, 0.10f};
    const DipDrawState wireframe = {
        .fill = DIP_FILL_WIREFRAME,
        .line_width = dip_kit_clamp((float)view->target.height / 320.0f, 1.0f, 8.0f)};
    const DipSampler skin = dip_kit_sampler(view, &view->stock->textures[0]);
    const DipMatrix identity = dip_matrix_identity();
    DipKitList list = dip_kit_list(view, 0.1, err);
    const Uniforms ground = uniforms_of(view, true);
    for (int copy = 0; copy < COPIES; copy++) {
        DipDraw *copied = add_copy(copy, &list);
        copied->samplers = &skin;
        copied->state = model_looks[view->look].wireframe ? &wireframe : NULL;
    }
    dip_kit_add(&list, view->stock->meshes[0], &ground, &identity, shade_phong);
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_model = {
    .info = {.name = "model",
             .title = "Animated model",
             .text =
                 "An MD2 model with key-frame animation under a directional, a point and a spot "
                 "light. The looks change the shading.",
             DIP_KIT_LOOKS("Phong", "Gouraud", "flat", "Phong, plain", "flat, plain",
                           "lit wireframe")},
    .meshes = {{DIP_KIT_PLANE, {24.0f, 24.0f, 48, 48}}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .destroy = destroy,
    .draw = draw,
};
