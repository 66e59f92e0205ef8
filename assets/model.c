// Loads a model: turns the nodes of the files into objects, lets pictures.c decode the pictures,
// and completes the scene description.
#include "assets/model.h"

#include "assets/animation.h"
#include "assets/gltf/reader.h"
#include "assets/importer.h"
#include "assets/model_parts.h"
#include "assets/pack/scene_pack.h"
#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MAX_OBJECTS = 1 << 20 };

// A dark grey behind models without a sky.
static const float background_lin[3] = {0.022f, 0.026f, 0.034f};

// State that a node's children inherit.
typedef struct NodeState {
    double world[12]; // rows of a 3x4 matrix
    DipTag tag;
    bool light_mapped;
} NodeState;

void *dip_array_grow(void *items, int count, size_t item_bytes) {
    const bool full = count == 0 || (count & (count - 1)) == 0;
    if (!full) {
        return items;
    }
    const size_t capacity = count == 0 ? 1 : 2 * (size_t)count;
    return count > (1 << 29) ? NULL : realloc(items, capacity * item_bytes);
}

void *dip_model_alloc(DipModel *model, size_t count, size_t item_bytes) {
    if (item_bytes > 0 && count > SIZE_MAX / 2 / item_bytes) {
        return NULL;
    }
    void **blocks = dip_array_grow(model->blocks, model->block_count, sizeof *blocks);
    if (!blocks) {
        return NULL;
    }
    model->blocks = blocks;
    void *block = calloc(1, count * item_bytes + 1);
    if (block) {
        blocks[model->block_count++] = block;
    }
    return block;
}

char *dip_model_copy_text(DipModel *model, const char *text) {
    const size_t size_bytes = strlen(text) + 1;
    char *copy = dip_model_alloc(model, size_bytes, 1);
    return copy ? memcpy(copy, text, size_bytes) : NULL;
}

void dip_make_one_line(char *text) {
    for (; *text; ++text) {
        *text = (unsigned char)*text < ' ' ? ' ' : *text;
    }
}

static void warn(DipModel *model, DipErrorCode code, const char *file, const char *key,
                 const char *format, va_list arguments) {
    char text[256];
    DipError warning;
    if (!model->warnings) {
        return;
    }
    vsnprintf(text, sizeof text, format, arguments);
    dip_make_one_line(text);
    dip_error_set(&warning, code, file, 0, key, "%s", text);
    dip_make_one_line(warning.key);
    warning.severity = DIP_SEVERITY_WARNING;
    dip_error_list_add(model->warnings, &warning);
}

void dip_model_warn(DipModel *model, const char *file, const char *key, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    warn(model, DIP_ERROR_UNSUPPORTED, file, key, format, arguments);
    va_end(arguments);
}

void dip_model_warn_of_picture(DipModel *model, const char *file, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    warn(model, DIP_ERROR_MISSING, file, NULL, format, arguments);
    va_end(arguments);
}

bool dip_model_out_of_memory(DipError *err, const char *file) {
    return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
}

const struct aiMetadataEntry *dip_model_metadata(const struct aiMetadata *meta, const char *key) {
    for (unsigned i = 0; meta && i < meta->mNumProperties; ++i) {
        if (strcmp(meta->mKeys[i].data, key) == 0) {
            return &meta->mValues[i];
        }
    }
    return NULL;
}

static bool metadata_is_true(const struct aiMetadataEntry *entry) {
    switch (entry->mType) {
    case AI_BOOL:
        return *(const bool *)entry->mData;
    case AI_INT32:
        return *(const int32_t *)entry->mData != 0;
    case AI_UINT64:
        return *(const uint64_t *)entry->mData != 0;
    case AI_FLOAT:
        return *(const float *)entry->mData != 0.0f;
    case AI_DOUBLE:
        return *(const double *)entry->mData != 0.0;
    default:
        return false;
    }
}

void dip_model_read_tag(DipModel *model, const char *file, const char *key, const char *name,
                        DipTag *tag) {
    static const char *const names[] = {"solid", "mask", "glass", "water", "sky"};
    for (int i = 0; i <= DIP_TAG_SKY; ++i) {
        if (strcmp(name, names[i]) == 0) {
            *tag = (DipTag)i;
            return;
        }
    }
    dip_model_warn(model, file, key,
                   "the surface \"%s\" is not known, accepted solid, mask, glass, water or sky",
                   name);
}

static void read_tags(DipModel *model, const char *path, const struct aiNode *node,
                      NodeState *state) {
    const struct aiMetadataEntry *light_mapped = dip_model_metadata(node->mMetaData, "lightmapped");
    if (light_mapped) {
        state->light_mapped = metadata_is_true(light_mapped);
    }
    const struct aiMetadataEntry *surface = dip_model_metadata(node->mMetaData, "surface");
    if (!surface || surface->mType != AI_AISTRING) {
        return;
    }
    dip_model_read_tag(model, path, node->mName.data,
                       ((const struct aiString *)surface->mData)->data, &state->tag);
}

void dip_model_multiply(const double a[12], const struct aiMatrix4x4 *b, double to[12]) {
    const double m[3][4] = {
        {b->a1, b->a2, b->a3, b->a4}, {b->b1, b->b2, b->b3, b->b4}, {b->c1, b->c2, b->c3, b->c4}};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            double sum = column == 3 ? a[4 * row + 3] : 0.0;
            for (int k = 0; k < 3; ++k) {
                sum += a[4 * row + k] * m[k][column];
            }
            to[4 * row + column] = sum;
        }
    }
}

bool dip_model_add_object(DipModel *model, int file, int mesh, const double transform[12],
                          const char *name, DipError *err) {
    const char *path = model->files[file].path;
    const int count = model->def.object_count;
    if (count == MAX_OBJECTS) {
        return dip_error_set(err, DIP_ERROR_RANGE, path, 0, NULL,
                             "the model has more than %d objects", MAX_OBJECTS);
    }
    DipObjectDef object = {.mesh = mesh};
    for (int i = 0; i < 12; ++i) {
        object.transform[i] = (float)transform[i];
    }
    object.name = dip_model_copy_text(model, name);
    DipObjectDef *objects = dip_array_grow(model->objects, count, sizeof *objects);
    model->objects = objects ? objects : model->objects;
    if (!object.name || !objects) {
        return dip_model_out_of_memory(err, path);
    }
    objects[model->def.object_count++] = object;
    return true;
}

// Adds the object of a file whose key frames play. Their reader turns them so that +Y is up.
static bool add_key_frames(DipModel *model, int file, unsigned source, int material,
                           const char *name, DipError *err) {
    double root[12];
    dip_model_up_transform(model, &model->files[file], root);
    const int mesh = dip_model_key_frame_mesh(model, file, source, material, root, err);
    return mesh >= 0 && dip_model_add_object(model, file, mesh, root, name, err);
}

static bool add_object(DipModel *model, int file, const struct aiNode *node, unsigned source,
                       const NodeState *state, DipError *err) {
    const struct aiMesh *mesh = model->files[file].scene->mMeshes[source];
    if (!dip_mesh_is_triangles(mesh) || mesh->mNumFaces == 0) {
        return true;
    }
    const int material =
        dip_model_material(model, file, mesh, state->tag, state->light_mapped, err);
    if (material < 0) {
        return false;
    }
    if (model->plans[material].invisible) {
        return true;
    }
    if (model->files[file].key_frames) {
        return add_key_frames(model, file, source, material, node->mName.data, err);
    }
    const int index = dip_model_mesh(model, file, source, material, err);
    return index >= 0 &&
           dip_model_add_object(model, file, index, state->world, node->mName.data, err);
}

// Adds a node and its children to the objects. The import has already limited how deep nodes nest.
static bool walk(DipModel *model, int file, const struct aiNode *node, const NodeState *parent,
                 DipError *err) {
    NodeState state = *parent;
    dip_model_multiply(parent->world, &node->mTransformation, state.world);
    for (int i = 0; i < 12; ++i) {
        if (!isfinite((float)state.world[i])) {
            return dip_error_set(err, DIP_ERROR_RANGE, model->files[file].path, 0, node->mName.data,
                                 "the node's transform is not finite");
        }
    }
    read_tags(model, model->files[file].path, node, &state);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (!add_object(model, file, node, node->mMeshes[i], &state, err)) {
            return false;
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
        if (!walk(model, file, node->mChildren[i], &state, err)) {
            return false;
        }
    }
    return true;
}

// Keeps the names of the file's materials.
static bool list_materials(DipModel *model, DipModelFile *file, DipError *err) {
    const unsigned count = file->scene->mNumMaterials;
    file->material_names = dip_model_alloc(model, count, sizeof *file->material_names);
    for (unsigned i = 0; file->material_names && i < count; ++i) {
        struct aiString name = {0};
        aiGetMaterialString(file->scene->mMaterials[i], AI_MATKEY_NAME, &name);
        file->material_names[i] = dip_model_copy_text(model, name.data);
        file->material_names = file->material_names[i] ? file->material_names : NULL;
    }
    file->material_count = (int)count;
    return file->material_names || dip_model_out_of_memory(err, file->path);
}

// Returns whether the name of a file has this ending.
static bool ends_with(const char *path, const char *ending) {
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

// Reads a file with assimp.
static bool load_with_assimp(DipModel *model, int index, DipError *err) {
    DipModelFile *file = &model->files[index];
    NodeState root = {.tag = DIP_TAG_SOLID};
    if (!dip_model_import(model, file, err) || !list_materials(model, file, err)) {
        return false;
    }
    if (ends_with(file->path, ".md2") && !dip_model_read_key_frames(model, file, err)) {
        return false;
    }
    dip_model_up_transform(model, file, root.world);
    return walk(model, index, file->scene->mRootNode, &root, err) &&
           dip_model_read_lights(model, file, root.world, err);
}

// Reads a file as glTF 2. Sets *is_other if it is something else.
static bool load_as_gltf(DipModel *model, int index, bool *is_other, DipError *err) {
    DipModelFile *file = &model->files[index];
    double root[12];
    *is_other = !ends_with(file->path, ".gltf") && !ends_with(file->path, ".glb");
    if (*is_other) {
        return true;
    }
    dip_model_up_transform(model, file, root);
    return dip_model_check_file(file->path, err) &&
           dip_gltf_read_scene(model, index, root, is_other, err);
}

static bool load_file(DipModel *model, int index, const char *path, DipError *err) {
    model->files[index].path = dip_model_copy_text(model, path);
    if (!model->files[index].path) {
        return dip_model_out_of_memory(err, path);
    }
    model->file_count = index + 1;
    const int objects_before = model->def.object_count;
    bool is_other;
    if (!load_as_gltf(model, index, &is_other, err) ||
        (is_other && !load_with_assimp(model, index, err))) {
        return false;
    }
    return model->def.object_count > objects_before ||
           dip_error_set(err, DIP_ERROR_MISSING, path, 0, NULL, "the model has no triangles");
}

static void release_scenes(DipModel *model) {
    for (int i = 0; i < model->file_count; ++i) {
        if (model->files[i].scene) {
            aiReleaseImport(model->files[i].scene);
            model->files[i].scene = NULL;
        }
        if (model->files[i].gltf) {
            dip_gltf_close(model->files[i].gltf);
            free(model->files[i].gltf);
            model->files[i].gltf = NULL;
        }
        dip_animated_model_destroy(&model->files[i].key_frames);
    }
}

static bool finish(DipModel *model, DipError *err) {
    release_scenes(model);
    model->rules = NULL;
    model->animation_name = NULL;
    model->rule_count = 0;
    model->def.textures = model->textures;
    model->def.materials = model->materials;
    model->def.meshes = model->meshes;
    model->def.objects = model->objects;
    memcpy(model->def.background_lin, background_lin, sizeof background_lin);
    model->def.sky = dip_sky_default();
    DipModelBounds bounds;
    if (!dip_model_finish_motion(model) || !dip_model_bounds(model, &bounds)) {
        return dip_model_out_of_memory(err, model->file_count > 0 ? model->files[0].path : NULL);
    }
    model->def.near_m = dip_model_near_distance(&bounds);
    dip_model_scale_lights(model, &bounds);
    model->warnings = NULL;
    return true;
}

static bool note(const DipModelLoad *load, DipImportStage stage, int file) {
    return load->note_file < 0 || dip_scene_pack_note(load->note_file, stage, file);
}

static bool load_parts(DipModel *model, const DipModelLoad *load, DipError *err) {
    bool ok = model->files || dip_model_out_of_memory(err, load->files[0]);
    const int64_t begin_ns = dip_clock_ns();
    for (int i = 0; ok && i < load->file_count; ++i) {
        note(load, DIP_IMPORT_READS, i);
        ok = load_file(model, i, load->files[i], err);
    }
    ok = ok && dip_model_check_rules(model, err) && dip_model_check_animation(model, err);
    const int64_t imported_ns = dip_clock_ns();
    note(load, DIP_IMPORT_PICTURES, 0);
    ok = ok && dip_model_decode_pictures(model, load->pool, err) &&
         dip_model_finish_materials(model, err) &&
         (load->options.shading != DIP_MODEL_SHADING_flat || dip_model_flatten(model, err));
    model->times.import_ms = 1e-6 * (double)(imported_ns - begin_ns);
    model->times.pictures_ms = 1e-6 * (double)(dip_clock_ns() - imported_ns);
    return ok;
}

// Loads a picture file. Its levels become the scene's only textures.
static bool load_picture(DipModel *model, const DipModelLoad *load, DipError *err) {
    const char *path = load->files[0];
    note(load, DIP_IMPORT_PICTURES, 0);
    model->pictures = calloc(1, sizeof *model->pictures);
    model->textures = calloc(DIP_MAX_LEVELS, sizeof *model->textures);
    const char *name = dip_model_copy_text(model, path);
    if (!model->pictures || !model->textures || !name) {
        return dip_model_out_of_memory(err, path);
    }
    DipPicture *picture = &model->pictures[0].picture;
    model->picture_count = 1;
    if (!dip_picture_read_file(path, picture, err)) {
        return false;
    }
    model->def.texture_count =
        dip_picture_levels(picture, name, DIP_ENCODING_SRGB, model->textures);
    return true;
}

DipModel *dip_model_load_here(const DipModelLoad *load, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipModel *model = calloc(1, sizeof *model);
    if (!model) {
        dip_model_out_of_memory(err, load->files[0]);
        return NULL;
    }
    model->warnings = load->warnings;
    model->normal_maps = load->options.normal_maps;
    model->up = load->options.up;
    model->rules = load->options.rules;
    model->rule_count = load->options.rule_count;
    model->has_light_scale = load->options.has_light_scale;
    model->light_scale = load->options.light_scale;
    model->animation = load->options.animation;
    model->animation_name = load->options.animation_name;
    model->animation_is_held = load->options.animation_is_held;
    model->animation_held_s = load->options.animation_held_s;
    model->files = calloc((size_t)load->file_count, sizeof *model->files);
    const bool ok =
        load->picture_only ? load_picture(model, load, err) : load_parts(model, load, err);
    if (!ok || !finish(model, err)) {
        dip_model_destroy(&model);
    }
    return model;
}

static bool check_load(const DipModelLoad *load, DipError *err) {
    const DipModelOptions *options = &load->options;
    if (load->file_count < 1 || load->file_count > DIP_MAX_MODEL_FILES) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL, "%d model files, accepted 1..%d",
                             load->file_count, DIP_MAX_MODEL_FILES);
    }
    if (options->rule_count < 0 || options->rule_count > DIP_MAX_MATERIAL_RULES) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL,
                             "%d rules for materials, accepted 0..%d", options->rule_count,
                             DIP_MAX_MATERIAL_RULES);
    }
    return dip_model_check_lights(options, err);
}

DipModel *dip_model_load_with(const char *const *files, int file_count,
                              const DipModelOptions *options, DipPool *pool, DipErrorList *warnings,
                              DipError *err) {
    DIP_FP_MODE_SCOPE();
    const DipModelLoad load = {.files = files,
                               .file_count = file_count,
                               .options = options ? *options : (DipModelOptions){0},
                               .pool = pool,
                               .warnings = warnings,
                               .note_file = -1};
    if (!check_load(&load, err)) {
        return NULL;
    }
    const DipImporter *importer = load.options.importer;
    DipModel *model =
        importer ? dip_model_load_in_child(&load, importer, err) : dip_model_load_here(&load, err);
    if (model && !dip_model_light(model, &load, err)) {
        dip_model_destroy(&model);
    }
    return model;
}

bool dip_picture_import(const char *path, const DipImporter *importer, DipPicture *picture,
                        DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!importer) {
        return dip_picture_read_file(path, picture, err);
    }
    *picture = (DipPicture){0};
    const DipModelLoad load = {
        .files = &path, .file_count = 1, .note_file = -1, .picture_only = true};
    DipModel *model = dip_model_load_in_child(&load, importer, err);
    if (!model) {
        return false;
    }
    const int levels = model->def.texture_count;
    const bool ok = levels >= 1 && levels <= DIP_MAX_LEVELS
                        ? dip_picture_copy(model->def.textures, levels, picture, err)
                        : dip_error_set(err, DIP_ERROR_FORMAT, path, 0, NULL,
                                        "the importer's result is malformed: it has no picture");
    dip_model_destroy(&model);
    return ok;
}

DipModel *dip_model_load(const char *const *files, int file_count, DipPool *pool,
                         DipErrorList *warnings, DipError *err) {
    return dip_model_load_with(files, file_count, NULL, pool, warnings, err);
}

DipModel *dip_model_load_with_normals(const char *const *files, int file_count, DipPool *pool,
                                      DipErrorList *warnings, DipError *err) {
    const DipModelOptions options = {.normal_maps = true};
    return dip_model_load_with(files, file_count, &options, pool, warnings, err);
}

void dip_model_destroy(DipModel **model_pointer) {
    DipModel *model = *model_pointer;
    if (!model) {
        return;
    }
    *model_pointer = NULL;
    release_scenes(model);
    if (model->pack) {
        dip_scene_pack_free(model->pack);
    }
    dip_model_unmap_pack(model);
    for (int i = 0; i < model->picture_count; ++i) {
        dip_picture_free(&model->pictures[i].picture);
    }
    for (int i = 0; i < model->merged_count; ++i) {
        dip_picture_free(&model->merged[i]);
    }
    for (int i = 0; i < model->block_count; ++i) {
        free(model->blocks[i]);
    }
    void *const arrays[] = {
        model->textures, model->texture_keys, model->materials,      model->plans,
        model->meshes,   model->mesh_keys,    model->objects,        model->pictures,
        model->merged,   model->blocks,       model->files,          model->lights,
        model->clips,    model->rigs,         model->moving_objects, model->moving_meshes};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; ++i) {
        free(arrays[i]);
    }
    free(model);
}

const DipSceneDef *dip_model_scene_def(const DipModel *model) {
    return &model->def;
}

const char *const *dip_model_animations(const DipModel *model, int *count) {
    *count = model->clip_count;
    return model->clip_names;
}

DipModelTimes dip_model_times(const DipModel *model) {
    return model->times;
}
