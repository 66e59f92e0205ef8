// FNV-1a's scheme, eight bytes at a time, with a fold that takes high bits down.
#include "renderer/base/hash.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

DipHash dip_hash_begin(void) {
    return (DipHash){{UINT64_C(0xcbf29ce484222325), UINT64_C(0x84222325cbf29ce4)}};
}

static void add(DipHash *hash, uint64_t word) {
    static const uint64_t primes[2] = {UINT64_C(0x100000001b3), UINT64_C(0x9e3779b97f4a7c15)};
    for (int i = 0; i < 2; i++) {
        hash->lanes[i] = (hash->lanes[i] ^ word) * primes[i];
        hash->lanes[i] ^= hash->lanes[i] >> 29;
    }
}

void dip_hash_bytes(DipHash *hash, const void *bytes, size_t size_bytes) {
    const unsigned char *at = bytes;
    while (size_bytes > 0) {
        const size_t taken = size_bytes < 8 ? size_bytes : 8;
        uint64_t word = 0;
        for (size_t i = 0; i < taken; i++) {
            word |= (uint64_t)at[i] << (8 * i); // little-endian on every host
        }
        add(hash, word);
        at += taken;
        size_bytes -= taken;
    }
}

void dip_hash_integer(DipHash *hash, int64_t value) {
    add(hash, (uint64_t)value);
}

void dip_hash_text(DipHash *hash, const char *text) {
    const size_t length = text ? strlen(text) : 0;
    dip_hash_integer(hash, (int64_t)length);
    dip_hash_bytes(hash, text, length);
}

void dip_hash_number(DipHash *hash, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    add(hash, bits);
}

void dip_hash_hex(const DipHash *hash, char hex[33]) {
    snprintf(hex, 33, "%016" PRIx64 "%016" PRIx64, hash->lanes[0], hash->lanes[1]);
}
