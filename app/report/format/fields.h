// Declares lists of the fields of structs. From these lists come JSON (written and read), CSV,
// tables for terminals and pages, and the documentation of the formats.
//
// A fact is a field that is written and read back; it is a member of the struct. A derived field is
// computed from facts; it is written and never read, so that a file cannot contradict its own
// measurements. JSON and CSV always have an estimate x as the three values x, x_low and x_high.
#ifndef DIP_APP_REPORT_FORMAT_FIELDS_H
#define DIP_APP_REPORT_FORMAT_FIELDS_H

#include "app/measure/stats/estimate.h"
#include "app/report/words.h"
#include "renderer/base/error.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum DipFieldKind {
    DIP_FIELD_TEXT,     // char[size].
    DIP_FIELD_WHOLE,    // int in least..most.
    DIP_FIELD_FLAG,     // bool.
    DIP_FIELD_NUMBER,   // double in least..most; a value that is not finite counts as unknown.
    DIP_FIELD_ESTIMATE, // DipEstimate; low and high are known if low < high.
    DIP_FIELD_SETTINGS, // DipQuality: "aa=4,taa=off,...".
    DIP_FIELD_NAMED,    // int: an index of `names`.
    DIP_FIELD_NUMBERS,  // double[size / sizeof(double)]; an object in JSON if `names` is not NULL,
                        // otherwise an array.
    DIP_FIELD_RECORD,   // A struct that has fields itself.
    DIP_FIELD_LIST      // Any number of structs or values.
} DipFieldKind;

// How a field is written.
enum {
    DIP_FIELD_JSON = 1,   // The field is a member of the object in JSON.
    DIP_FIELD_DERIVED = 2 // The field is derived, and so it is never read.
};

// How people read a field.
enum {
    DIP_SHOW_SIGN = 1,    // The field is a change, and is written with '+' or '-'.
    DIP_SHOW_FIGURES = 2, // `digits` are significant figures.
    DIP_SHOW_CODE = 4,    // The field is code that people copy. Pages mark it as code.
    DIP_SHOW_OF_TIMES = 8 // The field has no unit of time, but is computed from times, as a ratio.
};

// Names the item whose field is wanted. An item is a struct that has fields.
typedef struct DipFieldAt {
    void *context;                  // What all items belong to, for example the report.
    const void *item;               // NULL if the item, and so each of its fields, is not known.
    int index;                      // Index of the item in its list.
    const struct DipFieldAt *owner; // The item that has this item; NULL for the outermost one.
} DipFieldAt;

// Room for a derived value.
typedef union DipFieldScratch {
    double numbers[256];
    char text[2048];
} DipFieldScratch;

// Returns the value of a derived field, which may lie in *scratch, or NULL if it is not known.
typedef const void *DipFieldDerive(const DipFieldAt *at, DipFieldScratch *scratch);

struct DipField;

// A kind of struct that has fields.
typedef struct DipRecord {
    const char *name;  // Name in the documentation.
    const char *means; // A sentence for the documentation.
    const struct DipField *fields;
    int count;
    // Bytes from item to item. If `size` is 0, the items are no structs of their own. Their owner
    // then has an array for each field, and item i's value of the field lies i * DipField.stride
    // bytes behind the array's start.
    size_t size;
    // Returns whether the facts of an item fit together. It is called once all facts of the item
    // have been read. NULL if they always fit.
    bool (*check)(const DipFieldAt *at);
} DipRecord;

// A list that an item has. `at` is the item that owns the list.
typedef struct DipFieldList {
    const DipRecord *record; // Kind of the list's items; NULL if each item is a single value.
    // If `record` is NULL, a nameless field with the kind, range and stride of the values.
    const struct DipField *element;
    int (*count)(const DipFieldAt *at);
    // Returns the item, which the function may construct in *scratch. Items are written in order,
    // and at each call *scratch still holds what the previous call left there.
    const void *(*item)(const DipFieldAt *at, int index, DipFieldScratch *scratch);
    // Makes room for `count` items that are read. Returns DIP_ERROR_NONE, DIP_ERROR_FORMAT if this
    // number is impossible, or DIP_ERROR_MEMORY.
    DipErrorCode (*open)(const DipFieldAt *at, int count);
    // Stores an item that was read. Returns false if the item is impossible. NULL if each item is
    // read into its final place.
    bool (*put)(const DipFieldAt *at, int index, const void *item);
    // In place of each function above that is NULL, the following members are used. They describe
    // an array that is a member of the owner.
    size_t items;    // Offset of the array; 0 if the record's size is 0.
    bool points;     // True if the member is a pointer to the array, which reading allocates.
    size_t counted;  // Offset of the number of items, an int.
    int least, most; // Range of the number of items that are read.
} DipFieldList;

typedef struct DipField {
    const char *name;  // Key in JSON, and column in CSV: "p95_ms".
    const char *title; // Title of the column in tables for people: "p95"; NULL stands for `name`.
    const char *unit;  // "ms", or NULL.
    const char *means; // A sentence for the documentation and the page's glossary.
    DipFieldKind kind;
    unsigned where; // Sum of DIP_FIELD_JSON and DIP_FIELD_DERIVED, or one of them.
    unsigned show;  // Sum of the DIP_SHOW_ values that hold.
    int digits; // For people: digits after the point, or significant figures with DIP_SHOW_FIGURES.
    double scale;       // Tables for people show the value times this, in `unit`; 0 means 1.
    double least, most; // Range of a fact.
    size_t offset, size;
    size_t stride; // Bytes from one item's value to the next item's value, if both lie in one
                   // array.
    const char *const *names; // Names of the values of DIP_FIELD_NAMED or of DIP_FIELD_NUMBERS.
    int name_count;           // Number of names that DIP_FIELD_NAMED accepts on reading.
    const DipRecord *record;
    const DipFieldList *list;
    DipFieldDerive *derive; // NULL if the value is the member at `offset`.
    // Returns whether the value is known; JSON has null for an unknown value. NULL if the value is
    // always known.
    bool (*known)(const DipFieldAt *at);
} DipField;

// Returns where a field's value lies, or NULL if it is not known.
const void *dip_field_value(const DipField *field, const DipFieldAt *at, DipFieldScratch *scratch);

// Returns the address of a field's value. The field must be a member of its struct (no `derive`).
void *dip_field_member(const DipField *field, const DipFieldAt *at);

// Returns the text of a value that is a text, a name or settings, or NULL for other kinds. The text
// of settings is written to `settings`.
const char *dip_field_as_text(const DipField *field, const void *value,
                              char settings[DIP_SETTINGS_BYTES]);

// Returns whether both ends of an interval are known: they are finite, and low is below high.
bool dip_field_has_interval(const DipEstimate *estimate);

// A field that was found, and its value.
enum { DIP_FIELD_DEPTH = 4 };
typedef struct DipFieldFound {
    DipField field;
    const void *value; // NULL if it is not known.
    DipFieldScratch scratch[DIP_FIELD_DEPTH];
} DipFieldFound;

// Finds the field with a path such as "errors.flip". If the path of an estimate ends with ".value",
// finds only the estimate's number. `at->item` may be NULL. Asserts that there is such a field.
void dip_field_find(const DipRecord *record, const DipFieldAt *at, const char *path,
                    DipFieldFound *found);

// --- JSON and CSV --------------------------------------------------------------------------------

// Prints an item as a JSON object.
void dip_fields_print_json(const DipRecord *record, const DipFieldAt *at, FILE *out);

// Writes an item to a JSON file, whole or not at all. The item is also DipFieldAt.context.
bool dip_fields_write_json(const DipRecord *record, const void *item, const char *file,
                           DipError *err);

// Reads the facts of an item from a JSON object. Fails with DIP_ERROR_FORMAT, where err->key is the
// path of the field that is missing or impossible, or with DIP_ERROR_MEMORY.
struct cJSON;
bool dip_fields_read_json(const DipRecord *record, const DipFieldAt *at, const struct cJSON *object,
                          const char *file, DipError *err);

// The columns of a table are listed in a text such as "settings; row.ms=time; row.counters=". The
// text has the paths of fields. After a path, there may be '=' and the title that the column has in
// this table. Without '=', the title in CSV is the path with '_' in place of '.', and the title for
// people is the field's own. An object of numbers has a column for each number. In CSV, this column
// has the title followed by the number's name (DipField.names). Tables for people show the number's
// name alone.
typedef struct DipColumn {
    char path[64];
    char title[64];
    bool has_title;
} DipColumn;

// Takes the first column from a list. Returns false if the list is empty.
bool dip_column_take(const char **columns, DipColumn *column);

// Prints a line of CSV: an item, or the names of the columns if `at->item` is NULL. An estimate has
// three columns. The cell of a value that is not known is empty.
void dip_fields_print_csv(const DipRecord *record, const DipFieldAt *at, const char *columns,
                          FILE *out);

// --- tables for people ---------------------------------------------------------------------------

enum { DIP_CELL_BYTES = 512 };

// Writes an estimate's interval, "1.23 to 1.45", or "" if the interval is not known. Rounding
// carries neither end over a limit.
void dip_field_interval_text(const DipField *field, DipLimits limits, const DipEstimate *estimate,
                             char text[DIP_CELL_BYTES]);

// A table of items of one record. Terminals and pages print the same columns. They leave out
// columns whose cells are all empty and, in a table of several lines, the numbers of an object that
// are the same in all lines. A value has its field's digits, its unit in the head, and, if it is a
// change, its sign. An estimated change whose interval holds 0 is marked with '?'. An estimate has
// a second column for its interval. A flag that is true is shown as its title. The cell of a value
// that is not known, or of a flag that is false, is empty; terminals show '-' for an unknown number
// or interval. All members are borrowed.
typedef struct DipTable {
    const char *id; // Id of the table in a page, and the name of the file that its CSV is saved to.
    const char *caption; // NULL or "" if there is none.
    const DipRecord *record;
    const char *columns;
    void *context;
    const void *items;
    int count;
    // Milliseconds that no rounded time crosses: the budgets beside the table. If they are marked
    // as doubtful, so are all times and all fields with DIP_SHOW_OF_TIMES.
    DipLimits limits;
    bool (*shows)(const DipFieldAt *at); // Returns whether to show an item; NULL shows all items.
    // Items may have an int member with the index of the row of the report that the item shows, or
    // -1 if it shows none. `row` points to this member of the first item. The other items have it
    // at the same offset. NULL if no item shows a row.
    const int *row;
    const char *set; // Name of the page's set of pictures of these rows; NULL if there is none.
} DipTable;

// Prints a table without its caption for a terminal. Each line begins with two blanks.
void dip_table_print_text(const DipTable *table, FILE *out);

// Prints a table for a page, with its caption. The page's scripts find the rows of a report by the
// attribute data-row, and the settings that a table can be filtered by in data-settings.
void dip_table_print_html(const DipTable *table, FILE *out);

#endif
