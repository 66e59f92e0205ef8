// Reads PCX files (ZSoft's technical reference manual): 1 to 4 bits with the header's palette, 8
// bits with the palette at the file's end or in grey, and 24 bits.
#include "assets/picture/picture_private.h"

#include <stdlib.h>
#include <string.h>

enum {
    AT_VERSION = 1,
    AT_ENCODING = 2,
    AT_BITS = 3,
    AT_BOUNDS = 4, // least x, least y, greatest x, greatest y
    AT_PALETTE = 16,
    AT_PLANES = 65,
    AT_LINE_BYTES = 66,
    AT_PALETTE_KIND = 68,
    HEADER_BYTES = 128,
    BIG_PALETTE_BYTES = 1 + 3 * 256, // a mark and 256 colours
    BIG_PALETTE_MARK = 12,
    PALETTE_IS_GREY = 2,
    MOST_IN_RUN = 63
};

typedef struct Pcx {
    int width;
    int height;
    int bits;          // Bits of a pixel in a plane.
    int planes;        // Planes of a line, one after the other.
    size_t line_bytes; // Bytes of a plane of a line, which may be more than the pixels need.
    size_t data_end;   // Offset behind the run-length codes.
    uint8_t palette[256][3];
} Pcx;

bool dip_picture_is_pcx(const PictureFile *file) {
    if (file->size_bytes < 4 || file->bytes[0] != 10) {
        return false;
    }
    const int version = file->bytes[AT_VERSION];
    const int bits = file->bytes[AT_BITS];
    return version <= 5 && version != 1 && file->bytes[AT_ENCODING] == 1 &&
           (bits == 1 || bits == 2 || bits == 4 || bits == 8);
}

// --- the header ----------------------------------------------------------------------------------

static bool read_big_palette(const PictureFile *file, Pcx *pcx) {
    const size_t size = file->size_bytes;
    const bool has_palette = size >= HEADER_BYTES + BIG_PALETTE_BYTES &&
                             file->bytes[size - BIG_PALETTE_BYTES] == BIG_PALETTE_MARK;
    if (has_palette) {
        pcx->data_end = size - BIG_PALETTE_BYTES;
        memcpy(pcx->palette, file->bytes + pcx->data_end + 1, sizeof pcx->palette);
        return true;
    }
    for (int i = 0; i < 256; ++i) {
        memset(pcx->palette[i], i, 3);
    }
    return file->bytes[AT_PALETTE_KIND] == PALETTE_IS_GREY ||
           dip_error_set(file->err, DIP_ERROR_TRUNCATED, file->name, 0, NULL,
                         "the PCX file of 256 colours does not end with a palette");
}

// Pixels of 1 bit are black and white. Versions 0 and 3 have no palette of their own.
static bool read_small_palette(const PictureFile *file, Pcx *pcx) {
    const int version = file->bytes[AT_VERSION];
    if (pcx->bits * pcx->planes == 1) {
        memset(pcx->palette[1], 255, 3);
        return true;
    }
    memcpy(pcx->palette, file->bytes + AT_PALETTE, 3 * 16);
    return (version != 0 && version != 3) ||
           dip_error_set(file->err, DIP_ERROR_UNSUPPORTED, file->name, 0, NULL,
                         "the PCX file of version %d has no palette, accepted versions 2, 4 and 5",
                         version);
}

static bool read_palette(const PictureFile *file, Pcx *pcx) {
    if (pcx->bits == 8 && pcx->planes == 3) {
        return true;
    }
    if (pcx->bits == 8 && pcx->planes == 1) {
        return read_big_palette(file, pcx);
    }
    if (pcx->bits < 8 && pcx->planes >= 1 && pcx->bits * pcx->planes <= 4) {
        return read_small_palette(file, pcx);
    }
    return dip_error_set(file->err, DIP_ERROR_UNSUPPORTED, file->name, 0, NULL,
                         "the PCX file has %d planes of %d bits, accepted up to 4 bits in all, one "
                         "or three planes of 8 bits",
                         pcx->planes, pcx->bits);
}

static bool read_header(const PictureFile *file, Pcx *pcx) {
    if (file->size_bytes < HEADER_BYTES) {
        return dip_picture_truncated(file);
    }
    const long long width =
        1 + (long long)dip_picture_u16(file, AT_BOUNDS + 4) - dip_picture_u16(file, AT_BOUNDS);
    const long long height =
        1 + (long long)dip_picture_u16(file, AT_BOUNDS + 6) - dip_picture_u16(file, AT_BOUNDS + 2);
    if (!dip_picture_check_size(file, width, height)) {
        return false;
    }
    pcx->width = (int)width;
    pcx->height = (int)height;
    pcx->bits = file->bytes[AT_BITS];
    pcx->planes = file->bytes[AT_PLANES];
    pcx->line_bytes = dip_picture_u16(file, AT_LINE_BYTES);
    pcx->data_end = file->size_bytes;
    if (pcx->line_bytes < ((size_t)pcx->width * (size_t)pcx->bits + 7) / 8) {
        return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                             "the PCX file has lines of %zu bytes, too few for %d pixels",
                             pcx->line_bytes, pcx->width);
    }
    return read_palette(file, pcx);
}

// --- pixels --------------------------------------------------------------------------------------

// The run-length codes. Some writers let a run reach into the next line, so the codes are one
// stream.
typedef struct Runs {
    const uint8_t *at;
    const uint8_t *end;
    int left; // Bytes that the current run still gives.
    uint8_t value;
} Runs;

static bool next_byte(Runs *runs, uint8_t *byte) {
    while (runs->left == 0) {
        if (runs->at == runs->end) {
            return false;
        }
        const uint8_t code = *runs->at++;
        runs->left = 1;
        runs->value = code;
        if (code >= 0xc0) {
            if (runs->at == runs->end) {
                return false;
            }
            runs->left = code & MOST_IN_RUN;
            runs->value = *runs->at++;
        }
    }
    runs->left--;
    *byte = runs->value;
    return true;
}

static bool next_line(Runs *runs, uint8_t *line, size_t size_bytes) {
    for (size_t i = 0; i < size_bytes; ++i) {
        if (!next_byte(runs, &line[i])) {
            return false;
        }
    }
    return true;
}

// Returns the pixel's index into the palette. Plane p holds the bits from p * bits on.
static int index_of(const Pcx *pcx, const uint8_t *line, int x) {
    int index = 0;
    for (int plane = 0; plane < pcx->planes; ++plane) {
        const int bit = x * pcx->bits;
        const int byte = line[(size_t)plane * pcx->line_bytes + (size_t)(bit / 8)];
        const int value = byte >> (8 - pcx->bits - bit % 8) & ((1 << pcx->bits) - 1);
        index |= value << plane * pcx->bits;
    }
    return index;
}

static void convert_line(const Pcx *pcx, const uint8_t *line, uint8_t *to) {
    const bool has_palette = pcx->bits * pcx->planes <= 8;
    for (int x = 0; x < pcx->width; ++x, to += 4) {
        if (has_palette) {
            memcpy(to, pcx->palette[index_of(pcx, line, x)], 3);
        } else {
            for (size_t k = 0; k < 3; ++k) {
                to[k] = line[k * pcx->line_bytes + (size_t)x];
            }
        }
        to[3] = 255;
    }
}

static bool read_lines(const PictureFile *file, const Pcx *pcx, uint8_t *line,
                       DipPicture *picture) {
    const size_t all_planes = (size_t)pcx->planes * pcx->line_bytes;
    Runs runs = {.at = file->bytes + HEADER_BYTES, .end = file->bytes + pcx->data_end};
    for (int y = 0; y < pcx->height; ++y) {
        if (!next_line(&runs, line, all_planes)) {
            return dip_picture_truncated(file);
        }
        convert_line(pcx, line, picture->rgba8 + 4 * (size_t)y * (size_t)pcx->width);
    }
    return true;
}

bool dip_picture_read_pcx(const PictureFile *file, DipPicture *picture) {
    Pcx pcx = {0};
    if (!read_header(file, &pcx)) {
        return false;
    }
    // Two bytes give at most 63, so a short file is refused before memory is allocated for it.
    const size_t all_planes = (size_t)pcx.planes * pcx.line_bytes;
    if (all_planes * (size_t)pcx.height > (pcx.data_end - HEADER_BYTES) * MOST_IN_RUN) {
        return dip_picture_truncated(file);
    }
    if (!dip_picture_allocate(file, pcx.width, pcx.height, 1, picture)) {
        return false;
    }
    uint8_t *line = malloc(all_planes);
    const bool ok = line ? read_lines(file, &pcx, line, picture) : dip_picture_out_of_memory(file);
    free(line);
    return ok;
}
