// Names for content: 128 bits, from bytes. Guards against mistakes, is no protection against
// forgery.
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

DIP_API DipHash dip_hash_begin(void);
DIP_API void dip_hash_bytes(DipHash *hash, const void *bytes, size_t size_bytes);

// With its length, so that "ab", "c" is not "a", "bc". NULL is "".
DIP_API void dip_hash_text(DipHash *hash, const char *text);
DIP_API void dip_hash_integer(DipHash *hash, int64_t value);
DIP_API void dip_hash_number(DipHash *hash, double value);

// 32 hexadecimal digits.
DIP_API void dip_hash_hex(const DipHash *hash, char hex[33]);

#ifdef __cplusplus
}
#endif

#endif
