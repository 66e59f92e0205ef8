// Lists of the fields of records, from which all forms of a report come: JSON (written and read),
// CSV, text, HTML, and the documentation of the formats.
//
// A fact is a member of the record, and is read back. A derived field is computed from facts; it is
// written and never read, so that a file cannot contradict its own measurements. An estimate is
// written as x, x_low and x_high in every form, all three always.
#ifndef DIP_APP_REPORT_FORMAT_FIELDS_H
#define DIP_APP_REPORT_FORMAT_FIELDS_H

#include "app/measure/stats/estimate.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum DipFieldKind {
    DIP_FIELD_TEXT,     // char[size].
    DIP_FIELD_WHOLE,    // int in least..most.
    DIP_FIELD_FLAG,     // bool.
    DIP_FIELD_NUMBER,   // double in least..most; not finite: not known.
    DIP_FIELD_ESTIMATE, // DipEstimate; low and high are known if low < high.
    DIP_FIELD_SETTINGS, // DipQuality: "aa=4,taa=off,...".
    DIP_FIELD_NAMED,    // int: an index of `names`.
    DIP_FIELD_NUMBERS,  // double[size / sizeof(double)]: an object if they have names, or an array.
    DIP_FIELD_RECORD,   // A struct that has fields itself.
    DIP_FIELD_LIST      // Any number of records.
} DipFieldKind;

// How a field is written.
enum {
    DIP_FIELD_JSON = 1,   // It is a member of the object in JSON.
    DIP_FIELD_DERIVED = 2 // It is computed, and not read.
};

// How people read a field.
enum {
    DIP_SHOW_SIGN = 1,    // It is a change.
    DIP_SHOW_FIGURES = 2, // `digits` are significant figures.
    DIP_SHOW_CODE = 4     // People copy the text.
};

// An item of which a field is asked. Those of lists and records within others know their owner.
typedef struct DipFieldAt {
    void *context;                  // What all items belong to, for example the report.
    const void *item;               // NULL: not known, so no field is.
    int index;                      // In its list.
    const struct DipFieldAt *owner; // NULL for the outermost record.
} DipFieldAt;

// Room for a derived value.
typedef union DipFieldScratch {
    double numbers[256];
    char text[2048];
} DipFieldScratch;

// Returns the value, which may lie in *scratch, or NULL if it is not known.
typedef const void *DipFieldDerive(const DipFieldAt *at, DipFieldScratch *scratch);

struct DipField;

// A struct that has fields.
typedef struct DipRecord {
    const char *name; // In the documentation.
    const char *means;
    const struct DipField *fields;
    int count;
    size_t size;
    // Whether the facts fit together, once all of an item are read. NULL: they always do.
    bool (*check)(const DipFieldAt *at);
} DipRecord;

// A list that a record has. `at` is that of the owner.
typedef struct DipFieldList {
    const DipRecord *record;        // Of the items; NULL if each is a single value:
    const struct DipField *element; // its kind and range. It has no name.
    int (*count)(const DipFieldAt *at);
    // Returns the item; it may be made up in *scratch. Items are written in order, and *scratch
    // still has what was made up for the item before.
    const void *(*item)(const DipFieldAt *at, int index, DipFieldScratch *scratch);
    // Makes room for items that are read. Returns DIP_ERROR_NONE, DIP_ERROR_FORMAT (so many are
    // impossible) or DIP_ERROR_MEMORY.
    DipErrorCode (*open)(const DipFieldAt *at, int count);
    // Takes an item that was read. NULL: items are read where they lie.
    bool (*put)(const DipFieldAt *at, int index, const void *item);
    // Functions that are NULL work on an array that is a member of the owner:
    size_t items;   // Offset of the array, or
    bool points;    // of a pointer to it, which is allocated on reading.
    size_t counted; // Offset of the number of items, an int.
    int most;       // Greatest number of items.
    size_t stride;  // Bytes from item to item; 0: the size of the record or element.
    size_t within;  // Offset of the item in each of them.
} DipFieldList;

typedef struct DipField {
    const char *name;  // Key in JSON, and column in CSV: "p95_ms".
    const char *title; // Column for people: "p95"; NULL: the name.
    const char *unit;  // "ms", or NULL.
    const char *means; // A sentence for the documentation and the page's glossary.
    DipFieldKind kind;
    unsigned where;
    unsigned show;
    int digits;         // After the point, for people.
    double scale;       // People read the value times this; 0: the value. `unit` is what they read.
    double least, most; // Range of a fact.
    size_t offset, size;
    const char *const *names;
    int name_count;
    const DipRecord *record;
    const DipFieldList *list;
    DipFieldDerive *derive;              // NULL: the value is the member at `offset`.
    bool (*known)(const DipFieldAt *at); // NULL: always. A value that is not known is null.
} DipField;

// Returns where a field's value lies, or NULL if it is not known.
const void *dip_field_value(const DipField *field, const DipFieldAt *at, DipFieldScratch *scratch);

// The number of items of a list, and an item.
int dip_field_list_count(const DipFieldList *list, const DipFieldAt *at);
const void *dip_field_list_item(const DipFieldList *list, const DipFieldAt *at, int index,
                                DipFieldScratch *scratch);

// True if both ends of an interval are known: they are finite and not the same.
bool dip_field_has_interval(const DipEstimate *estimate);

// Writes a number with as few digits as tell it from all others.
void dip_field_format_exact(double value, char text[32]);

// Finds the field with a path, "errors.flip", and visits it with its value, or NULL. With ".value"
// at its end, an estimate is visited as a number. `at->item` may be NULL. Asserts that there is
// such a field.
typedef void DipFieldVisit(void *context, const DipField *field, const void *value);
void dip_field_visit(const DipRecord *record, const DipFieldAt *at, const char *path,
                     DipFieldVisit *visit, void *context);

// --- forms ---------------------------------------------------------------------------------------

// Prints an item as a JSON object.
void dip_fields_print_json(const DipRecord *record, const DipFieldAt *at, FILE *out);

// Reads the facts of an item from a JSON object. Fails with DIP_ERROR_FORMAT, whose key is the path
// of the field that is missing or impossible, or with DIP_ERROR_MEMORY.
struct cJSON;
bool dip_fields_read_json(const DipRecord *record, const DipFieldAt *at, const struct cJSON *object,
                          const char *file, DipError *err);

// A column of a table: the path of a field, and its title in this table. NULL: in CSV the path with
// '_' for '.'; for people the field's own. An object of numbers has a column for each, named after
// it alone if the title is "".
typedef struct DipColumn {
    const char *path;
    const char *title;
} DipColumn;

// Prints the names of the columns if `at->item` is NULL, or an item's line of CSV. An estimate has
// three columns. What is not known is empty.
void dip_fields_print_csv(const DipRecord *record, const DipFieldAt *at, const DipColumn *columns,
                          int count, FILE *out);

// --- tables for people
// -----------------------------------------------------------------------------

enum { DIP_CELL_BYTES = 512, DIP_TABLE_MOST_CELLS = 64 };

// Writes a value as people read it: with the field's digits, in its unit, with the sign of a
// change; a flag that is true as its title. What is not known, and a flag that is false, is "". A
// change whose interval holds 0 is marked with '?'.
void dip_field_text(const DipField *field, const void *value, char text[DIP_CELL_BYTES]);

// Writes an estimate's interval, "1.23 to 1.45", or "".
void dip_field_interval_text(const DipField *field, const DipEstimate *estimate,
                             char text[DIP_CELL_BYTES]);

// A table of items of one record. Terminals and pages print the same columns, without those of
// which no line knows anything, and without the numbers of an object that are the same in all
// lines. All members are borrowed.
typedef struct DipTable {
    const char *id; // Of the table in a page, and the name of the file that its CSV is saved to.
    const char *caption; // NULL or "": none.
    const DipRecord *record;
    const DipColumn *columns;
    int column_count;
    void *context;
    const void *items;
    int count;
    bool (*shows)(const DipFieldAt *at); // NULL: all items are shown.
    int (*row)(const DipFieldAt *at);    // Row of a report that an item shows, or -1. NULL: none.
    const char *set;                     // Set of pictures of the rows; NULL: none.
} DipTable;

// A cell of the table's line with this index, or of its head (-1: titles and units).
typedef struct DipCell {
    const DipField *field;
    const void *value; // NULL: not known.
    const char *text;
    const char *unit; // Of the head; NULL: none.
    int index;        // In the line.
    bool is_text;     // It is set to the left.
} DipCell;

// Visits all cells of a line. An estimate has a second cell for its interval.
typedef void DipCellVisit(void *context, const DipCell *cell);
void dip_table_visit(const DipTable *table, int line, DipCellVisit *visit, void *context);

// Finds out which cells of the table's lines are shown, and how many characters they have at most.
typedef struct DipTableLayout {
    bool shown[DIP_TABLE_MOST_CELLS];
    int width[DIP_TABLE_MOST_CELLS];
    int last; // The last cell that is shown.
} DipTableLayout;
void dip_table_measure(const DipTable *table, DipTableLayout *layout);

// Whether the line with this index is shown, and the row of the report that it shows, or -1.
bool dip_table_shows(const DipTable *table, int line);
int dip_table_row(const DipTable *table, int line);

// Prints a table without its caption for a terminal, each line after two blanks.
void dip_table_print_text(const DipTable *table, FILE *out);

// Prints a table for a page, with its caption.
void dip_table_print_html(const DipTable *table, FILE *out);

#endif
