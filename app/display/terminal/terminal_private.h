// Declares what the files of this folder do for each other: they read keys, switch the terminal's
// mode and encode frames. Private to this folder.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_PRIVATE_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_PRIVATE_H

#include "app/display/terminal/terminal_display.h"

// --- terminal_keys.c -----------------------------------------------------------------------------

// Reads one event from the bytes that the terminal sends for keys and the mouse. Returns the number
// of bytes that the event takes, or 0 if more bytes must follow. If `ended`, no byte follows for
// now: a lone escape character is then the Escape key, and a sequence that breaks off is dropped.
//
// Key presses are KEY_DOWN events. A terminal reports neither releases nor positions of keys: the
// event's position is the key's code. Shift is known for the letters A to Z, and for keys whose
// escape sequence tells it. Ctrl+C and Ctrl+Z end and suspend the program, so Alt stands for Ctrl
// with these two letters. Bytes that mean nothing to the preview are taken as an event of kind
// NONE.
int dip_terminal_keys_read(const uint8_t *bytes, int count, bool ended, DipEvent *event);

// --- terminal_mode.c -----------------------------------------------------------------------------
// A process has one mode: all these functions concern the same terminal. The terminal gets back its
// settings, its screen and its cursor when the process exits, crashes or is ended by a signal that
// the mode takes over (terminal_mode.c), but not by SIGKILL, for example. The terminal gets nothing
// back while another process group, such as the shell's, has the terminal.

// What signals have asked for, as bits.
enum {
    DIP_TERMINAL_QUIT = 1,   // SIGINT, SIGTERM or SIGHUP came.
    DIP_TERMINAL_RESIZE = 2, // SIGWINCH came.
    DIP_TERMINAL_STOP = 4,   // SIGTSTP came: the caller must call dip_terminal_mode_suspend.
    // SIGCONT came: another program may have changed the screen and the mode.
    DIP_TERMINAL_RESUME = 8
};

// Enters the mode for pictures and takes over the signals. `input` and `output` are file
// descriptors of the same terminal. Fails with RUNTIME.
bool dip_terminal_mode_enter(int input, int output, DipError *err);

// Restores the terminal, and gives each signal the action that it had before the mode was entered.
void dip_terminal_mode_leave(void);

// Restores the terminal, stops the process as Ctrl+Z does, and enters the mode again when the
// process goes on, unless a signal has asked it to quit.
void dip_terminal_mode_suspend(void);

// Sets the mode again, because another program may have changed it.
void dip_terminal_mode_renew(void);

// Returns what signals have asked for since the last call, and forgets all of these requests but
// QUIT.
unsigned dip_terminal_mode_take_signals(void);

// Returns a file descriptor that has something to read when a signal has come.
int dip_terminal_mode_signal_fd(void);

// Writes all bytes to the terminal. Returns false if the terminal is gone, and also if a signal
// has asked the program to quit and the terminal has not taken all bytes at once.
bool dip_terminal_mode_write(const char *bytes, size_t count);

// --- terminal_writer.c ---------------------------------------------------------------------------
// The writer remembers what the terminal shows and encodes only the cells that differ. A cell shows
// two pixels of the picture, one above the other, as a half block (U+2580 or U+2584, or a space if
// both have the same colour) if the terminal has colours and UTF-8, otherwise as one character or
// colour that stands for the mean of both pixels. Colours are rounded to the terminal's palette, or
// in true colour to 64 values per channel, before cells are compared, so a change that is hard to
// see costs nothing.

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

// Returns whether the locale is not set or its character set is UTF-8, which has half blocks.
bool dip_terminal_has_utf8(const DipTerminalEnvironment *environment);

// Returns whether the terminal has escape sequences that place characters. A terminal whose TERM is
// not set or is "dumb" has none.
bool dip_terminal_can_place(const DipTerminalEnvironment *environment);

// A cell as the terminal shows it.
typedef struct DipTerminalCell {
    uint32_t code;  // Code point; 0 if it is not known what the cell shows.
    uint32_t ink;   // 0xRRGGBB or an index in the palette; 0 for a space and without colours.
    uint32_t paper; // 0xRRGGBB or an index in the palette; without colours, 1 is reverse video.
} DipTerminalCell;

// Zero-initialise a writer, set its first two fields, and call dip_terminal_writer_resize.
typedef struct DipTerminalWriter {
    DipTerminalColours colours; // Not AUTO.
    bool utf8;                  // False if the terminal shows ASCII only.

    int columns;
    int rows;
    DipTerminalCell *shown; // Owned: what the terminal shows.
    char *bytes;            // Owned: the bytes of the last frame.
    size_t count;
    // The terminal writes its next character in the colours of `pen` and at this column and row.
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

// Encodes a frame into writer->bytes. Cells outside the picture are black. `text` is text_rows rows
// of text_columns cells, or NULL. Returns writer->count, which is 0 if nothing has changed.
size_t dip_terminal_writer_encode(DipTerminalWriter *writer, const DipPixels *picture,
                                  const DipTextCell *text, int text_columns, int text_rows);

#endif
