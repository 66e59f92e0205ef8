// Writes text into a screen of character cells (DipTextCell in display.h).
#ifndef DIP_APP_PREVIEW_CELLS_TEXT_SCREEN_H
#define DIP_APP_PREVIEW_CELLS_TEXT_SCREEN_H

#include "app/display/display.h"

// A rectangle in cells.
typedef struct DipTextArea {
    int column;
    int row;
    int columns;
    int rows;
} DipTextArea;

// Zero-initialise.
typedef struct DipTextScreen {
    DipTextCell *cells; // Owned; the top row first.
    int columns;
    int rows;
} DipTextScreen;

// The colours of a text: `ink` is for the letters, `paper` for the cells behind them.
typedef struct DipTextColours {
    DipColour ink;
    DipColour paper;
} DipTextColours;

static const DipTextColours dip_text_white = {{255, 255, 255, 255}, {10, 11, 14, 255}};
static const DipTextColours dip_text_soft = {{196, 202, 210, 255}, {10, 11, 14, 255}};
static const DipTextColours dip_text_dim = {{152, 162, 174, 255}, {10, 11, 14, 255}};
static const DipTextColours dip_text_accent = {{255, 190, 92, 255}, {10, 11, 14, 255}};
static const DipTextColours dip_text_gain = {{95, 214, 189, 255}, {10, 11, 14, 255}};
static const DipTextColours dip_text_worse = {{255, 154, 139, 255}, {10, 11, 14, 255}};
// dip_text_wanted marks the requested step (value) of a setting, and the key that applies the
// requested settings. dip_text_focused marks the title of the setting on which the arrow keys act.
static const DipTextColours dip_text_wanted = {{26, 18, 6, 255}, {255, 190, 92, 255}};
static const DipTextColours dip_text_focused = {{255, 255, 255, 255}, {30, 70, 110, 255}};

// Sets the size and clears all cells. A clear cell shows the picture. Fails with MEMORY.
bool dip_text_screen_begin(DipTextScreen *screen, int columns, int rows, DipError *err);
void dip_text_screen_free(DipTextScreen *screen);

// Fills an area with spaces of the colour `paper`.
void dip_text_screen_fill(DipTextScreen *screen, DipTextArea area, DipColour paper);

// Returns the number of characters of a UTF-8 text. Every character is one cell wide.
int dip_text_length(const char *text);

// Writes a text into a row, from `column` to the column before `end`. A text that is too long is
// cut and ends in an ellipsis. Returns the column after the text. Cells outside the screen are left
// out.
int dip_text_put(DipTextScreen *screen, int row, int column, int end, DipTextColours colours,
                 const char *text);

// Writes a text so that its last character stands in the column before `end`. A text that is too
// long begins at `column`, is cut and ends in an ellipsis. Returns the column of the text's first
// character.
int dip_text_put_right(DipTextScreen *screen, int row, int column, int end, DipTextColours colours,
                       const char *text);

#endif
