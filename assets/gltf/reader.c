// What all parts of the reader of glTF files use: memory and names.
//
// Diptych reads glTF 2 itself. assimp, which reads the other formats, loses the interpolation of
// animations, the strength of emission, morph weights of nodes and the types of quantized numbers.
#include "assets/gltf/reader.h"

#include <cjson/cJSON.h>

#include <stdio.h>
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
