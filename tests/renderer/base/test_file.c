// Tests reading whole files, and which files are refused.
#include "renderer/base/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char name[] = "test_file.bytes";

static void write_bytes(const char *bytes, size_t size_bytes) {
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size_bytes, out), size_bytes);
    fclose(out);
}

static void a_file_is_read_whole_and_terminated(void **state) {
    (void)state;
    unsigned char *bytes;
    size_t size_bytes;
    write_bytes("a\0b\r\n", 5);
    assert_true(dip_file_read(name, "test", 5, &bytes, &size_bytes, NULL));
    assert_int_equal(size_bytes, 5);
    assert_memory_equal(bytes, "a\0b\r\n", 6);
    free(bytes);
    write_bytes("", 0);
    assert_true(dip_file_read(name, "test", 0, &bytes, &size_bytes, NULL));
    assert_int_equal(size_bytes, 0);
    assert_int_equal(bytes[0], 0);
    free(bytes);
    remove(name);
}

static void refuse(const char *file, size_t max_bytes, DipErrorCode code, const char *message) {
    DipError err = {0};
    unsigned char *bytes = (unsigned char *)name;
    size_t size_bytes;
    assert_false(dip_file_read(file, "camera path", max_bytes, &bytes, &size_bytes, &err));
    assert_null(bytes);
    assert_int_equal(err.code, code);
    assert_string_equal(err.file, file);
    assert_non_null(strstr(err.message, message));
}

static void errors_name_the_file_that_cannot_be_read(void **state) {
    (void)state;
    refuse("none/there", 10, DIP_ERROR_MISSING, "cannot open camera path: ");
    refuse(".", 10, DIP_ERROR_IO, "camera path is not a file");
    refuse("/dev/zero", 10, DIP_ERROR_IO, "camera path is not a file"); // an endless file
    write_bytes("12345", 5);
    refuse(name, 4, DIP_ERROR_OVERSIZED, "camera path file has 5 bytes, accepted at most 4");
    remove(name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_read_whole_and_terminated),
        cmocka_unit_test(errors_name_the_file_that_cannot_be_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
