// What a command of the program is: a row of the list in command_list.c. To add a command, write
// its folder with one such row and add the row to that list.
#ifndef DIP_APP_COMMAND_H
#define DIP_APP_COMMAND_H

#include "app/options.h"
#include "app/session.h"

// Options that every command has. Every command's struct of options begins with this struct.
typedef struct DipProgramOptions {
    const char *log; // File that gets a copy of warnings and errors, or NULL.
    bool help;
    bool version;
} DipProgramOptions;

extern const DipOptionTable dip_program_option_table;

// Arguments that are not options, such as the files of `diptych path convert`. They are stored as
// an array of `const char *`.
typedef struct DipOperands {
    size_t field; // Offset of the array in the command's struct of options.
    size_t count; // Offset of the int that holds their number.
    int most;     // Most operands the command takes; 0: it takes none.
} DipOperands;

// Texts that show a command at work: "diptych dump --out out", "draws one frame".
typedef struct DipExample {
    const char *typed;
    const char *does; // Whole sentence without a full stop.
} DipExample;

typedef struct DipCommand {
    const char *name;    // "dump", "cost merge": one word or two.
    const char *summary; // Starts with a verb; one line in the list of commands.
    const char *usage;   // What follows the name: "--out DIR [OPTION]..."
    const char *text;    // Paragraphs that explain the command, separated by "\n\n".
    const DipExample *examples;
    size_t example_count;
    bool lists_settings; // The help explains the settings (SET), since options take them.
    const DipOptionParts *parts;
    DipOperands operands;
    size_t options_size; // Bytes of the command's struct of options.

    // Fills in what holds when an option is not given; the struct is zero before. argv is the whole
    // command line. NULL: zeros are right.
    void (*set_defaults)(void *options, int argc, char *const *argv);

    // Refuses options that do not fit together, or too few of them.
    bool (*check)(const void *options, DipError *err);

    // Says what the session must load. NULL: the command runs without a session.
    void (*describe_session)(const void *options, DipSessionDef *def);

    // Does the work. The session is NULL if there is no describe_session.
    bool (*run)(DipSession *session, const void *options, DipError *err);
} DipCommand;

// The commands of a program. The first one runs when none is named.
typedef struct DipCommandList {
    const DipCommand *const *commands;
    size_t count;
} DipCommandList;

#endif
