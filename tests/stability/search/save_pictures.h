// Writes the pictures of a scene of the random search to files.
#ifndef DIP_TESTS_STABILITY_SEARCH_SAVE_PICTURES_H
#define DIP_TESTS_STABILITY_SEARCH_SAVE_PICTURES_H

#include "tests/stability/search/check.h"

// Draws the scene of the choices and writes NAME_fast.ppm, NAME_reference.ppm and
// NAME_difference.ppm, which has 16 times the difference in linear light. Returns false, after a
// message to stderr, if drawing or writing fails.
bool search_save_pictures(const SearchBench *bench, Choices *choices, const char *name);

#endif
