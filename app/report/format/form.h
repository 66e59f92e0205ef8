// Writes what people read of a report, for a terminal or for a page: headings, sentences, facts and
// tables. A section is written once, with these functions, so that both say the same. All texts are
// escaped.
#ifndef DIP_APP_REPORT_FORMAT_FORM_H
#define DIP_APP_REPORT_FORMAT_FORM_H

#include "app/report/format/fields.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct DipForm {
    FILE *out;
    bool is_page;   // Otherwise a terminal, whose lines have at most 100 characters where they can.
    bool has_begun; // Something has been written.
    bool is_in_facts; // A list of facts has been begun.
    bool is_after_heading;
} DipForm;

#define DIP_FORM_TEXT __attribute__((format(printf, 3, 4)))

// Begins a section. `id` is the anchor of the section in a page, or NULL.
void dip_form_heading(DipForm *form, const char *id, const char *format, ...) DIP_FORM_TEXT;

// Writes sentences. `style` is the CSS class of the paragraph in a page, or NULL.
void dip_form_paragraph(DipForm *form, const char *style, const char *format, ...) DIP_FORM_TEXT;

// Writes a fact: a term and what is said about it, such as "Fits" and "with 99 %".
void dip_form_fact(DipForm *form, const char *term, const char *format, ...) DIP_FORM_TEXT;

// Writes a fact that people copy, on one line.
void dip_form_code(DipForm *form, const char *term, const char *code);

// Writes a table with its caption. A table without lines is left out. DIP_FORM_TABLE takes members
// of the table.
void dip_form_table(DipForm *form, const DipTable *table);
#define DIP_FORM_TABLE(form, ...) dip_form_table(form, &(DipTable){__VA_ARGS__})

// Ends a list of facts that is open. Call it before something else is written to `out`, and at the
// end.
void dip_form_end(DipForm *form);

#endif
