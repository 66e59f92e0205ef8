// Keeps the drawing commands of a frame in a list, and finds out by itself what has changed since
// the previous frame.
//
// The caller records the whole frame anew each time, from the back to the front. Painting compares
// the new list with the list that was painted last, and draws only inside the rectangles of
// commands that differ. Therefore code that draws never has to say what it changed. If only one
// number changes, painting draws only inside the rectangle of that number.
#ifndef DIP_APP_UI_DRAW_LIST_H
#define DIP_APP_UI_DRAW_LIST_H

#include "app/ui/canvas.h"
#include "app/ui/font.h"

typedef struct DipDrawList DipDrawList;

// Says which point of a line of text dip_draw_list_text puts at `x`: the line's left end, right end
// or centre.
typedef enum DipAlign { DIP_ALIGN_LEFT, DIP_ALIGN_RIGHT, DIP_ALIGN_CENTRE } DipAlign;

enum { DIP_MAX_DAMAGE = 8 };

// Rectangles of the canvas in which pixels may have changed.
typedef struct DipDamage {
    DipRect rects[DIP_MAX_DAMAGE];
    int count;
} DipDamage;

// Adds a rectangle. Rectangles that overlap are united. If the array is full, the new rectangle is
// united with one in the array.
void dip_damage_add(DipDamage *damage, DipRect rect);

// Creates an empty list. The font is borrowed and must outlive the list. Fails with MEMORY.
DipDrawList *dip_draw_list_create(DipFont *font, DipError *err);
void dip_draw_list_destroy(DipDrawList **list);

DipFont *dip_draw_list_font(const DipDrawList *list);

// Begins a frame of the given size.
void dip_draw_list_begin(DipDrawList *list, int width, int height);

int dip_draw_list_width(const DipDrawList *list);
int dip_draw_list_height(const DipDrawList *list);

// Each of the next functions records one command. If memory runs out, the command is left out of
// the frame, and dip_draw_list_paint fails. If `list` is NULL, the functions do nothing.

void dip_draw_list_fill(DipDrawList *list, DipRect rect, DipColour colour);

// Fills a rectangle with rounded corners or draws its outline: see dip_canvas_round.
void dip_draw_list_round(DipDrawList *list, DipRect rect, int radius, int ring, DipColour colour);

// Shows a picture, scaled to the rectangle. The pixels are borrowed until the next frame begins.
// The caller numbers the picture's contents with `version`: equal versions mean equal pixels.
void dip_draw_list_picture(DipDrawList *list, DipRect rect, const DipPixels *picture,
                           uint64_t version);

// Shows a line of UTF-8 text of at most 511 bytes with its top at y. A line that is wider than
// max_width is shortened as by dip_font_fit.
void dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x, int y,
                        int max_width, const char *line);

// Ends the frame: resizes the canvas if needed, draws what differs from the frame that was painted
// last, and returns the changed rectangles in *damage. The first command should cover the whole
// frame, since a pixel that no command covers is undefined. Fails with MEMORY; the next call then
// paints the whole frame.
bool dip_draw_list_paint(DipDrawList *list, DipCanvas *canvas, DipDamage *damage, DipError *err);

#endif
