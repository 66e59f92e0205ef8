// Tests of the option tables of all commands. The parser reads every option of every command and
// refuses wrong values, and the help explains every option.
#include "app/cli/command_line.h"
#include "app/command_list.h"
#include "app/cost/options.h"
#include "app/cli/help.h"
#include "renderer/base/assert.h"

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MAX_WORDS = 16, TEXT_SIZE = 65536 };

// The arguments that each command needs at least.
static const char *const complete[] = {
    "preview",
    "dump --hash",
    "bench",
    "cost --out x",
    "cost merge --out x y",
    "cost diff x y",
    "cost advise x --budget-ms 8",
    "cost predict x",
    "path info x",
    "path convert x y.pth",
    "compare x y",
    "verify",
};

// Parses `words`, which are separated by blanks, and then the arguments `more` and `last` if they
// are not NULL.
static bool parse(const char *words, const char *more, const char *last, DipCommandLine *line,
                  DipError *err) {
    static char copy[512]; // Static, since options borrow their texts.
    char *argv[MAX_WORDS] = {(char *)"diptych"};
    int argc = 1;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " ")) {
        argv[argc++] = word;
    }
    argv[argc] = (char *)more;
    argc += more != NULL;
    argv[argc] = (char *)last;
    argc += last != NULL;
    return dip_command_line_parse(&dip_command_list, argc, argv, line, err);
}

static bool parses(const char *words) {
    DipCommandLine line;
    DipError err = {0};
    const bool parsed = parse(words, NULL, NULL, &line, &err);
    dip_command_line_free(&line);
    return parsed;
}

static void assert_refused(const char *words, const char *more, const char *last, DipErrorCode code,
                           const char *key) {
    DipCommandLine line;
    DipError err = {0};
    assert_false(parse(words, more, last, &line, &err));
    dip_command_line_free(&line);
    assert_int_equal(err.code, code);
    assert_string_equal(err.key, key);
    assert_int_equal(err.origin, DIP_ORIGIN_INPUT);
}

static char *read_back(FILE *file) {
    static char text[TEXT_SIZE];
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

// Calls `check` for every option of every command.
static void for_each_row(void (*check)(size_t command, const DipOptionRow *row)) {
    for (size_t c = 0; c < dip_command_list.count; c++) {
        const DipOptionParts *parts = dip_command_list.commands[c]->parts;
        for (size_t p = 0; p < parts->count; p++) {
            for (size_t r = 0; r < parts->items[p].table->count; r++) {
                check(c, &parts->items[p].table->rows[r]);
            }
        }
    }
}

static void every_command_is_found_by_its_name(void **state) {
    (void)state;
    assert_int_equal(dip_command_list.count, DIP_ARRAY_COUNT(complete));
    for (size_t c = 0; c < dip_command_list.count; c++) {
        DipCommandLine line;
        DipError err = {0};
        assert_true(parse(complete[c], NULL, NULL, &line, &err));
        assert_ptr_equal(line.command, dip_command_list.commands[c]);
        assert_true(line.named);
        dip_command_line_free(&line);
    }
}

// The program itself starts the hidden command.
static void the_hidden_command_is_found_but_not_listed(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse("import -- 1 2 -x.obj", NULL, NULL, &line, &err));
    assert_string_equal(line.command->name, "import");
    dip_command_line_free(&line);
    for (size_t c = 0; c < dip_command_list.count; c++) {
        assert_string_not_equal(dip_command_list.commands[c]->name, "import");
    }
}

static void preview_runs_when_no_command_is_named(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse("", NULL, NULL, &line, &err));
    assert_string_equal(line.command->name, "preview");
    assert_false(line.named);
    dip_command_line_free(&line);
    assert_true(parses("model.glb"));
    assert_true(parses("./model"));
    assert_true(parses("-- -model-"));
    assert_true(parses("--size 64x48 model.glb other.glb"));
}

static void check_value(size_t command, const DipOptionRow *row) {
    const char *words = complete[command];
    if (row->kind == DIP_OPTION_FLAG) {
        char with_value[80];
        snprintf(with_value, sizeof with_value, "%s=1", row->name);
        assert_refused(words, with_value, NULL, DIP_ERROR_TYPE, row->name);
        return;
    }
    assert_refused(words, row->name, NULL, DIP_ERROR_MISSING, row->name);
    assert_refused(words, row->name, "", DIP_ERROR_MISSING, row->name);
    if (row->kind == DIP_OPTION_INTEGER) {
        char beyond[40];
        snprintf(beyond, sizeof beyond, "%.0f", row->most + 1.0);
        assert_refused(words, row->name, beyond, DIP_ERROR_RANGE, row->name);
        snprintf(beyond, sizeof beyond, "%.0f", row->least - 1.0);
        assert_refused(words, row->name, beyond, DIP_ERROR_RANGE, row->name);
        assert_refused(words, row->name, "two", DIP_ERROR_RANGE, row->name);
    } else if (row->kind == DIP_OPTION_NUMBER || row->kind == DIP_OPTION_SIZE) {
        assert_refused(words, row->name, "-1", DIP_ERROR_RANGE, row->name);
        assert_refused(words, row->name, "1e9", DIP_ERROR_RANGE, row->name);
    } else if (row->kind == DIP_OPTION_SETTINGS) {
        assert_refused(words, row->name, "aa=3", DIP_ERROR_UNKNOWN, "aa");
        assert_refused(words, row->name, "asd=4", DIP_ERROR_CONFLICT, "asd");
    } else if (row->kind == DIP_OPTION_LIST) {
        char empty[] = {'8', row->separator, '\0'};
        DipCommandLine line;
        DipError err = {0};
        assert_false(parse(words, row->name, empty, &line, &err));
        dip_command_line_free(&line);
    }
}

static void every_option_refuses_bad_values(void **state) {
    (void)state;
    for_each_row(check_value);
}

static void check_words(size_t command, const DipOptionRow *row) {
    const DipOptionParts *parts = dip_command_list.commands[command]->parts;
    const DipOptionPart *part;
    const size_t length = strlen(row->text);
    assert_true(strncmp(row->name, "--", 2) == 0);
    assert_true(length > 8 && isupper((unsigned char)row->text[0]) && row->text[length - 1] == '.');
    assert_int_equal(row->argument == NULL, row->kind == DIP_OPTION_FLAG);
    // No two rows have the same name, so a search finds this row.
    assert_ptr_equal(dip_option_find(parts, row->name, &part), row);
}

static void every_option_is_explained_in_sentences(void **state) {
    (void)state;
    for_each_row(check_words);
}

static char *help_of(size_t command) {
    DipCommandLine line;
    DipError err = {0};
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(parse(dip_command_list.commands[command]->name, "--help", NULL, &line, &err));
    dip_help_print(&dip_command_list, &line, file);
    dip_command_line_free(&line);
    return read_back(file);
}

static void check_help(size_t command, const DipOptionRow *row) {
    char start[80];
    snprintf(start, sizeof start, "\n  %s%s%s\n", row->name, row->argument ? " " : "",
             row->argument ? row->argument : "");
    assert_non_null(strstr(help_of(command), start));
}

static void help_of_a_command_has_its_options(void **state) {
    (void)state;
    for_each_row(check_help);
}

static void help_fits_a_terminal_of_80_columns(void **state) {
    (void)state;
    for (size_t c = 0; c < dip_command_list.count; c++) {
        char *text = help_of(c);
        bool is_example = false;
        for (char *at = strtok(text, "\n"); at; at = strtok(NULL, "\n")) {
            // An example may be longer, since it must stay on one line to be copied.
            is_example = strncmp(at, "  diptych", 9) == 0;
            assert_true(is_example || strlen(at) <= 80);
            assert_true(at[strlen(at) - 1] != ' ');
        }
    }
}

static void check_manual(size_t command, const DipOptionRow *row) {
    (void)command;
    FILE *file = tmpfile();
    char start[80] = "\n.B \\-\\-";
    assert_non_null(file);
    dip_manual_print(&dip_command_list, file);
    size_t length = strlen(start);
    for (const char *from = row->name + 2; *from; from++) {
        length += (size_t)snprintf(start + length, sizeof start - length, "%s%c",
                                   *from == '-' ? "\\" : "", *from);
    }
    assert_non_null(strstr(read_back(file), start));
}

static void manual_has_every_option(void **state) {
    (void)state;
    for_each_row(check_manual);
}

// In roff, a line that begins with '.' or "'" is a request, and '"' groups the arguments of a
// macro.
static void manual_escapes_text(void **state) {
    (void)state;
    static const DipExample example = {"diptych say \"a;b\"", "says\n.a"};
    static const DipOptionParts no_parts = {0};
    static const DipCommand say = {.name = "say",
                                   .usage = "WORD",
                                   .text = ".b\n.c.\n'd\n\n.e",
                                   .examples = &example,
                                   .example_count = 1,
                                   .parts = &no_parts};
    static const DipCommand *const commands[] = {&say};
    FILE *file = tmpfile();
    assert_non_null(file);
    dip_manual_print(&(DipCommandList){.commands = commands, .count = 1}, file);
    const char *text = read_back(file);
    assert_non_null(strstr(text, "\n.SS diptych say\n\\&.b\n\\&.c.\n\\(aqd\n.PP\n\\&.e\n.PP\n"));
    assert_non_null(strstr(text, "\n.B diptych say \\(dqa;b\\(dq\nsays\n\\&.a\n"));
}

static void help_of_a_group_has_its_commands(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(parse("path -h", NULL, NULL, &line, &err));
    assert_string_equal(line.group, "path");
    dip_help_print(&dip_command_list, &line, file);
    dip_command_line_free(&line);
    const char *text = read_back(file);
    assert_non_null(strstr(text, "diptych path info FILE"));
    assert_non_null(strstr(text, "diptych path convert IN"));
}

static void mistyped_commands_are_refused(void **state) {
    (void)state;
    assert_refused("dmp", NULL, NULL, DIP_ERROR_UNKNOWN, "dmp");
    assert_refused("path", NULL, NULL, DIP_ERROR_MISSING, "path");
    assert_refused("path show x", NULL, NULL, DIP_ERROR_UNKNOWN, "path");
    assert_refused("cost mrge --out x", NULL, NULL, DIP_ERROR_UNKNOWN, "mrge");
    assert_refused("dump --hash stray", NULL, NULL, DIP_ERROR_UNKNOWN, "stray");
    assert_refused("path info a b", NULL, NULL, DIP_ERROR_UNKNOWN, "b");
    assert_refused("path info", NULL, NULL, DIP_ERROR_MISSING, "path info");
    assert_refused("path convert a", NULL, NULL, DIP_ERROR_MISSING, "path convert");
    assert_refused("path convert a b.txt", NULL, NULL, DIP_ERROR_UNKNOWN, "path convert");
    assert_refused("cost merge --out x", NULL, NULL, DIP_ERROR_MISSING, "cost merge");
}

static void help_needs_no_complete_command_line(void **state) {
    (void)state;
    assert_true(parses("dump --help"));
    assert_true(parses("cost --help"));
    assert_true(parses("path convert -h"));
    assert_true(parses("dump --version"));
}

// --quick changes defaults, wherever it stands; what is given holds.
static void quick_changes_what_is_not_given(void **state) {
    (void)state;
    DipCommandLine line;
    DipError err = {0};
    assert_true(parse("cost --samples 25 --out x --quick", NULL, NULL, &line, &err));
    const DipCostArguments *quick = line.options;
    assert_true(quick->cost.predict && quick->cost.places == 2 && quick->cost.samples == 25);
    assert_int_equal(quick->measure.starts * quick->measure.rounds, 6);
    dip_command_line_free(&line);
    assert_true(parse("cost --out x", NULL, NULL, &line, &err));
    const DipCostArguments *usual = line.options;
    assert_true(!usual->cost.predict && usual->cost.places == 3 && usual->cost.samples == 64);
    assert_int_equal(usual->measure.starts * usual->measure.rounds, 16);
    dip_command_line_free(&line);
}

// Options of this name mean different things, or are yet to be shared. Do not add to this list.
static bool may_stand_twice(const char *name) {
    static const char *const names[] = {
        "--csv", "--fps", "--frames", "--isa", "--json", "--out", "--sets", "--size", "--threads",
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(name, names[i]) == 0) {
            return true;
        }
    }
    return false;
}

// Compares a table with every other table of every command.
static void check_against_all(const DipOptionTable *table) {
    for (size_t c = 0; c < dip_command_list.count; c++) {
        const DipOptionParts *parts = dip_command_list.commands[c]->parts;
        for (size_t p = 0; p < parts->count; p++) {
            const DipOptionTable *other = parts->items[p].table;
            for (size_t i = 0; other != table && i < other->count * table->count; i++) {
                const char *a = table->rows[i % table->count].name;
                const char *b = other->rows[i / table->count].name;
                if (strcmp(a, b) == 0 && !may_stand_twice(a)) {
                    fail_msg("%s stands in the tables \"%s\" and \"%s\"", a, table->title,
                             other->title);
                }
            }
        }
    }
}

// One option is described once, so that its text, its range and its meaning are the same in every
// command.
static void an_option_stands_in_one_table(void **state) {
    (void)state;
    for (size_t c = 0; c < dip_command_list.count; c++) {
        const DipOptionParts *parts = dip_command_list.commands[c]->parts;
        for (size_t p = 0; p < parts->count; p++) {
            check_against_all(parts->items[p].table);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_command_is_found_by_its_name),
        cmocka_unit_test(the_hidden_command_is_found_but_not_listed),
        cmocka_unit_test(preview_runs_when_no_command_is_named),
        cmocka_unit_test(every_option_refuses_bad_values),
        cmocka_unit_test(every_option_is_explained_in_sentences),
        cmocka_unit_test(help_of_a_command_has_its_options),
        cmocka_unit_test(help_fits_a_terminal_of_80_columns),
        cmocka_unit_test(manual_has_every_option),
        cmocka_unit_test(manual_escapes_text),
        cmocka_unit_test(help_of_a_group_has_its_commands),
        cmocka_unit_test(mistyped_commands_are_refused),
        cmocka_unit_test(quick_changes_what_is_not_given),
        cmocka_unit_test(help_needs_no_complete_command_line),
        cmocka_unit_test(an_option_stands_in_one_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
