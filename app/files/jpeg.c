// Encodes JPEG in memory by stb_image_write. Unlike its encoder of PNG, the encoder of JPEG
// allocates nothing (so png.c's memory is not needed) and shifts bits out of a signed int, which
// the sanitizer must overlook in this file.
#include "app/files/jpeg.h"

#include <stdlib.h>
#include <string.h>

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

// The bytes of the file so far. stb_image_write delivers the file in many small pieces.
typedef struct Buffer {
    unsigned char *bytes;
    size_t size;
    size_t room;
    bool failed;
} Buffer;

static void append(void *context, void *data, int size) {
    Buffer *buffer = context;
    if (buffer->failed) {
        return;
    }
    if (buffer->size + (size_t)size > buffer->room) {
        const size_t room = 2 * (buffer->room + (size_t)size);
        unsigned char *grown = realloc(buffer->bytes, room);
        if (!grown) {
            buffer->failed = true;
            return;
        }
        buffer->bytes = grown;
        buffer->room = room;
    }
    memcpy(buffer->bytes + buffer->size, data, (size_t)size);
    buffer->size += (size_t)size;
}

bool dip_jpeg_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height, int quality,
                     unsigned char **bytes, size_t *size_bytes) {
    const size_t row_bytes = (size_t)width * 4;
    Buffer buffer = {0};
    uint8_t *packed = malloc(row_bytes * (size_t)height);
    for (int y = 0; packed && y < height; y++) {
        memcpy(packed + (size_t)y * row_bytes, rgba8 + (size_t)y * stride_bytes, row_bytes);
    }
    const bool made = packed &&
                      stbi_write_jpg_to_func(append, &buffer, width, height, 4, packed, quality) &&
                      !buffer.failed;
    free(packed);
    if (!made) {
        free(buffer.bytes);
        return false;
    }
    *bytes = buffer.bytes;
    *size_bytes = buffer.size;
    return true;
}
