// Writes and checks docs/stability.md, the page that lists the catalogue.
#ifndef DIP_TESTS_STABILITY_DOCUMENT_H
#define DIP_TESTS_STABILITY_DOCUMENT_H

#include "renderer/catalogue/stability.h"

// What was measured of one row, per instruction set.
typedef struct StabilityMeasured {
    bool known[DIP_ISA_COUNT];     // false: the row was not measured with this instruction set
    double worst[DIP_ISA_COUNT];   // greatest error
    uint64_t cases[DIP_ISA_COUNT]; // number of cases that were compared
} StabilityMeasured;

// The last section of the page: what Diptych does not promise.
extern const char *const stability_not_promised;

// Returns the number of rows of all topics.
size_t stability_row_count(void);

// Writes the page. measured has an element for each row, in the order of the topics.
bool stability_document_write(const char *path, const StabilityMeasured *measured);

// Compares the page with the rows, except for what was measured. Prints the first difference to
// standard error. Returns true if they agree.
bool stability_document_check(const char *path);

// Reads the number of cases of each row from the page: `cases` has an element for each row. Prints
// what is wrong with the page to standard error. Returns true if it has a number for every row.
bool stability_document_read_cases(const char *path, uint64_t *cases);

#endif
