// Switches the terminal to the mode for pictures and back, and takes the signals that a program in
// a terminal gets. Private to this folder.
//
// A process has one mode: all functions concern the same terminal. Whatever ends the process, the
// terminal gets back its settings, its screen and its cursor, unless the process dies by SIGKILL.
#ifndef DIP_APP_DISPLAY_TERMINAL_TERMINAL_MODE_H
#define DIP_APP_DISPLAY_TERMINAL_TERMINAL_MODE_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>

// What signals have asked for, as bits.
enum {
    DIP_TERMINAL_QUIT = 1,   // SIGINT, SIGTERM or SIGHUP came.
    DIP_TERMINAL_RESIZE = 2, // SIGWINCH came.
    DIP_TERMINAL_STOP = 4,   // SIGTSTP came: the caller must call dip_terminal_mode_suspend.
    DIP_TERMINAL_RESUME =
        8 // SIGCONT came: another program may have changed the screen and the mode.
};

// Enters the mode for pictures and takes over the signals. input and output: file descriptors of
// the same terminal. Fails with RUNTIME.
bool dip_terminal_mode_enter(int input, int output, DipError *err);

// Restores the terminal and gives the signals back.
void dip_terminal_mode_leave(void);

// Restores the terminal, stops the process as Ctrl+Z does, and enters the mode again when the
// process goes on.
void dip_terminal_mode_suspend(void);

// Sets the mode again, because another program may have changed it.
void dip_terminal_mode_renew(void);

// Returns what signals have asked for since the last call, and forgets it. QUIT is not forgotten.
unsigned dip_terminal_mode_take_signals(void);

// Returns a file descriptor that has something to read when a signal has come.
int dip_terminal_mode_signal_fd(void);

// Writes all bytes to the terminal. Returns false if the terminal is gone, and also if a signal
// asks the program to quit while the terminal takes no bytes.
bool dip_terminal_mode_write(const char *bytes, size_t count);

#endif
