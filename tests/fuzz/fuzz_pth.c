// Fuzzes the reader of camera paths as text (.pth).
#include "tests/fuzz/check_path.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    if (size_bytes > 0 && bytes[0] == 0x89) {
        return -1; // A binary path, which fuzz_bth.c reads.
    }
    check_path(bytes, size_bytes);
    return 0;
}
