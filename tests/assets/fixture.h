// Files for the tests of assets/: a temporary folder, and small pictures and copies to put there.
// Also loads models.
#ifndef DIP_TESTS_ASSETS_FIXTURE_H
#define DIP_TESTS_ASSETS_FIXTURE_H

#include "assets/model.h"

#include <stddef.h>
#include <stdint.h>

// 2x2 pixels: red, green; blue, white with alpha 0. Made with zlib, not with the code under test.
extern const uint8_t fixture_png[76];

enum { FIXTURE_PATH = 512 };

// Set-up and tear-down of a group of tests: create the folder, and remove it with its files.
int fixture_open(void **state);
int fixture_close(void **state);

// Returns the path of a file in the folder. The buffer is reused after four calls.
const char *fixture_path(const char *name);

// Returns the path of a file in tests/assets/data, in one of the same four buffers.
const char *fixture_data(const char *name);

// Each function writes a file into the folder. fixture_copy copies a file from tests/assets/data.
void fixture_write(const char *name, const void *bytes, size_t size_bytes);
void fixture_write_text(const char *name, const char *text);
void fixture_copy(const char *data_name);

// Writes an uncompressed TGA of 24 bits, top row first. All pixels have the same grey.
void fixture_write_tga(const char *name, int width, int height, uint8_t grey);

// Loads a model, or fails the running cmocka test with the message of the load. warnings may be
// NULL.
DipModel *fixture_load(const char *path, const DipModelOptions *options, DipErrorList *warnings);

// Returns the object of this name, or fails the running test.
const DipObjectDef *fixture_object(const DipSceneDef *def, const char *name);

// Reads a file of less than 1 MiB. The caller frees the array, which has room for one more byte.
uint8_t *fixture_read(const char *path, size_t *size_bytes);

#endif
