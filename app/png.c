// PNG through stb_image_write, into a buffer, then to a file at once.
#include "app/png.h"

#include "app/whole_file.h"

#include <stdlib.h>

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

// stb may hand over the picture in pieces; they are gathered here.
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

// The frame's pixels without alpha, rows packed: a third of the file would say 255.
static uint8_t *packed_rgb(const DipFrame *frame) {
    const size_t width = (size_t)frame->width;
    uint8_t *rgb = malloc(width * (size_t)frame->height * 3);
    for (int y = 0; rgb && y < frame->height; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        for (size_t x = 0; x < width; x++) {
            memcpy(rgb + 3 * ((size_t)y * width + x), row + 4 * x, 3);
        }
    }
    return rgb;
}

bool dip_png_write(const char *file, const DipFrame *frame, DipError *err) {
    Buffer buffer = {0};
    uint8_t *rgb = packed_rgb(frame);
    const bool made = rgb && stbi_write_png_to_func(append, &buffer, frame->width, frame->height, 3,
                                                    rgb, frame->width * 3);
    free(rgb);
    const bool written =
        made && !buffer.failed
            ? dip_whole_file_write(file, buffer.bytes, buffer.size, err)
            : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "png", "out of memory");
    free(buffer.bytes);
    return written;
}
