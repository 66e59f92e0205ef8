// Reads the options of a command line. Tables describe the options: a row is one option, and each
// command has a list of tables (command.h). The help and the manual page use the same tables.
#ifndef DIP_APP_CLI_OPTIONS_H
#define DIP_APP_CLI_OPTIONS_H

#include "renderer/base/error.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>

// How an option's value is read, and the type of the field that stores the value.
typedef enum DipOptionKind {
    DIP_OPTION_FLAG,     // bool; the option takes no value
    DIP_OPTION_TEXT,     // const char *, borrowed from argv
    DIP_OPTION_TEXTS,    // const char *[room]; the option may be repeated
    DIP_OPTION_INTEGER,  // int in least..most
    DIP_OPTION_NUMBER,   // double in least..most
    DIP_OPTION_SIZE,     // DipOptionSize
    DIP_OPTION_SETTINGS, // DipQuality
    DIP_OPTION_SET,      // DipOptionSet
    DIP_OPTION_CHOICE,   // int; the index in `names` of the name that was typed
    DIP_OPTION_LIST,     // array of at most `room` values of kind `item`; or any type, if `read`
                         // stores each value
    DIP_OPTION_CUSTOM    // any type; the function `read` stores the value
} DipOptionKind;

typedef struct DipOptionSize {
    int width; // Pixels.
    int height;
} DipOptionSize;

// Settings, and the text that gives them: as the user typed it, or as the program chose it.
typedef struct DipOptionSet {
    char text[DIP_SETTINGS_BYTES];
    DipQuality quality;
} DipOptionSet;

typedef struct DipOptionRow DipOptionRow;

// Stores a value in the struct that the row's table describes. Returns false and fills *err if the
// value is wrong.
typedef bool DipOptionReader(void *fields, const DipOptionRow *row, const char *value,
                             DipError *err);

// One option.
struct DipOptionRow {
    const char *name;     // "--size"
    const char *argument; // "WxH", for the help; NULL for a FLAG
    DipOptionKind kind;
    size_t field; // Offset of the field that holds the value. A LIST holds its values in an array.
    size_t given; // Offset of a bool that becomes true if the option is given; 0 if there is none.
    size_t count; // TEXTS and LIST: offset of an int that holds the number of values.
    int room;     // TEXTS and LIST: greatest number of values.
    DipOptionKind
        item;     // LIST without `read`: the kind of each value: INTEGER, NUMBER, SIZE or SET.
    double least; // INTEGER and NUMBER: the least value.
    double most;  // INTEGER and NUMBER: the greatest value. CHOICE: number of names.
    const char *const *names; // CHOICE: the names of the values.
    // What a value must be. The error message is "'VALUE' is not " and this text. NULL if the kind
    // of the option decides the message.
    const char *accepted;
    char separator;        // LIST, and CUSTOM with several values: what separates the values.
    DipOptionReader *read; // CUSTOM, and LIST without `item`: the function that stores a value.
    const char *text;      // Whole sentences for the help and the manual page.
};

// A group of options. All of them store their values in one struct.
typedef struct DipOptionTable {
    const char *title; // Heading of these options in the help: "Scene and camera".
    const DipOptionRow *rows;
    size_t count;
} DipOptionTable;

// Initialises a table with an array of rows.
#define DIP_OPTION_TABLE(title, rows)                                                              \
    { title, rows, sizeof(rows) / sizeof *(rows) }

// A table as a part of a command's options. Several commands can share a table.
typedef struct DipOptionPart {
    const DipOptionTable *table;
    size_t offset; // Offset of the table's struct in the command's struct of options.
} DipOptionPart;

// All options of a command.
typedef struct DipOptionParts {
    const DipOptionPart *items;
    size_t count;
} DipOptionParts;

// Reads the option argv[*index] and stores its value in `options`, the command's struct of options.
// The value may be in argv[*index + 1]. Sets *index to the index of the last argument that was
// read. `command` is the command's name, for messages. Returns false and fills *err if the option
// or its value is wrong.
bool dip_option_parse(const DipOptionParts *parts, const char *command, int argc, char *const *argv,
                      int *index, void *options, DipError *err);

// Stores an option's value in `fields`, the struct of its table. Does not set the bool of `given`.
// Returns false and fills *err if the value is wrong.
bool dip_option_store(const DipOptionRow *row, const char *value, void *fields, DipError *err);

// Finds a row by its name, and sets *part to the part that has the row. Returns NULL if no part has
// such a row.
const DipOptionRow *dip_option_find(const DipOptionParts *parts, const char *name,
                                    const DipOptionPart **part);

// --- for readers of values -----------------------------------------------------------------------

// Fills *err with the message "'VALUE' is not WHAT", where WHAT is `what`. Returns false.
bool dip_option_refuse(DipError *err, DipErrorCode code, const char *key, const char *value,
                       const char *what);

// Reads at most `count` whole numbers, which stand between separators. Returns how many numbers
// there are. Returns 0 if a part is not a whole number or there are more than `count` parts.
int dip_option_integers(const char *text, char separator, int count, int *values);

#endif
