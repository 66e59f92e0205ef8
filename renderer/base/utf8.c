// Decodes and encodes UTF-8.
#include "renderer/base/utf8.h"

#include <string.h>

// Leading bits of a character of 1 to 4 bytes, and the least code point of that length.
static const struct {
    unsigned lead;
    uint32_t least;
} forms[DIP_UTF8_MOST_BYTES + 1] = {{0}, {0, 0}, {0xc0, 0x80}, {0xe0, 0x800}, {0xf0, 0x10000}};

size_t dip_utf8_read(const char *text, size_t length, uint32_t *code) {
    const unsigned char *bytes = (const unsigned char *)text;
    const unsigned first = length > 0 ? bytes[0] : 0xff;
    const size_t count = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if ((first >= 0x80 && first < 0xc2) || first > 0xf4 || count > length) {
        return 0;
    }
    uint32_t found = count == 1 ? first : first & (0x7fu >> count);
    for (size_t i = 1; i < count; i++) {
        if ((bytes[i] & 0xc0u) != 0x80u) {
            return 0;
        }
        found = found << 6 | (bytes[i] & 0x3fu);
    }
    const bool surrogate = found >= 0xd800 && found <= 0xdfff;
    if (found < forms[count].least || found > 0x10ffff || surrogate) {
        return 0;
    }
    *code = found;
    return count;
}

size_t dip_utf8_write(uint32_t code, char bytes[DIP_UTF8_MOST_BYTES]) {
    const size_t count = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = count; i-- > 1; code >>= 6) {
        bytes[i] = (char)(0x80 | (code & 0x3f));
    }
    bytes[0] = (char)(forms[count].lead | code);
    return count;
}

size_t dip_utf8_valid_bytes(const char *text, size_t length) {
    size_t valid = 0;
    size_t count;
    uint32_t code;
    while ((count = dip_utf8_read(text + valid, length - valid, &code)) > 0) {
        valid += count;
    }
    return valid;
}

bool dip_utf8_mend(char *text) {
    bool ascii = true;
    while (*text) {
        uint32_t code;
        const size_t count = dip_utf8_read(text, DIP_UTF8_MOST_BYTES, &code);
        *text = count > 0 ? *text : '?';
        ascii = ascii && count <= 1;
        text += count > 0 ? count : 1;
    }
    return ascii;
}
