// Finds out what a terminal can show, and turns a picture and characters into the bytes that make
// the terminal show them. Private to this folder.
//
// The writer remembers what the terminal shows and encodes only the cells that differ. A cell shows
// two pixels of the picture, one above the other, as a half block (U+2580). Colours are rounded to
// those of the terminal before cells are compared, so a change that nobody could see costs nothing.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_WRITER_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_WRITER_H

#include "app/display/terminal/terminal_display.h"

// The environment variables that describe a terminal. A variable that is not set is NULL.
typedef struct DipTerminalEnvironment {
    const char *term;      // TERM
    const char *colorterm; // COLORTERM
    const char *no_color;  // NO_COLOR
    const char *locale;    // The first of LC_ALL, LC_CTYPE and LANG that is set and not empty.
} DipTerminalEnvironment;

// Reads the variables of this process.
DipTerminalEnvironment dip_terminal_environment(void);

// Returns the colours that the terminal can show; never AUTO. A NO_COLOR that is not empty means
// NONE (no-color.org).
DipTerminalColours dip_terminal_best_colours(const DipTerminalEnvironment *environment);

// Returns false if the locale names a character set that has no half blocks.
bool dip_terminal_has_utf8(const DipTerminalEnvironment *environment);

// Returns false if the terminal has no escape sequences that place characters.
bool dip_terminal_can_place(const DipTerminalEnvironment *environment);

// A cell as the terminal shows it.
typedef struct DipTerminalCell {
    uint32_t code;  // Code point; 0: not known.
    uint32_t ink;   // 0xRRGGBB, an index in the palette, or 0 if there are no colours.
    uint32_t paper; // As `ink`; without colours, 1 means reverse video.
} DipTerminalCell;

// Zero-initialise a writer, set its first two fields, and call dip_terminal_writer_resize.
typedef struct DipTerminalWriter {
    DipTerminalColours colours; // Not AUTO.
    bool utf8;                  // False: the terminal shows ASCII only.

    int columns;
    int rows;
    DipTerminalCell *shown; // Owned: what the terminal shows.
    char *bytes;            // Owned: the bytes of the last frame.
    size_t count;
    // Colours, column and row at which the terminal writes its next character.
    DipTerminalCell pen;
    int column;
    int row;
} DipTerminalWriter;

// Sets the terminal's size in cells, and forgets what the terminal shows. Fails with MEMORY; the
// old size then stays.
bool dip_terminal_writer_resize(DipTerminalWriter *writer, int columns, int rows, DipError *err);
void dip_terminal_writer_free(DipTerminalWriter *writer);

// Forgets what the terminal shows, so that the next frame sends every cell.
void dip_terminal_writer_forget(DipTerminalWriter *writer);

// Encodes a frame into writer->bytes. Cells outside the picture are black. text: text_rows rows of
// text_columns cells, or NULL. Returns writer->count, which is 0 if nothing has changed.
size_t dip_terminal_writer_encode(DipTerminalWriter *writer, const DipPixels *picture,
                                  const DipTextCell *text, int text_columns, int text_rows);

#endif
