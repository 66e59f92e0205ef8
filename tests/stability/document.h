// Writes and checks docs/stability.md, the page that lists the catalogue.
#ifndef DIP_TESTS_STABILITY_DOCUMENT_H
#define DIP_TESTS_STABILITY_DOCUMENT_H

#include "renderer/catalogue/stability.h"

// The greatest errors of one row, per instruction set.
typedef struct StabilityErrors {
    bool known[DIP_ISA_COUNT]; // false: the row was not measured with this instruction set
    double worst[DIP_ISA_COUNT];
} StabilityErrors;

// The last section of the page: what Diptych does not promise.
extern const char *const stability_not_promised;

// Returns the number of rows of all topics.
size_t stability_row_count(void);

// Writes the page. errors has an element for each row, in the order of the topics.
bool stability_document_write(const char *path, const StabilityErrors *errors);

// Compares the page with the rows, except for the errors measured. Prints the first difference to
// standard error. Returns true if they agree.
bool stability_document_check(const char *path);

#endif
