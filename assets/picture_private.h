// Checks of picture files that stb_image leaves out. Private to assets/.
#ifndef DIP_ASSETS_PICTURE_PRIVATE_H
#define DIP_ASSETS_PICTURE_PRIVATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Returns false if the bytes are a JPEG file that has a malformed table, or that does not define a
// table which it uses. Returns true for files of other formats.
bool dip_jpeg_has_good_tables(const uint8_t *bytes, size_t size_bytes);

#endif
