// Compares hashes with the published test vectors of FNV-1a, and tests which contents have
// different hashes. A hash has two lanes of 64 bits.
#include "renderer/base/hash.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

static DipHash hash_of(const char *bytes) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, bytes, strlen(bytes));
    return hash;
}

// These values are from the FNV authors' list of test vectors (isthe.com/chongo/tech/comp/fnv,
// FNV-1a, 64 bits).
static void lane_0_is_fnv_1a(void **state) {
    (void)state;
    assert_int_equal(hash_of("").lanes[0], UINT64_C(0xcbf29ce484222325));
    assert_int_equal(hash_of("a").lanes[0], UINT64_C(0xaf63dc4c8601ec8c));
    assert_int_equal(hash_of("foobar").lanes[0], UINT64_C(0x85944171f73967e8));
}

// Lane 1 is FNV-1a of the inverted bytes. The inverse of "a" is 0x9e, so lane 1 of "a" equals lane
// 0 of 0x9e.
static void lane_1_hashes_inverted_bytes(void **state) {
    (void)state;
    assert_int_equal(hash_of("a").lanes[1], hash_of("\x9e").lanes[0]);
    assert_int_equal(hash_of("foo").lanes[1], hash_of("\x99\x90\x90").lanes[0]);
}

static void a_variant_changes_only_lane_1(void **state) {
    (void)state;
    const DipHash plain = dip_hash_begin(0);
    const DipHash other = dip_hash_begin(1);
    assert_int_equal(plain.lanes[0], other.lanes[0]);
    assert_int_not_equal(plain.lanes[1], other.lanes[1]);
}

static void hashing_in_pieces_gives_the_same_hash(void **state) {
    (void)state;
    DipHash pieces = dip_hash_begin(0);
    const DipHash whole = hash_of("diptych");
    dip_hash_bytes(&pieces, "dip", 3);
    dip_hash_bytes(&pieces, "", 0);
    dip_hash_bytes(&pieces, "tych", 4);
    assert_memory_equal(&pieces, &whole, sizeof whole);
}

static void the_length_of_a_text_is_hashed_too(void **state) {
    (void)state;
    DipHash one = dip_hash_begin(0);
    DipHash other = dip_hash_begin(0);
    dip_hash_text(&one, "ab");
    dip_hash_text(&one, "c");
    dip_hash_text(&other, "a");
    dip_hash_text(&other, "bc");
    assert_int_not_equal(one.lanes[0], other.lanes[0]);
    DipHash null = dip_hash_begin(0);
    DipHash empty = dip_hash_begin(0);
    dip_hash_text(&null, NULL);
    dip_hash_text(&empty, "");
    assert_memory_equal(&null, &empty, sizeof null);
}

static void numbers_are_hashed_as_bytes_lowest_first(void **state) {
    (void)state;
    DipHash integer = dip_hash_begin(0);
    DipHash number = dip_hash_begin(0);
    DipHash bytes = dip_hash_begin(0);
    dip_hash_integer(&integer, INT64_C(0x3ff0000000000000)); // the bits of 1.0
    dip_hash_number(&number, 1.0);
    dip_hash_bytes(&bytes, "\0\0\0\0\0\0\xf0\x3f", 8);
    assert_memory_equal(&integer, &bytes, sizeof bytes);
    assert_memory_equal(&number, &bytes, sizeof bytes);
}

static void the_hexadecimal_text_has_both_lanes(void **state) {
    (void)state;
    char hex[DIP_HASH_HEX_SIZE];
    const DipHash hash = {{UINT64_C(0x0123456789abcdef), 10}};
    dip_hash_hex(&hash, hex);
    assert_string_equal(hex, "0123456789abcdef000000000000000a");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lane_0_is_fnv_1a),
        cmocka_unit_test(lane_1_hashes_inverted_bytes),
        cmocka_unit_test(a_variant_changes_only_lane_1),
        cmocka_unit_test(hashing_in_pieces_gives_the_same_hash),
        cmocka_unit_test(the_length_of_a_text_is_hashed_too),
        cmocka_unit_test(numbers_are_hashed_as_bytes_lowest_first),
        cmocka_unit_test(the_hexadecimal_text_has_both_lanes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
