// Reads, writes and mends UTF-8.
#include "renderer/base/utf8.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

static void every_code_point_is_read_as_it_was_written(void **state) {
    (void)state;
    for (uint32_t code = 0; code <= 0x10ffff; code++) {
        char bytes[DIP_UTF8_MOST_BYTES + 1] = "";
        uint32_t found = 1;
        const size_t length = dip_utf8_write(code, bytes);
        const bool surrogate = code >= 0xd800 && code <= 0xdfff;
        assert_int_equal(dip_utf8_read(bytes, length, &found), surrogate ? 0 : length);
        assert_int_equal(found, surrogate ? 1 : code);
        assert_int_equal(dip_utf8_read(bytes, length - 1, &found), 0);
    }
}

static void texts_that_are_not_utf8_are_refused(void **state) {
    (void)state;
    static const char *const wrong[] = {
        "\x80",
        "\xbf",
        "\xc0\x80",
        "\xc1\xbf",
        "\xc3",
        "\xc3(",
        "\xe0\x9f\xbf",
        "\xed\xa0\x80",
        "\xe2\x82",
        "\xf0\x8f\xbf\xbf",
        "\xf4\x90\x80\x80",
        "\xf5\x80\x80\x80",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        uint32_t code;
        assert_int_equal(dip_utf8_read(wrong[i], DIP_UTF8_MOST_BYTES, &code), 0);
        assert_int_equal(dip_utf8_valid_bytes(wrong[i], strlen(wrong[i])), 0);
    }
    assert_int_equal(dip_utf8_valid_bytes("a\xc3\xa9\xff", 4), 3);
    assert_int_equal(dip_utf8_valid_bytes("a\0b", 3), 3);
}

static void wrong_bytes_are_mended(void **state) {
    (void)state;
    char text[] = "a\xff\xc3\xa9\xe2\x82";
    char ascii[] = "plain\xff";
    assert_false(dip_utf8_mend(text));
    assert_string_equal(text, "a?\xc3\xa9??");
    assert_true(dip_utf8_mend(ascii));
    assert_string_equal(ascii, "plain?");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_point_is_read_as_it_was_written),
        cmocka_unit_test(texts_that_are_not_utf8_are_refused),
        cmocka_unit_test(wrong_bytes_are_mended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
