// Mutates scene packs: changes numbers at places where packs have numbers.
#include "tests/fuzz/mutate_pack.h"

#include "assets/pack/scene_pack_layout.h"
#include "tests/fuzz/fuzz.h"

#include <string.h>

#ifdef FUZZ_WITH_LIBFUZZER
static uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// Overwrites a number of 4 or 8 bytes with one that sits on a boundary, or adds a little to it.
static void change_number(uint8_t *bytes, size_t size_bytes, uint32_t *random) {
    static const uint64_t numbers[] = {
        0,          1,          2,          3,          64,         8192,           8193,
        0x7fffffff, 0x80000000, 0xffffffff, 0x7f7fffff, 0x7f800000, 0x7fc00000,     0x00000001,
        0x3f800000, 0xbf800000, 0x5f000000, 0x20000000, UINT64_MAX, UINT64_MAX / 2, 1u << 24};
    const size_t width = next_random(random) % 2 ? 8 : 4;
    const size_t at = next_random(random) % ((size_bytes - 8) / 4 + 1) * 4;
    uint64_t value = 0;
    memcpy(&value, bytes + at, width);
    const uint32_t choice = next_random(random) % (sizeof numbers / sizeof numbers[0] + 8);
    value = choice < sizeof numbers / sizeof numbers[0]
                ? numbers[choice]
                : value + (uint64_t)(int64_t)(next_random(random) % 129) - 64;
    memcpy(bytes + at, &value, width);
}

size_t mutate_pack(uint8_t *bytes, size_t size_bytes, size_t most_bytes, unsigned seed) {
    uint32_t random = seed;
    size_t size = size_bytes;
    if (size_bytes < sizeof(PackHeader) || next_random(&random) % 4 == 0) {
        size = LLVMFuzzerMutate(bytes, size_bytes, most_bytes);
    } else {
        for (uint32_t i = next_random(&random) % 3 + 1; i > 0; i--) {
            change_number(bytes, size_bytes, &random);
        }
    }
    if (size >= sizeof(PackHeader)) {
        const uint64_t total_bytes = size;
        memcpy(bytes + offsetof(PackHeader, total_bytes), &total_bytes, sizeof total_bytes);
    }
    return size;
}
#endif
