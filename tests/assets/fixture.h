// Files for the tests of assets/: a folder of their own and small pictures to put there.
#ifndef DIP_TESTS_ASSETS_FIXTURE_H
#define DIP_TESTS_ASSETS_FIXTURE_H

#include <stddef.h>
#include <stdint.h>

// 2x2 pixels: red, green; blue, white with alpha 0. Made with zlib, not with the code under test.
extern const uint8_t fixture_png[76];

enum { FIXTURE_PATH = 512 };

// Set-up and tear-down of a group of tests: make the folder, remove it with its files.
int fixture_open(void **state);
int fixture_close(void **state);

// The path of a file in the folder; the buffer is reused after four calls.
const char *fixture_path(const char *name);
const char *fixture_data(const char *name); // of a file in tests/assets/data; likewise
void fixture_write(const char *name, const void *bytes, size_t size_bytes);
void fixture_write_text(const char *name, const char *text);
void fixture_copy(const char *data_name);

// An uncompressed TGA, 24 bits, top row first, every pixel the same grey.
void fixture_write_tga(const char *name, int width, int height, uint8_t grey);

// Reads a whole file, to be freed.
uint8_t *fixture_read(const char *path, size_t *size_bytes);

#endif
