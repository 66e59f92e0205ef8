// Tests of the reader of requests: what it accepts, and what it says about everything else.
#include "app/control/request.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static DipControlRequest request;
static DipError err;

static bool reads(const char *line) {
    memset(&err, 0, sizeof err);
    return dip_control_request_read(line, strlen(line), &request, &err);
}

static void assert_reads(const char *line) {
    if (!reads(line)) {
        fail_msg("%s: [%s] %s", line, err.key, err.message);
    }
}

static void fields_arrive_in_the_request(void **state) {
    (void)state;
    assert_reads("{\"id\":7,\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4\"}");
    assert_int_equal(request.id.kind, DIP_CONTROL_ID_NUMBER);
    assert_true(request.id.number == 7.0);
    assert_int_equal(request.verb, DIP_CONTROL_SET);
    assert_int_equal(request.panes, DIP_CONTROL_PANE_REQUESTED);
    assert_string_equal(request.settings, "aa=4");
    assert_string_equal(request.change, "");
    assert_reads("{\"request\":\"set\",\"pane\":[\"requested\",\"current\"],\"change\":\"x\"}");
    assert_int_equal(request.panes, DIP_CONTROL_PANE_CURRENT | DIP_CONTROL_PANE_REQUESTED);
    assert_int_equal(request.id.kind, DIP_CONTROL_ID_NONE);
    assert_reads("{\"id\":\"\\u00e9\",\"request\":\"seek\",\"time_s\":2.25}");
    assert_string_equal(request.id.text, "\xc3\xa9");
    assert_true(request.time_s == 2.25);
    assert_reads("{\"request\":\"size\",\"height\":220,\"width\":192}");
    assert_int_equal(request.width, 192);
    assert_int_equal(request.height, 220);
    assert_reads("{\"request\":\"subscribe\",\"to\":[\"times\",\"picks\",\"times\"]}");
    assert_int_equal(request.topics, 1u << DIP_CONTROL_TOPIC_TIMES | 1u << DIP_CONTROL_TOPIC_PICKS);
    assert_reads("{\"request\":\"get\",\"what\":\"steps\"}\r");
    assert_int_equal(request.parts, 1u << DIP_CONTROL_PART_STEPS);
    assert_reads("{\"request\":\"get\"}");
    assert_int_equal(request.parts, 1u << DIP_CONTROL_PART_STATE | 1u << DIP_CONTROL_PART_SETTINGS |
                                        1u << DIP_CONTROL_PART_TIMES |
                                        1u << DIP_CONTROL_PART_ERRORS);
    assert_reads("{\"request\":\"screenshot\",\"file\":\"a b/\\\\u0000.png\"}");
    assert_string_equal(request.file, "a b/\\u0000.png");
}

// Each line breaks one rule. `key` is the field that the message names.
static const struct {
    const char *line;
    DipErrorCode code;
    const char *key;
    const char *says; // A part of the message.
} bad_lines[] = {
    {"", DIP_ERROR_MISSING, "line", "empty"},
    {" \t", DIP_ERROR_MISSING, "line", "empty"},
    {"\r", DIP_ERROR_MISSING, "line", "empty"},
    {"hello", DIP_ERROR_FORMAT, "line", "no JSON at byte 0"},
    {"{", DIP_ERROR_FORMAT, "line", "no JSON"},
    {"{\"request\":\"apply\"}x", DIP_ERROR_FORMAT, "line", "no JSON at byte 19"},
    {"{\"request\":\"apply\"},", DIP_ERROR_FORMAT, "line", "no JSON"},
    {"{'request':'apply'}", DIP_ERROR_FORMAT, "line", "no JSON"},
    {"{\"request\":\"\x01\"}", DIP_ERROR_FORMAT, "line", "control character at byte 12"},
    {"{\"request\":\"a\\u0000\"}", DIP_ERROR_FORMAT, "line", "\\u0000 at byte 13"},
    {"{\"request\":\"\xff\"}", DIP_ERROR_FORMAT, "line", "not UTF-8 at byte 12"},
    {"{\"request\":\"\xc0\x80\"}", DIP_ERROR_FORMAT, "line", "not UTF-8"},
    {"{\"request\":\"\xe0\x80\xaf\"}", DIP_ERROR_FORMAT, "line", "not UTF-8"},
    {"{\"request\":\"\xed\xa0\x80\"}", DIP_ERROR_FORMAT, "line", "not UTF-8"},
    {"{\"request\":\"\xf4\x90\x80\x80\"}", DIP_ERROR_FORMAT, "line", "not UTF-8"},
    {"{\"request\":\"\xe2\x82\"}", DIP_ERROR_FORMAT, "line", "not UTF-8"},
    {"[]", DIP_ERROR_TYPE, "line", "an array found"},
    {"3", DIP_ERROR_TYPE, "line", "3 found"},
    {"null", DIP_ERROR_TYPE, "line", "null found"},
    {"{}", DIP_ERROR_MISSING, "request", "accepted set apply"},
    {"{\"Request\":\"apply\"}", DIP_ERROR_MISSING, "request", "missing"},
    {"{\"request\":\"Apply\"}", DIP_ERROR_UNKNOWN, "request", "'Apply' is no request"},
    {"{\"request\":{\"a\":1}}", DIP_ERROR_TYPE, "request", "an object found"},
    {"{\"request\":\"apply\",\"request\":\"quit\"}", DIP_ERROR_CONFLICT, "request", "twice"},
    {"{\"id\":1,\"id\":1,\"request\":\"quit\"}", DIP_ERROR_CONFLICT, "id", "twice"},
    {"{\"id\":1.5,\"request\":\"quit\"}", DIP_ERROR_TYPE, "id", "1.5 found"},
    {"{\"id\":1e300,\"request\":\"quit\"}", DIP_ERROR_RANGE, "id", "2^53"},
    {"{\"id\":1e999,\"request\":\"quit\"}", DIP_ERROR_RANGE, "id", "2^53"},
    {"{\"id\":[],\"request\":\"quit\"}", DIP_ERROR_TYPE, "id", "an array found"},
    {"{\"id\":\"\",\"request\":\"quit\"}", DIP_ERROR_MISSING, "id", "empty text"},
    {"{\"request\":\"quit\",\"pane\":\"current\"}", DIP_ERROR_UNKNOWN, "pane",
     "no field of the request quit, accepted id request"},
    {"{\"request\":\"quit\",\"\":1}", DIP_ERROR_UNKNOWN, "", "no field"},
    {"{\"request\":\"seek\"}", DIP_ERROR_MISSING, "time_s", "missing from the request seek"},
    {"{\"request\":\"seek\",\"time_s\":1,\"time_s\":1}", DIP_ERROR_CONFLICT, "time_s", "twice"},
    {"{\"request\":\"seek\",\"time_s\":-0.5}", DIP_ERROR_RANGE, "time_s", "accepted 0..86400"},
    {"{\"request\":\"seek\",\"time_s\":1e999}", DIP_ERROR_RANGE, "time_s", "inf is out of range"},
    {"{\"request\":\"seek\",\"time_s\":true}", DIP_ERROR_TYPE, "time_s", "a truth value found"},
    {"{\"request\":\"size\",\"width\":0,\"height\":9}", DIP_ERROR_RANGE, "width", "1..8192"},
    {"{\"request\":\"size\",\"width\":9,\"height\":9.5}", DIP_ERROR_TYPE, "height", "9.5 found"},
    {"{\"request\":\"size\",\"width\":9}", DIP_ERROR_MISSING, "height", "missing"},
    {"{\"request\":\"pick\",\"x\":8192,\"y\":0}", DIP_ERROR_RANGE, "x", "0..8191"},
    {"{\"request\":\"set\",\"change\":\"aa=2\"}", DIP_ERROR_MISSING, "pane", "missing"},
    {"{\"request\":\"set\",\"pane\":\"both\",\"change\":\"aa=2\"}", DIP_ERROR_UNKNOWN, "pane",
     "accepted current requested"},
    {"{\"request\":\"set\",\"pane\":[],\"change\":\"aa=2\"}", DIP_ERROR_MISSING, "pane",
     "empty array"},
    {"{\"request\":\"set\",\"pane\":[\"current\",1],\"change\":\"aa=2\"}", DIP_ERROR_TYPE, "pane",
     "1 found"},
    {"{\"request\":\"set\",\"pane\":\"current\"}", DIP_ERROR_MISSING, "settings", "either"},
    {"{\"request\":\"set\",\"pane\":\"current\",\"change\":\"aa=2\",\"settings\":\"aa=2\"}",
     DIP_ERROR_CONFLICT, "settings", "either"},
    {"{\"request\":\"set\",\"pane\":\"current\",\"settings\":\"\"}", DIP_ERROR_MISSING, "settings",
     "1 to 511 bytes"},
    {"{\"request\":\"set\",\"pane\":\"current\",\"settings\":\"aa=3\"}", DIP_ERROR_UNKNOWN, "aa",
     "none|2|4|6|8"},
    {"{\"request\":\"set\",\"pane\":\"current\",\"settings\":\"asd=4\"}", DIP_ERROR_CONFLICT, "asd",
     "aa="},
    {"{\"request\":\"subscribe\",\"to\":\"time\"}", DIP_ERROR_UNKNOWN, "to", "times errors"},
    {"{\"request\":\"get\",\"what\":{\"a\":[]}}", DIP_ERROR_TYPE, "what", "an object found"},
};

static void bad_lines_name_the_field_and_what_is_accepted(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad_lines / sizeof *bad_lines; ++i) {
        if (reads(bad_lines[i].line)) {
            fail_msg("%s is accepted", bad_lines[i].line);
        }
        if (err.code != bad_lines[i].code || strcmp(err.key, bad_lines[i].key) != 0 ||
            !strstr(err.message, bad_lines[i].says)) {
            fail_msg("%s: %s [%s] %s", bad_lines[i].line, dip_error_code_name(err.code), err.key,
                     err.message);
        }
    }
}

static void a_refused_request_still_has_its_id(void **state) {
    (void)state;
    assert_false(reads("{\"request\":\"fly\",\"id\":9007199254740992}"));
    assert_int_equal(request.id.kind, DIP_CONTROL_ID_NUMBER);
    assert_true(request.id.number == 9007199254740992.0);
    assert_false(reads("{\"id\":\"a\",\"request\":\"seek\",\"time_s\":[]}"));
    assert_string_equal(request.id.text, "a");
    assert_false(reads("{\"id\":1,\"id\":2,\"request\":\"quit\"}"));
    assert_int_equal(request.id.kind, DIP_CONTROL_ID_NONE);
}

static char *repeated(const char *begin, char byte, size_t count, const char *end) {
    char *line = malloc(strlen(begin) + count + strlen(end) + 1);
    assert_non_null(line);
    char *to = line + sprintf(line, "%s", begin);
    memset(to, byte, count);
    strcpy(to + count, end);
    return line;
}

static void lengths_and_depths_are_limited(void **state) {
    (void)state;
    char *line = repeated("{\"request\":\"apply\"", ' ', DIP_CONTROL_MAX_LINE_BYTES - 19, "}\r");
    assert_reads(line);
    free(line);
    line = repeated("{\"request\":\"apply\"", ' ', DIP_CONTROL_MAX_LINE_BYTES - 18, "}");
    assert_false(reads(line));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    free(line);
    line = repeated("", '[', DIP_CONTROL_MAX_LINE_BYTES, "");
    assert_false(reads(line));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
    free(line);
    line = repeated("{\"request\":\"screenshot\",\"file\":\"", 'f', DIP_CONTROL_FILE_SIZE, "\"}");
    assert_false(reads(line));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    assert_string_equal(err.key, "file");
    free(line);
    line = repeated("{\"request\":\"", 'r', 60000, "\"}");
    assert_false(reads(line));
    assert_non_null(strstr(err.message, "...' is no request"));
    free(line);
    // The text is cut after 40 bytes, but not within a letter.
    line = repeated("{\"request\":\"", 'r', 39, "\xc3\xa4\"}");
    assert_false(reads(line));
    assert_non_null(strstr(err.message, "rr...' is no request"));
    free(line);
}

// Bytes after a zero byte are part of the line.
static void a_zero_byte_is_refused(void **state) {
    (void)state;
    static const char line[] = "{\"request\":\"apply\"}\0garbage";
    assert_false(dip_control_request_read(line, sizeof line - 1, &request, &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
}

static void a_change_keeps_the_other_settings(void **state) {
    (void)state;
    DipQuality quality, expected;
    assert_true(dip_quality_parse("aa=4,aaa=on,asd=2,af=16", &quality, NULL));
    assert_true(dip_control_change_settings(&quality, "af=2,taa=on", &quality, NULL));
    assert_true(dip_quality_parse("aa=4,aaa=on,asd=2,af=2,taa=on", &expected, NULL));
    assert_memory_equal(&quality, &expected, sizeof quality);
    static const char *const refused[] = {"aa=6,asd=4", "a=4", "aa", "aa=4,aa=8", "af=3", ",", "="};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
        assert_false(dip_control_change_settings(&quality, refused[i], &quality, &err));
        assert_memory_equal(&quality, &expected, sizeof quality);
    }
    // asd=2 does not fit one sample; the change must name asd, too.
    assert_false(dip_control_change_settings(&quality, "aa=none", &quality, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_true(dip_control_change_settings(&quality, "aa=none,asd=1", &quality, NULL));
    // All settings at once.
    char all[256];
    dip_quality_format(&expected, all, sizeof all);
    assert_true(dip_control_change_settings(&quality, all, &quality, NULL));
    assert_memory_equal(&quality, &expected, sizeof quality);
}

// A change of the greatest length is parsed; one that does not fit beside the other settings is
// refused. A text of commas is parsed and refused for another reason.
static void a_change_has_a_greatest_length(void **state) {
    (void)state;
    static char change[2 * DIP_CONTROL_TEXT_SIZE];
    DipQuality quality;
    DipError fault = {0};
    assert_true(dip_quality_parse("aa=4", &quality, NULL));
    memset(change, ',', DIP_CONTROL_TEXT_SIZE - 1);
    assert_false(dip_control_change_settings(&quality, change, &quality, &fault));
    assert_int_not_equal(fault.code, DIP_ERROR_OVERSIZED);
    memset(change, ',', sizeof change - 1);
    assert_false(dip_control_change_settings(&quality, change, &quality, &fault));
    assert_int_equal(fault.code, DIP_ERROR_OVERSIZED);
    assert_string_equal(fault.key, "change");
    assert_string_equal(fault.message, "is a text of 1023 bytes, accepted at most 511");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_arrive_in_the_request),
        cmocka_unit_test(bad_lines_name_the_field_and_what_is_accepted),
        cmocka_unit_test(a_refused_request_still_has_its_id),
        cmocka_unit_test(lengths_and_depths_are_limited),
        cmocka_unit_test(a_zero_byte_is_refused),
        cmocka_unit_test(a_change_keeps_the_other_settings),
        cmocka_unit_test(a_change_has_a_greatest_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
