// Text: the system's sans-serif font, which fontconfig finds and FreeType draws, at any size.
//
// A glyph is drawn once per size and kept, so that a line of text costs one blend per letter. Lines
// are UTF-8; a byte that is not valid UTF-8 shows as U+FFFD. Not safe on two threads at once.
#ifndef DIP_APP_CANVAS_FONT_H
#define DIP_APP_CANVAS_FONT_H

#include "app/canvas/canvas.h"

typedef struct DipFont DipFont;

enum { DIP_FONT_MIN_SIZE = 8, DIP_FONT_MAX_SIZE = 128 }; // Pixels of an em.

// Fails with MISSING if the system has no usable font.
DipFont *dip_font_create(DipError *err);
void dip_font_destroy(DipFont **font);

// All functions below clamp the size to DIP_FONT_MIN_SIZE..DIP_FONT_MAX_SIZE.

// Pixels from one line's top to the next line's top.
int dip_font_line_height(DipFont *font, int size);

// Width of a line in pixels.
int dip_font_width(DipFont *font, int size, const char *line);

// Shortens a line in place until it is at most max_width pixels wide: whole characters at its end
// make way for an ellipsis. If not even an ellipsis fits, the line becomes empty. size_bytes is the
// size of the array.
void dip_font_fit(DipFont *font, int size, int max_width, char *line, size_t size_bytes);

// Draws a line whose left end is at x and whose top is at y.
void dip_font_draw(DipFont *font, DipCanvas *canvas, int size, DipColour colour, int x, int y,
                   const char *line);

#endif
