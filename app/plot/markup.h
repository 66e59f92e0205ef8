// Text for HTML and SVG.
#ifndef DIP_APP_PLOT_MARKUP_H
#define DIP_APP_PLOT_MARKUP_H

#include <stdio.h>

// Writes text with the characters escaped that mean something between tags.
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
