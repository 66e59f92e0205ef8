// Writes and checks docs/stability.md, the page that lists the catalogue.
#ifndef DIP_TESTS_STABILITY_DOCUMENT_H
#define DIP_TESTS_STABILITY_DOCUMENT_H

#include "renderer/catalogue/stability.h"

// What was measured of one row, per instruction set.
typedef struct StabilityMeasured {
    bool known[DIP_ISA_COUNT];     // false: the row was not measured with this instruction set
    double worst[DIP_ISA_COUNT];   // greatest error
    uint64_t cases[DIP_ISA_COUNT]; // number of cases that were compared
    char hash[DIP_ISA_COUNT][DIP_HASH_HEX_SIZE]; // of the cases and results, see StabilityRun
} StabilityMeasured;

// What the page says of the measurements of a row.
typedef struct StabilityListed {
    uint64_t cases; // number of cases
    char hash[DIP_HASH_HEX_SIZE];
} StabilityListed;

// The last section of the page: what Diptych does not promise.
extern const char *const stability_not_promised;

// Returns the number of rows of all topics.
size_t stability_row_count(void);

// Writes the page. measured has an element for each row, in the order of the topics.
bool stability_document_write(const char *path, const StabilityMeasured *measured);

// Compares the page with the rows, except for what was measured. Prints the first difference to
// standard error. Returns true if they agree.
bool stability_document_check(const char *path);

// Reads the number of cases and the hash of each row from the page: `listed` has an element for
// each row. Prints what is wrong with the page to standard error. Returns true if it has every row.
bool stability_document_read(const char *path, StabilityListed *listed);

#endif
