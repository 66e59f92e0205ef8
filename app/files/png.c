// Encoding PNG and compressing with deflate in memory, both by stb_image_write.
#include "app/files/png.h"

#include "app/files/whole_file.h"
#include "app/files/zip.h"

#include <limits.h>
#include <stdlib.h>

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

// The bytes of the file so far. stb_image_write may deliver the file in several pieces.
typedef struct Buffer {
    unsigned char *bytes;
    size_t size;
    bool failed;
} Buffer;

static void append(void *context, void *data, int size) {
    Buffer *buffer = context;
    unsigned char *grown = realloc(buffer->bytes, buffer->size + (size_t)size);
    if (!grown) {
        buffer->failed = true;
        return;
    }
    memcpy(grown + buffer->size, data, (size_t)size);
    buffer->bytes = grown;
    buffer->size += (size_t)size;
}

// Copies the pixels without their alpha, which is 255 everywhere. The copy's rows have no padding.
static uint8_t *packed_rgb(const uint8_t *rgba8, size_t stride_bytes, int width, int height) {
    uint8_t *rgb = malloc((size_t)width * (size_t)height * 3);
    for (int y = 0; rgb && y < height; y++) {
        const uint8_t *row = rgba8 + (size_t)y * stride_bytes;
        for (int x = 0; x < width; x++) {
            memcpy(rgb + 3 * ((size_t)y * (size_t)width + (size_t)x), row + 4 * x, 3);
        }
    }
    return rgb;
}

bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                    unsigned char **bytes, size_t *size_bytes) {
    Buffer buffer = {0};
    uint8_t *rgb = packed_rgb(rgba8, stride_bytes, width, height);
    const bool made = rgb &&
                      stbi_write_png_to_func(append, &buffer, width, height, 3, rgb, width * 3) &&
                      !buffer.failed;
    free(rgb);
    if (!made) {
        free(buffer.bytes);
        return false;
    }
    *bytes = buffer.bytes;
    *size_bytes = buffer.size;
    return true;
}

bool dip_png_write(const char *file, const DipFrame *frame, DipError *err) {
    unsigned char *bytes;
    size_t size_bytes;
    if (!dip_png_encode(frame->rgba8, frame->stride_bytes, frame->width, frame->height, &bytes,
                        &size_bytes)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "png", "out of memory");
    }
    const bool written = dip_whole_file_write(file, bytes, size_bytes, err);
    free(bytes);
    return written;
}

size_t dip_zip_size(const unsigned char *bytes, size_t size_bytes) {
    int size = 0;
    unsigned char *zipped = NULL;
    if (size_bytes > 0 && size_bytes < INT_MAX) {
        // The library's parameter is not const, although it only reads.
        unsigned char *copy = malloc(size_bytes);
        if (copy) {
            memcpy(copy, bytes, size_bytes);
            zipped = stbi_zlib_compress(copy, (int)size_bytes, &size, 8);
        }
        free(copy);
    }
    const size_t zipped_size = zipped ? (size_t)size : 0;
    free(zipped);
    return zipped_size;
}
