// Taking PNG files apart, without the code that made them.
#ifndef DIP_TESTS_APP_PREVIEW_PNG_PARTS_H
#define DIP_TESTS_APP_PREVIEW_PNG_PARTS_H

#include <stdbool.h>
#include <stddef.h>

// Reads a whole file into *bytes, which the caller frees. Fails the test if it is not a PNG file
// whose chunks all have the right checksum.
void png_read(const char *file, unsigned char **bytes, size_t *size_bytes);

// Copies the text of a keyword. Returns false if the PNG has no such text.
bool png_text(const unsigned char *bytes, size_t size_bytes, const char *keyword, char *text,
              size_t room);

// Removes all texts. Returns the new size.
size_t png_strip_texts(unsigned char *bytes, size_t size_bytes);

#endif
