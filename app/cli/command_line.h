// Reads the command line: finds the command and reads its options.
#ifndef DIP_APP_CLI_COMMAND_LINE_H
#define DIP_APP_CLI_COMMAND_LINE_H

#include "app/cli/command.h"

typedef struct DipCommandLine {
    const DipCommand *command; // The named command; if none is named, the list's first.
    bool named;                // The command line names a command.
    // After `diptych path --help`: "path", the first word that several commands share. Otherwise
    // NULL.
    const char *group;
    void *options; // The command's struct of options, which begins with DipProgramOptions.
} DipCommandLine;

// Reads argv[1..]. Free the result with dip_command_line_free, also after a failure.
bool dip_command_line_parse(const DipCommandList *list, int argc, char *const *argv,
                            DipCommandLine *line, DipError *err);
void dip_command_line_free(DipCommandLine *line);

#endif
