// A frame as a list of drawing commands, which finds out by itself what changed.
//
// The caller records the whole frame anew each time, from the back to the front. Painting compares
// the new list with the one painted before and draws only inside the rectangles of commands that
// differ. So code that draws never has to say what it changed, and a frame in which only a figure
// changes costs no more than that figure.
#ifndef DIP_APP_CANVAS_DRAW_LIST_H
#define DIP_APP_CANVAS_DRAW_LIST_H

#include "app/canvas/canvas.h"
#include "app/canvas/font.h"

typedef struct DipDrawList DipDrawList;

// Which point of a line x names.
typedef enum DipAlign { DIP_ALIGN_LEFT, DIP_ALIGN_RIGHT, DIP_ALIGN_CENTRE } DipAlign;

enum { DIP_MAX_DAMAGE = 8 };

// Rectangles of the canvas whose pixels changed.
typedef struct DipDamage {
    DipRect rects[DIP_MAX_DAMAGE];
    int count;
} DipDamage;

// Adds a rectangle; rectangles that overlap, and those there is no room for, are united.
void dip_damage_add(DipDamage *damage, DipRect rect);

// The font is borrowed and must outlive the list.
DipDrawList *dip_draw_list_create(DipFont *font, DipError *err);
void dip_draw_list_destroy(DipDrawList **list);

DipFont *dip_draw_list_font(const DipDrawList *list);

// Begins a frame of the given size.
void dip_draw_list_begin(DipDrawList *list, int width, int height);

int dip_draw_list_width(const DipDrawList *list);
int dip_draw_list_height(const DipDrawList *list);

// Each records one command. A command that memory runs out for is left out of the frame, and
// dip_draw_list_paint fails.

void dip_draw_list_fill(DipDrawList *list, DipRect rect, DipColour colour);

// Shows a picture, scaled to the rectangle. The pixels are borrowed until the next frame begins.
// The version is the caller's: pixels of the same version are taken to be the same.
void dip_draw_list_picture(DipDrawList *list, DipRect rect, const DipPixels *picture,
                           uint64_t version);

// Shows a line of UTF-8 text with its top at y. A line wider than max_width ends in an ellipsis.
void dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x, int y,
                        int max_width, const char *line);

// Ends the frame: resizes the canvas if need be, draws what differs from the frame painted before
// and says where that is. The first command should cover the whole frame, since a pixel that no
// command covers is undefined. Fails with MEMORY; the next frame is then painted as a whole.
bool dip_draw_list_paint(DipDrawList *list, DipCanvas *canvas, DipDamage *damage, DipError *err);

#endif
