// Writes text into the forms of a report: HTML and SVG, scripts, CSV and terminals. Everything that
// is inserted is escaped for the form, so a text of a report is shown and never obeyed.
//
// The formats are those of printf with the conversions d, lld, u, zu, f, g, e, c and s. They must
// be literals of the program, since they are written as they are; only what they insert is escaped.
// In all forms, control characters become '?'.
#ifndef DIP_APP_FILES_PUT_H
#define DIP_APP_FILES_PUT_H

#include "renderer/base/api.h"

#include <stdio.h>

// Writes HTML or SVG. Texts may be inserted between tags and into quoted attributes.
void dip_put_html(FILE *out, const char *format, ...) DIP_PRINTF(2, 3);

// Writes markup, style or script that the program itself holds, unchanged.
void dip_put_markup(FILE *out, const char *markup);

// Writes a string of JavaScript or JSON, with its quotes, that may stand within a script element.
void dip_put_script_string(FILE *out, const char *text);

// Writes a quoted text of CSV (RFC 4180). An apostrophe is put before a text that a spreadsheet
// would take for a formula.
void dip_put_csv_text(FILE *out, const char *text);

// Writes for a terminal, or for a file that is read like one.
void dip_put_text(FILE *out, const char *format, ...) DIP_PRINTF(2, 3);

// Replaces control characters in a text in place.
void dip_put_clean(char *text);

#endif
