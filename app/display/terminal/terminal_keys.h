// Reads the bytes that a terminal sends for keys and for the mouse. Private to this folder.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_KEYS_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_KEYS_H

#include "app/display/display.h"

// Reads one event from the first bytes. Returns the number of bytes that the event takes, or 0 if
// more bytes must follow. ended: no byte follows for now. A lone escape character then is the
// Escape key, and a sequence that breaks off is dropped.
//
// Key presses are KEY_DOWN events. A terminal reports neither releases nor positions of keys: the
// event's position is the key's code. Shift is known for letters and for keys without a character.
// Ctrl+C and Ctrl+Z end and suspend the program, so Alt stands for Ctrl with these two letters.
// Bytes that mean nothing to the preview are taken as an event of kind NONE.
int dip_terminal_keys_read(const uint8_t *bytes, int count, bool ended, DipEvent *event);

#endif
