// Draws text in the system's sans-serif font at any size. fontconfig finds the font, and FreeType
// draws its glyphs.
//
// A cache keeps the drawn glyphs of each size, so that a line of text usually costs one blend per
// letter. Lines are UTF-8; a byte that is not valid UTF-8 shows as U+FFFD. Two threads must not use
// one font at the same time.
#ifndef DIP_APP_UI_FONT_H
#define DIP_APP_UI_FONT_H

#include "app/ui/canvas.h"

typedef struct DipFont DipFont;

enum { DIP_FONT_MIN_SIZE = 8, DIP_FONT_MAX_SIZE = 128 }; // Em size in pixels.

// Opens the system's font. Fails with MISSING if there is no usable font, or with MEMORY.
DipFont *dip_font_create(DipError *err);
void dip_font_destroy(DipFont **font);

// All functions below clamp the size to DIP_FONT_MIN_SIZE..DIP_FONT_MAX_SIZE.

// Returns the distance in pixels from the top of one line to the top of the next line. The letters
// of a line fit between the two.
int dip_font_line_height(DipFont *font, int size);

// Returns the width of a line in pixels.
int dip_font_width(DipFont *font, int size, const char *line);

// Shortens a line in place until it is at most max_width pixels wide. An ellipsis replaces whole
// characters at the line's end. If not even an ellipsis fits, or if the array is too short for the
// ellipsis, the line becomes empty. size_bytes is the size of the array.
void dip_font_fit(DipFont *font, int size, int max_width, char *line, size_t size_bytes);

// Draws a line whose left end is at x and whose top is at y.
void dip_font_draw(DipFont *font, DipCanvas *canvas, int size, DipColour colour, int x, int y,
                   const char *line);

#endif
