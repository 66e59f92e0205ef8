// Opens the display of a terminal. The display shows pictures as half blocks in the terminal's
// colours, or as characters if the terminal has no colours, and shows texts over them.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_DISPLAY_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_DISPLAY_H

#include "app/display/display.h"

// The colours that a terminal can show.
typedef enum DipTerminalColours {
    DIP_TERMINAL_AUTO, // The environment variables decide.
    DIP_TERMINAL_TRUE, // Colours of 24 bits.
    DIP_TERMINAL_256,  // The palette of xterm: a cube of 216 colours, and 24 greys.
    DIP_TERMINAL_NONE  // No colours: brightness becomes characters.
} DipTerminalColours;

// Returns whether standard output is a terminal that can show pictures. A "dumb" terminal cannot.
bool dip_terminal_is_there(void);

// Puts the terminal of standard output into the mode for pictures: the terminal shows its alternate
// screen, hides the cursor and reports the mouse. Keys come from standard input if that is a
// terminal, otherwise from the controlling terminal. The display restores the terminal when it
// closes, when the process exits or crashes, and while the user suspends the process. SIGINT,
// SIGTERM and SIGHUP become DIP_EVENT_QUIT; a second such signal ends the process at once.
//
// A process may have one such display at a time. Fails with RUNTIME if standard output is no
// terminal that can show pictures, if there is no terminal to read keys from, or if the terminal's
// mode cannot be set. Fails with MEMORY when memory runs out. The caller closes the display.
bool dip_terminal_display_open(DipDisplay *display, DipTerminalColours colours, DipError *err);

#endif
