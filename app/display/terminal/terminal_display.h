// Opens the display of a terminal. It shows pictures as half blocks in the terminal's colours, with
// characters over them.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_DISPLAY_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_DISPLAY_H

#include "app/display/display.h"

// The colours that a terminal can show.
typedef enum DipTerminalColours {
    DIP_TERMINAL_AUTO, // Find out from the environment.
    DIP_TERMINAL_TRUE, // 24 bits.
    DIP_TERMINAL_256,  // The palette of xterm: a cube of 216 colours, and 24 greys.
    DIP_TERMINAL_NONE  // No colours: brightness becomes characters.
} DipTerminalColours;

// Returns whether standard output is a terminal that can show pictures. A "dumb" terminal cannot.
bool dip_terminal_is_there(void);

// Puts the terminal of standard output into the mode for pictures: it shows its alternate screen,
// hides the cursor and reports the mouse. Keys come from standard input if that is a terminal,
// otherwise from the controlling terminal. The display restores the terminal when it closes, when
// the process exits or crashes, and while the user suspends the process. SIGINT, SIGTERM and SIGHUP
// become DIP_EVENT_QUIT; a second one of them ends the process at once.
//
// A process may have one such display at a time. Fails with RUNTIME if standard output is no
// terminal that can show pictures or the terminal cannot be controlled, or with MEMORY. The
// caller closes the display.
bool dip_terminal_display_open(DipDisplay *display, DipTerminalColours colours, DipError *err);

#endif
