// The command line: which command, and its options.
#ifndef DIP_APP_COMMAND_LINE_H
#define DIP_APP_COMMAND_LINE_H

#include "app/command.h"

typedef struct DipCommandLine {
    const DipCommand *command; // The command that was named, else the first of the list.
    bool named;                // A command was named.
    // First word of several commands, "path", when the second word is --help; else NULL.
    const char *group;
    void *options; // The command's struct of options, which begins with DipProgramOptions.
} DipCommandLine;

// Reads argv[1..]. Free the result with dip_command_line_free, also after a failure.
bool dip_command_line_parse(const DipCommandList *list, int argc, char *const *argv,
                            DipCommandLine *line, DipError *err);
void dip_command_line_free(DipCommandLine *line);

#endif
