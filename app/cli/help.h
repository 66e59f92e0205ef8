// Prints the help of --help and the manual page diptych(1). Both are made from the commands and
// their tables of options.
#ifndef DIP_APP_CLI_HELP_H
#define DIP_APP_CLI_HELP_H

#include "app/cli/command_line.h"

#include <stdio.h>

// Prints the help of the command that the command line names, of a group of commands such as
// `path`, or of the program if neither is named.
void dip_help_print(const DipCommandList *list, const DipCommandLine *line, FILE *out);

// Prints the manual page in the man macros of roff.
void dip_manual_print(const DipCommandList *list, FILE *out);

#endif
