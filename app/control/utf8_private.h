// Checks and mends UTF-8.
#ifndef DIP_APP_CONTROL_UTF8_PRIVATE_H
#define DIP_APP_CONTROL_UTF8_PRIVATE_H

#include <stddef.h>

// Returns the length in bytes of the longest beginning of a text that is UTF-8. Surrogates, code
// points beyond 0x10ffff and encodings that are longer than necessary are not UTF-8.
size_t dip_utf8_valid_bytes(const char *text, size_t length);

// Replaces each byte that does not belong to UTF-8 by '?'. Messages that were cut need this.
void dip_utf8_mend(char *text);

#endif
