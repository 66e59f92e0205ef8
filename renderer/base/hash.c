// 128-bit hashes from two lanes of 64-bit FNV-1a.
#include "renderer/base/hash.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const uint64_t basis = UINT64_C(0xcbf29ce484222325);
static const uint64_t prime = UINT64_C(0x100000001b3);

DipHash dip_hash_begin(uint64_t variant) {
    return (DipHash){{basis, basis ^ variant}};
}

void dip_hash_bytes(DipHash *hash, const void *bytes, size_t size_bytes) {
    const uint8_t *at = bytes;
    uint64_t a = hash->lanes[0];
    uint64_t b = hash->lanes[1];
    for (size_t i = 0; i < size_bytes; i++) {
        a = (a ^ at[i]) * prime;
        b = (b ^ (uint8_t)~at[i]) * prime;
    }
    *hash = (DipHash){{a, b}};
}

void dip_hash_integer(DipHash *hash, int64_t value) {
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++) {
        bytes[i] = (uint8_t)((uint64_t)value >> (8 * i));
    }
    dip_hash_bytes(hash, bytes, sizeof bytes);
}

void dip_hash_text(DipHash *hash, const char *text) {
    const size_t length = text ? strlen(text) : 0;
    dip_hash_integer(hash, (int64_t)length);
    dip_hash_bytes(hash, text, length);
}

void dip_hash_number(DipHash *hash, double value) {
    int64_t bits;
    memcpy(&bits, &value, sizeof bits);
    dip_hash_integer(hash, bits);
}

void dip_hash_hex(const DipHash *hash, char hex[DIP_HASH_HEX_SIZE]) {
    snprintf(hex, DIP_HASH_HEX_SIZE, "%016" PRIx64 "%016" PRIx64, hash->lanes[0], hash->lanes[1]);
}
