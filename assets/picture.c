// Decodes pictures with stb_image and adds the checks that it leaves out: the size of the picture,
// truncated files, and the tables of JPEG files (jpeg_tables.c).
#include "assets/picture.h"

#include "assets/picture_private.h"
#include "renderer/base/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// stb_image reports a failed allocation like a fault of the file, so failures are recorded here.
static _Thread_local bool ran_out;

static void *stb_resize(void *memory, size_t size_bytes) {
    void *resized = realloc(memory, size_bytes);
    ran_out = ran_out || !resized;
    return resized;
}

#define STBI_MALLOC(size)           stb_resize(NULL, size)
#define STBI_REALLOC(pointer, size) stb_resize(pointer, size)
#define STBI_FREE(pointer)          free(pointer)

// stb_image's code is compiled into this file only, with the supported formats and without file
// access.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#include <stb/stb_image.h>

static const size_t max_file_bytes = (size_t)512 << 20;

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

static bool check_size(long long width, long long height, const char *name, DipError *err) {
    if (width < 1 || height < 1 || width > DIP_MAX_PICTURE_SIZE || height > DIP_MAX_PICTURE_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, name, 0, NULL,
                             "the picture has %lld x %lld pixels, accepted 1..%d in each direction",
                             width, height, DIP_MAX_PICTURE_SIZE);
    }
    return true;
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

static bool decode(const uint8_t *bytes, size_t size_bytes, const char *name, DipPicture *picture,
                   DipError *err) {
    static const stbi_io_callbacks callbacks = {source_read, source_skip, source_at_end};
    *picture = (DipPicture){0};
    if (size_bytes == 0) {
        return dip_error_set(err, DIP_ERROR_TRUNCATED, name, 0, NULL, "the picture file is empty");
    }
    if (!dip_jpeg_has_good_tables(bytes, size_bytes)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, name, 0, NULL,
                             "a Huffman or quantisation table of the JPEG file is malformed or "
                             "missing, accepted files with every table that they use");
    }
    Source source = {.bytes = bytes, .size_bytes = size_bytes};
    int channels = 0;
    if (!stbi_info_from_callbacks(&callbacks, &source, &picture->width, &picture->height,
                                  &channels)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, name, 0, NULL,
                             "the file is not a supported picture, accepted PNG, BMP, TGA and JPEG "
                             "(not arithmetic-coded)");
    }
    if (!check_size(picture->width, picture->height, name, err)) {
        return false;
    }
    source = (Source){.bytes = bytes, .size_bytes = size_bytes};
    picture->rgba8 = stbi_load_from_callbacks(&callbacks, &source, &picture->width,
                                              &picture->height, &channels, 4);
    if (!picture->rgba8 || source.passed_end) {
        const char *reason = picture->rgba8 ? NULL : stbi_failure_reason();
        dip_picture_free(picture);
        if (source.passed_end) {
            return dip_error_set(err, DIP_ERROR_TRUNCATED, name, 0, NULL,
                                 "the picture file ends too early");
        }
        return dip_error_set(err, DIP_ERROR_FORMAT, name, 0, NULL, "the picture cannot be read: %s",
                             reason ? reason : "stb_image gives no reason");
    }
    picture->has_alpha = (channels == 2 || channels == 4) && any_alpha(picture);
    return true;
}

bool dip_picture_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                        DipPicture *picture, DipError *err) {
    ran_out = false;
    const bool decoded = decode(bytes, size_bytes, name, picture, err);
    if (ran_out) {
        dip_picture_free(picture);
        return dip_error_set(err, DIP_ERROR_MEMORY, name, 0, NULL,
                             "the picture cannot be read: out of memory");
    }
    return decoded;
}

bool dip_picture_read_file(const char *path, DipPicture *picture, DipError *err) {
    *picture = (DipPicture){0};
    size_t size_bytes = 0;
    uint8_t *bytes;
    if (!dip_file_read(path, "picture", max_file_bytes, &bytes, &size_bytes, err)) {
        return false;
    }
    const bool ok = dip_picture_decode(bytes, size_bytes, path, picture, err);
    free(bytes);
    return ok;
}

static bool allocate(DipPicture *picture, int width, int height) {
    *picture = (DipPicture){.width = width, .height = height};
    picture->rgba8 = malloc(4 * (size_t)width * (size_t)height);
    return picture->rgba8 != NULL;
}

bool dip_picture_from_bgra(const uint8_t *bgra8, uint32_t width, uint32_t height, const char *name,
                           DipPicture *picture, DipError *err) {
    *picture = (DipPicture){0};
    if (!check_size(width, height, name, err)) {
        return false;
    }
    if (!allocate(picture, (int)width, (int)height)) {
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

bool dip_picture_copy(const DipTextureDef *texture, DipPicture *picture, DipError *err) {
    if (!allocate(picture, texture->width, texture->height)) {
        *picture = (DipPicture){0};
        return dip_error_set(err, DIP_ERROR_MEMORY, texture->name, 0, NULL, "out of memory");
    }
    memcpy(picture->rgba8, texture->rgba8, 4 * (size_t)texture->width * (size_t)texture->height);
    picture->has_alpha = any_alpha(picture);
    return true;
}

bool dip_picture_with_opacity(const DipPicture *colour, const DipPicture *opacity,
                              DipPicture *picture) {
    const DipPicture *size_of = colour ? colour : opacity;
    const int width = size_of->width;
    const int height = size_of->height;
    if (!allocate(picture, width, height)) {
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
