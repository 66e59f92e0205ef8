// Options of a command line, described by tables. This file knows no command: each command brings
// its tables (command.h), and the parser, the help and the manual page are made from them.
#ifndef DIP_APP_OPTIONS_H
#define DIP_APP_OPTIONS_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>

// How an option's value is read, and the type of the field that it is stored in.
typedef enum DipOptionKind {
    DIP_OPTION_FLAG,     // bool; the option takes no value
    DIP_OPTION_TEXT,     // const char *, borrowed from argv
    DIP_OPTION_TEXTS,    // const char *[most]; the option may be repeated
    DIP_OPTION_INTEGER,  // int in least..most
    DIP_OPTION_NUMBER,   // double in least..most
    DIP_OPTION_SIZE,     // DipOptionSize
    DIP_OPTION_SETTINGS, // DipQuality
    DIP_OPTION_LIST,     // `read` stores each value; there are at most `most`
    DIP_OPTION_CUSTOM    // `read` stores the value
} DipOptionKind;

typedef struct DipOptionSize {
    int width; // Pixels.
    int height;
} DipOptionSize;

typedef struct DipOptionRow DipOptionRow;

// Stores a value in the struct that the row's table describes, or fills *err with what is wrong.
typedef bool DipOptionReader(void *fields, const DipOptionRow *row, const char *value,
                             DipError *err);

// One option.
struct DipOptionRow {
    const char *name;     // "--size"
    const char *argument; // "WxH", for the help; NULL for a FLAG
    const char *text;     // Whole sentences for the help and the manual page.
    DipOptionKind kind;
    size_t field; // Offset of the field that holds the value.
    size_t given; // Offset of a bool that becomes true when the option is given; 0: there is none.
    size_t count; // TEXTS and LIST: offset of an int that holds the number of values.
    double least; // INTEGER and NUMBER: the range of the value.
    double most;
    const char *accepted;  // What the value must be, for messages. NULL: it follows from the kind.
    char separator;        // LIST: the character between two values.
    DipOptionReader *read; // LIST and CUSTOM.
};

// Options that belong together, and whose fields stand in one struct.
typedef struct DipOptionTable {
    const char *title; // "Scene and camera", above the options in the help.
    const DipOptionRow *rows;
    size_t count;
} DipOptionTable;

// A table as a part of a command. Several commands can share a table.
typedef struct DipOptionPart {
    const DipOptionTable *table;
    size_t offset; // Where the table's struct starts in the command's struct of options.
} DipOptionPart;

// All options of a command.
typedef struct DipOptionParts {
    const DipOptionPart *items;
    size_t count;
} DipOptionParts;

// Reads argv[*index], and argv[*index + 1] if that is its value, into `options`, the command's
// struct of options. Leaves *index at the last argument read. `command` is the name for messages.
bool dip_option_parse(const DipOptionParts *parts, const char *command, int argc, char *const *argv,
                      int *index, void *options, DipError *err);

// Finds a row by its name. Returns NULL if no part has it.
const DipOptionRow *dip_option_find(const DipOptionParts *parts, const char *name);

// --- for readers of values -----------------------------------------------------------------------

// Fails with "'value' is not what"; returns false.
bool dip_option_refuse(DipError *err, DipErrorCode code, const char *key, const char *value,
                       const char *what);

// Calls `read` for each value between separators. Refuses empty values.
bool dip_option_each(void *fields, const DipOptionRow *row, const char *value, char separator,
                     DipOptionReader *read, DipError *err);

// Reads numbers between separators, at most `count`. Returns how many there are, or 0 if one is not
// a whole number or there are too many.
int dip_option_integers(const char *text, char separator, int count, int *values);

// Reads a whole number in the row's range.
bool dip_option_integer(const DipOptionRow *row, const char *value, int *number, DipError *err);

// Reads WIDTHxHEIGHT.
bool dip_option_size(const DipOptionRow *row, const char *value, DipOptionSize *size,
                     DipError *err);

#endif
