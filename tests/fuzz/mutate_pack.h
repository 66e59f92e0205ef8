// Mutates scene packs for the fuzzers.
#ifndef DIP_TESTS_FUZZ_MUTATE_PACK_H
#define DIP_TESTS_FUZZ_MUTATE_PACK_H

#include <stddef.h>
#include <stdint.h>

// Changes a pack of size_bytes within its room of most_bytes. Afterwards mends the size in the
// pack's header, because the reader refuses every other pack at once. Returns the new size. Only
// builds with libFuzzer have this function.
size_t mutate_pack(uint8_t *bytes, size_t size_bytes, size_t most_bytes, unsigned seed);

#endif
