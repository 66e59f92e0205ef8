// Decodes UTF-8 texts and writes their characters into cells.
#include "app/preview/cells/text_screen.h"

#include "renderer/base/utf8.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t ellipsis = 0x2026;

bool dip_text_screen_begin(DipTextScreen *screen, int columns, int rows, DipError *err) {
    const size_t size_bytes = (size_t)columns * (size_t)rows * sizeof *screen->cells;
    if (columns != screen->columns || rows != screen->rows) {
        dip_text_screen_free(screen);
        screen->cells = malloc(size_bytes > 0 ? size_bytes : 1);
        if (!screen->cells) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        }
        screen->columns = columns;
        screen->rows = rows;
    }
    memset(screen->cells, 0, size_bytes);
    return true;
}

void dip_text_screen_free(DipTextScreen *screen) {
    free(screen->cells);
    *screen = (DipTextScreen){0};
}

static void put_code(DipTextScreen *screen, int row, int column, DipTextColours colours,
                     uint32_t code) {
    if (row >= 0 && row < screen->rows && column >= 0 && column < screen->columns) {
        screen->cells[(size_t)row * (size_t)screen->columns + (size_t)column] =
            (DipTextCell){code, colours.ink, colours.paper};
    }
}

void dip_text_screen_fill(DipTextScreen *screen, DipTextArea area, DipColour paper) {
    for (int row = area.row; row < area.row + area.rows; ++row) {
        for (int column = area.column; column < area.column + area.columns; ++column) {
            put_code(screen, row, column, (DipTextColours){paper, paper}, ' ');
        }
    }
}

// Reads the next character of *text, and moves *text to the character after it. The texts of the
// preview are valid UTF-8, but a scene's name may hold anything. A control character, and a byte
// that is not valid, becomes U+FFFD.
static uint32_t next_code(const char **text) {
    uint32_t code = 0;
    const size_t length = dip_utf8_read(*text, DIP_UTF8_MOST_BYTES, &code);
    *text += length > 0 ? length : 1;
    return code < ' ' || (code >= 0x7f && code < 0xa0) ? 0xfffd : code;
}

int dip_text_length(const char *text) {
    int length = 0;
    while (*text) {
        next_code(&text);
        ++length;
    }
    return length;
}

int dip_text_put(DipTextScreen *screen, int row, int column, int end, DipTextColours colours,
                 const char *text) {
    const bool cut = dip_text_length(text) > end - column;
    while (*text && column < end) {
        const uint32_t code = next_code(&text);
        put_code(screen, row, column, colours, cut && column == end - 1 ? ellipsis : code);
        ++column;
    }
    return column;
}

int dip_text_put_right(DipTextScreen *screen, int row, int column, int end, DipTextColours colours,
                       const char *text) {
    const int first = end - dip_text_length(text);
    column = first > column ? first : column;
    dip_text_put(screen, row, column, end, colours, text);
    return column;
}
