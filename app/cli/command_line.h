// Reads the command line: finds the command (command.h), and reads its options and operands.
#ifndef DIP_APP_CLI_COMMAND_LINE_H
#define DIP_APP_CLI_COMMAND_LINE_H

#include "app/cli/command.h"

typedef struct DipCommandLine {
    const DipCommand *command; // The named command, or the list's first if none is named.
    bool named;                // True if the command line names a command.
    // The first word of several commands' names, if the command line asks for the help of this
    // word, as in `diptych path --help`. The help then shows all of these commands. Otherwise NULL.
    const char *group;
    void *options; // The command's struct of options, which begins with DipProgramOptions.
} DipCommandLine;

// Reads argv[1..argc - 1]. Returns false and fills *err if the command line is wrong or memory runs
// out. Free *line with dip_command_line_free even after a failure.
bool dip_command_line_parse(const DipCommandList *list, int argc, char *const *argv,
                            DipCommandLine *line, DipError *err);
void dip_command_line_free(DipCommandLine *line);

#endif
