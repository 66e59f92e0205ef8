// Shrinks a failing scene of the random search.
#ifndef DIP_TESTS_STABILITY_SEARCH_SHRINK_H
#define DIP_TESTS_STABILITY_SEARCH_SHRINK_H

#include "tests/stability/search/check.h"

// Replaces the choices by the smallest sequence that it finds for which the same check fails. Of
// two sequences, the shorter one is smaller; of equally long ones, the one with the smaller first
// number that differs. Stops after 500 tries in a row without gain. Prints progress to stderr.
// *finding is the failure, and becomes the failure of the shrunk scene.
void search_shrink(const SearchBench *bench, Choices *choices, SearchFinding *finding);

#endif
