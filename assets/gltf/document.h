// A glTF file as JSON with its buffers, for the readers of scenes, animated models and cameras.
// Private to assets/.
//
// Functions that return bool fill the document's err on failure.
#ifndef DIP_ASSETS_GLTF_DOCUMENT_H
#define DIP_ASSETS_GLTF_DOCUMENT_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct DipModel;
struct cJSON;

// The arrays at the top of a glTF file, whose items refer to one another by index.
#define DIP_GLTF_TABLES(X)                                                                         \
    X(accessors)                                                                                   \
    X(animations)                                                                                  \
    X(bufferViews)                                                                                 \
    X(buffers)                                                                                     \
    X(cameras)                                                                                     \
    X(images)                                                                                      \
    X(materials)                                                                                   \
    X(meshes)                                                                                      \
    X(nodes)                                                                                       \
    X(samplers)                                                                                    \
    X(scenes)                                                                                      \
    X(skins)                                                                                       \
    X(textures)

typedef enum DipGltfTable {
#define DIP_GLTF_ENUM(name) DIP_GLTF_##name,
    DIP_GLTF_TABLES(DIP_GLTF_ENUM)
#undef DIP_GLTF_ENUM
        DIP_GLTF_TABLE_COUNT
} DipGltfTable;

// An array of JSON as pointers, because cJSON's arrays are linked lists.
typedef struct DipGltfItems {
    const struct cJSON **items;
    int count;
} DipGltfItems;

typedef struct DipGltfBuffer {
    uint8_t *bytes; // NULL until the buffer is used for the first time.
    size_t size_bytes;
    bool owned; // False for the part of a .glb file.
} DipGltfBuffer;

typedef struct DipGltf {
    const char *path;
    DipError *err;
    uint8_t *file;
    size_t file_bytes;
    const uint8_t *binary; // The binary part of a .glb file, or NULL.
    size_t binary_bytes;
    struct cJSON *json;
    DipGltfItems tables[DIP_GLTF_TABLE_COUNT];
    DipGltfBuffer *buffers;
    uint8_t **unpacked;  // For each buffer view the content of a packed one (unpack.c), or NULL.
    uint8_t **dense;     // For each accessor the values of a sparse one, or NULL.
    size_t made_bytes;   // Size of all unpacked views and sparse accessors.
    DipGltfBuffer *data; // The content of each image that is a "data:" address.
} DipGltf;

// Reads the file and its JSON. Call dip_gltf_close even after a failure.
bool dip_gltf_open(DipGltf *gltf, const char *path, DipError *err);
void dip_gltf_close(DipGltf *gltf);

// True if the file was read, but is glTF of version 1, which has another structure.
bool dip_gltf_is_version_1(const DipGltf *gltf);

// Allocates zeroed memory for content that the file describes but does not hold. Returns NULL and
// fills *err if memory runs out or the file describes more than is accepted. The caller frees it.
void *dip_gltf_make(DipGltf *gltf, size_t size_bytes);

// Fills *err with a code and a message. key: the part of the file at fault, or NULL.
bool dip_gltf_refuse(const DipGltf *gltf, DipErrorCode code, const char *key, const char *format,
                     ...) __attribute__((format(printf, 4, 5)));

// Returns an item of a table, which must be an object. After a bad index, fills *err and returns
// NULL.
const struct cJSON *dip_gltf_item(const DipGltf *gltf, DipGltfTable table, int index);

// Makes a list of an object's array; it is empty if the object lacks the array. The caller frees
// the list with dip_gltf_free_list, even after a failure.
bool dip_gltf_list(const DipGltf *gltf, const struct cJSON *object, const char *name,
                   DipGltfItems *list);
void dip_gltf_free_list(DipGltfItems *list);

// The same as dip_gltf_item for such a list, which messages call `name`.
const struct cJSON *dip_gltf_list_item(const DipGltf *gltf, const DipGltfItems *list, int index,
                                       const char *name);

// Reads an integer of an object, 0..2^30, or `otherwise` if the object lacks it.
bool dip_gltf_integer(const DipGltf *gltf, const struct cJSON *object, const char *name,
                      int otherwise, int *value);

// Returns the number of an object with this name, or `otherwise` if there is no finite number.
double dip_gltf_number_of(const struct cJSON *object, const char *name, double otherwise);

// True if the file lists the extension as one that it requires.
bool dip_gltf_requires(const DipGltf *gltf, const char *extension);

// Returns an extension of an object, or NULL.
const struct cJSON *dip_gltf_extension(const struct cJSON *object, const char *name);

// Reads `count` finite numbers of an object's array. Leaves *values as they are if the object lacks
// the array.
bool dip_gltf_numbers(const DipGltf *gltf, const struct cJSON *object, const char *name, int count,
                      double *values);

// The values of an accessor, whose bytes have been checked.
typedef struct DipGltfAccessor {
    const uint8_t *bytes; // The first value; NULL if all values are 0.
    size_t stride_bytes;
    uint32_t count;
    int component; // FLOAT and so on, as in the file.
    int width;     // Components of a value: 1..4 or 16.
    bool normalized;
} DipGltfAccessor;

enum {
    DIP_GLTF_BYTE = 5120,
    DIP_GLTF_UNSIGNED_BYTE = 5121,
    DIP_GLTF_SHORT = 5122,
    DIP_GLTF_UNSIGNED_SHORT = 5123,
    DIP_GLTF_UNSIGNED_INT = 5125,
    DIP_GLTF_FLOAT = 5126
};

// accessors.c: finds an accessor. width: the components that its values must have, or 0 for any
// number. what: for messages.
bool dip_gltf_accessor(DipGltf *gltf, int index, int width, const char *what,
                       DipGltfAccessor *accessor);

// Returns a component of value i. Integers of a normalised accessor become -1..1 or 0..1.
double dip_gltf_number(const DipGltfAccessor *accessor, uint32_t i, int component);
uint32_t dip_gltf_unsigned(const DipGltfAccessor *accessor, uint32_t i, int component);

// Writes count * width floats. Fails with RANGE if one is not finite.
bool dip_gltf_floats(const DipGltf *gltf, const DipGltfAccessor *accessor, const char *what,
                     float *to);

// Finds the bytes of a buffer view, and the distance between its values: 0 if the file gives none.
bool dip_gltf_view(DipGltf *gltf, int index, const uint8_t **bytes, size_t *size_bytes,
                   int *stride_bytes);

// unpack.c: unpacks a buffer view with the extension EXT_meshopt_compression to size_bytes bytes.
// view_stride: the distance between its values as the view itself says, or 0.
bool dip_gltf_unpack(DipGltf *gltf, int index, const struct cJSON *extension, size_t size_bytes,
                     int view_stride, uint8_t *to);

// document.c: finds the bytes of a part of a buffer. what: for messages.
bool dip_gltf_buffer_part(DipGltf *gltf, const struct cJSON *json, int index, const uint8_t **bytes,
                          size_t *size_bytes);

// Finds an image. *uri becomes the address of a picture file, or NULL if the image lies in the
// model; then *bytes becomes its content.
bool dip_gltf_image(DipGltf *gltf, int index, const char **uri, const uint8_t **bytes,
                    size_t *size_bytes);

// features.c: refuses a file that requires an extension without which it cannot be read. Warns once
// of each feature that the file uses and that Diptych does not draw. model: takes the warnings, or
// NULL.
bool dip_gltf_check_extensions(const DipGltf *gltf, struct DipModel *model);

// Reads a number of 32 bits, low byte first.
static inline uint32_t dip_gltf_u32(const uint8_t *at) {
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

#endif
