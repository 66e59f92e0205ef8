// Fuzzes the reader of binary camera paths (.bth).
#include "campaths/campath.h"
#include "tests/fuzz/check_path.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    if (size_bytes > 0 && bytes[0] != 0x89) {
        return -1; // A text path, which fuzz_pth.c reads.
    }
    check_path(bytes, size_bytes);
    return 0;
}

#ifdef FUZZ_WITH_LIBFUZZER
// Three times of four, cuts the file to whole keys and writes their number into the header, because
// a file whose size contradicts its header is refused at once.
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size_bytes, size_t most_bytes,
                               unsigned seed) {
    size_t size = LLVMFuzzerMutate(bytes, size_bytes, most_bytes);
    if (seed % 4 != 0 && size >= DIP_CAMPATH_HEADER_BYTES + DIP_CAMPATH_KEY_BYTES) {
        const size_t count = (size - DIP_CAMPATH_HEADER_BYTES) / DIP_CAMPATH_KEY_BYTES;
        size = DIP_CAMPATH_HEADER_BYTES + count * DIP_CAMPATH_KEY_BYTES;
        for (int i = 0; i < 4; i++) {
            bytes[12 + i] = (uint8_t)(count >> (8 * i));
        }
    }
    return size;
}
#endif
