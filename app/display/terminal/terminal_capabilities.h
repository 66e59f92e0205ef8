// What a terminal can show, found out from the environment. Private to this folder.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_CAPABILITIES_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_CAPABILITIES_H

#include "app/display/terminal/terminal_display.h"

// The environment variables that describe a terminal. A variable that is not set is NULL.
typedef struct DipTerminalEnvironment {
    const char *term;      // TERM
    const char *colorterm; // COLORTERM
    const char *no_color;  // NO_COLOR
    const char *locale;    // The first of LC_ALL, LC_CTYPE and LANG that is set and not empty.
} DipTerminalEnvironment;

DipTerminalEnvironment dip_terminal_environment(void);

// Returns the colours that the terminal can show; never AUTO. A NO_COLOR that is not empty means
// NONE (no-color.org).
DipTerminalColours dip_terminal_best_colours(const DipTerminalEnvironment *environment);

// Returns false if the locale names a character set that has no half blocks.
bool dip_terminal_has_utf8(const DipTerminalEnvironment *environment);

// Returns false if the terminal has no escape sequences that place characters.
bool dip_terminal_can_place(const DipTerminalEnvironment *environment);

#endif
