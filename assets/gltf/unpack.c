// Unpacks buffer views with the extension EXT_meshopt_compression, by the library meshoptimizer.
#include "assets/gltf/document.h"

#include <cjson/cJSON.h>

#include <string.h>

#ifdef DIP_HAS_MESHOPTIMIZER

#include <meshoptimizer.h>

enum { MAX_STRIDE = 256 };

// What the extension says about a view.
typedef struct Packing {
    const uint8_t *bytes;
    size_t size_bytes;
    size_t count;  // Number of values.
    size_t stride; // Size of a value in bytes.
    const char *mode;
    const char *filter;
} Packing;

static const char *word_of(const cJSON *object, const char *name, const char *otherwise) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    return cJSON_IsString(item) ? item->valuestring : otherwise;
}

static bool read_packing(DipGltf *gltf, int index, const cJSON *extension, Packing *packing) {
    int count;
    int stride;
    if (!dip_gltf_integer(gltf, extension, "count", 0, &count) ||
        !dip_gltf_integer(gltf, extension, "byteStride", 0, &stride) ||
        !dip_gltf_buffer_part(gltf, extension, index, &packing->bytes, &packing->size_bytes)) {
        return false;
    }
    packing->count = (size_t)count;
    packing->stride = (size_t)stride;
    packing->mode = word_of(extension, "mode", "");
    packing->filter = word_of(extension, "filter", "NONE");
    return true;
}

// The library asserts that its callers meet these rules of the extension.
static bool is_valid(const Packing *packing) {
    const bool indices = strcmp(packing->mode, "TRIANGLES") == 0;
    const bool sequence = strcmp(packing->mode, "INDICES") == 0;
    if (indices || sequence) {
        return (packing->stride == 2 || packing->stride == 4) &&
               (!indices || packing->count % 3 == 0) && strcmp(packing->filter, "NONE") == 0;
    }
    const bool octahedral = strcmp(packing->filter, "OCTAHEDRAL") == 0;
    const bool quaternion = strcmp(packing->filter, "QUATERNION") == 0;
    return strcmp(packing->mode, "ATTRIBUTES") == 0 && packing->stride >= 4 &&
           packing->stride % 4 == 0 && packing->stride <= MAX_STRIDE &&
           (!octahedral || packing->stride == 4 || packing->stride == 8) &&
           (!quaternion || packing->stride == 8);
}

static bool decode(const Packing *packing, uint8_t *to) {
    if (strcmp(packing->mode, "TRIANGLES") == 0) {
        return meshopt_decodeIndexBuffer(to, packing->count, packing->stride, packing->bytes,
                                         packing->size_bytes) == 0;
    }
    if (strcmp(packing->mode, "INDICES") == 0) {
        return meshopt_decodeIndexSequence(to, packing->count, packing->stride, packing->bytes,
                                           packing->size_bytes) == 0;
    }
    return meshopt_decodeVertexBuffer(to, packing->count, packing->stride, packing->bytes,
                                      packing->size_bytes) == 0;
}

static bool filter(const Packing *packing, uint8_t *values) {
    if (strcmp(packing->filter, "OCTAHEDRAL") == 0) {
        meshopt_decodeFilterOct(values, packing->count, packing->stride);
    } else if (strcmp(packing->filter, "QUATERNION") == 0) {
        meshopt_decodeFilterQuat(values, packing->count, packing->stride);
    } else if (strcmp(packing->filter, "EXPONENTIAL") == 0) {
        meshopt_decodeFilterExp(values, packing->count, packing->stride);
    } else {
        return strcmp(packing->filter, "NONE") == 0;
    }
    return true;
}

bool dip_gltf_unpack(DipGltf *gltf, int index, const cJSON *extension, size_t size_bytes,
                     int view_stride, uint8_t *to) {
    Packing packing;
    if (!read_packing(gltf, index, extension, &packing)) {
        return false;
    }
    const bool fits = packing.count * packing.stride == size_bytes && packing.count > 0 &&
                      (view_stride == 0 || (size_t)view_stride == packing.stride);
    return (fits && is_valid(&packing) && decode(&packing, to) && filter(&packing, to)) ||
           dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "EXT_meshopt_compression",
                           "the packed content of view %d is malformed", index);
}

#else

bool dip_gltf_unpack(DipGltf *gltf, int index, const cJSON *extension, size_t size_bytes,
                     int view_stride, uint8_t *to) {
    (void)index;
    (void)extension;
    (void)size_bytes;
    (void)view_stride;
    (void)to;
    return dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "EXT_meshopt_compression",
                           "the model is packed by meshoptimizer, which this build of Diptych "
                           "lacks: install libmeshoptimizer-dev and build again");
}

#endif
