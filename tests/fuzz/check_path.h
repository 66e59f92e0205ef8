// The check that the fuzzers of both formats of camera paths share.
#ifndef DIP_TESTS_FUZZ_CHECK_PATH_H
#define DIP_TESTS_FUZZ_CHECK_PATH_H

#include <stddef.h>
#include <stdint.h>

// Parses a camera path. If it is accepted, checks that it is the same after it was saved and loaded
// in either format, and that its poses are finite and its orientations of unit length.
void check_path(const uint8_t *bytes, size_t size_bytes);

#endif
