// Reads the values of glTF accessors, and checks that they lie within their buffer views.
#include "assets/gltf/document.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdlib.h>
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
    const bool fits = width > 0 ? accessor->width == width : accessor->width > 0;
    return (fits && component_bytes(accessor->component) > 0 && count > 0) ||
           dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "accessors",
                           "the accessor of %s has another type, or no values", what);
}

static size_t value_bytes_of(const DipGltfAccessor *accessor) {
    return component_bytes(accessor->component) * (size_t)accessor->width;
}

// Places the values in the buffer view that `json` names. The accessor has its other fields.
static bool place_in_view(DipGltf *gltf, const cJSON *json, const char *what,
                          DipGltfAccessor *accessor) {
    int view;
    int offset;
    int stride;
    size_t size_bytes;
    if (!dip_gltf_integer(gltf, json, "bufferView", -1, &view) ||
        !dip_gltf_integer(gltf, json, "byteOffset", 0, &offset) ||
        !dip_gltf_view(gltf, view, &accessor->bytes, &size_bytes, &stride)) {
        return false;
    }
    const size_t value_bytes = value_bytes_of(accessor);
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

// --- sparse accessors ----------------------------------------------------------------------------

// Overwrites the values that a sparse accessor lists. `to` has all values without gaps.
static bool write_sparse(DipGltf *gltf, const cJSON *sparse, const char *what,
                         const DipGltfAccessor *accessor, uint8_t *to) {
    const cJSON *index_json = cJSON_GetObjectItemCaseSensitive(sparse, "indices");
    const cJSON *value_json = cJSON_GetObjectItemCaseSensitive(sparse, "values");
    DipGltfAccessor indices = {.width = 1};
    DipGltfAccessor values = *accessor;
    int count;
    if (!dip_gltf_integer(gltf, sparse, "count", 0, &count) ||
        !dip_gltf_integer(gltf, index_json, "componentType", 0, &indices.component)) {
        return false;
    }
    if (count < 1 || (uint32_t)count > accessor->count ||
        (indices.component != DIP_GLTF_UNSIGNED_BYTE &&
         indices.component != DIP_GLTF_UNSIGNED_SHORT &&
         indices.component != DIP_GLTF_UNSIGNED_INT)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "sparse",
                               "the sparse accessor of %s lists %d of %u values, or its indices "
                               "are not unsigned integers",
                               what, count, accessor->count);
    }
    indices.count = values.count = (uint32_t)count;
    if (!place_in_view(gltf, index_json, what, &indices) ||
        !place_in_view(gltf, value_json, what, &values)) {
        return false;
    }
    const size_t value_bytes = value_bytes_of(accessor);
    for (uint32_t i = 0; i < indices.count; ++i) {
        const uint32_t at = dip_gltf_unsigned(&indices, i, 0);
        if (at >= accessor->count) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "sparse",
                                   "the sparse accessor of %s lists value %u of %u", what, at,
                                   accessor->count);
        }
        memcpy(to + at * value_bytes, values.bytes + i * values.stride_bytes, value_bytes);
    }
    return true;
}

// Makes the values of a sparse accessor when it is used for the first time.
static bool make_dense(DipGltf *gltf, const cJSON *sparse, int index, const char *what,
                       DipGltfAccessor *accessor) {
    const size_t value_bytes = value_bytes_of(accessor);
    if (!gltf->dense[index]) {
        uint8_t *values = dip_gltf_make(gltf, accessor->count * value_bytes);
        for (uint32_t i = 0; values && accessor->bytes && i < accessor->count; ++i) {
            memcpy(values + i * value_bytes, accessor->bytes + i * accessor->stride_bytes,
                   value_bytes);
        }
        if (!values || !write_sparse(gltf, sparse, what, accessor, values)) {
            free(values);
            return false;
        }
        gltf->dense[index] = values;
    }
    accessor->bytes = gltf->dense[index];
    accessor->stride_bytes = value_bytes;
    return true;
}

bool dip_gltf_accessor(DipGltf *gltf, int index, int width, const char *what,
                       DipGltfAccessor *accessor) {
    *accessor = (DipGltfAccessor){0};
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_accessors, index);
    const cJSON *sparse = cJSON_GetObjectItemCaseSensitive(json, "sparse");
    if (!json || !read_layout(gltf, json, width, what, accessor)) {
        return false;
    }
    // Without a view, all values are 0 that a sparse accessor does not list.
    if (cJSON_GetObjectItemCaseSensitive(json, "bufferView") &&
        !place_in_view(gltf, json, what, accessor)) {
        return false;
    }
    return !sparse || make_dense(gltf, sparse, index, what, accessor);
}

// --- values --------------------------------------------------------------------------------------

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
    if (!accessor->bytes) {
        return 0.0;
    }
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
    return accessor->bytes ? (uint32_t)read_integer(accessor, component_at(accessor, i, component))
                           : 0;
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
