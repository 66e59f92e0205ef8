// Writes what people read of a report: headings, sentences, facts and tables. The same calls write
// for a terminal or for an HTML page, so that both say the same. All texts are escaped.
#ifndef DIP_APP_REPORT_FORMAT_FORM_H
#define DIP_APP_REPORT_FORMAT_FORM_H

#include "app/report/format/fields.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct DipForm {
    FILE *out;
    bool is_page;     // True for a page; false for a terminal, where sentences are broken into
                      // lines of at most 100 characters.
    bool has_begun;   // True once something has been written.
    bool is_in_facts; // True within a list of facts.
    bool is_after_heading;
} DipForm;

#define DIP_FORM_TEXT __attribute__((format(printf, 3, 4)))

// Begins a section. `id` is the anchor of the section in a page, or NULL.
void dip_form_heading(DipForm *form, const char *id, const char *format, ...) DIP_FORM_TEXT;

// Writes sentences. `style` is the CSS class of the paragraph in a page, or NULL.
void dip_form_paragraph(DipForm *form, const char *style, const char *format, ...) DIP_FORM_TEXT;

// Writes a fact: a term and what is said about it, such as "Fits" and "with 99 %".
void dip_form_fact(DipForm *form, const char *term, const char *format, ...) DIP_FORM_TEXT;

// Writes a fact whose text people copy. It is never broken into lines.
void dip_form_code(DipForm *form, const char *term, const char *code);

// Writes a table with its caption. A table without items is left out. DIP_FORM_TABLE takes the
// initialisers of a DipTable.
void dip_form_table(DipForm *form, const DipTable *table);
#define DIP_FORM_TABLE(form, ...) dip_form_table(form, &(DipTable){__VA_ARGS__})

// Ends a list of facts that is open. Call it before other functions write to `out`, and when the
// form is finished.
void dip_form_end(DipForm *form);

#endif
