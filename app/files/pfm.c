// Puts the header and the rows of a PFM file together and writes the file.
#include "app/files/pfm.h"

#include "app/files/whole_file.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_ROOM = 64 };

// Stores values in little-endian order, on any machine.
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
