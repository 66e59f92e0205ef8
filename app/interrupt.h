// Ctrl-C that lets a command finish what it has in hand.
#ifndef DIP_APP_INTERRUPT_H
#define DIP_APP_INTERRUPT_H

#include <stdbool.h>

// From now on the first Ctrl-C (or request to end) only sets a flag; the second ends the program.
void dip_interrupt_watch(void);
bool dip_interrupted(void);

#endif
