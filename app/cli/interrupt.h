// Handles Ctrl-C: a command first finishes the frame or measurement that it has begun.
#ifndef DIP_APP_CLI_INTERRUPT_H
#define DIP_APP_CLI_INTERRUPT_H

#include <stdbool.h>

// From now on, the first SIGINT (Ctrl-C) or SIGTERM only sets a flag. The second one ends the
// program at once.
void dip_interrupt_watch(void);

// True once the first signal has come.
bool dip_interrupted(void);

#endif
