// Reads Radiance HDR files (RGBE). A picture maps them to 8 bits: linear light above 1 becomes 1,
// and the result is the nearest sRGB code. An environment keeps the light. The file's exposure is
// ignored.
#include "assets/picture/picture_private.h"

#include "renderer/base/file.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/srgb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MIN_RLE_WIDTH = 8, MAX_RLE_WIDTH = 32767, MOST_IN_RUN = 127, RUN_MARK = 128 };

typedef struct Hdr {
    const PictureFile *file;
    size_t at; // Offset of the next byte.
    int width;
    int height;
    // light[c] is the linear light from which on the nearest sRGB code is greater than c.
    double light[255];
} Hdr;

static bool begins(const PictureFile *file, size_t at, const char *text) {
    const size_t length = strlen(text);
    return file->size_bytes - at >= length && memcmp(file->bytes + at, text, length) == 0;
}

bool dip_picture_is_hdr(const PictureFile *file) {
    return begins(file, 0, "#?RADIANCE") || begins(file, 0, "#?RGBE");
}

static bool refuse(const PictureFile *file, const char *what) {
    return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL, "the HDR file %s", what);
}

// --- the header ----------------------------------------------------------------------------------

// Moves behind the end of the line. Returns false at the end of the file.
static bool skip_line(Hdr *hdr) {
    const uint8_t *from = hdr->file->bytes + hdr->at;
    const uint8_t *end = memchr(from, '\n', hdr->file->size_bytes - hdr->at);
    hdr->at = end ? (size_t)(end - hdr->file->bytes) + 1 : hdr->file->size_bytes;
    return end != NULL;
}

// Reads a number of 1 to 5 digits. Returns false if there is none.
static bool read_size(Hdr *hdr, const char *before, int *size) {
    if (!begins(hdr->file, hdr->at, before)) {
        return false;
    }
    hdr->at += strlen(before);
    *size = 0;
    int digits = 0;
    for (; hdr->at < hdr->file->size_bytes && digits < 6; ++digits, ++hdr->at) {
        const int digit = hdr->file->bytes[hdr->at] - '0';
        if (digit < 0 || digit > 9) {
            break;
        }
        *size = 10 * *size + digit;
    }
    return digits >= 1 && digits <= 5;
}

// The header consists of lines of text and ends with an empty line. A line with the size follows.
static bool read_header(Hdr *hdr) {
    const PictureFile *file = hdr->file;
    bool known_format = false;
    while (!begins(file, hdr->at, "\n")) {
        known_format = known_format || begins(file, hdr->at, "FORMAT=32-bit_rle_rgbe");
        if (!skip_line(hdr)) {
            return dip_picture_truncated(file);
        }
    }
    hdr->at++;
    if (!known_format) {
        return refuse(file, "has no line FORMAT=32-bit_rle_rgbe");
    }
    if (!read_size(hdr, "-Y ", &hdr->height) || !read_size(hdr, " +X ", &hdr->width) ||
        !begins(file, hdr->at, "\n")) {
        return hdr->at == file->size_bytes
                   ? dip_picture_truncated(file)
                   : refuse(file, "does not say its size as \"-Y height +X width\"");
    }
    hdr->at++;
    return dip_picture_check_size(file, hdr->width, hdr->height);
}

// --- pixels --------------------------------------------------------------------------------------

static double light_of(int mantissa, int exponent) {
    return exponent ? ldexp(mantissa, exponent - 136) : 0.0;
}

// Returns the number of thresholds up to the value.
static uint8_t code_of(const Hdr *hdr, int mantissa, int exponent) {
    const double light = light_of(mantissa, exponent);
    int low = 0;
    int high = 255;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (hdr->light[middle] <= light) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return (uint8_t)low;
}

static bool has_runs(const Hdr *hdr) {
    const uint8_t *at = hdr->file->bytes + hdr->at;
    return hdr->width >= MIN_RLE_WIDTH && hdr->width <= MAX_RLE_WIDTH &&
           hdr->file->size_bytes - hdr->at >= 4 && at[0] == 2 && at[1] == 2 && at[2] < 128;
}

// Reads a run of equal bytes, or a group of up to 128 different ones. Stores them four bytes apart,
// at to[0], to[4] and so on.
static bool read_run(Hdr *hdr, int left, uint8_t *to, int *count) {
    const PictureFile *file = hdr->file;
    if (file->size_bytes - hdr->at < 2) {
        return dip_picture_truncated(file);
    }
    const int code = file->bytes[hdr->at++];
    const bool same = code > RUN_MARK;
    *count = same ? code - RUN_MARK : code;
    if (*count == 0 || *count > left) {
        return refuse(file, "has a run that does not fit its line");
    }
    const size_t stored = same ? 1 : (size_t)*count;
    if (file->size_bytes - hdr->at < stored) {
        return dip_picture_truncated(file);
    }
    for (int i = 0; i < *count; ++i) {
        to[4 * i] = file->bytes[hdr->at + (same ? 0 : (size_t)i)];
    }
    hdr->at += stored;
    return true;
}

static bool read_runs(Hdr *hdr, uint8_t *line) {
    const uint8_t *mark = hdr->file->bytes + hdr->at;
    if (mark[2] << 8 != (hdr->width & 0xff00) || mark[3] != (hdr->width & 0xff)) {
        return refuse(hdr->file, "has a line of another length");
    }
    hdr->at += 4;
    for (int channel = 0; channel < 4; ++channel) {
        int count = 0;
        for (int x = 0; x < hdr->width; x += count) {
            if (!read_run(hdr, hdr->width - x, line + 4 * x + channel, &count)) {
                return false;
            }
        }
    }
    return true;
}

// Reads a line without runs. An old kind of run repeats the pixel before it; its mantissas are 1,
// which no ordinary pixel has.
static bool read_flat(Hdr *hdr, uint8_t *line) {
    const size_t size_bytes = 4 * (size_t)hdr->width;
    if (hdr->file->size_bytes - hdr->at < size_bytes) {
        return dip_picture_truncated(hdr->file);
    }
    memcpy(line, hdr->file->bytes + hdr->at, size_bytes);
    hdr->at += size_bytes;
    for (size_t i = 0; i < size_bytes; i += 4) {
        if (line[i] == 1 && line[i + 1] == 1 && line[i + 2] == 1) {
            return refuse(hdr->file, "has runs of the old kind, accepted runs of the kind 2, 2");
        }
    }
    return true;
}

// Stores a line of pixels: three mantissas and an exponent each.
typedef void StoreLine(const Hdr *hdr, const uint8_t *line, int y, void *to);

static void store_codes(const Hdr *hdr, const uint8_t *line, int y, void *picture) {
    uint8_t *to = ((DipPicture *)picture)->rgba8 + 4 * (size_t)y * (size_t)hdr->width;
    for (int x = 0; x < hdr->width; ++x, to += 4) {
        const uint8_t *from = line + 4 * (size_t)x;
        for (int k = 0; k < 3; ++k) {
            to[k] = code_of(hdr, from[k], from[3]);
        }
        to[3] = 255;
    }
}

static void store_light(const Hdr *hdr, const uint8_t *line, int y, void *rgb_lin) {
    float *to = (float *)rgb_lin + 3 * (size_t)y * (size_t)hdr->width;
    for (size_t i = 0; i < 3 * (size_t)hdr->width; ++i) {
        const uint8_t *from = line + i / 3 * 4;
        to[i] = (float)fmin(light_of(from[i % 3], from[3]), (double)DIP_MAX_ENVIRONMENT_LIN);
    }
}

static bool read_lines(Hdr *hdr, StoreLine *store, void *to) {
    uint8_t *line = malloc(4 * (size_t)hdr->width);
    bool read = line || dip_picture_out_of_memory(hdr->file);
    for (int y = 0; read && y < hdr->height; ++y) {
        read = has_runs(hdr) ? read_runs(hdr, line) : read_flat(hdr, line);
        if (read) {
            store(hdr, line, y, to);
        }
    }
    free(line);
    return read;
}

// Returns the least size of the pixels, so that a short file is refused before memory is allocated
// for it.
static size_t least_bytes(const Hdr *hdr) {
    const size_t width = (size_t)hdr->width;
    const size_t runs = 4 + 4 * 2 * ((width + MOST_IN_RUN - 1) / MOST_IN_RUN);
    const size_t flat = 4 * width;
    return (size_t)hdr->height * (width >= MIN_RLE_WIDTH && runs < flat ? runs : flat);
}

bool dip_picture_read_hdr(const PictureFile *file, DipPicture *picture) {
    Hdr hdr = {.file = file};
    if (!read_header(&hdr)) {
        return false;
    }
    if (file->size_bytes - hdr.at < least_bytes(&hdr)) {
        return dip_picture_truncated(file);
    }
    if (!dip_picture_allocate(file, hdr.width, hdr.height, 1, picture)) {
        return false;
    }
    for (int code = 0; code < 255; ++code) {
        hdr.light[code] = dip_srgb_decode((code + 0.5) / 255.0);
    }
    return read_lines(&hdr, store_codes, picture);
}

// --- environments --------------------------------------------------------------------------------

static bool check_environment(const Hdr *hdr) {
    if (hdr->width != 2 * hdr->height || hdr->width > DIP_MAX_ENVIRONMENT_WIDTH) {
        return dip_error_set(hdr->file->err, DIP_ERROR_RANGE, hdr->file->name, 0, NULL,
                             "the environment has %dx%d pixels, accepted 2x1..%dx%d, twice as wide "
                             "as high",
                             hdr->width, hdr->height, DIP_MAX_ENVIRONMENT_WIDTH,
                             DIP_MAX_ENVIRONMENT_WIDTH / 2);
    }
    return true;
}

DipEnvironmentDef *dip_environment_decode(const uint8_t *bytes, size_t size_bytes, const char *name,
                                          DipError *err) {
    DIP_FP_MODE_SCOPE();
    const PictureFile file = {bytes, size_bytes, name, err};
    Hdr hdr = {.file = &file};
    if (!dip_picture_is_hdr(&file)) {
        dip_error_set(err, DIP_ERROR_FORMAT, name, 0, NULL,
                      "the file is not a picture of the format that is accepted: Radiance HDR");
        return NULL;
    }
    if (!read_header(&hdr) || !check_environment(&hdr)) {
        return NULL;
    }
    if (size_bytes - hdr.at < least_bytes(&hdr)) {
        dip_picture_truncated(&file);
        return NULL;
    }
    const size_t floats = 3 * (size_t)hdr.width * (size_t)hdr.height;
    DipEnvironmentDef *environment = malloc(sizeof *environment + floats * sizeof(float));
    if (!environment) {
        dip_picture_out_of_memory(&file);
        return NULL;
    }
    float *rgb_lin = (float *)(environment + 1);
    *environment = (DipEnvironmentDef){rgb_lin, hdr.width, hdr.height};
    if (!read_lines(&hdr, store_light, rgb_lin)) {
        free(environment);
        return NULL;
    }
    return environment;
}

DipEnvironmentDef *dip_environment_read_file(const char *path, DipError *err) {
    size_t size_bytes = 0;
    uint8_t *bytes;
    if (!dip_file_read(path, "picture", DIP_MAX_PICTURE_BYTES, &bytes, &size_bytes, err)) {
        return NULL;
    }
    DipEnvironmentDef *environment = dip_environment_decode(bytes, size_bytes, path, err);
    free(bytes);
    return environment;
}
