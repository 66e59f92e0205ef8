// Tests of options.h with a table that has one option of each kind and fills a struct of this test.
#include "app/cli/options.h"
#include "renderer/base/assert.h"
#include "renderer/scene/quality.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_NAMES = 3, MOST_NUMBERS = 4 };

typedef struct Fields {
    int guard; // Unused: in a row, offset 0 means "no such field".
    bool flag;
    const char *text;
    const char *names[MOST_NAMES];
    int name_count;
    bool has_count;
    int count;
    double share;
    DipOptionSize size;
    DipQuality settings;
    int numbers[MOST_NUMBERS];
    int number_count;
    int shape;
    bool has_shape;
    char letter;
} Fields;

typedef struct All {
    double other; // Keeps the options' fields from starting at offset 0.
    Fields fields;
} All;

#define FIELD(name) offsetof(Fields, name)

static bool read_letter(void *to, const DipOptionRow *row, const char *value, DipError *err) {
    ((Fields *)to)->letter = *value;
    return value[1] == '\0' ||
           dip_option_refuse(err, DIP_ERROR_TYPE, row->name, value, "one letter");
}

static const DipOptionRow first_rows[] = {
    {.name = "--flag", .text = "A.", .kind = DIP_OPTION_FLAG, .field = FIELD(flag)},
    {.name = "--text", .argument = "T", .kind = DIP_OPTION_TEXT, .field = FIELD(text)},
    {.name = "--name",
     .argument = "N",
     .kind = DIP_OPTION_TEXTS,
     .field = FIELD(names),
     .count = FIELD(name_count),
     .room = MOST_NAMES},
    {.name = "--count",
     .argument = "N",
     .kind = DIP_OPTION_INTEGER,
     .field = FIELD(count),
     .given = FIELD(has_count),
     .least = -2,
     .most = 12},
};

static const char *const shapes[] = {"round", "square"};

static const DipOptionRow second_rows[] = {
    {.name = "--share",
     .argument = "X",
     .kind = DIP_OPTION_NUMBER,
     .field = FIELD(share),
     .least = 0.5,
     .most = 1.0},
    {.name = "--size", .argument = "WxH", .kind = DIP_OPTION_SIZE, .field = FIELD(size)},
    {.name = "--settings",
     .argument = "SET",
     .kind = DIP_OPTION_SETTINGS,
     .field = FIELD(settings)},
    {.name = "--numbers",
     .argument = "LIST",
     .kind = DIP_OPTION_LIST,
     .field = FIELD(numbers),
     .count = FIELD(number_count),
     .room = MOST_NUMBERS,
     .item = DIP_OPTION_INTEGER,
     .least = -9,
     .most = 9,
     .separator = ':'},
    {.name = "--letter", .argument = "L", .kind = DIP_OPTION_CUSTOM, .read = read_letter},
    {"--shape", "S", DIP_OPTION_CHOICE, FIELD(shape), .given = FIELD(has_shape), .names = shapes,
     .most = 2, .accepted = "round or square"},
    {"--letters", "L", DIP_OPTION_CUSTOM, .separator = ',', .read = read_letter},
};

static const DipOptionTable first_table = {"First", first_rows, DIP_ARRAY_COUNT(first_rows)};
static const DipOptionTable second_table = {"Second", second_rows, DIP_ARRAY_COUNT(second_rows)};
static const DipOptionPart part_items[] = {{&first_table, offsetof(All, fields)},
                                           {&second_table, offsetof(All, fields)}};
static const DipOptionParts parts = {part_items, 2};

// Parses one option with one value; if `value` is NULL, there is no value. Returns the number of
// arguments used; 0 after a failure.
static int parse(const char *name, const char *value, All *all, DipError *err) {
    char *const argv[] = {(char *)"diptych", (char *)name, (char *)value};
    int index = 1;
    return dip_option_parse(&parts, "test", value ? 3 : 2, argv, &index, all, err) ? index : 0;
}

static void assert_refused(const char *name, const char *value, DipErrorCode code,
                           const char *message) {
    All all = {.other = 7.0};
    DipError err = {0};
    assert_int_equal(parse(name, value, &all, &err), 0);
    assert_int_equal(err.code, code);
    assert_int_equal(err.origin, DIP_ORIGIN_INPUT);
    assert_non_null(strstr(err.message, message));
}

static void each_kind_is_stored_in_its_field(void **state) {
    (void)state;
    All all = {.other = 7.0};
    DipError err = {0};
    Fields *fields = &all.fields;
    assert_int_equal(parse("--flag", NULL, &all, &err), 1);
    assert_true(fields->flag);
    assert_int_equal(parse("--text", "some", &all, &err), 2);
    assert_string_equal(fields->text, "some");
    assert_int_equal(parse("--count", "-2", &all, &err), 2);
    assert_int_equal(fields->count, -2);
    assert_true(fields->has_count);
    assert_int_equal(parse("--share", "0.75", &all, &err), 2);
    assert_true(fields->share == 0.75);
    assert_int_equal(parse("--size", "640x480", &all, &err), 2);
    assert_int_equal(fields->size.width, 640);
    assert_int_equal(fields->size.height, 480);
    assert_int_equal(parse("--settings", "aa=4,af=16", &all, &err), 2);
    assert_int_equal(dip_quality_sample_count(&fields->settings), 4);
    assert_int_equal(parse("--letter", "q", &all, &err), 2);
    assert_int_equal(fields->letter, 'q');
    assert_int_equal(parse("--letters", "a,b", &all, &err), 2);
    assert_int_equal(fields->letter, 'b');
    assert_int_equal(parse("--shape", "square", &all, &err), 2);
    assert_int_equal(fields->shape, 1);
    assert_true(fields->has_shape);
    assert_int_equal(fields->guard, 0);
    assert_true(all.other == 7.0);
}

static void value_can_follow_an_equals_sign(void **state) {
    (void)state;
    All all = {0};
    DipError err = {0};
    assert_int_equal(parse("--count=12", "next", &all, &err), 1);
    assert_int_equal(all.fields.count, 12);
    assert_int_equal(parse("--settings=aa=8", NULL, &all, &err), 1);
    assert_int_equal(dip_quality_sample_count(&all.fields.settings), 8);
}

static void repeated_texts_are_all_kept(void **state) {
    (void)state;
    All all = {0};
    DipError err = {0};
    assert_int_equal(parse("--name", "a", &all, &err), 2);
    assert_int_equal(parse("--name", "b", &all, &err), 2);
    assert_int_equal(parse("--name", "c", &all, &err), 2);
    assert_int_equal(all.fields.name_count, 3);
    assert_string_equal(all.fields.names[2], "c");
    assert_int_equal(parse("--name", "d", &all, &err), 0);
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "--name");
    assert_int_equal(all.fields.name_count, 3);
}

static void a_list_replaces_the_previous_list(void **state) {
    (void)state;
    All all = {0};
    DipError err = {0};
    assert_int_equal(parse("--numbers", "1:-2:3", &all, &err), 2);
    assert_int_equal(all.fields.number_count, 3);
    assert_int_equal(all.fields.numbers[1], -2);
    assert_int_equal(parse("--numbers", "4", &all, &err), 2);
    assert_int_equal(all.fields.number_count, 1);
    assert_int_equal(all.fields.numbers[0], 4);
    assert_int_equal(parse("--numbers", "1:2:3:4", &all, &err), 2);
}

static void bad_values_are_refused_with_what_is_accepted(void **state) {
    (void)state;
    assert_refused("--count", "13", DIP_ERROR_RANGE, "'13' is not a whole number from -2 to 12");
    assert_refused("--count", "-3", DIP_ERROR_RANGE, "'-3' is not");
    assert_refused("--count", "1.5", DIP_ERROR_RANGE, "'1.5' is not");
    assert_refused("--share", "0.4", DIP_ERROR_RANGE, "'0.4' is not a number from 0.5 to 1");
    assert_refused("--share", "nan", DIP_ERROR_RANGE, "'nan' is not");
    assert_refused("--size", "640", DIP_ERROR_RANGE, "'640' is not WIDTHxHEIGHT");
    assert_refused("--size", "640x480x1", DIP_ERROR_RANGE, "'640x480x1' is not WIDTHxHEIGHT");
    assert_refused("--size", "0x1", DIP_ERROR_RANGE, "'0x1' is not");
    assert_refused("--size", "1x8193", DIP_ERROR_RANGE, "'1x8193' is not");
    assert_refused("--settings", "aa=3", DIP_ERROR_UNKNOWN, "'3'");
    assert_refused("--letter", "qq", DIP_ERROR_TYPE, "'qq' is not one letter");
    assert_refused("--letters", "q,", DIP_ERROR_MISSING, "holds an empty value");
    assert_refused("--shape", "Square", DIP_ERROR_UNKNOWN, "'Square' is not round or square");
    assert_refused("--numbers", "1::2", DIP_ERROR_MISSING, "'1::2' holds an empty value");
    assert_refused("--numbers", "1:", DIP_ERROR_MISSING, "holds an empty value");
    assert_refused("--numbers", "1:2:3:4:5", DIP_ERROR_OVERSIZED, "more than 4 values");
    assert_refused("--numbers", "1:x", DIP_ERROR_RANGE, "'x' is not");
}

static void missing_and_unwanted_values_are_refused(void **state) {
    (void)state;
    assert_refused("--text", NULL, DIP_ERROR_MISSING, "needs a value: --text T");
    assert_refused("--text=", NULL, DIP_ERROR_MISSING, "needs a value");
    assert_refused("--text", "", DIP_ERROR_MISSING, "needs a value");
    assert_refused("--flag=on", NULL, DIP_ERROR_TYPE, "takes no value");
}

static void unknown_options_are_refused_with_a_suggestion(void **state) {
    (void)state;
    assert_refused("--sise", "1x1", DIP_ERROR_UNKNOWN, "did you mean --size?");
    assert_refused("--requested", "aa=2", DIP_ERROR_UNKNOWN, "`diptych test --help` lists");
    assert_refused("-x", NULL, DIP_ERROR_UNKNOWN, "is not an option of `diptych test`");
    char name[300];
    memset(name, '-', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_refused(name, NULL, DIP_ERROR_UNKNOWN, "is not an option");
}

static void options_are_found_by_name(void **state) {
    (void)state;
    const DipOptionPart *part = NULL;
    assert_ptr_equal(dip_option_find(&parts, "--size", &part), &second_rows[1]);
    assert_ptr_equal(part, &parts.items[1]);
    assert_null(dip_option_find(&parts, "--siz", &part));
    assert_null(dip_option_find(&parts, "--sizes", &part));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_is_stored_in_its_field),
        cmocka_unit_test(value_can_follow_an_equals_sign),
        cmocka_unit_test(repeated_texts_are_all_kept),
        cmocka_unit_test(a_list_replaces_the_previous_list),
        cmocka_unit_test(bad_values_are_refused_with_what_is_accepted),
        cmocka_unit_test(missing_and_unwanted_values_are_refused),
        cmocka_unit_test(unknown_options_are_refused_with_a_suggestion),
        cmocka_unit_test(options_are_found_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
