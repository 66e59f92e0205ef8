// Escaping text for HTML and SVG.
#ifndef DIP_APP_REPORT_PAGE_MARKUP_H
#define DIP_APP_REPORT_PAGE_MARKUP_H

#include <stdio.h>

// Writes text between tags; &, < and > are escaped.
static inline void dip_markup_text(FILE *out, const char *text) {
    for (; *text; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        default:
            fputc(*text, out);
        }
    }
}

#endif
