// Writes headings, sentences, facts and tables for a terminal or for a page.
#include "app/report/format/form.h"

#include "app/files/put.h"

#include <stdarg.h>
#include <string.h>

enum { LINE_WIDTH = 100, TERM_WIDTH = 14, TEXT_BYTES = 4096 };

#define FORMAT_TEXT(text, format)                                                                  \
    char text[TEXT_BYTES];                                                                         \
    va_list arguments;                                                                             \
    va_start(arguments, format);                                                                   \
    vsnprintf(text, sizeof text, format, arguments);                                               \
    va_end(arguments)

// Breaks a text into lines at blanks. The cursor is at the column `indent`, where all lines begin.
static void print_wrapped(FILE *out, const char *text, int indent) {
    int column = indent;
    while (*text) {
        int length = (int)strcspn(text, " ");
        while (strncmp(text + length, " %", 2) == 0) { // Keeps a number and its '%' together.
            length += 1 + (int)strcspn(text + length + 1, " ");
        }
        if (column > indent && column + 1 + length > LINE_WIDTH) {
            dip_put_text(out, "\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            dip_put_text(out, " ");
            column++;
        }
        dip_put_text(out, "%.*s", length, text);
        column += length;
        text += length + (text[length] == ' ');
    }
    dip_put_text(out, "\n");
}

void dip_form_end(DipForm *form) {
    if (form->is_in_facts && form->is_page) {
        dip_put_html(form->out, "</dl>\n");
    }
    form->is_in_facts = false;
}

void dip_form_heading(DipForm *form, const char *id, const char *format, ...) {
    FORMAT_TEXT(text, format);
    dip_form_end(form);
    if (!form->is_page) {
        dip_put_text(form->out, form->has_begun ? "\n%s:\n" : "%s:\n", text);
    } else if (id) {
        dip_put_html(form->out, "<h2 id=\"%s\">%s</h2>\n", id, text);
    } else {
        dip_put_html(form->out, "<h2>%s</h2>\n", text);
    }
    form->has_begun = form->is_after_heading = true;
}

void dip_form_paragraph(DipForm *form, const char *style, const char *format, ...) {
    FORMAT_TEXT(text, format);
    dip_form_end(form);
    form->has_begun = true;
    form->is_after_heading = false;
    if (!form->is_page) {
        print_wrapped(form->out, text, 0);
    } else if (style) {
        dip_put_html(form->out, "<p class=\"%s\">%s</p>\n", style, text);
    } else {
        dip_put_html(form->out, "<p>%s</p>\n", text);
    }
}

static void begin_fact(DipForm *form, const char *term) {
    if (form->is_page) {
        dip_put_markup(form->out, form->is_in_facts ? "" : "<dl class=\"facts\">\n");
        dip_put_html(form->out, "<div><dt>%s</dt>", term);
    } else {
        dip_put_text(form->out, "  %-*s ", TERM_WIDTH, term);
    }
    form->has_begun = form->is_in_facts = true;
    form->is_after_heading = false;
}

// Writes a text that a page may break behind each comma, so that lists of settings, which have no
// blanks, are not broken within a word.
static void put_breakable(FILE *out, char *text) {
    while (*text) {
        char *next = text + strcspn(text, ",");
        next += *next == ',';
        const char kept = *next;
        *next = '\0';
        dip_put_html(out, "%s", text);
        *next = kept;
        dip_put_markup(out, kept && kept != ' ' ? "<wbr>" : "");
        text = next;
    }
}

void dip_form_fact(DipForm *form, const char *term, const char *format, ...) {
    FORMAT_TEXT(text, format);
    begin_fact(form, term);
    if (form->is_page) {
        dip_put_markup(form->out, "<dd>");
        put_breakable(form->out, text);
        dip_put_markup(form->out, "</dd></div>\n");
    } else {
        print_wrapped(form->out, text, TERM_WIDTH + 3);
    }
}

void dip_form_code(DipForm *form, const char *term, const char *code) {
    begin_fact(form, term);
    if (form->is_page) {
        dip_put_html(form->out, "<dd class=\"code\">%s</dd></div>\n", code);
    } else {
        dip_put_text(form->out, "%s\n", code);
    }
}

void dip_form_table(DipForm *form, const DipTable *table) {
    dip_form_end(form);
    if (table->count == 0) {
        return;
    }
    if (form->is_page) {
        dip_table_print_html(table, form->out);
    } else {
        if (table->caption && *table->caption) {
            dip_put_text(form->out, form->has_begun && !form->is_after_heading ? "\n" : "");
            print_wrapped(form->out, table->caption, 0);
        }
        dip_table_print_text(table, form->out);
    }
    form->has_begun = true;
    form->is_after_heading = false;
}
