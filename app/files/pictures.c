// Encodes pictures as PNG and JPEG with the library stb_image_write, and as PFM without it. The
// library's JPEG encoder shifts bits out of a signed int, so the build turns off UBSan's check of
// shifts in this file.
#include "app/files/pictures.h"

#include "app/files/whole_file.h"
#include "renderer/base/utf8.h"

#include <limits.h>
#include <setjmp.h>
#include <stdalign.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- memory for stb_image_write ------------------------------------------------------------------

// stb_image_write does not check whether an allocation succeeds. If an allocation fails, a longjmp
// leaves the library, and all blocks that the library has allocated are freed. A Block is the
// header of such a block.
typedef struct Block {
    alignas(max_align_t) struct Block *next;
    struct Block *previous;
} Block;

typedef struct Memory {
    jmp_buf ran_out;
    Block first; // Head of the list of blocks.
} Memory;

static _Thread_local Memory *memory; // The memory of the current call of the library.

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

// --- encoding ------------------------------------------------------------------------------------

// The bytes of the file so far. stb_image_write may deliver the file in many small pieces.
typedef struct Buffer {
    unsigned char *bytes;
    size_t size;
    size_t room;
    bool failed;
} Buffer;

static void append(void *context, void *data, int size) {
    Buffer *buffer = context;
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

// Returns a copy of the pixels without alpha and with packed rows, which the caller frees, or NULL
// when memory runs out.
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

// Returns whether a picture has pixels, and few enough: stb_image_write counts bytes with ints.
static bool has_good_size(int width, int height) {
    return width >= 1 && height >= 1 && width <= DIP_MAX_WRITTEN_PIXELS / height;
}

// Fills the buffer with a PNG. `pixels` has packed rows with 1 or 3 channels. Returns false when
// memory runs out.
static bool write_png(Buffer *buffer, const uint8_t *pixels, int width, int height, int channels) {
    Memory own = {.first = {.next = NULL}};
    memory = &own;
    if (setjmp(own.ran_out) != 0) {
        free_blocks();
        memory = NULL;
        return false;
    }
    const int written =
        stbi_write_png_to_func(append, buffer, width, height, channels, pixels, width * channels);
    memory = NULL;
    return written && !buffer->failed;
}

// Encodes a PNG if `quality` is 0, and otherwise a JPEG of this quality.
static bool encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height, int quality,
                   unsigned char **bytes, size_t *size_bytes) {
    if (!has_good_size(width, height)) {
        return false;
    }
    Buffer buffer = {0};
    uint8_t *rgb = packed_rgb(rgba8, stride_bytes, width, height);
    const bool made = rgb && (quality == 0 ? write_png(&buffer, rgb, width, height, 3)
                                           : stbi_write_jpg_to_func(append, &buffer, width, height,
                                                                    3, rgb, quality) &&
                                                 !buffer.failed);
    free(rgb);
    if (!made) {
        free(buffer.bytes);
        return false;
    }
    *bytes = buffer.bytes;
    *size_bytes = buffer.size;
    return true;
}

bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                    unsigned char **bytes, size_t *size_bytes) {
    return encode(rgba8, stride_bytes, width, height, 0, bytes, size_bytes);
}

bool dip_jpeg_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height, int quality,
                     unsigned char **bytes, size_t *size_bytes) {
    return quality >= 1 && quality <= 100 && width <= DIP_MAX_JPEG_SIZE &&
           height <= DIP_MAX_JPEG_SIZE &&
           encode(rgba8, stride_bytes, width, height, quality, bytes, size_bytes);
}

// --- chunks of PNG -------------------------------------------------------------------------------

// Offsets and sizes in a PNG file, which begins with the signature and the chunk IHDR.
enum {
    PNG_HEADER_TYPE = 12,  // Offset of the letters "IHDR".
    PNG_COLOUR_TYPE = 25,  // A byte of IHDR: 0 for grey, 3 for indices into a palette.
    PNG_HEADER_CRC = 29,   // Checksum of the bytes from PNG_HEADER_TYPE on.
    PNG_AFTER_HEADER = 33, // End of IHDR, where the palette (the chunk PLTE) belongs.
    PNG_PALETTE_BYTES = 3 * 256,
    PNG_CHUNK_FRAME = 12,  // Bytes of a chunk's length, type and checksum, 4 each.
    PNG_CHUNK_CONTENT = 8, // Offset of the content within a chunk.
    PNG_TEXT_FIELDS = 5    // Bytes between keyword and text in the chunk iTXt.
};

static void store_u32(unsigned char *to, unsigned value) {
    for (int i = 0; i < 4; i++) {
        to[i] = (unsigned char)(value >> (24 - 8 * i));
    }
}

// Writes the length, the type and the checksum of a chunk around its content, which stands at
// chunk + PNG_CHUNK_CONTENT. Returns the size of the chunk.
static size_t frame_chunk(unsigned char *chunk, const char *type, size_t content_bytes) {
    store_u32(chunk, (unsigned)content_bytes);
    memcpy(chunk + 4, type, 4);
    store_u32(chunk + PNG_CHUNK_CONTENT + content_bytes,
              stbiw__crc32(chunk + 4, (int)(4 + content_bytes)));
    return PNG_CHUNK_FRAME + content_bytes;
}

bool dip_png_encode_indexed(const uint8_t *indices, const uint8_t *palette, int width, int height,
                            unsigned char **bytes, size_t *size_bytes) {
    Buffer grey = {0};
    const bool written =
        has_good_size(width, height) && write_png(&grey, indices, width, height, 1);
    unsigned char *made = written ? malloc(grey.size + PNG_PALETTE_BYTES + PNG_CHUNK_FRAME) : NULL;
    if (made) {
        size_t size = PNG_AFTER_HEADER;
        memcpy(made, grey.bytes, PNG_AFTER_HEADER);
        made[PNG_COLOUR_TYPE] = 3;
        store_u32(made + PNG_HEADER_CRC,
                  stbiw__crc32(made + PNG_HEADER_TYPE, PNG_HEADER_CRC - PNG_HEADER_TYPE));
        memcpy(made + size + PNG_CHUNK_CONTENT, palette, PNG_PALETTE_BYTES);
        size += frame_chunk(made + size, "PLTE", PNG_PALETTE_BYTES);
        memcpy(made + size, grey.bytes + PNG_AFTER_HEADER, grey.size - PNG_AFTER_HEADER);
        *bytes = made;
        *size_bytes = size + grey.size - PNG_AFTER_HEADER;
    }
    free(grey.bytes);
    return made != NULL;
}

// --- texts ---------------------------------------------------------------------------------------

// Returns the most bytes that the chunk of a text may take.
static size_t most_chunk_bytes(const DipPngText *text) {
    return PNG_CHUNK_FRAME + strlen(text->keyword) + PNG_TEXT_FIELDS + strlen(text->text);
}

// Writes a text as a chunk and returns the chunk's size. A text in ASCII becomes the chunk tEXt;
// its content is the keyword, a 0 and the text. Any other text becomes iTXt; its content is the
// keyword, a 0, two bytes 0 (the text is not compressed), an empty language and an empty
// translation of the keyword, each ended by a 0, and the text.
static size_t write_text_chunk(unsigned char *chunk, const DipPngText *text) {
    const size_t keyword_bytes = strlen(text->keyword);
    const size_t text_bytes = strlen(text->text); // dip_utf8_mend keeps the length.
    unsigned char *content = chunk + PNG_CHUNK_CONTENT;
    char *copied = (char *)content + keyword_bytes + PNG_TEXT_FIELDS;
    memcpy(copied, text->text, text_bytes + 1); // The checksum overwrites the final 0.
    const bool ascii = dip_utf8_mend(copied);
    const size_t fields = ascii ? 1 : PNG_TEXT_FIELDS;
    memcpy(content, text->keyword, keyword_bytes);
    memset(content + keyword_bytes, 0, fields);
    memmove(content + keyword_bytes + fields, copied, text_bytes);
    return frame_chunk(chunk, ascii ? "tEXt" : "iTXt", keyword_bytes + fields + text_bytes);
}

// Inserts texts into a PNG, before its picture. Replaces *bytes by a larger block and frees the old
// one. When memory runs out, returns false and leaves the PNG as it is.
static bool add_texts(unsigned char **bytes, size_t *size_bytes, const DipPngText *texts,
                      int count) {
    size_t most_bytes = *size_bytes;
    for (int i = 0; i < count; i++) {
        most_bytes += most_chunk_bytes(&texts[i]);
    }
    unsigned char *made = malloc(most_bytes);
    if (!made) {
        return false;
    }
    size_t size = PNG_AFTER_HEADER;
    memcpy(made, *bytes, PNG_AFTER_HEADER);
    for (int i = 0; i < count; i++) {
        size += write_text_chunk(made + size, &texts[i]);
    }
    memcpy(made + size, *bytes + PNG_AFTER_HEADER, *size_bytes - PNG_AFTER_HEADER);
    *size_bytes += size - PNG_AFTER_HEADER;
    free(*bytes);
    *bytes = made;
    return true;
}

// --- files ---------------------------------------------------------------------------------------

// Checks the pointer to a picture's pixels, which is the parameter `name`, and its size.
static bool check_size(const char *file, const char *name, const void *pixels, int width,
                       int height, DipError *err) {
    if (!pixels) {
        return dip_error_set(err, DIP_ERROR_MISSING, file, 0, name, "NULL, accepted a pointer");
    }
    return has_good_size(width, height) ||
           dip_error_set(err, DIP_ERROR_RANGE, file, 0, "width",
                         "%dx%d pixels, accepted 1x1 and more, with at most %d pixels", width,
                         height, DIP_MAX_WRITTEN_PIXELS);
}

// Checks a frame's pixels, and that stride_bytes is enough for a row of them.
static bool check_frame(const char *file, const DipFrame *frame, DipError *err) {
    if (!check_size(file, "rgba8", frame->rgba8, frame->width, frame->height, err)) {
        return false;
    }
    const size_t row_bytes = 4 * (size_t)frame->width;
    return frame->stride_bytes >= row_bytes ||
           dip_error_set(err, DIP_ERROR_RANGE, file, 0, "stride_bytes",
                         "%zu, accepted the %zu bytes of a row and more", frame->stride_bytes,
                         row_bytes);
}

bool dip_png_write_with_texts(const char *file, const DipFrame *frame, const DipPngText *texts,
                              int count, DipError *err) {
    if (!check_frame(file, frame, err)) {
        return false;
    }
    unsigned char *bytes = NULL;
    size_t size_bytes;
    if (!dip_png_encode(frame->rgba8, frame->stride_bytes, frame->width, frame->height, &bytes,
                        &size_bytes) ||
        !add_texts(&bytes, &size_bytes, texts, count)) {
        free(bytes);
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "png", "out of memory");
    }
    const bool written = dip_whole_file_write(file, bytes, size_bytes, err);
    free(bytes);
    return written;
}

bool dip_png_write(const char *file, const DipFrame *frame, DipError *err) {
    return dip_png_write_with_texts(file, frame, NULL, 0, err);
}

bool dip_png_write_rgba8(const char *file, const uint8_t *rgba8, size_t stride_bytes, int width,
                         int height, DipError *err) {
    const DipFrame frame = {
        .rgba8 = rgba8, .stride_bytes = stride_bytes, .width = width, .height = height};
    return dip_png_write(file, &frame, err);
}

// --- PFM -----------------------------------------------------------------------------------------

enum { HEADER_ROOM = 64 };

// Stores values in little-endian byte order, on any machine.
static void store_values(unsigned char *to, const float *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (int b = 0; b < 4; b++) {
            to[4 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
        }
    }
}

bool dip_pfm_write(const char *file, const float *rgb, int width, int height, DipError *err) {
    if (!check_size(file, "rgb", rgb, width, height, err)) {
        return false;
    }
    const size_t row_values = 3 * (size_t)width;
    unsigned char *bytes = malloc(HEADER_ROOM + 4 * row_values * (size_t)height);
    if (!bytes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "pfm", "out of memory");
    }
    size_t size = (size_t)snprintf((char *)bytes, HEADER_ROOM, "PF\n%d %d\n-1.0\n", width, height);
    for (int y = height - 1; y >= 0; y--) {
        store_values(bytes + size, rgb + (size_t)y * row_values, row_values);
        size += 4 * row_values;
    }
    const bool written = dip_whole_file_write(file, bytes, size, err);
    free(bytes);
    return written;
}
