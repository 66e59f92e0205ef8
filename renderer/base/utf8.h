// UTF-8 as RFC 3629 defines it. Surrogates, code points beyond 0x10ffff and encodings that are
// longer than necessary are not UTF-8.
#ifndef DIP_RENDERER_BASE_UTF8_H
#define DIP_RENDERER_BASE_UTF8_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_UTF8_MOST_BYTES = 4 }; // Longest encoding of a character.

// Reads the character at the start of a text of `length` bytes. Returns the character's length in
// bytes, or 0 if the text does not begin with UTF-8; *code is then unchanged. No byte behind the
// first wrong one is read, so a text that ends in 0 may be given the length DIP_UTF8_MOST_BYTES.
// Thread-safe.
DIP_API size_t dip_utf8_read(const char *text, size_t length, uint32_t *code);

// Writes a code point, at most 0x10ffff, and returns its length in bytes. Thread-safe.
DIP_API size_t dip_utf8_write(uint32_t code, char bytes[DIP_UTF8_MOST_BYTES]);

// Returns the length in bytes of the longest beginning of a text that is UTF-8. Thread-safe.
DIP_API size_t dip_utf8_valid_bytes(const char *text, size_t length);

// Replaces each byte of a text that does not belong to UTF-8 by '?'. Returns whether all characters
// are ASCII then. Thread-safe.
DIP_API bool dip_utf8_mend(char *text);

#ifdef __cplusplus
}
#endif

#endif
