// Encodes bytes in base64 (RFC 4648).
#include "app/report/page/data_uri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Writes the four digits of up to three bytes.
static void write_group(const unsigned char *bytes, size_t left, char *to) {
    const unsigned word = (unsigned)bytes[0] << 16 | (left > 1 ? (unsigned)bytes[1] << 8 : 0u) |
                          (left > 2 ? bytes[2] : 0u);
    to[0] = digits[word >> 18 & 63];
    to[1] = digits[word >> 12 & 63];
    to[2] = left > 1 ? digits[word >> 6 & 63] : '=';
    to[3] = left > 2 ? digits[word & 63] : '=';
}

char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes) {
    const size_t room = strlen(type) + 16 + (size_bytes + 2) / 3 * 4 + 1;
    char *uri = malloc(room);
    if (!uri) {
        return NULL;
    }
    char *to = uri + snprintf(uri, room, "data:%s;base64,", type);
    for (size_t i = 0; i < size_bytes; i += 3, to += 4) {
        write_group(bytes + i, size_bytes - i, to);
    }
    *to = '\0';
    return uri;
}
