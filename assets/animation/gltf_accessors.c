// Reads the values of glTF accessors, and checks that they lie within their buffer views.
#include "assets/animation/gltf_document.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <string.h>

static size_t component_bytes(int component) {
    switch (component) {
    case DIP_GLTF_BYTE:
    case DIP_GLTF_UNSIGNED_BYTE:
        return 1;
    case DIP_GLTF_SHORT:
    case DIP_GLTF_UNSIGNED_SHORT:
        return 2;
    case DIP_GLTF_UNSIGNED_INT:
    case DIP_GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static int width_of(const cJSON *type) {
    static const struct {
        const char *name;
        int width;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    for (size_t i = 0; cJSON_IsString(type) && i < sizeof types / sizeof *types; ++i) {
        if (strcmp(type->valuestring, types[i].name) == 0) {
            return types[i].width;
        }
    }
    return 0;
}

static bool read_layout(const DipGltf *gltf, const cJSON *json, int width, const char *what,
                        DipGltfAccessor *accessor) {
    int count;
    if (!dip_gltf_integer(gltf, json, "count", 0, &count) ||
        !dip_gltf_integer(gltf, json, "componentType", 0, &accessor->component)) {
        return false;
    }
    accessor->count = (uint32_t)count;
    accessor->width = width_of(cJSON_GetObjectItemCaseSensitive(json, "type"));
    accessor->normalized = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(json, "normalized"));
    if (accessor->width != width || component_bytes(accessor->component) == 0 || count == 0) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "accessors",
                               "the accessor of %s has another type, or no values", what);
    }
    return cJSON_GetObjectItemCaseSensitive(json, "sparse") == NULL ||
           dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "accessors",
                           "the accessor of %s is sparse, accepted accessors that are not", what);
}

bool dip_gltf_accessor(DipGltf *gltf, int index, int width, const char *what,
                       DipGltfAccessor *accessor) {
    *accessor = (DipGltfAccessor){0};
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_accessors, index);
    int view;
    int offset;
    int stride;
    size_t size_bytes;
    if (!json || !read_layout(gltf, json, width, what, accessor) ||
        !dip_gltf_integer(gltf, json, "bufferView", -1, &view) ||
        !dip_gltf_integer(gltf, json, "byteOffset", 0, &offset)) {
        return false;
    }
    if (view < 0) {
        return dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "accessors",
                               "the accessor of %s has no buffer view", what);
    }
    if (!dip_gltf_view(gltf, view, &accessor->bytes, &size_bytes, &stride)) {
        return false;
    }
    const size_t value_bytes = component_bytes(accessor->component) * (size_t)width;
    accessor->stride_bytes = stride ? (size_t)stride : value_bytes;
    if (accessor->stride_bytes < value_bytes) {
        return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "byteStride",
                               "the stride of %s is %d bytes, accepted at least %zu", what, stride,
                               value_bytes);
    }
    // Counts, strides and offsets are at most 2^30, so nothing overflows.
    const uint64_t end =
        (uint64_t)offset + value_bytes + (uint64_t)(accessor->count - 1) * accessor->stride_bytes;
    if (end > size_bytes) {
        return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "accessors",
                               "the accessor of %s ends beyond its view of %zu bytes", what,
                               size_bytes);
    }
    accessor->bytes += offset;
    return true;
}

// Reads an integer component with its sign.
static int64_t read_integer(const DipGltfAccessor *accessor, const uint8_t *at) {
    switch (accessor->component) {
    case DIP_GLTF_BYTE:
        return (int8_t)at[0];
    case DIP_GLTF_UNSIGNED_BYTE:
        return at[0];
    case DIP_GLTF_SHORT:
        return (int16_t)(at[0] | at[1] << 8);
    case DIP_GLTF_UNSIGNED_SHORT:
        return at[0] | at[1] << 8;
    default:
        return dip_gltf_u32(at);
    }
}

static const uint8_t *component_at(const DipGltfAccessor *accessor, uint32_t i, int component) {
    return accessor->bytes + (size_t)i * accessor->stride_bytes +
           (size_t)component * component_bytes(accessor->component);
}

double dip_gltf_number(const DipGltfAccessor *accessor, uint32_t i, int component) {
    const uint8_t *at = component_at(accessor, i, component);
    if (accessor->component == DIP_GLTF_FLOAT) {
        const uint32_t bits = dip_gltf_u32(at);
        float value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    const double value = (double)read_integer(accessor, at);
    switch (accessor->normalized ? accessor->component : 0) {
    case DIP_GLTF_BYTE:
        return fmax(value / 127.0, -1.0);
    case DIP_GLTF_UNSIGNED_BYTE:
        return value / 255.0;
    case DIP_GLTF_SHORT:
        return fmax(value / 32767.0, -1.0);
    case DIP_GLTF_UNSIGNED_SHORT:
        return value / 65535.0;
    default:
        return value;
    }
}

uint32_t dip_gltf_unsigned(const DipGltfAccessor *accessor, uint32_t i, int component) {
    return (uint32_t)read_integer(accessor, component_at(accessor, i, component));
}

bool dip_gltf_floats(const DipGltf *gltf, const DipGltfAccessor *accessor, const char *what,
                     float *to) {
    for (uint32_t i = 0; i < accessor->count; ++i) {
        for (int k = 0; k < accessor->width; ++k) {
            *to = (float)dip_gltf_number(accessor, i, k);
            if (!isfinite(*to)) {
                return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, what, "value %u is not finite", i);
            }
            ++to;
        }
    }
    return true;
}
