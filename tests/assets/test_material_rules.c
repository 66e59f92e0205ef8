// Tests the patterns that name materials against a recursive definition of what a pattern fits.
#include "assets/model_parts.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// The definition itself: `*` fits nothing, or one byte and whatever it fits after that.
static bool fits(const char *pattern, const char *name) {
    if (*pattern == '*') {
        return fits(pattern + 1, name) || (*name && fits(pattern, name + 1));
    }
    return *pattern == *name ? !*name || fits(pattern + 1, name + 1)
                             : *pattern == '?' && *name && fits(pattern + 1, name + 1);
}

// Writes the text number `index` over an alphabet, as digits of a number.
static void write_text(int index, int length, const char *alphabet, char *text) {
    const int size = (int)strlen(alphabet);
    for (int i = 0; i < length; ++i) {
        text[i] = alphabet[index % size];
        index /= size;
    }
    text[length] = '\0';
}

static void patterns_fit_what_their_definition_says(void **context) {
    (void)context;
    int yes = 0;
    for (int p_length = 0, p_count = 1; p_length <= 5; ++p_length, p_count *= 4) {
        for (int p = 0; p < p_count; ++p) {
            char pattern[8];
            write_text(p, p_length, "*?ab", pattern);
            for (int n_length = 0, n_count = 1; n_length <= 6; ++n_length, n_count *= 2) {
                for (int n = 0; n < n_count; ++n) {
                    char name[8];
                    write_text(n, n_length, "ab", name);
                    const bool expected = fits(pattern, name);
                    yes += expected;
                    if (dip_material_name_fits(pattern, name) != expected) {
                        fail_msg("'%s' fits '%s': expected %d", pattern, name, expected);
                    }
                }
            }
        }
    }
    assert_true(yes > 10000);
}

static void a_question_mark_is_one_character_of_utf_8(void **context) {
    (void)context;
    assert_true(dip_material_name_fits("Pool ?", "Pool \xc3\xa9"));
    assert_true(dip_material_name_fits("?x", "\xf0\x9f\x8c\x8ax"));
    assert_false(dip_material_name_fits("Pool ??", "Pool \xc3\xa9"));
    assert_false(dip_material_name_fits("pool *", "Pool \xc3\xa9"));
}

static void many_stars_take_little_time(void **context) {
    (void)context;
    char pattern[64];
    char name[1024];
    for (int i = 0; i < 62; i += 2) {
        memcpy(pattern + i, "*a", 2);
    }
    memcpy(pattern + 62, "b", 2);
    memset(name, 'a', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_false(dip_material_name_fits(pattern, name));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_fit_what_their_definition_says),
        cmocka_unit_test(a_question_mark_is_one_character_of_utf_8),
        cmocka_unit_test(many_stars_take_little_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
