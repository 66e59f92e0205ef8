// Decodes pictures: chooses the reader, and reads PNG, JPEG, BMP and TGA with stb_image. Adds the
// checks that stb_image leaves out: the size of the picture, truncated files, and the tables of
// JPEG files (jpeg_tables.c).
#include "assets/picture.h"

#include "assets/picture/picture_private.h"
#include "renderer/base/file.h"
#include "renderer/base/fp_mode.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// stb_image reports a failed allocation like a fault of the file, so failures are recorded here.
static _Thread_local bool ran_out;

// stb_image shows memory that it never wrote if a JPEG file lacks data or a PNG file is malformed.
// All its memory is therefore zeroed. CMakeLists.txt makes the compiler zero its local variables,
// among them palettes, whose colours beyond those of the file a pixel may name.
static void *stb_allocate(size_t size_bytes) {
    void *memory = calloc(1, size_bytes);
    ran_out = ran_out || !memory;
    return memory;
}

// Most bytes that a block of stb_image may grow to, and whether it tried to grow beyond. Two blocks
// grow, each to twice its size: the compressed data of a PNG file, which it sizes by what the file
// says before it reads it, and the data that this unpacks to. Beyond the end of the compressed data
// it reads zeros, and if the file's code makes bytes of zeros, 200 bytes unpack to 2 GB.
static _Thread_local size_t most_bytes;
static _Thread_local bool grew_too_large;

static void *stb_resize(void *memory, size_t old_bytes, size_t size_bytes) {
    grew_too_large = grew_too_large || size_bytes > most_bytes;
    if (size_bytes > most_bytes) {
        return NULL; // stb_image gives up.
    }
    uint8_t *resized = realloc(memory, size_bytes);
    ran_out = ran_out || !resized;
    if (resized && size_bytes > old_bytes) {
        memset(resized + old_bytes, 0, size_bytes - old_bytes);
    }
    return resized;
}

// A PNG file may begin its data with an empty chunk. stb_image then copies 0 bytes to NULL + 0, for
// which memcpy is not defined. The sum is NULL with all compilers, so clang's sanitizer need not
// report it.
static void *stb_copy(void *to, const void *from, size_t size_bytes) {
    return size_bytes > 0 ? memcpy(to, from, size_bytes) : to;
}

#define STBI_MALLOC(size)                                stb_allocate(size)
#define STBI_REALLOC_SIZED(pointer, old_bytes, new_size) stb_resize(pointer, old_bytes, new_size)
#define STBI_FREE(pointer)                               free(pointer)

// stb_image's code is compiled into this file only, with the supported formats and without file
// access.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define memcpy stb_copy
#ifdef __clang__
#pragma clang attribute push(__attribute__((no_sanitize("pointer-overflow"))), apply_to = function)
#endif
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#undef memcpy

// stb_image reads zeros beyond the end of TGA, BMP and JPEG data, so passed_end records whether
// stb_image has read past the end.
typedef struct Source {
    const uint8_t *bytes;
    size_t size_bytes;
    size_t position;
    bool passed_end;
} Source;

// Size of stb_image's own buffer. A read of this size fills the buffer. At the end of the data it
// may return fewer bytes, but at least one. If a read of another size returns fewer bytes than
// wanted, the data is truncated.
enum { STB_REFILL_BYTES = 128 };

static int source_read(void *user, char *data, int size) {
    Source *source = user;
    const size_t left = source->size_bytes - source->position;
    const size_t wanted = size > 0 ? (size_t)size : 0;
    const size_t count = wanted < left ? wanted : left;
    if (count < wanted && (count == 0 || wanted != STB_REFILL_BYTES)) {
        source->passed_end = true;
    }
    memcpy(data, source->bytes + source->position, count);
    source->position += count;
    return (int)count;
}

static void source_skip(void *user, int count) {
    Source *source = user;
    if (count < 0) {
        const size_t back = (size_t)(-(long long)count);
        source->position -= back < source->position ? back : source->position;
        return;
    }
    const size_t left = source->size_bytes - source->position;
    if ((size_t)count > left) {
        source->passed_end = true;
    }
    source->position += (size_t)count < left ? (size_t)count : left;
}

static int source_at_end(void *user) {
    const Source *source = user;
    return source->position >= source->size_bytes;
}

bool dip_picture_check_size(const PictureFile *file, long long width, long long height) {
    if (width < 1 || height < 1 || width > DIP_MAX_PICTURE_SIZE || height > DIP_MAX_PICTURE_SIZE) {
        return dip_error_set(file->err, DIP_ERROR_RANGE, file->name, 0, NULL,
                             "the picture has %lld x %lld pixels, accepted 1..%d in each direction",
                             width, height, DIP_MAX_PICTURE_SIZE);
    }
    return true;
}

bool dip_picture_truncated(const PictureFile *file) {
    return dip_error_set(file->err, DIP_ERROR_TRUNCATED, file->name, 0, NULL,
                         "the picture file ends too early");
}

bool dip_picture_out_of_memory(const PictureFile *file) {
    return dip_error_set(file->err, DIP_ERROR_MEMORY, file->name, 0, NULL,
                         "the picture cannot be read: out of memory");
}

// Sets the alpha of pixels that name a colour beyond the palette: without an alpha channel they are
// black, like in most programs; with one, they are transparent.
static void make_opaque(DipPicture *picture) {
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; ++i) {
        picture->rgba8[4 * i + 3] = 255;
    }
}

static bool any_alpha(const DipPicture *picture) {
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; ++i) {
        if (picture->rgba8[4 * i + 3] < 255) {
            return true;
        }
    }
    return false;
}

// --- PNG, JPEG, BMP, TGA -------------------------------------------------------------------------

// Returns twice the greater of the file's size and the size of a PNG's unpacked data: rows of at
// most 8 bytes per pixel and a byte that names their filter, of which an interlaced picture has
// about twice as many.
static size_t largest_block(const PictureFile *file, const DipPicture *picture) {
    const size_t row_bytes = 8 * (size_t)picture->width + 8;
    const size_t unpacked_bytes = 2 * row_bytes * ((size_t)picture->height + 8);
    const size_t read_bytes = file->size_bytes + 4096;
    return 2 * (unpacked_bytes > read_bytes ? unpacked_bytes : read_bytes);
}

static bool read_with_stb(const PictureFile *file, DipPicture *picture) {
    static const stbi_io_callbacks callbacks = {source_read, source_skip, source_at_end};
    if (!dip_jpeg_check(file)) {
        return false;
    }
    Source source = {.bytes = file->bytes, .size_bytes = file->size_bytes};
    int channels = 0;
    if (!stbi_info_from_callbacks(&callbacks, &source, &picture->width, &picture->height,
                                  &channels)) {
        return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                             "the file is not a supported picture, accepted PNG, BMP, TGA, DDS, "
                             "PCX, PPM, PGM, HDR and JPEG (not arithmetic-coded)");
    }
    if (!dip_picture_check_size(file, picture->width, picture->height)) {
        return false;
    }
    source = (Source){.bytes = file->bytes, .size_bytes = file->size_bytes};
    picture->level_count = 1;
    picture->has_alpha = channels == 2 || channels == 4;
    most_bytes = largest_block(file, picture);
    grew_too_large = false;
    picture->rgba8 = stbi_load_from_callbacks(&callbacks, &source, &picture->width,
                                              &picture->height, &channels, 4);
    if (source.passed_end) {
        return dip_picture_truncated(file);
    }
    if (grew_too_large) {
        return dip_error_set(
            file->err, DIP_ERROR_TRUNCATED, file->name, 0, NULL,
            "the picture file ends too early, or its data is longer than its pixels");
    }
    if (picture->rgba8 && !picture->has_alpha) {
        make_opaque(picture);
    }
    const char *reason = picture->rgba8 ? NULL : stbi_failure_reason();
    return picture->rgba8 || dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                                           "the picture cannot be read: %s",
                                           reason ? reason : "stb_image gives no reason");
}

// --- all formats ---------------------------------------------------------------------------------

static bool read_picture(const PictureFile *file, DipPicture *picture) {
    static const struct {
        bool (*is)(const PictureFile *file);
        bool (*read)(const PictureFile *file, DipPicture *picture);
    } readers[] = {
        {dip_picture_is_dds, dip_picture_read_dds},
        {dip_picture_is_pcx, dip_picture_read_pcx},
        {dip_picture_is_pnm, dip_picture_read_pnm},
        {dip_picture_is_hdr, dip_picture_read_hdr},
        {dip_picture_is_webp, dip_picture_read_webp},
        {dip_picture_is_ktx2, dip_picture_refuse_ktx2},
    };
    if (file->size_bytes == 0) {
        return dip_error_set(file->err, DIP_ERROR_TRUNCATED, file->name, 0, NULL,
                             "the picture file is empty");
    }
    for (size_t i = 0; i < sizeof readers / sizeof *readers; ++i) {
        if (readers[i].is(file)) {
            return readers[i].read(file, picture);
        }
    }
    return read_with_stb(file, picture);
}

bool dip_picture_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                        DipPicture *picture, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const PictureFile file = {bytes, size_bytes, name, err};
    *picture = (DipPicture){0};
    ran_out = false;
    bool decoded = read_picture(&file, picture);
    if (ran_out) {
        decoded = dip_picture_out_of_memory(&file);
    }
    if (!decoded) {
        dip_picture_free(picture);
        return false;
    }
    picture->has_alpha = picture->has_alpha && any_alpha(picture);
    return true;
}

bool dip_picture_read_file(const char *path, DipPicture *picture, DipError *err) {
    *picture = (DipPicture){0};
    size_t size_bytes = 0;
    uint8_t *bytes;
    if (!dip_file_read(path, "picture", DIP_MAX_PICTURE_BYTES, &bytes, &size_bytes, err)) {
        return false;
    }
    const bool ok = dip_picture_decode(bytes, size_bytes, path, picture, err);
    free(bytes);
    return ok;
}

// --- levels --------------------------------------------------------------------------------------

static int half_size(int size, int level) {
    return size >> level > 1 ? size >> level : 1;
}

// Returns the number of texels of the levels 0..level_count-1.
static size_t texel_count(int width, int height, int level_count) {
    size_t count = 0;
    for (int level = 0; level < level_count; ++level) {
        count += (size_t)half_size(width, level) * (size_t)half_size(height, level);
    }
    return count;
}

const uint8_t *dip_picture_level(const DipPicture *picture, int level, int *width, int *height) {
    *width = half_size(picture->width, level);
    *height = half_size(picture->height, level);
    return picture->rgba8 + 4 * texel_count(picture->width, picture->height, level);
}

int dip_picture_levels(const DipPicture *picture, const char *name, DipEncoding encoding,
                       DipTextureDef *levels) {
    for (int level = 0; level < picture->level_count; ++level) {
        DipTextureDef *to = &levels[level];
        *to = (DipTextureDef){.name = name, .encoding = encoding};
        to->rgba8 = dip_picture_level(picture, level, &to->width, &to->height);
    }
    return picture->level_count;
}

static bool allocate(DipPicture *picture, int width, int height, int level_count) {
    *picture = (DipPicture){.width = width, .height = height, .level_count = level_count};
    picture->rgba8 = malloc(4 * texel_count(width, height, level_count));
    return picture->rgba8 != NULL;
}

bool dip_picture_allocate(const PictureFile *file, int width, int height, int level_count,
                          DipPicture *picture) {
    return allocate(picture, width, height, level_count) || dip_picture_out_of_memory(file);
}

// --- pictures made from others -------------------------------------------------------------------

bool dip_picture_from_bgra(const uint8_t *bgra8, uint32_t width, uint32_t height, const char *name,
                           DipPicture *picture, DipError *err) {
    const PictureFile file = {.name = name, .err = err};
    *picture = (DipPicture){0};
    if (!dip_picture_check_size(&file, width, height)) {
        return false;
    }
    if (!allocate(picture, (int)width, (int)height, 1)) {
        *picture = (DipPicture){0};
        return dip_error_set(err, DIP_ERROR_MEMORY, name, 0, NULL, "out of memory");
    }
    const size_t count = (size_t)width * height;
    for (size_t i = 0; i < count; ++i) {
        picture->rgba8[4 * i + 0] = bgra8[4 * i + 2];
        picture->rgba8[4 * i + 1] = bgra8[4 * i + 1];
        picture->rgba8[4 * i + 2] = bgra8[4 * i + 0];
        picture->rgba8[4 * i + 3] = bgra8[4 * i + 3];
    }
    picture->has_alpha = any_alpha(picture);
    return true;
}

bool dip_picture_copy(const DipTextureDef *levels, int level_count, DipPicture *picture,
                      DipError *err) {
    *picture = (DipPicture){0};
    for (int level = 0; level < level_count; ++level) {
        if (levels[level].width != half_size(levels[0].width, level) ||
            levels[level].height != half_size(levels[0].height, level)) {
            return dip_error_set(err, DIP_ERROR_FORMAT, levels[0].name, 0, NULL,
                                 "the textures are not the levels of one picture");
        }
    }
    if (!allocate(picture, levels[0].width, levels[0].height, level_count)) {
        *picture = (DipPicture){0};
        return dip_error_set(err, DIP_ERROR_MEMORY, levels[0].name, 0, NULL, "out of memory");
    }
    for (int level = 0; level < level_count; ++level) {
        int width;
        int height;
        uint8_t *to = (uint8_t *)dip_picture_level(picture, level, &width, &height);
        memcpy(to, levels[level].rgba8, 4 * (size_t)width * (size_t)height);
    }
    picture->has_alpha = any_alpha(picture);
    return true;
}

bool dip_picture_enlarge(const DipPicture *picture, int factor, DipPicture *enlarged) {
    const int width = picture->width * factor;
    const int height = picture->height * factor;
    if (!allocate(enlarged, width, height, 1)) {
        return false;
    }
    for (int y = 0; y < height; ++y) {
        const uint8_t *row = picture->rgba8 + 4 * (size_t)(y / factor) * (size_t)picture->width;
        uint8_t *to = enlarged->rgba8 + 4 * (size_t)y * (size_t)width;
        for (int x = 0; x < width; ++x) {
            memcpy(to + 4 * (size_t)x, row + 4 * (size_t)(x / factor), 4);
        }
    }
    enlarged->has_alpha = picture->has_alpha;
    return true;
}

bool dip_picture_with_opacity(const DipPicture *colour, const DipPicture *opacity,
                              DipPicture *picture) {
    const DipPicture *size_of = colour ? colour : opacity;
    const int width = size_of->width;
    const int height = size_of->height;
    if (!allocate(picture, width, height, 1)) {
        return false;
    }
    for (int y = 0; y < height; ++y) {
        const int from_y = (int)((long long)y * opacity->height / height);
        for (int x = 0; x < width; ++x) {
            const int from_x = (int)((long long)x * opacity->width / width);
            const size_t to = 4 * ((size_t)y * (size_t)width + (size_t)x);
            const uint8_t *from =
                opacity->rgba8 + 4 * ((size_t)from_y * (size_t)opacity->width + (size_t)from_x);
            static const uint8_t white[3] = {255, 255, 255};
            memcpy(picture->rgba8 + to, colour ? colour->rgba8 + to : white, 3);
            picture->rgba8[to + 3] =
                opacity->has_alpha ? from[3] : (uint8_t)((from[0] + from[1] + from[2]) / 3);
        }
    }
    picture->has_alpha = any_alpha(picture);
    return true;
}

void dip_picture_free(DipPicture *picture) {
    free(picture->rgba8);
    *picture = (DipPicture){0};
}
