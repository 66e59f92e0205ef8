// Prints the help of a command, of a group of commands or of the program.
#include "app/cli/help.h"

#include "renderer/scene/quality.h"

#include <string.h>

enum { COLUMNS = 80, OPTION_INDENT = 6, EXAMPLE_INDENT = 6 };

// Prints paragraphs, which are separated by "\n\n", in indented lines of at most COLUMNS columns.
static void print_wrapped(const char *text, int indent, FILE *out) {
    int column = 0;
    while (*text) {
        const int length = (int)strcspn(text, " \n");
        if (column > 0 && column + 1 + length > COLUMNS) {
            fputc('\n', out);
            column = 0;
        }
        column += fprintf(out, "%*s%.*s", column ? 1 : indent, "", length, text);
        text += length;
        if (strncmp(text, "\n\n", 2) == 0) {
            fputs("\n\n", out);
            column = 0;
            text++;
        }
        text += *text != '\0';
    }
    fputc('\n', out);
}

static void print_usage(const char *lead, const DipCommand *command, FILE *out) {
    fprintf(out, "%s diptych %s %s\n", lead, command->name, command->usage);
}

static void print_summary(const DipCommand *command, FILE *out) {
    fprintf(out, "  %-14s %s\n", command->name, command->summary);
}

// Prints all options of a command. Successive tables with the same title share one heading.
static void print_options(const DipOptionParts *parts, FILE *out) {
    const char *title = "";
    for (size_t p = 0; p < parts->count; p++) {
        const DipOptionTable *table = parts->items[p].table;
        if (strcmp(title, table->title) != 0) {
            title = table->title;
            fprintf(out, "\n%s:\n", title);
        }
        for (size_t r = 0; r < table->count; r++) {
            const DipOptionRow *row = &table->rows[r];
            fprintf(out, "  %s%s%s\n", row->name, row->argument ? " " : "",
                    row->argument ? row->argument : "");
            print_wrapped(row->text, OPTION_INDENT, out);
        }
    }
}

static void print_settings(FILE *out) {
    fputs("\nSettings:\n", out);
    print_wrapped("A set of settings (SET) is written as key=step,key=step,... without spaces. A "
                  "setting that is left out keeps its default, which is marked with * here.",
                  2, out);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        fprintf(out, "  %-8s ", info->key);
        for (int i = 0; i < info->step_count; i++) {
            fprintf(out, "%s%s%s", i ? "|" : "", info->steps[i],
                    i == info->default_step ? "*" : "");
        }
        fputc('\n', out);
        print_wrapped(info->text, 11, out);
    }
}

static void print_examples(const DipCommand *command, FILE *out) {
    fputs("\nExamples:\n", out);
    for (size_t e = 0; e < command->example_count; e++) {
        fprintf(out, "  %s\n", command->examples[e].typed);
        print_wrapped(command->examples[e].does, EXAMPLE_INDENT, out);
    }
}

static void print_exit_codes(FILE *out) {
    fputs("\nExit codes:\n"
          "  0  The command is done.\n"
          "  1  The command failed: a file cannot be written, there is no display, ...\n"
          "  2  The command line or an input file is wrong.\n"
          "  3  Other programs kept the machine too busy to measure times (cost diff,\n"
          "     cost advise).\n",
          out);
}

// Prints the other commands that begin with the same first word.
static void print_related(const DipCommandList *list, const DipCommand *command, FILE *out) {
    const size_t length = strcspn(command->name, " ");
    bool first = true;
    for (size_t c = 0; c < list->count; c++) {
        const DipCommand *other = list->commands[c];
        if (other != command && strncmp(other->name, command->name, length) == 0 &&
            strcspn(other->name, " ") == length) {
            fputs(first ? "\nRelated commands:\n" : "", out);
            first = false;
            print_summary(other, out);
        }
    }
}

static void print_command(const DipCommandList *list, const DipCommand *command, FILE *out) {
    print_usage("Usage:", command, out);
    fputc('\n', out);
    print_wrapped(command->text, 0, out);
    print_related(list, command, out);
    print_options(command->parts, out);
    if (command->lists_settings) {
        print_settings(out);
    }
    print_examples(command, out);
    print_exit_codes(out);
}

static void print_group(const DipCommandList *list, const char *word, FILE *out) {
    const size_t length = strlen(word);
    const char *lead = "Usage:";
    for (size_t c = 0; c < list->count; c++) {
        const DipCommand *command = list->commands[c];
        if (strncmp(command->name, word, length) == 0 && command->name[length] == ' ') {
            print_usage(lead, command, out);
            lead = "      ";
        }
    }
    fprintf(out, "\nCommands (`diptych %s WORD --help` explains a command):\n", word);
    for (size_t c = 0; c < list->count; c++) {
        const DipCommand *command = list->commands[c];
        if (strncmp(command->name, word, length) == 0 && command->name[length] == ' ') {
            print_summary(command, out);
        }
    }
}

static void print_all(const DipCommandList *list, FILE *out) {
    const DipCommand *first = list->commands[0];
    print_wrapped("Diptych previews 3D image-quality settings in real time: two panes show one "
                  "scene with the current and with the requested settings.",
                  0, out);
    fprintf(out, "\nUsage: diptych [COMMAND] [OPTION]...\n       diptych [%s] %s\n", first->name,
            first->usage);
    fputs("\nCommands (`diptych COMMAND --help` explains a command):\n", out);
    for (size_t c = 0; c < list->count; c++) {
        print_summary(list->commands[c], out);
    }
    fprintf(out, "\nThe following options belong to %s.\n", first->name);
    print_options(first->parts, out);
    print_settings(out);
    print_examples(first, out);
    print_exit_codes(out);
}

void dip_help_print(const DipCommandList *list, const DipCommandLine *line, FILE *out) {
    if (line->group) {
        print_group(list, line->group, out);
    } else if (line->named) {
        print_command(list, line->command, out);
    } else {
        print_all(list, out);
    }
}
