// Keeps the lines that the window gives to its draw list.
#include "tests/app/preview/shown_texts.h"

#include "app/ui/draw_list.h"

#include <stdio.h>
#include <string.h>

enum { MOST_LINES = 512, LINE_BYTES = 512 };

static struct {
    char text[LINE_BYTES];
    bool whole;
} lines[MOST_LINES];
static int count;

// The linker gives these names to the function of the draw list, and to its replacement.
void __real_dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x,
                               int y, int max_width, const char *line);
void __wrap_dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x,
                               int y, int max_width, const char *line);

void __wrap_dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x,
                               int y, int max_width, const char *line) {
    if (list && count < MOST_LINES) { // Passes that draw nothing have no list.
        snprintf(lines[count].text, LINE_BYTES, "%s", line);
        lines[count].whole = dip_font_width(dip_draw_list_font(list), size, line) <= max_width;
        count++;
    }
    __real_dip_draw_list_text(list, size, colour, align, x, y, max_width, line);
}

void dip_shown_texts_forget(void) {
    count = 0;
}

const char *dip_shown_text(const char *part, bool *whole) {
    for (int i = 0; i < count; i++) {
        if (strstr(lines[i].text, part)) {
            if (whole) {
                *whole = lines[i].whole;
            }
            return lines[i].text;
        }
    }
    return NULL;
}
