// Reads animated glTF models: calls the readers of the parts in order.
//
// assimp is not used here, because version 5.2.5 loses the interpolation of animations: STEP and
// CUBICSPLINE samplers become ordinary keys.
#include "assets/animation/animation_gltf.h"

#include <cjson/cJSON.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *dip_gltf_alloc(DipGltfReader *reader, size_t count, size_t item_bytes) {
    return dip_animated_alloc(reader->model, count, item_bytes);
}

bool dip_gltf_no_room(const DipGltfReader *reader) {
    return dip_animated_no_room(reader->model, reader->gltf.err);
}

const char *dip_gltf_name(DipGltfReader *reader, const cJSON *item, const char *kind, int index) {
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(item, "name");
    char made[48];
    if (index < 0) {
        snprintf(made, sizeof made, "default %s", kind);
    } else {
        snprintf(made, sizeof made, "%s %d", kind, index);
    }
    const char *text = cJSON_IsString(name) && name->valuestring[0] ? name->valuestring : made;
    return dip_animated_text(reader->model, text, strlen(text));
}

static bool read_parts(DipGltfReader *reader) {
    const DipAnimatedDef *def = &reader->model->def;
    if (!dip_gltf_prepare_materials(reader) || !dip_gltf_read_meshes(reader) ||
        !dip_gltf_read_nodes(reader)) {
        return false;
    }
    if (def->object_count == 0) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_MISSING, NULL,
                               "the model has no triangles");
    }
    return dip_gltf_read_animations(reader);
}

bool dip_animated_read_gltf(DipAnimatedModel *model, DipError *err) {
    DipGltfReader reader = {.model = model};
    if (!dip_model_precheck(model->store, model->path, err)) {
        return false;
    }
    const bool ok = dip_gltf_open(&reader.gltf, model->path, err) && read_parts(&reader);
    dip_gltf_close(&reader.gltf);
    return ok;
}
