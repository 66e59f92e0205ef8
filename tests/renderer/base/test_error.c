// Tests error.h and nearest.h: the origin and the text of errors, lists of errors, and the choice
// of the name that the user probably meant.
#include "renderer/base/error.h"
#include "renderer/base/nearest.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void origin_follows_from_the_code(void **state) {
    (void)state;
    DipError err;
    assert_false(dip_error_set(&err, DIP_ERROR_RANGE, NULL, 0, "--fps", "'0'"));
    assert_int_equal(err.origin, DIP_ORIGIN_INPUT);
    dip_error_set(&err, DIP_ERROR_IO, "none.ini", 0, NULL, "cannot be read");
    assert_int_equal(err.origin, DIP_ORIGIN_INPUT);
    dip_error_set(&err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    dip_error_set(&err, DIP_ERROR_RUNTIME, NULL, 0, NULL, "no display");
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
}

static void set_runtime_overrides_the_origin(void **state) {
    (void)state;
    DipError err;
    assert_false(dip_error_set_runtime(&err, DIP_ERROR_IO, "a.png", 0, NULL, "%s", "is full"));
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_string_equal(err.message, "is full");
    assert_false(dip_error_set_runtime(NULL, DIP_ERROR_IO, NULL, 0, NULL, "nobody listens"));
}

static void formatting_leaves_out_missing_fields(void **state) {
    (void)state;
    DipError err;
    char text[128];
    dip_error_set(&err, DIP_ERROR_RANGE, "a.ini", 3, "RES", "'x'");
    dip_error_format(&err, text, sizeof text);
    assert_string_equal(text, "a.ini:3: [RES] 'x'");
    dip_error_set(&err, DIP_ERROR_RANGE, "a.ini", 0, NULL, "'x'");
    assert_int_equal(dip_error_format(&err, text, sizeof text), strlen("a.ini: 'x'"));
    assert_string_equal(text, "a.ini: 'x'");
    err.severity = DIP_SEVERITY_WARNING;
    dip_error_format(&err, text, sizeof text);
    assert_string_equal(text, "a.ini: warning: 'x'");
}

static void over_long_names_keep_their_end(void **state) {
    (void)state;
    char name[400];
    DipError err;
    memset(name, 'a', sizeof name);
    strcpy(name + 390, "end.ini");
    dip_error_set(&err, DIP_ERROR_IO, name, 0, NULL, "cannot be read");
    assert_int_equal(strlen(err.file), sizeof err.file - 1);
    assert_non_null(strstr(err.file, "end.ini"));
}

static void list_counts_errors_apart_from_warnings(void **state) {
    (void)state;
    DipErrorList list = {0};
    DipError err;
    dip_error_set(&err, DIP_ERROR_RANGE, NULL, 0, NULL, "one");
    for (int i = 0; i < 20; i++) {
        err.severity = i % 2 ? DIP_SEVERITY_WARNING : DIP_SEVERITY_ERROR;
        dip_error_list_add(&list, &err);
    }
    assert_int_equal(list.count, 20);
    assert_int_equal(list.error_count, 10);
    dip_error_list_free(&list);
}

static void only_similar_names_are_likely(void **state) {
    (void)state;
    const char *const names[] = {"--frames", "--fps", "--hash"};
    assert_string_equal(dip_nearest_likely("--frmes", names, 3), "--frames");
    assert_string_equal(dip_nearest_likely("--HASH", names, 3), "--hash");
    assert_null(dip_nearest_likely("--requested", names, 3));
    assert_null(dip_nearest_likely("--hash", names, 0));
    assert_string_equal(dip_nearest_name("--requested", names, 3), "--frames");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(origin_follows_from_the_code),
        cmocka_unit_test(set_runtime_overrides_the_origin),
        cmocka_unit_test(formatting_leaves_out_missing_fields),
        cmocka_unit_test(over_long_names_keep_their_end),
        cmocka_unit_test(list_counts_errors_apart_from_warnings),
        cmocka_unit_test(only_similar_names_are_likely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
