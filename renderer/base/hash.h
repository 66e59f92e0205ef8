// 128-bit hashes that identify content. They guard against mistakes, not against forgery.
//
// A hash has two lanes, each a 64-bit FNV-1a of the bytes (Fowler, Noll, Vo; draft-eastlake-fnv).
// Lane 0 is the standard hash. Lane 1 inverts every byte before hashing it, and may start from
// another basis. So the two lanes are independent enough to be used together. The same bytes give
// the same hash on every machine. Several threads may call the functions at the same time on
// different hashes.
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

enum { DIP_HASH_HEX_SIZE = 33 }; // bytes of a hash's text, including the final zero

// Starts a hash. `variant` changes the basis of lane 1 and leaves lane 0 alone. Usually pass 0. If
// equal bytes of different kinds of content must get different hashes, pass a different number for
// each kind.
DIP_API DipHash dip_hash_begin(uint64_t variant);

// Adds size_bytes bytes to the hash.
DIP_API void dip_hash_bytes(DipHash *hash, const void *bytes, size_t size_bytes);

// Adds a text and its length. Adding "ab" and then "c" therefore results in another hash than
// adding "a" and then "bc". NULL counts as "".
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
