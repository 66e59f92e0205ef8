// Loads animated models: chooses the reader.
#include "assets/animation.h"

#include "assets/animation/animation_parts.h"
#include "assets/gltf/reader.h"
#include "renderer/base/fp_mode.h"

#include <string.h>
#include <strings.h>

typedef bool ReadModel(DipAnimatedModel *model, DipError *err);

static ReadModel *reader_of(const char *path) {
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".md2") == 0) {
        return dip_animated_read_md2;
    }
    const bool is_gltf = dot && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0);
    return is_gltf ? dip_animated_read_gltf : NULL;
}

static bool read_model(DipAnimatedModel *model, DipError *err) {
    ReadModel *read = reader_of(model->path);
    if (!read) {
        return dip_error_set(err, DIP_ERROR_FORMAT, model->path, 0, NULL,
                             "the file is not an animated model, accepted .md2, .gltf and .glb");
    }
    if (!read(model, err)) {
        return false;
    }
    model->def.textures = model->textures;
    model->def.materials = model->materials;
    model->def.meshes = model->meshes;
    model->def.objects = model->objects;
    model->def.animations = model->animations;
    model->def.key_frames = model->key_frames;
    return true;
}

static DipAnimatedModel *load(const char *file, const struct DipImporter *importer,
                              bool shapes_only, DipErrorList *warnings, DipError *err) {
    DipAnimatedModel *model = dip_animated_model_make(file);
    if (!model) {
        dip_model_out_of_memory(err, file);
        return NULL;
    }
    model->store->warnings = warnings;
    model->importer = importer;
    model->shapes_only = shapes_only;
    if (!read_model(model, err)) {
        dip_animated_model_destroy(&model);
        return NULL;
    }
    model->store->warnings = NULL;
    model->importer = NULL;
    return model;
}

DipAnimatedModel *dip_animated_model_load(const char *file, const struct DipImporter *importer,
                                          DipErrorList *warnings, DipError *err) {
    DIP_FP_MODE_SCOPE();
    return load(file, importer, false, warnings, err);
}

DipAnimatedModel *dip_animated_model_load_shapes(const char *file, DipErrorList *warnings,
                                                 DipError *err) {
    DIP_FP_MODE_SCOPE();
    return load(file, NULL, true, warnings, err);
}
