// Finds the command that the command line names, and reads its options and operands.
#include "app/cli/command_line.h"

#include "renderer/base/assert.h"
#include "renderer/base/nearest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COMMANDS = 32 };

static const DipOptionRow program_rows[] = {
    {"--log", "FILE", DIP_OPTION_TEXT, offsetof(DipProgramOptions, log),
     .text = "Append warnings and errors to this file, too."},
    {"--help", NULL, DIP_OPTION_FLAG, offsetof(DipProgramOptions, help),
     .text = "Print this help. After the name of a command, print the help of that command."},
    {"--version", NULL, DIP_OPTION_FLAG, offsetof(DipProgramOptions, version),
     .text = "Print the version of Diptych."},
};

const DipOptionTable dip_program_option_table = DIP_OPTION_TABLE("Program", program_rows);

// Returns the length of the first word of a command's name.
static size_t first_word(const DipCommand *command) {
    return strcspn(command->name, " ");
}

static bool is_first_word(const DipCommand *command, const char *word) {
    return strlen(word) == first_word(command) && strncmp(command->name, word, strlen(word)) == 0;
}

static bool is_help(const char *argument) {
    return strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0;
}

static bool unknown_command(const DipCommandList *list, const char *word, DipError *err) {
    const char *names[MAX_COMMANDS];
    char words[MAX_COMMANDS][24];
    DIP_ASSERT(list->count <= MAX_COMMANDS);
    for (size_t c = 0; c < list->count; c++) {
        snprintf(words[c], sizeof words[c], "%.*s", (int)first_word(list->commands[c]),
                 list->commands[c]->name);
        names[c] = words[c];
    }
    const char *likely = dip_nearest_likely(word, names, list->count);
    return likely ? dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, word,
                                  "is not a command; did you mean %s? (To open a model of this "
                                  "name, write ./%.60s)",
                                  likely, word)
                  : dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, word,
                                  "is not a command; `diptych --help` lists them (to open a model "
                                  "of this name, write ./%.60s)",
                                  word);
}

// Fails because `second` is not the second word of any of the two-word commands that begin with
// `first`. `second` is NULL if the second word is missing.
static bool unknown_second_word(const DipCommandList *list, const char *first, const char *second,
                                DipError *err) {
    char known[256] = "";
    for (size_t c = 0; c < list->count; c++) {
        if (is_first_word(list->commands[c], first)) {
            const size_t length = strlen(known);
            snprintf(known + length, sizeof known - length, "%s%s %s", length ? ", " : "",
                     list->commands[c]->name, list->commands[c]->usage);
        }
    }
    return second ? dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, first,
                                  "'%.40s' is not a command; give one of %s", second, known)
                  : dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, first,
                                  "nothing to do; give one of %s", known);
}

// Finds the command that argv names, and sets line->command or line->group. Sets neither if argv
// names no command. A two-word command has precedence over a one-word command. Sets *used to the
// number of words in the command's name, or to 0 if no command is named.
static bool find_command(const DipCommandList *list, int argc, char *const *argv,
                         DipCommandLine *line, int *used, DipError *err) {
    const char *first = argc > 1 ? argv[1] : "-";
    const char *second = argc > 2 ? argv[2] : NULL;
    bool is_group = false;
    char both[64];
    snprintf(both, sizeof both, "%.30s %.30s", first, second ? second : "");
    *used = 0;
    for (size_t c = 0; c < list->count; c++) {
        if (strcmp(list->commands[c]->name, both) == 0) {
            line->command = list->commands[c];
            *used = 2;
            return true;
        }
        if (strcmp(list->commands[c]->name, first) == 0) {
            line->command = list->commands[c];
            *used = 1;
        }
        is_group = is_group || is_first_word(list->commands[c], first);
    }
    for (size_t m = 0; m < list->moved_count; m++) {
        if (strcmp(list->moved[m].name, both) == 0) {
            return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, list->moved[m].name,
                                 "is not a command any more; type %s", list->moved[m].instead);
        }
    }
    if (*used == 0 && is_group) {
        line->group = second && is_help(second) ? first : NULL;
        return line->group || unknown_second_word(list, first, second, err);
    }
    for (size_t c = 0; c < list->hidden_count; c++) {
        if (strcmp(list->hidden[c]->name, first) == 0) {
            line->command = list->hidden[c];
            *used = 1;
        }
    }
    // A word without a dot, slash or backslash is taken for a mistyped command, not for the name
    // of a model.
    return *used || first[0] == '-' || strpbrk(first, "./\\") || unknown_command(list, first, err);
}

static bool add_operand(const DipCommandLine *line, const char *operand, DipError *err) {
    const DipOperands *operands = &line->command->operands;
    const char **texts = (const char **)((char *)line->options + operands->field);
    int *count = (int *)((char *)line->options + operands->count);
    if (operands->most == 0 || *count == operands->most) {
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, operand,
                             "is one argument too many for `diptych %s`", line->command->name);
    }
    texts[(*count)++] = operand;
    return true;
}

static bool parse_arguments(int argc, char *const *argv, int index, const DipCommandLine *line,
                            DipError *err) {
    const DipCommand *command = line->command;
    bool only_operands = false;
    for (; index < argc; index++) {
        const char *argument = argv[index];
        if (!only_operands && strcmp(argument, "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argument[0] == '-' && argument[1]) {
            if (!dip_option_parse(command->parts, command->name, argc, argv, &index, line->options,
                                  err)) {
                return false;
            }
        } else if (!add_operand(line, argument, err)) {
            return false;
        }
    }
    return true;
}

bool dip_command_line_parse(const DipCommandList *list, int argc, char *const *argv,
                            DipCommandLine *line, DipError *err) {
    int used;
    *line = (DipCommandLine){.command = list->commands[0]};
    if (!find_command(list, argc, argv, line, &used, err)) {
        return false;
    }
    line->named = used > 0;
    line->options = calloc(1, line->command->options_size);
    if (!line->options) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
    }
    DipProgramOptions *program = line->options;
    program->argc = argc;
    program->argv = argv;
    if (line->group) {
        program->help = true;
        return true;
    }
    if (line->command->set_defaults) {
        line->command->set_defaults(line->options);
    }
    if (!parse_arguments(argc, argv, 1 + used, line, err)) {
        return false;
    }
    return program->help || program->version || !line->command->check ||
           line->command->check(line->options, err);
}

void dip_command_line_free(DipCommandLine *line) {
    free(line->options);
    *line = (DipCommandLine){0};
}
