// What people read of a report: headings, sentences, facts and tables, for a terminal or for a
// page. Sections are written once, by these functions, so that both say the same. All texts are
// escaped.
#ifndef DIP_APP_REPORT_FORMAT_FORM_H
#define DIP_APP_REPORT_FORMAT_FORM_H

#include "app/report/format/fields.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct DipForm {
    FILE *out;
    bool is_page;   // Otherwise a terminal, whose lines have at most 100 characters where they can.
    bool has_begun; // The terminal has a line already.
    bool is_in_facts; // A list of facts has been begun.
    bool is_after_heading;
} DipForm;

#define DIP_FORM_TEXT __attribute__((format(printf, 3, 4)))

// Begins a section. `id` is the page's anchor of it, or NULL.
void dip_form_heading(DipForm *form, const char *id, const char *format, ...) DIP_FORM_TEXT;

// Writes sentences. `style` is the page's class of the paragraph, or NULL.
void dip_form_paragraph(DipForm *form, const char *style, const char *format, ...) DIP_FORM_TEXT;

// Writes what something is: "Fits", "with 99 %".
void dip_form_fact(DipForm *form, const char *term, const char *format, ...) DIP_FORM_TEXT;

// Writes a fact that people copy, on one line.
void dip_form_code(DipForm *form, const char *term, const char *code);

// Writes a table with its caption. A table without lines is left out.
void dip_form_table(DipForm *form, const DipTable *table);

// Ends what is open. Call it before something else is written to `out`, and at the end.
void dip_form_end(DipForm *form);

#endif
