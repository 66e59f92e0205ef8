// Writes text as HTML, SVG, a script, CSV or plain text for a terminal. Inserted texts are escaped,
// so that a name from a file, for example, is shown and never acts as markup or code.
//
// A `format` is that of printf, with the conversions d, lld, u, zu, f, g, e, c and s. A format must
// be a string literal, since the format itself is written unchanged; only the texts that it inserts
// are escaped. Control characters and malformed UTF-8 in these texts become '?'.
#ifndef DIP_APP_FILES_PUT_H
#define DIP_APP_FILES_PUT_H

#include "renderer/base/api.h"

#include <stdio.h>

// Writes HTML or SVG. Texts may be inserted between tags and into quoted attributes.
void dip_put_html(FILE *out, const char *format, ...) DIP_PRINTF(2, 3);

// Writes markup, style or script unchanged. `markup` must be a text of the program itself, not one
// from a file or a user.
void dip_put_markup(FILE *out, const char *markup);

// Writes a text as a string of JavaScript or JSON, with quotes. The string may stand within a
// script element.
void dip_put_script_string(FILE *out, const char *text);

// Writes a quoted text of CSV (RFC 4180). An apostrophe is put before a text that a spreadsheet
// would take for a formula.
void dip_put_csv_text(FILE *out, const char *text);

// Writes plain text, for a terminal or a text file.
void dip_put_text(FILE *out, const char *format, ...) DIP_PRINTF(2, 3);

// Appends to a text in an array of size_bytes, as printf writes. Nothing is escaped. What does not
// fit is cut.
void dip_put_append(char *text, size_t size_bytes, const char *format, ...) DIP_PRINTF(3, 4);

// Replaces control characters and malformed UTF-8 in a text by '?', in place.
void dip_put_clean(char *text);

#endif
