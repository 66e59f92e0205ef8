// Text in the window: the system's sans font, found through fontconfig, at any size.
#ifndef DIP_APP_PREVIEW_TEXT_H
#define DIP_APP_PREVIEW_TEXT_H

#include "renderer/base/error.h"

#include <SDL2/SDL.h>
#include <stdbool.h>

typedef struct DipText DipText;

enum { DIP_TEXT_MIN_SIZE = 8, DIP_TEXT_MAX_SIZE = 32 }; // pixels of an em

typedef enum DipAlign { DIP_ALIGN_LEFT, DIP_ALIGN_RIGHT, DIP_ALIGN_CENTRE } DipAlign;

// The renderer is borrowed. Fails with MISSING when the system has no usable font.
DipText *dip_text_create(SDL_Renderer *renderer, DipError *err);
void dip_text_destroy(DipText **text);

int dip_text_line_height(DipText *text, int size);
int dip_text_width(DipText *text, int size, const char *line);

// Draws a line with its top at y. x is its left end, right end or middle. A line wider than
// max_width ends in an ellipsis.
void dip_text_draw(DipText *text, int size, SDL_Color colour, DipAlign align, int x, int y,
                   int max_width, const char *line);

#endif
