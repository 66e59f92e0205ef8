// What the readers of picture formats share. Private to assets/.
//
// stb_image reads PNG, JPEG, BMP and TGA (picture.c). Diptych's own readers read the formats below:
// - DDS and PCX, which stb_image does not know.
// - PPM and PGM, of which stb_image reads 16-bit values wrongly and ignores the greatest value.
// - WebP, by the library libwebp where there is one.
// - HDR, for which the stb_image of Debian 12 never returns if a run-length code is cut off.
#ifndef DIP_ASSETS_PICTURE_PICTURE_PRIVATE_H
#define DIP_ASSETS_PICTURE_PICTURE_PRIVATE_H

#include "assets/picture.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIP_MAX_PICTURE_BYTES = 512 << 20 }; // Greatest size of a picture file.

// The bytes of a picture file while it is read.
typedef struct PictureFile {
    const uint8_t *bytes;
    size_t size_bytes;
    const char *name; // The name that messages call the file by.
    DipError *err;    // May be NULL.
} PictureFile;

// Little-endian numbers. The caller checks that the file holds them.
static inline uint32_t dip_picture_u16(const PictureFile *file, size_t offset) {
    return file->bytes[offset] | (uint32_t)file->bytes[offset + 1] << 8;
}

static inline uint32_t dip_picture_u32(const PictureFile *file, size_t offset) {
    return dip_picture_u16(file, offset) | dip_picture_u16(file, offset + 2) << 16;
}

// Returns false if the width or the height is not 1..DIP_MAX_PICTURE_SIZE.
bool dip_picture_check_size(const PictureFile *file, long long width, long long height);

// Sets the size, which has been checked, and allocates the texels of all levels. level_count:
// 1..DIP_MAX_LEVELS.
bool dip_picture_allocate(const PictureFile *file, int width, int height, int level_count,
                          DipPicture *picture);

// Fill *err and return false: the file ends too early; it does not fit into memory.
bool dip_picture_truncated(const PictureFile *file);
bool dip_picture_out_of_memory(const PictureFile *file);

// The readers. `is` tests the beginning of a file. `read` fills a zeroed picture, and sets
// has_alpha if the file has an alpha channel, whatever its values. If `read` fails, it may leave
// texels, which the caller frees.
bool dip_picture_is_dds(const PictureFile *file);
bool dip_picture_read_dds(const PictureFile *file, DipPicture *picture);
bool dip_picture_is_pcx(const PictureFile *file);
bool dip_picture_read_pcx(const PictureFile *file, DipPicture *picture);
bool dip_picture_is_pnm(const PictureFile *file);
bool dip_picture_read_pnm(const PictureFile *file, DipPicture *picture);
bool dip_picture_is_hdr(const PictureFile *file);
bool dip_picture_read_hdr(const PictureFile *file, DipPicture *picture);
bool dip_picture_is_webp(const PictureFile *file);
bool dip_picture_read_webp(const PictureFile *file, DipPicture *picture);

// Textures of KTX 2.0 are recognised, but not read: the message says how to convert them.
bool dip_picture_is_ktx2(const PictureFile *file);
bool dip_picture_refuse_ktx2(const PictureFile *file, DipPicture *picture);

// Decodes a block of 4x4 texels, row-major, from BC1 (8 bytes), BC2 or BC3 (16 bytes).
void dip_picture_decode_bc1(const uint8_t *block, uint8_t rgba8[64]);
void dip_picture_decode_bc2(const uint8_t *block, uint8_t rgba8[64]);
void dip_picture_decode_bc3(const uint8_t *block, uint8_t rgba8[64]);

// Returns false and fills *err if the file is a JPEG file with a malformed table, without a table
// that it uses, or without a scan of one of its components. Returns true for other formats.
bool dip_jpeg_check(const PictureFile *file);

#endif
