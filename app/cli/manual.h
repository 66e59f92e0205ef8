// The manual page diptych(1), made from the commands and their tables of options.
#ifndef DIP_APP_CLI_MANUAL_H
#define DIP_APP_CLI_MANUAL_H

#include "app/cli/command.h"

#include <stdio.h>

// Prints the page in the man macros of roff.
void dip_manual_print(const DipCommandList *list, FILE *out);

#endif
