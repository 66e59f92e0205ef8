// Tests what a form writes for a terminal and for a page.
#include "app/report/format/form.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

static char *written;
static size_t size;

static DipForm begin(bool is_page) {
    const DipForm form = {.out = open_memstream(&written, &size), .is_page = is_page};
    assert_non_null(form.out);
    return form;
}

static void expect(DipForm *form, const char *expected) {
    dip_form_end(form);
    fclose(form->out);
    assert_string_equal(written, expected);
    free(written);
}

// A list of settings has no blanks. A page breaks it behind a comma, and copies it without breaks.
static void facts_break_between_settings(void **state) {
    (void)state;
    DipForm page = begin(true);
    dip_form_fact(&page, "Next better", "%s: +1.0 ms, <b>; fits", "aa=8,af=16,taa=on");
    dip_form_fact(&page, "Fits", "with %d %%,", 99);
    expect(&page, "<dl class=\"facts\">\n"
                  "<div><dt>Next better</dt><dd>aa=8,<wbr>af=16,<wbr>taa=on: +1.0 ms, "
                  "&lt;b&gt;; fits</dd></div>\n"
                  "<div><dt>Fits</dt><dd>with 99 %,</dd></div>\n"
                  "</dl>\n");
    DipForm terminal = begin(false);
    dip_form_fact(&terminal, "Next better", "%s: +1.0 ms", "aa=8,af=16,taa=on");
    expect(&terminal, "  Next better    aa=8,af=16,taa=on: +1.0 ms\n");
}

// Lines have at most 100 characters and are broken at blanks, but not between a number and its %.
static void a_terminal_has_lines_of_100_characters(void **state) {
    (void)state;
    char text[300] = "", expected[400] = "";
    for (int i = 0; i < 20; i++) {
        strcat(text, i ? " words" : "words");
        strcat(expected, i == 0 ? "words" : i == 16 ? "\nwords" : " words");
    }
    DipForm form = begin(false);
    dip_form_paragraph(&form, NULL, "%s", text);
    expect(&form, strcat(expected, "\n"));
    char line[101];
    memset(line, 'x', sizeof line);
    line[96] = '\0';
    form = begin(false);
    dip_form_paragraph(&form, NULL, "%s 50 %%", line);
    snprintf(expected, sizeof expected, "%s\n50 %%\n", line);
    expect(&form, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facts_break_between_settings),
        cmocka_unit_test(a_terminal_has_lines_of_100_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
