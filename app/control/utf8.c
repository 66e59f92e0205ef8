// Decodes UTF-8 as RFC 3629 defines it.
#include "app/control/utf8_private.h"

#include <stdint.h>
#include <string.h>

// Returns the length of the character at the start of a text, or 0 if it is not UTF-8.
static size_t character_bytes(const unsigned char *text, size_t length) {
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned first = text[0];
    if (first < 0x80) {
        return 1;
    }
    const size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || bytes > length) {
        return 0;
    }
    uint32_t code = first & (0x7fu >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((text[i] & 0xc0u) != 0x80u) {
            return 0;
        }
        code = code << 6 | (text[i] & 0x3fu);
    }
    const int surrogate = code >= 0xd800 && code <= 0xdfff;
    return code >= least[bytes] && code <= 0x10ffff && !surrogate ? bytes : 0;
}

size_t dip_utf8_valid_bytes(const char *text, size_t length) {
    size_t valid = 0;
    while (valid < length) {
        const size_t bytes = character_bytes((const unsigned char *)text + valid, length - valid);
        if (bytes == 0) {
            break;
        }
        valid += bytes;
    }
    return valid;
}

void dip_utf8_mend(char *text) {
    size_t left = strlen(text);
    for (;;) {
        const size_t valid = dip_utf8_valid_bytes(text, left);
        if (valid == left) {
            return;
        }
        text[valid] = '?';
        text += valid;
        left -= valid;
    }
}
