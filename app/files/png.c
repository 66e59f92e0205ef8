// Encoding PNG and compressing with deflate in memory, both by stb_image_write.
#include "app/files/png.h"

#include "app/files/whole_file.h"
#include "app/files/zip.h"

#include <limits.h>
#include <setjmp.h>
#include <stdalign.h>
#include <stddef.h>
#include <stdlib.h>

// --- memory for stb_image_write ------------------------------------------------------------------

// stb_image_write does not check whether an allocation succeeds. If one fails, control jumps out of
// the library, and all blocks that it holds are freed.
typedef struct Block {
    alignas(max_align_t) struct Block *next;
    struct Block *previous;
} Block;

typedef struct Memory {
    jmp_buf ran_out;
    Block first; // Head of the list of blocks.
} Memory;

static _Thread_local Memory *memory; // That of the call in progress.

static void stb_free(void *pointer) {
    if (pointer) {
        Block *block = (Block *)pointer - 1;
        block->previous->next = block->next;
        if (block->next) {
            block->next->previous = block->previous;
        }
        free(block);
    }
}

static void *stb_resize(void *pointer, size_t size_bytes) {
    Block *old = pointer ? (Block *)pointer - 1 : NULL;
    Block *block = realloc(old, sizeof *block + size_bytes);
    if (!block) {
        longjmp(memory->ran_out, 1);
    }
    if (!old) {
        block->previous = &memory->first;
        block->next = memory->first.next;
    }
    block->previous->next = block;
    if (block->next) {
        block->next->previous = block;
    }
    return block + 1;
}

static void free_blocks(void) {
    while (memory->first.next) {
        stb_free(memory->first.next + 1);
    }
}

#define STBIW_MALLOC(size)           stb_resize(NULL, size)
#define STBIW_REALLOC(pointer, size) stb_resize(pointer, size)
#define STBIW_FREE(pointer)          stb_free(pointer)
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

// --- PNG -----------------------------------------------------------------------------------------

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

// Fills the buffer with a PNG of rows without padding, of 1 or 3 channels. Returns false when
// memory runs out.
static bool write_png(Buffer *buffer, const uint8_t *pixels, int width, int height, int channels) {
    Memory own = {.first = {.next = NULL}};
    memory = &own;
    if (setjmp(own.ran_out) != 0) {
        free_blocks();
        return false;
    }
    return stbi_write_png_to_func(append, buffer, width, height, channels, pixels,
                                  width * channels) &&
           !buffer->failed;
}

bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                    unsigned char **bytes, size_t *size_bytes) {
    Buffer buffer = {0};
    uint8_t *rgb = packed_rgb(rgba8, stride_bytes, width, height);
    const bool made = rgb && write_png(&buffer, rgb, width, height, 3);
    free(rgb);
    if (!made) {
        free(buffer.bytes);
        return false;
    }
    *bytes = buffer.bytes;
    *size_bytes = buffer.size;
    return true;
}

// Offsets and sizes in a PNG file: the signature, the chunk IHDR, then the next chunk.
enum {
    PNG_HEADER_TYPE = 12,  // The letters "IHDR".
    PNG_COLOUR_TYPE = 25,  // Byte of IHDR: 0 for grey, 3 for indices into a palette.
    PNG_HEADER_CRC = 29,   // Checksum of the bytes from PNG_HEADER_TYPE on.
    PNG_AFTER_HEADER = 33, // Where the palette, the chunk PLTE, belongs.
    PNG_PALETTE_BYTES = 3 * 256,
    PNG_CHUNK_FRAME = 12 // Length, type and checksum of a chunk, 4 bytes each.
};

static void store_u32(unsigned char *to, unsigned value) {
    for (int i = 0; i < 4; i++) {
        to[i] = (unsigned char)(value >> (24 - 8 * i));
    }
}

bool dip_png_encode_indexed(const uint8_t *indices, const uint8_t *palette, int width, int height,
                            unsigned char **bytes, size_t *size_bytes) {
    Buffer grey = {0};
    const bool written = write_png(&grey, indices, width, height, 1);
    unsigned char *made = written ? malloc(grey.size + PNG_PALETTE_BYTES + PNG_CHUNK_FRAME) : NULL;
    if (made) {
        unsigned char *chunk = made + PNG_AFTER_HEADER;
        memcpy(made, grey.bytes, PNG_AFTER_HEADER);
        made[PNG_COLOUR_TYPE] = 3;
        store_u32(made + PNG_HEADER_CRC,
                  stbiw__crc32(made + PNG_HEADER_TYPE, PNG_HEADER_CRC - PNG_HEADER_TYPE));
        store_u32(chunk, PNG_PALETTE_BYTES);
        memcpy(chunk + 4, "PLTE", 4);
        memcpy(chunk + 8, palette, PNG_PALETTE_BYTES);
        store_u32(chunk + 8 + PNG_PALETTE_BYTES, stbiw__crc32(chunk + 4, 4 + PNG_PALETTE_BYTES));
        memcpy(chunk + PNG_PALETTE_BYTES + PNG_CHUNK_FRAME, grey.bytes + PNG_AFTER_HEADER,
               grey.size - PNG_AFTER_HEADER);
        *bytes = made;
        *size_bytes = grey.size + PNG_PALETTE_BYTES + PNG_CHUNK_FRAME;
    }
    free(grey.bytes);
    return made != NULL;
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

// --- deflate -------------------------------------------------------------------------------------

// Returns the size of the compressed bytes, or 0 when memory runs out. stb_image_write only reads
// the bytes, although its parameter is not const.
static size_t zip(unsigned char *bytes, int size_bytes) {
    Memory own = {.first = {.next = NULL}};
    memory = &own;
    if (setjmp(own.ran_out) != 0) {
        free_blocks();
        return 0;
    }
    int size = 0;
    stb_free(stbi_zlib_compress(bytes, size_bytes, &size, 8));
    return (size_t)size;
}

size_t dip_zip_size(const unsigned char *bytes, size_t size_bytes) {
    unsigned char *copy = size_bytes > 0 && size_bytes < INT_MAX ? malloc(size_bytes) : NULL;
    size_t zipped_size = 0;
    if (copy) {
        memcpy(copy, bytes, size_bytes);
        zipped_size = zip(copy, (int)size_bytes);
    }
    free(copy);
    return zipped_size;
}
