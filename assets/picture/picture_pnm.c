// Reads PPM and PGM files (netpbm), as text (P2, P3) and binary (P5, P6), with 8 or 16 bits.
//
// Values are scaled so that the file's greatest value becomes 255, rounded to the nearest.
#include "assets/picture/picture_private.h"

typedef struct Pnm {
    const PictureFile *file;
    size_t at; // Offset of the next byte.
    bool is_text;
    int channels; // 1 (PGM) or 3 (PPM)
    uint32_t width;
    uint32_t height;
    uint32_t max; // The greatest value, 1..65535.
} Pnm;

static bool is_blank(uint8_t c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool dip_picture_is_pnm(const PictureFile *file) {
    const uint8_t *bytes = file->bytes;
    return file->size_bytes >= 3 && bytes[0] == 'P' && is_blank(bytes[2]) &&
           (bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '5' || bytes[1] == '6');
}

// Skips white space and comments, which reach from a # to the end of the line.
static void skip_blanks(Pnm *pnm) {
    const PictureFile *file = pnm->file;
    bool in_comment = false;
    for (; pnm->at < file->size_bytes; ++pnm->at) {
        const uint8_t c = file->bytes[pnm->at];
        in_comment = c == '#' || (in_comment && c != '\n' && c != '\r');
        if (!in_comment && !is_blank(c)) {
            return;
        }
    }
}

// Reads a decimal number 0..most. most: 1..65535.
static bool read_number(Pnm *pnm, uint32_t most, uint32_t *number) {
    const PictureFile *file = pnm->file;
    skip_blanks(pnm);
    const size_t begin = pnm->at;
    *number = 0;
    for (; pnm->at < file->size_bytes; ++pnm->at) {
        const uint8_t c = file->bytes[pnm->at];
        if (c < '0' || c > '9' || *number > most) {
            break;
        }
        *number = 10 * *number + (uint32_t)(c - '0');
    }
    if (begin == file->size_bytes) {
        return dip_picture_truncated(file);
    }
    if (pnm->at == begin || *number > most) {
        return dip_error_set(
            file->err, DIP_ERROR_RANGE, file->name, 0, NULL,
            "the PPM or PGM file is malformed at byte %zu, accepted a number 0..%u", begin, most);
    }
    return true;
}

static bool read_header(Pnm *pnm) {
    const PictureFile *file = pnm->file;
    const uint8_t kind = file->bytes[1];
    pnm->is_text = kind == '2' || kind == '3';
    pnm->channels = kind == '3' || kind == '6' ? 3 : 1;
    pnm->at = 2;
    if (!read_number(pnm, UINT16_MAX, &pnm->width) || !read_number(pnm, UINT16_MAX, &pnm->height) ||
        !read_number(pnm, UINT16_MAX, &pnm->max) ||
        !dip_picture_check_size(file, pnm->width, pnm->height)) {
        return false;
    }
    if (pnm->max == 0) {
        return dip_error_set(file->err, DIP_ERROR_RANGE, file->name, 0, NULL,
                             "the greatest value of the PPM or PGM file is 0, accepted 1..65535");
    }
    if (pnm->at == file->size_bytes) {
        return dip_picture_truncated(file);
    }
    pnm->at++; // A single blank separates the header from binary values.
    return true;
}

// The caller has checked that the file holds all binary values.
static bool read_value(Pnm *pnm, uint32_t *value) {
    const PictureFile *file = pnm->file;
    if (pnm->is_text) {
        return read_number(pnm, pnm->max, value);
    }
    *value = file->bytes[pnm->at++];
    if (pnm->max > 255) {
        *value = *value << 8 | file->bytes[pnm->at++];
    }
    return *value <= pnm->max ||
           dip_error_set(file->err, DIP_ERROR_RANGE, file->name, 0, NULL,
                         "the PPM or PGM file has the value %u, accepted 0..%u", *value, pnm->max);
}

static bool read_texels(Pnm *pnm, DipPicture *picture) {
    const size_t count = (size_t)pnm->width * pnm->height;
    for (size_t i = 0; i < count; ++i) {
        uint8_t *to = picture->rgba8 + 4 * i;
        for (int k = 0; k < pnm->channels; ++k) {
            uint32_t value;
            if (!read_value(pnm, &value)) {
                return false;
            }
            to[k] = (uint8_t)((255 * value + pnm->max / 2) / pnm->max);
        }
        to[1] = pnm->channels == 3 ? to[1] : to[0];
        to[2] = pnm->channels == 3 ? to[2] : to[0];
        to[3] = 255;
    }
    return true;
}

bool dip_picture_read_pnm(const PictureFile *file, DipPicture *picture) {
    Pnm pnm = {.file = file};
    if (!read_header(&pnm)) {
        return false;
    }
    // In text, each value takes a digit and, except for the last one, a blank.
    const size_t values = (size_t)pnm.width * pnm.height * (size_t)pnm.channels;
    const size_t least = pnm.is_text ? 2 * values - 1 : pnm.max > 255 ? 2 * values : values;
    if (least > file->size_bytes - pnm.at) {
        return dip_picture_truncated(file);
    }
    return dip_picture_allocate(file, (int)pnm.width, (int)pnm.height, 1, picture) &&
           read_texels(&pnm, picture);
}
