// Reads the JSON and the buffers of glTF files, and checks every index and offset in them.
#include "assets/gltf/document.h"

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

static const size_t max_file_bytes = (size_t)1 << 30;
static const size_t max_made_bytes = (size_t)1 << 30;
static const char base64_mark[] = ";base64,";

enum {
    GLB_MAGIC = 0x46546c67, // "glTF"
    GLB_CHUNK_JSON = 0x4e4f534a,
    GLB_CHUNK_BINARY = 0x004e4942,
    GLB_HEADER_BYTES = 12,
    CHUNK_HEADER_BYTES = 8,
    MAX_INTEGER = 1 << 30,
    MAX_JSON_DEPTH = 512
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
    dip_make_one_line(text);
    dip_error_set(gltf->err, code, gltf->path, 0, key, "%s", text);
    if (gltf->err) {
        dip_make_one_line(gltf->err->key);
    }
    return false;
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

// Refuses JSON that nests so deep that the parser, which calls itself, would need much stack.
// *is_open becomes true if the text ends within an object, an array or a string.
static bool check_depth(const DipGltf *gltf, const char *text, size_t length, bool *is_open) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (size_t i = 0; i < length; ++i) {
        const char c = text[i];
        if (in_string) {
            i += c == '\\';
            in_string = c != '"';
            continue;
        }
        in_string = c == '"';
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        deepest = depth > deepest ? depth : deepest;
    }
    *is_open = depth > 0 || in_string;
    return deepest <= MAX_JSON_DEPTH ||
           dip_gltf_refuse(gltf, DIP_ERROR_RANGE, NULL, "JSON is nested %d deep, accepted %d",
                           deepest, MAX_JSON_DEPTH);
}

static bool parse_json(DipGltf *gltf) {
    const char *text = (const char *)gltf->file;
    const char *end = NULL;
    size_t length = gltf->file_bytes;
    if (length >= GLB_HEADER_BYTES && dip_gltf_u32(gltf->file) == GLB_MAGIC &&
        !split_glb(gltf, &text, &length)) {
        return false;
    }
    bool is_open;
    if (!check_depth(gltf, text, length, &is_open)) {
        return false;
    }
    errno = 0; // cJSON does not say when memory runs out, but malloc does.
    gltf->json = cJSON_ParseWithLengthOpts(text, length, &end, false);
    if (!gltf->json && errno == ENOMEM) {
        return out_of_memory(gltf);
    }
    if (!gltf->json && is_open) {
        return dip_gltf_refuse(gltf, DIP_ERROR_TRUNCATED, NULL,
                               "the model file ends too early: its JSON has no end");
    }
    if (!gltf->json) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, NULL,
                               "the model cannot be read: the JSON is malformed at byte %zu",
                               end ? (size_t)(end - text) : 0);
    }
    return cJSON_IsObject(gltf->json) ||
           dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, NULL,
                           "the model cannot be read: its JSON is not an object");
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
    const size_t views = (size_t)gltf->tables[DIP_GLTF_bufferViews].count;
    const size_t accessors = (size_t)gltf->tables[DIP_GLTF_accessors].count;
    const size_t images = (size_t)gltf->tables[DIP_GLTF_images].count;
    gltf->buffers = calloc((size_t)gltf->tables[DIP_GLTF_buffers].count + 1, sizeof *gltf->buffers);
    gltf->unpacked = calloc(views + 1, sizeof *gltf->unpacked);
    gltf->dense = calloc(accessors + 1, sizeof *gltf->dense);
    gltf->data = calloc(images + 1, sizeof *gltf->data);
    return (gltf->buffers && gltf->unpacked && gltf->dense && gltf->data) || out_of_memory(gltf);
}

static bool has_version(const DipGltf *gltf, const char *begin) {
    const cJSON *asset = cJSON_GetObjectItemCaseSensitive(gltf->json, "asset");
    const cJSON *version = cJSON_GetObjectItemCaseSensitive(asset, "version");
    return cJSON_IsString(version) && strncmp(version->valuestring, begin, strlen(begin)) == 0;
}

bool dip_gltf_is_version_1(const DipGltf *gltf) {
    return has_version(gltf, "1.") ||
           (gltf->file && gltf->file_bytes >= GLB_HEADER_BYTES &&
            dip_gltf_u32(gltf->file) == GLB_MAGIC && dip_gltf_u32(gltf->file + 4) == 1);
}

static bool check_version(const DipGltf *gltf) {
    const cJSON *asset = cJSON_GetObjectItemCaseSensitive(gltf->json, "asset");
    const cJSON *least = cJSON_GetObjectItemCaseSensitive(asset, "minVersion");
    if (!has_version(gltf, "2.")) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "asset",
                               "the file is not glTF of version 2, accepted 2.0");
    }
    return !cJSON_IsString(least) || strcmp(least->valuestring, "2.0") <= 0 ||
           dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "minVersion",
                           "the file needs a newer version of glTF than 2.0, accepted 2.0");
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
    for (int i = 0; gltf->unpacked && i < gltf->tables[DIP_GLTF_bufferViews].count; ++i) {
        free(gltf->unpacked[i]);
    }
    for (int i = 0; gltf->dense && i < gltf->tables[DIP_GLTF_accessors].count; ++i) {
        free(gltf->dense[i]);
    }
    for (int i = 0; gltf->data && i < gltf->tables[DIP_GLTF_images].count; ++i) {
        free(gltf->data[i].bytes);
    }
    for (int t = 0; t < DIP_GLTF_TABLE_COUNT; ++t) {
        dip_gltf_free_list(&gltf->tables[t]);
    }
    free(gltf->buffers);
    free(gltf->unpacked);
    free(gltf->dense);
    free(gltf->data);
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

double dip_gltf_number_of(const cJSON *object, const char *name, double otherwise) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    return cJSON_IsNumber(item) && isfinite(item->valuedouble) ? item->valuedouble : otherwise;
}

const cJSON *dip_gltf_extension(const cJSON *object, const char *name) {
    const cJSON *extensions = cJSON_GetObjectItemCaseSensitive(object, "extensions");
    const cJSON *extension = cJSON_GetObjectItemCaseSensitive(extensions, name);
    return cJSON_IsObject(extension) ? extension : NULL;
}

bool dip_gltf_requires(const DipGltf *gltf, const char *extension) {
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(gltf->json, "extensionsRequired");
    for (const cJSON *item = list ? list->child : NULL; item; item = item->next) {
        if (cJSON_IsString(item) && strcmp(item->valuestring, extension) == 0) {
            return true;
        }
    }
    return false;
}

void *dip_gltf_make(DipGltf *gltf, size_t size_bytes) {
    if (size_bytes > max_made_bytes - gltf->made_bytes) {
        dip_gltf_refuse(gltf, DIP_ERROR_OVERSIZED, NULL,
                        "the content of the model is larger than is accepted: %zu MiB unpacked",
                        max_made_bytes >> 20);
        return NULL;
    }
    void *block = calloc(1, size_bytes + 1);
    if (!block) {
        out_of_memory(gltf);
        return NULL;
    }
    gltf->made_bytes += size_bytes;
    return block;
}

// --- buffers -------------------------------------------------------------------------------------

static int base64_digit(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

// Decodes a "data:" address. Returns NULL and fills *err if it is malformed or memory runs out. The
// caller frees the bytes.
static uint8_t *decode_data(const DipGltf *gltf, const char *uri, size_t *size_bytes) {
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
    DipError why = {0};
    const bool ok =
        dip_file_read(found, "buffer", max_file_bytes, &buffer->bytes, &buffer->size_bytes, &why);
    free(found);
    buffer->owned = ok;
    if (!ok && why.origin == DIP_ORIGIN_RUNTIME) {
        if (gltf->err) {
            *gltf->err = why;
        }
        return false;
    }
    return ok || dip_gltf_refuse(gltf, why.code, "buffers", "the buffer %.100s: %.100s", uri,
                                 why.message);
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
    buffer->bytes = decode_data(gltf, uri->valuestring, &buffer->size_bytes);
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
                           "the buffer ends too early: buffer %d has %zu bytes, expected %d", index,
                           buffer->size_bytes, length);
}

bool dip_gltf_buffer_part(DipGltf *gltf, const cJSON *json, int index, const uint8_t **bytes,
                          size_t *size_bytes) {
    const DipGltfBuffer *buffer;
    int in_buffer;
    int offset;
    int length;
    if (!dip_gltf_integer(gltf, json, "buffer", 0, &in_buffer) ||
        !dip_gltf_integer(gltf, json, "byteOffset", 0, &offset) ||
        !dip_gltf_integer(gltf, json, "byteLength", 0, &length) ||
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

// Unpacks a view that is used for the first time.
static bool use_packed_view(DipGltf *gltf, const cJSON *view, const cJSON *packed, int index,
                            int stride) {
    int length;
    if (gltf->unpacked[index]) {
        return true;
    }
    if (!dip_gltf_integer(gltf, view, "byteLength", 0, &length)) {
        return false;
    }
    uint8_t *made = dip_gltf_make(gltf, (size_t)length);
    if (!made || !dip_gltf_unpack(gltf, index, packed, (size_t)length, stride, made)) {
        free(made);
        return false;
    }
    gltf->unpacked[index] = made;
    return true;
}

bool dip_gltf_view(DipGltf *gltf, int index, const uint8_t **bytes, size_t *size_bytes,
                   int *stride) {
    const cJSON *view = dip_gltf_item(gltf, DIP_GLTF_bufferViews, index);
    if (!view || !dip_gltf_integer(gltf, view, "byteStride", 0, stride)) {
        return false;
    }
    const cJSON *packed = dip_gltf_extension(view, "EXT_meshopt_compression");
    if (!packed) {
        return dip_gltf_buffer_part(gltf, view, index, bytes, size_bytes);
    }
    if (!use_packed_view(gltf, view, packed, index, *stride)) {
        return false;
    }
    const cJSON *length = cJSON_GetObjectItemCaseSensitive(view, "byteLength");
    *bytes = gltf->unpacked[index];
    *size_bytes = length ? (size_t)length->valuedouble : 0;
    return true;
}

bool dip_gltf_image(DipGltf *gltf, int index, const char **uri, const uint8_t **bytes,
                    size_t *size_bytes) {
    const cJSON *image = dip_gltf_item(gltf, DIP_GLTF_images, index);
    const cJSON *address = cJSON_GetObjectItemCaseSensitive(image, "uri");
    *uri = NULL;
    if (!image) {
        return false;
    }
    if (!cJSON_IsString(address)) {
        int view;
        int stride;
        return dip_gltf_integer(gltf, image, "bufferView", -1, &view) &&
               dip_gltf_view(gltf, view, bytes, size_bytes, &stride);
    }
    if (strncmp(address->valuestring, "data:", 5) != 0) {
        *uri = address->valuestring;
        return true;
    }
    DipGltfBuffer *data = &gltf->data[index];
    if (!data->bytes) {
        data->bytes = decode_data(gltf, address->valuestring, &data->size_bytes);
    }
    *bytes = data->bytes;
    *size_bytes = data->size_bytes;
    return data->bytes != NULL;
}
