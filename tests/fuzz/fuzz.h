// What the fuzzers share. A fuzzer is one file, fuzz_<reader>.c, with the entry point of libFuzzer:
// a function that gives any bytes to a reader and checks what the reader promises. The preset
// `fuzz` links the file with libFuzzer, which invents inputs and keeps those that reach new code.
// All other builds link it with replay.c, which reads the inputs in tests/fuzz/corpus/.
#ifndef DIP_TESTS_FUZZ_FUZZ_H
#define DIP_TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Names and signatures are libFuzzer's. TestOneInput returns 0, or -1 for an input that is not
// worth keeping. Initialize and CustomMutator are optional; CustomMutator exists only in libFuzzer.
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes);
int LLVMFuzzerInitialize(int *argc, char ***argv);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size_bytes, size_t most_bytes, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t size_bytes, size_t most_bytes);

// A promise of the reader. If it is broken, prints it and aborts, which libFuzzer reports as a
// finding.
#define FUZZ_CHECK(promise)                                                                        \
    ((promise) ? (void)0 : fuzz_broken_promise(#promise, __FILE__, __LINE__))
_Noreturn void fuzz_broken_promise(const char *promise, const char *file, int line);

// Returns the path of a file with this name in a folder of this process. The folder is made in
// TMPDIR or /tmp by the first call, and removed with its files when the process exits. The text is
// valid until the next call but three.
const char *fuzz_path(const char *name);

// Writes such a file and returns its path.
const char *fuzz_write(const char *name, const void *bytes, size_t size_bytes);

// Copies bytes to an array of exactly their size, so that the address sanitizer notices every
// read beyond them. A zero byte is added if `ended`. The caller frees the array.
uint8_t *fuzz_copy(const void *bytes, size_t size_bytes, bool ended);

// True if both numbers are equal, or both are NaN.
bool fuzz_same_number(double a, double b);

#endif
