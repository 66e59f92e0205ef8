// The shipped hashes. `stability --print-hashes` prints the rows with the hashes of its build. A
// hash may change only together with a change that must change pictures.
#include "renderer/catalogue/shipped_hashes.h"

const StabilityHash stability_hashes[] = {
#include "renderer/catalogue/shipped_list.inc"
};

const size_t stability_hash_count = sizeof stability_hashes / sizeof *stability_hashes;
