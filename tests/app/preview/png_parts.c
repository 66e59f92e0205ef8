// Walking through the chunks of a PNG file.
#include "tests/app/preview/png_parts.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIGNATURE = 8, FRAME = 12, ROOM = 1 << 24 };

static uint32_t number_at(const unsigned char *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// The checksum of the PNG specification, one bit at a time.
static uint32_t checksum(const unsigned char *bytes, size_t size_bytes) {
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size_bytes; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
        }
    }
    return ~crc;
}

void png_read(const char *file, unsigned char **bytes, size_t *size_bytes) {
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    *bytes = malloc(ROOM);
    assert_non_null(*bytes);
    *size_bytes = fread(*bytes, 1, ROOM, in);
    fclose(in);
    assert_true(*size_bytes > SIGNATURE && *size_bytes < ROOM);
    assert_memory_equal(*bytes, "\x89PNG\r\n\x1a\n", SIGNATURE);
    size_t at = SIGNATURE;
    while (at < *size_bytes) {
        const size_t content = number_at(*bytes + at);
        assert_true(at + FRAME + content <= *size_bytes);
        assert_int_equal(number_at(*bytes + at + 8 + content),
                         checksum(*bytes + at + 4, content + 4));
        at += FRAME + content;
    }
    assert_memory_equal(*bytes + *size_bytes - 8, "IEND", 4);
}

static bool is_text(const unsigned char *chunk) {
    return memcmp(chunk + 4, "tEXt", 4) == 0 || memcmp(chunk + 4, "iTXt", 4) == 0;
}

bool png_text(const unsigned char *bytes, size_t size_bytes, const char *keyword, char *text,
              size_t room) {
    for (size_t at = SIGNATURE; at < size_bytes; at += FRAME + number_at(bytes + at)) {
        const char *found = (const char *)bytes + at + 8;
        if (is_text(bytes + at) && strcmp(found, keyword) == 0) {
            const size_t fields = strlen(keyword) + (bytes[at + 4] == 't' ? 1 : 5);
            const size_t length = number_at(bytes + at) - fields;
            assert_true(length < room);
            memcpy(text, found + fields, length);
            text[length] = '\0';
            return true;
        }
    }
    return false;
}

size_t png_strip_texts(unsigned char *bytes, size_t size_bytes) {
    size_t to = SIGNATURE;
    size_t at = SIGNATURE;
    while (at < size_bytes) {
        const size_t chunk_bytes = FRAME + number_at(bytes + at);
        if (!is_text(bytes + at)) {
            memmove(bytes + to, bytes + at, chunk_bytes);
            to += chunk_bytes;
        }
        at += chunk_bytes;
    }
    return to;
}
