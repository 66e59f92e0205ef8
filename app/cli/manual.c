// Writes the manual page. If several commands share a table of options, the page describes these
// options once.
#include "app/cli/help.h"

#include "renderer/scene/quality.h"

#include <string.h>

// --- roff ----------------------------------------------------------------------------------------

// Prints text and escapes the characters that have a meaning in roff. A blank line starts a new
// paragraph.
static void print_text(const char *text, FILE *out) {
    static const char specials[] = "\\-~^`'\"";
    static const char *const escapes[] = {"\\e",   "\\-",   "\\(ti", "\\(ha",
                                          "\\(ga", "\\(aq", "\\(dq"};
    bool line_begins = true;
    for (; *text; text++) {
        if (strncmp(text, "\n\n", 2) == 0) {
            fputs("\n.PP\n", out);
            text++;
            line_begins = true;
            continue;
        }
        const char *special = strchr(specials, *text);
        if (special) {
            fputs(escapes[special - specials], out);
        } else {
            fprintf(out, "%s%c", line_begins && *text == '.' ? "\\&" : "", *text);
        }
        line_begins = *text == '\n';
    }
}

static void print_line(const char *macro, const char *text, FILE *out) {
    fprintf(out, "%s", macro);
    print_text(text, out);
    fputc('\n', out);
}

// --- options -------------------------------------------------------------------------------------

static bool has_table(const DipCommand *command, const DipOptionTable *table) {
    for (size_t p = 0; p < command->parts->count; p++) {
        if (command->parts->items[p].table == table) {
            return true;
        }
    }
    return false;
}

// Returns the number of commands that take a table's options. Sets *first to the first of these
// commands.
static size_t count_users(const DipCommandList *list, const DipOptionTable *table,
                          const DipCommand **first) {
    size_t count = 0;
    for (size_t c = 0; c < list->count; c++) {
        if (has_table(list->commands[c], table)) {
            *first = count ? *first : list->commands[c];
            count++;
        }
    }
    return count;
}

static void print_table(const DipOptionTable *table, FILE *out) {
    for (size_t r = 0; r < table->count; r++) {
        const DipOptionRow *row = &table->rows[r];
        fputs(".TP\n.B ", out);
        print_text(row->name, out);
        if (row->argument) {
            fputc(' ', out);
            print_text(row->argument, out);
        }
        print_line("\n", row->text, out);
    }
}

// Prints which commands take the options of a table. `count` is their number.
static void print_users(const DipCommandList *list, const DipOptionTable *table, size_t count,
                        FILE *out) {
    if (count == list->count) {
        fputs(".PP\nAll commands take these options:\n", out);
        return;
    }
    fputs(".PP\nThe commands ", out);
    size_t said = 0;
    for (size_t c = 0; c < list->count; c++) {
        if (has_table(list->commands[c], table)) {
            fputs(said == 0 ? "" : said + 1 == count ? " and " : ", ", out);
            print_text(list->commands[c]->name, out);
            said++;
        }
    }
    fprintf(out, " take %s:\n", table->count == 1 ? "this option" : "these options");
}

static void print_shared_options(const DipCommandList *list, FILE *out) {
    fputs(".SH OPTIONS OF SEVERAL COMMANDS\n", out);
    for (size_t c = 0; c < list->count; c++) {
        const DipOptionParts *parts = list->commands[c]->parts;
        for (size_t p = 0; p < parts->count; p++) {
            const DipCommand *first = NULL;
            const size_t users = count_users(list, parts->items[p].table, &first);
            if (users > 1 && first == list->commands[c]) {
                print_users(list, parts->items[p].table, users, out);
                print_table(parts->items[p].table, out);
            }
        }
    }
}

// --- sections ------------------------------------------------------------------------------------

static void print_usage(const char *macro, const DipCommand *command, FILE *out) {
    fprintf(out, "%s\n.B diptych ", macro);
    print_text(command->name, out);
    fputc('\n', out);
    print_line("", command->usage, out);
}

static void print_command(const DipCommandList *list, const DipCommand *command, FILE *out) {
    print_line(".SS diptych ", command->name, out);
    print_text(command->text, out);
    print_usage("\n.PP", command, out);
    for (size_t p = 0; p < command->parts->count; p++) {
        const DipCommand *first;
        if (count_users(list, command->parts->items[p].table, &first) == 1) {
            print_table(command->parts->items[p].table, out);
        }
    }
}

static void print_settings(FILE *out) {
    fputs(".SH SETTINGS\nA set of settings (SET) is written as key=step,key=step,... without "
          "spaces.\nA setting that is left out keeps its default, which is marked with * here.\n",
          out);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        fprintf(out, ".TP\n.B %s=", info->key);
        for (int i = 0; i < info->step_count; i++) {
            fputs(i ? "|" : "", out);
            print_text(info->steps[i], out);
            fputs(i == info->default_step ? "*" : "", out);
        }
        print_line("\n", info->text, out);
    }
}

static void print_examples(const DipCommandList *list, FILE *out) {
    fputs(".SH EXAMPLES\n", out);
    for (size_t c = 0; c < list->count; c++) {
        for (size_t e = 0; e < list->commands[c]->example_count; e++) {
            print_line(".TP\n.B ", list->commands[c]->examples[e].typed, out);
            print_line("", list->commands[c]->examples[e].does, out);
        }
    }
}

void dip_manual_print(const DipCommandList *list, FILE *out) {
    fputs(".\\\" Made from the tables of options; do not edit.\n"
          ".TH DIPTYCH 1 \"\" \"Diptych " DIP_VERSION "\" \"User Commands\"\n"
          ".SH NAME\ndiptych \\- preview 3D image\\-quality settings in real time\n"
          ".SH SYNOPSIS\n",
          out);
    for (size_t c = 0; c < list->count; c++) {
        print_usage(c ? ".br" : ".PP", list->commands[c], out);
    }
    fputs(".SH DESCRIPTION\n"
          "Diptych draws one scene in two panes, the left one with the current settings of image "
          "quality and the right one with the requested settings.\n"
          "It draws with a software pipeline of its own, so that the same settings give the same "
          "picture on every machine.\n"
          "Without the name of a command, diptych runs preview.\n"
          ".SH COMMANDS\n",
          out);
    for (size_t c = 0; c < list->count; c++) {
        print_command(list, list->commands[c], out);
    }
    print_shared_options(list, out);
    print_settings(out);
    print_examples(list, out);
    fputs(".SH EXIT STATUS\n"
          ".TP\n.B 0\nThe command is done.\n"
          ".TP\n.B 1\nThe command failed: a file cannot be written, there is no "
          "display, ...\n"
          ".TP\n.B 2\nThe command line or an input file is wrong.\n"
          ".TP\n.B 3\nOther programs kept the machine too busy to measure times (cost diff, cost "
          "advise).\n",
          out);
}
