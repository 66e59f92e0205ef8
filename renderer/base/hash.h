// Names for content: 128-bit hashes of bytes. They guard against mistakes, not against forgery.
//
// Both lanes are FNV-1a with 64 bits (Fowler, Noll, Vo; draft-eastlake-fnv), byte by byte. Lane 0
// is the standard hash. Lane 1 starts from another basis and takes every byte inverted, so that the
// lanes are independent enough to stand side by side. The same bytes give the same hash on every
// machine. Functions are thread-safe on separate hashes.
#ifndef DIP_RENDERER_BASE_HASH_H
#define DIP_RENDERER_BASE_HASH_H

#include "renderer/base/api.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipHash {
    uint64_t lanes[2];
} DipHash;

enum { DIP_HASH_HEX_SIZE = 33 }; // bytes of the text of a hash, with its terminating zero

// Starts a hash. `variant` changes the start of lane 1 only; 0 unless hashes of different kinds of
// content must differ.
DIP_API DipHash dip_hash_begin(uint64_t variant);

DIP_API void dip_hash_bytes(DipHash *hash, const void *bytes, size_t size_bytes);

// Adds a text and its length, so that "ab", "c" differs from "a", "bc". NULL counts as "".
DIP_API void dip_hash_text(DipHash *hash, const char *text);

// Adds the eight bytes of a number, the lowest byte first on every machine.
DIP_API void dip_hash_integer(DipHash *hash, int64_t value);
DIP_API void dip_hash_number(DipHash *hash, double value);

// Writes 32 hexadecimal digits: lane 0, then lane 1.
DIP_API void dip_hash_hex(const DipHash *hash, char hex[DIP_HASH_HEX_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
