// Reads the JSON and the buffers of glTF files, and checks every index and offset in them.
#include "assets/animation/gltf_document.h"

#include "assets/model_parts.h"
#include "renderer/base/file.h"

#include <cjson/cJSON.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const size_t max_file_bytes = (size_t)512 << 20;
static const char base64_mark[] = ";base64,";

enum {
    GLB_MAGIC = 0x46546c67, // "glTF"
    GLB_CHUNK_JSON = 0x4e4f534a,
    GLB_CHUNK_BINARY = 0x004e4942,
    GLB_HEADER_BYTES = 12,
    CHUNK_HEADER_BYTES = 8,
    MAX_INTEGER = 1 << 30
};

static const char *const table_names[DIP_GLTF_TABLE_COUNT] = {
#define TABLE_NAME(name) #name,
    DIP_GLTF_TABLES(TABLE_NAME)
#undef TABLE_NAME
};

bool dip_gltf_refuse(const DipGltf *gltf, DipErrorCode code, const char *key, const char *format,
                     ...) {
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return dip_error_set(gltf->err, code, gltf->path, 0, key, "%s", text);
}

static bool out_of_memory(const DipGltf *gltf) {
    return dip_model_out_of_memory(gltf->err, gltf->path);
}

// --- the file ------------------------------------------------------------------------------------

// Finds the JSON of a .glb file, and its binary part if it has one.
static bool split_glb(DipGltf *gltf, const char **text, size_t *length) {
    size_t at = GLB_HEADER_BYTES;
    for (int chunk = 0; chunk < 2 && (chunk == 0 || at < gltf->file_bytes); ++chunk) {
        if (gltf->file_bytes < at + CHUNK_HEADER_BYTES ||
            gltf->file_bytes - at - CHUNK_HEADER_BYTES < dip_gltf_u32(gltf->file + at)) {
            return dip_gltf_refuse(gltf, DIP_ERROR_TRUNCATED, NULL,
                                   "the model file ends too early");
        }
        const uint32_t size = dip_gltf_u32(gltf->file + at);
        const uint32_t kind = dip_gltf_u32(gltf->file + at + 4);
        const uint8_t *content = gltf->file + at + CHUNK_HEADER_BYTES;
        const uint32_t expected =
            chunk == 0 ? (uint32_t)GLB_CHUNK_JSON : (uint32_t)GLB_CHUNK_BINARY;
        if (kind != expected) {
            return chunk == 1 || dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, NULL,
                                                 "the first part of the file is not JSON");
        }
        if (chunk == 0) {
            *text = (const char *)content;
            *length = size;
        } else {
            gltf->binary = content;
            gltf->binary_bytes = size;
        }
        at += CHUNK_HEADER_BYTES + (size_t)size;
    }
    return true;
}

static bool parse_json(DipGltf *gltf) {
    const char *text = (const char *)gltf->file;
    const char *end = NULL;
    size_t length = gltf->file_bytes;
    if (length >= GLB_HEADER_BYTES && dip_gltf_u32(gltf->file) == GLB_MAGIC &&
        !split_glb(gltf, &text, &length)) {
        return false;
    }
    errno = 0; // cJSON does not say when memory runs out, but malloc does.
    gltf->json = cJSON_ParseWithLengthOpts(text, length, &end, false);
    if (!gltf->json && errno == ENOMEM) {
        return out_of_memory(gltf);
    }
    if (!cJSON_IsObject(gltf->json)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, NULL,
                               "the model cannot be read: the JSON is malformed at byte %zu",
                               end ? (size_t)(end - text) : 0);
    }
    return true;
}

bool dip_gltf_list(const DipGltf *gltf, const cJSON *object, const char *name, DipGltfItems *list) {
    const cJSON *array = cJSON_GetObjectItemCaseSensitive(object, name);
    *list = (DipGltfItems){0};
    if (array && !cJSON_IsArray(array)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, name, "this is not an array");
    }
    const int count = array ? cJSON_GetArraySize(array) : 0;
    list->items = calloc((size_t)count + 1, sizeof *list->items);
    if (!list->items) {
        return out_of_memory(gltf);
    }
    for (const cJSON *item = array ? array->child : NULL; item; item = item->next) {
        list->items[list->count++] = item;
    }
    return true;
}

void dip_gltf_free_list(DipGltfItems *list) {
    free((void *)list->items);
    *list = (DipGltfItems){0};
}

static bool fill_tables(DipGltf *gltf) {
    for (int t = 0; t < DIP_GLTF_TABLE_COUNT; ++t) {
        if (!dip_gltf_list(gltf, gltf->json, table_names[t], &gltf->tables[t])) {
            return false;
        }
    }
    gltf->buffers = calloc((size_t)gltf->tables[DIP_GLTF_buffers].count + 1, sizeof *gltf->buffers);
    return gltf->buffers || out_of_memory(gltf);
}

static bool check_version(const DipGltf *gltf) {
    const cJSON *asset = cJSON_GetObjectItemCaseSensitive(gltf->json, "asset");
    const cJSON *version = cJSON_GetObjectItemCaseSensitive(asset, "version");
    const bool ok = cJSON_IsString(version) && strncmp(version->valuestring, "2.", 2) == 0;
    return ok || dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "asset",
                                 "the file is not glTF of version 2, accepted 2.0");
}

bool dip_gltf_open(DipGltf *gltf, const char *path, DipError *err) {
    *gltf = (DipGltf){.path = path, .err = err};
    return dip_file_read(path, "model", max_file_bytes, &gltf->file, &gltf->file_bytes, err) &&
           parse_json(gltf) && check_version(gltf) && fill_tables(gltf);
}

void dip_gltf_close(DipGltf *gltf) {
    for (int i = 0; gltf->buffers && i < gltf->tables[DIP_GLTF_buffers].count; ++i) {
        if (gltf->buffers[i].owned) {
            free(gltf->buffers[i].bytes);
        }
    }
    for (int t = 0; t < DIP_GLTF_TABLE_COUNT; ++t) {
        dip_gltf_free_list(&gltf->tables[t]);
    }
    free(gltf->buffers);
    cJSON_Delete(gltf->json);
    free(gltf->file);
    *gltf = (DipGltf){0};
}

// --- values --------------------------------------------------------------------------------------

const cJSON *dip_gltf_list_item(const DipGltf *gltf, const DipGltfItems *list, int index,
                                const char *name) {
    if (index < 0 || index >= list->count) {
        dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name, "the file uses item %d of %d", index,
                        list->count);
        return NULL;
    }
    if (!cJSON_IsObject(list->items[index])) {
        dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, name, "item %d is not an object", index);
        return NULL;
    }
    return list->items[index];
}

const cJSON *dip_gltf_item(const DipGltf *gltf, DipGltfTable table, int index) {
    return dip_gltf_list_item(gltf, &gltf->tables[table], index, table_names[table]);
}

bool dip_gltf_integer(const DipGltf *gltf, const cJSON *object, const char *name, int otherwise,
                      int *value) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    *value = otherwise;
    if (!item) {
        return true;
    }
    const double number = cJSON_IsNumber(item) ? item->valuedouble : -1.0;
    if (!(number >= 0.0 && number <= MAX_INTEGER) || number != floor(number)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name, "this is not an integer 0..%d",
                               MAX_INTEGER);
    }
    *value = (int)number;
    return true;
}

bool dip_gltf_numbers(const DipGltf *gltf, const cJSON *object, const char *name, int count,
                      double *values) {
    const cJSON *array = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!array) {
        return true;
    }
    const cJSON *item = cJSON_IsArray(array) ? array->child : NULL;
    for (int i = 0; i < count; ++i) {
        if (!cJSON_IsNumber(item) || !isfinite((float)item->valuedouble)) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name,
                                   "this is not an array of %d finite numbers", count);
        }
        values[i] = item->valuedouble;
        item = item->next;
    }
    return !item || dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name,
                                    "this is not an array of %d finite numbers", count);
}

// --- buffers -------------------------------------------------------------------------------------

static int base64_digit(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

uint8_t *dip_gltf_decode_data(const DipGltf *gltf, const char *uri, size_t *size_bytes) {
    const char *mark = strstr(uri, base64_mark);
    const char *text = mark ? mark + strlen(base64_mark) : "";
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '=') {
        --length;
    }
    *size_bytes = length / 4 * 3 + (length % 4 > 0 ? length % 4 - 1 : 0);
    uint8_t *bytes = malloc(*size_bytes + 1);
    if (!bytes) {
        out_of_memory(gltf);
        return NULL;
    }
    uint32_t bits = 0;
    bool ok = mark && length % 4 != 1;
    for (size_t i = 0, to = 0; ok && i < length; ++i) {
        const int digit = base64_digit(text[i]);
        ok = digit >= 0;
        bits = bits << 6 | (uint32_t)(digit & 63);
        if (i % 4 > 0) {
            bytes[to++] = (uint8_t)(bits >> (6 - 2 * (i % 4)));
        }
    }
    if (!ok) {
        free(bytes);
        dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "uri", "the data is not base64");
        return NULL;
    }
    return bytes;
}

static bool read_buffer_file(const DipGltf *gltf, const char *uri, DipGltfBuffer *buffer) {
    char *found = dip_model_find_file(gltf->path, uri);
    if (!found) {
        return out_of_memory(gltf);
    }
    const bool ok = dip_file_read(found, "buffer", max_file_bytes, &buffer->bytes,
                                  &buffer->size_bytes, gltf->err);
    free(found);
    buffer->owned = ok;
    return ok;
}

// Loads the content of a buffer that is used for the first time.
static bool load_buffer(DipGltf *gltf, const cJSON *json, int index, DipGltfBuffer *buffer) {
    const cJSON *uri = cJSON_GetObjectItemCaseSensitive(json, "uri");
    if (!uri && index == 0 && gltf->binary) {
        *buffer = (DipGltfBuffer){(uint8_t *)gltf->binary, gltf->binary_bytes, false};
        return true;
    }
    if (!cJSON_IsString(uri)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "buffers", "buffer %d has no content",
                               index);
    }
    if (strncmp(uri->valuestring, "data:", 5) != 0) {
        return read_buffer_file(gltf, uri->valuestring, buffer);
    }
    buffer->bytes = dip_gltf_decode_data(gltf, uri->valuestring, &buffer->size_bytes);
    buffer->owned = buffer->bytes != NULL;
    return buffer->owned;
}

static bool use_buffer(DipGltf *gltf, int index, const DipGltfBuffer **found) {
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_buffers, index);
    DipGltfBuffer *buffer = json ? &gltf->buffers[index] : NULL;
    if (!json || (!buffer->bytes && !load_buffer(gltf, json, index, buffer))) {
        return false;
    }
    int length;
    if (!dip_gltf_integer(gltf, json, "byteLength", 0, &length)) {
        return false;
    }
    *found = buffer;
    return (size_t)length <= buffer->size_bytes ||
           dip_gltf_refuse(gltf, DIP_ERROR_TRUNCATED, "buffers",
                           "buffer %d has %zu bytes, expected %d", index, buffer->size_bytes,
                           length);
}

bool dip_gltf_view(DipGltf *gltf, int index, const uint8_t **bytes, size_t *size_bytes,
                   int *stride) {
    const DipGltfBuffer *buffer;
    const cJSON *view = dip_gltf_item(gltf, DIP_GLTF_bufferViews, index);
    int in_buffer;
    int offset;
    int length;
    if (!view || !dip_gltf_integer(gltf, view, "buffer", 0, &in_buffer) ||
        !dip_gltf_integer(gltf, view, "byteOffset", 0, &offset) ||
        !dip_gltf_integer(gltf, view, "byteLength", 0, &length) ||
        !dip_gltf_integer(gltf, view, "byteStride", 0, stride) ||
        !use_buffer(gltf, in_buffer, &buffer)) {
        return false;
    }
    if ((size_t)offset > buffer->size_bytes ||
        (size_t)length > buffer->size_bytes - (size_t)offset) {
        return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "bufferViews",
                               "view %d ends beyond its buffer of %zu bytes", index,
                               buffer->size_bytes);
    }
    *bytes = buffer->bytes + offset;
    *size_bytes = (size_t)length;
    return true;
}
