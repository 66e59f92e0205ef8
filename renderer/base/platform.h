// Refuses platforms on which Diptych could not keep its promise of equal bits.
//
// Tested platforms: x86-64 and i686 with SSE2, and aarch64; Linux with glibc or musl, and Windows
// with MinGW-w64; gcc and clang. `./test platforms` runs the tests on them.
#ifndef DIP_RENDERER_BASE_PLATFORM_H
#define DIP_RENDERER_BASE_PLATFORM_H

// The x87 unit rounds intermediate results to 64 bits, so floats would depend on the compiler's
// choice of registers.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "Diptych needs arithmetic in the precision of its types; for i686, add -msse2 -mfpmath=sse"
#endif

#if defined(__FAST_MATH__)
#error "Diptych needs IEEE 754 arithmetic; leave out -ffast-math and -Ofast"
#endif

// Pixels, hashes and binary files are read and written as little-endian words.
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "Diptych supports little-endian processors only"
#endif

#endif
