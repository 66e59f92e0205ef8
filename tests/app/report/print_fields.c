// Prints the fields of all files of a report as Markdown: docs/cost-fields.md.
#include "app/cost/advise/common_advice.h"
#include "app/cost/diff/diff.h"
#include "app/cost/predict/predict_elsewhere.h"
#include "app/report/format/cost_fields.h"

#include <stdio.h>
#include <string.h>

enum { MOST = 64 };

// Records that have been named, in the order in which they are printed.
static const DipRecord *records[MOST];
static int record_count;

static void add(const DipRecord *record) {
    for (int i = 0; i < record_count; i++) {
        if (records[i] == record) {
            return;
        }
    }
    records[record_count++] = record;
}

static const char *kind_of(const DipField *field) {
    static const char *const kinds[] = {
        "text", "whole number", "true or false", "number", "estimate", "settings as text",
        "name", "numbers",      "object",        "list"};
    return field->kind == DIP_FIELD_NUMBERS && field->names ? "object of numbers"
                                                            : kinds[field->kind];
}

static void print_kind(const DipField *field) {
    const DipRecord *record = field->record ? field->record
                              : field->list ? field->list->record
                                            : NULL;
    printf("%s", kind_of(field));
    if (record) {
        printf(": %s", record->name);
        add(record);
    } else if (field->list) {
        const DipFieldKind kind = field->list->element->kind;
        printf(" of %s", kind == DIP_FIELD_TEXT       ? "texts"
                         : kind == DIP_FIELD_SETTINGS ? "settings as text"
                                                      : "numbers");
    }
    printf("%s", field->known ? ", or null" : "");
}

// '|' ends a cell of a table.
static void print_text(const char *text) {
    for (; *text; text++) {
        *text == '|' ? (void)printf("\\|") : (void)putchar(*text);
    }
}

static void print_record(const DipRecord *record) {
    printf("\n### %s\n\n%s\n\n| member | kind | unit | meaning |\n|---|---|---|---|\n",
           record->name, record->means);
    for (int f = 0; f < record->count; f++) {
        const DipField *field = &record->fields[f];
        if (field->where & DIP_FIELD_JSON) {
            const bool derived = field->where & DIP_FIELD_DERIVED || field->derive;
            printf("| `%s`%s | ", field->name, derived ? "" : " *");
            print_kind(field);
            // A unit that people read may not be that of the number.
            printf(" | %s | ", field->unit && field->scale == 0.0 ? field->unit : "");
            print_text(field->means);
            printf(" |\n");
        }
    }
}

int main(void) {
    const struct {
        const char *title;
        const DipRecord *record;
    } files[] = {{"cost.json", &dip_cost_report_record},
                 {"The file of `cost diff --json`", &dip_cost_diff_record},
                 {"The file of `cost advise --json`", &dip_cost_common_record},
                 {"The file of `cost predict --json`", &dip_cost_prediction_record}};
    printf(
        "# Fields of the files of a report\n\n"
        "This page is printed from the list of fields that writes and reads the files\n"
        "(`tests/app/report/print_fields.c`); it is not written by hand.\n\n"
        "The member `format` is %d. An estimate is three members, `x`, `x_low` and `x_high`: a\n"
        "value and its two-sided 95 %% interval. All three are always there; what is not known\n"
        "is null. A member with a star is a fact; cost.json is read back from them. Others are "
        "computed\n"
        "from facts, so what a file says of them is not believed. Files of format %d are read,\n"
        "too. In CSV, a column is named after the member, with `_low` and `_high`, and an empty\n"
        "cell is not known.\n",
        DIP_COST_JSON_FORMAT, DIP_COST_JSON_FORMAT - 1);
    int printed = 0;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        printf("\n## %s\n", files[i].title);
        add(files[i].record);
        for (; printed < record_count; printed++) {
            print_record(records[printed]);
        }
    }
    return 0;
}
