// Describes a command of the program. To add a command, define its DipCommand in a folder of its
// own, and add the DipCommand to the list in command_list.c.
#ifndef DIP_APP_CLI_COMMAND_H
#define DIP_APP_CLI_COMMAND_H

#include "app/cli/options.h"

typedef struct DipSession DipSession;       // app/session/session.h
typedef struct DipSessionDef DipSessionDef; // app/session/session.h

// Options that every command has. Every command's struct of options begins with this struct.
typedef struct DipProgramOptions {
    int argc;          // Number of elements of argv.
    char *const *argv; // The whole command line. Borrowed.
    const char *log;   // File to which warnings, errors and notes are also written, or NULL.
    bool help;
    bool version;
} DipProgramOptions;

extern const DipOptionTable dip_program_option_table;

// Arguments that are not options, such as the files of `diptych path convert`. They are stored as
// an array of `const char *`.
typedef struct DipOperands {
    size_t field; // Offset of the array in the command's struct of options.
    size_t count; // Offset of the int that holds the number of operands.
    int most;     // Greatest number of operands; 0 if the command takes none.
} DipOperands;

// An example in the help of a command.
typedef struct DipExample {
    const char *typed; // The command line: "diptych dump --out out".
    const char *does;  // What the command does, beginning with a verb: "draws one frame".
} DipExample;

typedef struct DipCommand {
    const char *name;    // One or two words, such as "dump" or "cost merge".
    const char *summary; // Line in the list of commands; starts with a verb.
    const char *usage;   // What follows the name on the command line: "--out DIR [OPTION]..."
    const char *text;    // Paragraphs that explain the command, separated by "\n\n".
    const DipExample *examples;
    size_t example_count;
    bool lists_settings; // True if the help also lists the settings, because one of the options
                         // takes settings.
    const DipOptionParts *parts;
    DipOperands operands;
    size_t options_size; // Bytes of the command's struct of options.

    // Fills in the default of every option. Before the call, the struct is zero except for the
    // command line in its DipProgramOptions. The function may be NULL if zero is the default of
    // every option.
    void (*set_defaults)(void *options);

    // Returns false and fills *err if options contradict each other or a necessary option is
    // missing. The function may be NULL if any options may be combined.
    bool (*check)(const void *options, DipError *err);

    // Says in *def what the session must load. The function is NULL if the command runs without a
    // session.
    void (*describe_session)(const void *options, DipSessionDef *def);

    // Does the command's work. Returns false and fills *err if it fails. The session is NULL if
    // describe_session is NULL.
    bool (*run)(DipSession *session, const void *options, DipError *err);
} DipCommand;

// A former command, whose name has two words. Typing it is an error that says what to type now.
typedef struct DipMovedCommand {
    const char *name;
    const char *instead; // What to type now.
} DipMovedCommand;

// The commands of a program. The first command runs if the command line names no command. Hidden
// commands run when they are named, but neither the list of commands in the help nor the manual
// page shows them, because the program itself starts them. Their names are single words.
typedef struct DipCommandList {
    const DipCommand *const *commands;
    size_t count;
    const DipCommand *const *hidden;
    size_t hidden_count;
    const DipMovedCommand *moved;
    size_t moved_count;
} DipCommandList;

#endif
