// Tests the lists of names that messages end with.
#include "assets/model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void a_list_joins_and_quotes_each_name_once(void **state) {
    (void)state;
    DipNameList list = {.text = "none"};
    static const char *const names[] = {"Run", "Walk\nslowly", "Run", "none"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        dip_name_list_add(&list, names[i]);
    }
    assert_string_equal(dip_name_list_end(&list), "none, \"Run\", \"Walk slowly\", \"none\"");
    DipNameList empty = {.left_out = 0};
    assert_string_equal(dip_name_list_end(&empty), "");
    dip_name_list_add(&empty, "Sky");
    assert_string_equal(dip_name_list_end(&empty), "\"Sky\"");
}

// The text has 200 bytes, of which 24 are kept for the number of names that are left out. Names of
// 10 letters take 14 bytes with their quotes and the comma.
static void names_that_do_not_fit_are_counted(void **state) {
    (void)state;
    DipNameList list = {.left_out = 0};
    for (int i = 0; i < 1000000013; i += 1000000) {
        char name[16];
        snprintf(name, sizeof name, "%010d", i);
        dip_name_list_add(&list, name);
    }
    const char *text = dip_name_list_end(&list);
    char expected[200] = "\"0000000000\"";
    for (int i = 1; i < 12; ++i) {
        snprintf(expected + strlen(expected), sizeof expected - strlen(expected), ", \"%010d\"",
                 i * 1000000);
    }
    strcat(expected, " and 989 more");
    assert_string_equal(text, expected);
}

// Names of 70 bytes are whole, longer ones are cut.
static void long_names_are_cut(void **state) {
    (void)state;
    char name[101] = "";
    char expected[110];
    memset(name, 'n', 100);
    DipNameList list = {.left_out = 0};
    dip_name_list_add(&list, name);
    name[70] = '\0';
    dip_name_list_add(&list, name); // The same after the cut.
    snprintf(expected, sizeof expected, "\"%s\"", name);
    assert_string_equal(dip_name_list_end(&list), expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_list_joins_and_quotes_each_name_once),
        cmocka_unit_test(names_that_do_not_fit_are_counted),
        cmocka_unit_test(long_names_are_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
