// The catalogue of hard cases: numerically difficult inputs, each with a promise that Diptych
// keeps.
//
// A row of the catalogue states a promise, the independent truth that the row compares Diptych
// with, and a bound. Measuring a row runs many cases and keeps the greatest error. The row holds if
// the greatest error is at most the bound. The program `stability` (tests/stability/) measures
// rows, and writes docs/stability.md from them; `diptych verify` measures all rows in their short
// form.
//
// To add a row, write its measuring function in the file of its topic in rows/ and add an entry to
// the table at the end of that file. To add a topic, add its table to catalogue.c.
#ifndef DIP_RENDERER_CATALOGUE_STABILITY_H
#define DIP_RENDERER_CATALOGUE_STABILITY_H

#include "renderer/base/api.h"
#include "renderer/base/hash.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// How many cases a row runs. Every depth runs the known hard cases; the deeper ones add random
// cases.
typedef enum StabilityDepth {
    STABILITY_SHORT, // at most about 20 ms per row and instruction set; `diptych verify`
    STABILITY_FULL,  // at most about 2 s per row and instruction set; ./test
    STABILITY_LONG,  // minutes; ./test long
} StabilityDepth;

// The measurement of one row with one instruction set.
typedef struct StabilityRun {
    DipIsa isa;           // instruction set whose kernels are measured
    DipPool *pool;        // threads to draw with; borrowed
    StabilityDepth depth; // number of cases to run
    uint64_t seed;        // seed of the random cases
    // The result, which the functions below fill in.
    double worst;          // greatest error seen, in the row's unit; 0 at first
    char worst_at[200];    // the case with the greatest error, in words; empty: no error
    uint64_t case_count;   // number of cases that were compared
    uint64_t failed_count; // number of cases with an error other than 0
    // Hash of the names of all cases and of what Diptych drew and computed for them. It is the same
    // with every instruction set of every machine, as long as neither the cases nor the bits of
    // Diptych's results change.
    DipHash hash;
    bool broken; // the row could not be measured
    char broken_why[400];
} StabilityRun;

typedef struct StabilityRow {
    const char *id;      // "N26" is row 26 of the field's list of hard cases; "A3": added by us
    const char *promise; // one sentence
    const char *truth;   // what the row compares Diptych with: a noun phrase
    const char *unit;    // unit of the error and of the bound: "pixels", "of light, RMS"
    double bound;        // greatest error that the row accepts
    // True if the row's code has one version per instruction set. Otherwise, the row is measured
    // once, with the best instruction set of the machine.
    bool per_isa;
    void (*measure)(StabilityRun *run);
} StabilityRow;

// The rows about one subject.
typedef struct StabilityTopic {
    const char *name;  // "texture": chooses the topic on the command line
    const char *title; // "Textures and level of detail": heading in docs/stability.md
    const StabilityRow *rows;
    size_t row_count;
} StabilityTopic;

extern const StabilityTopic *const stability_topics[];
extern const size_t stability_topic_count;

// Measures a row. The run's pool, depth, seed and instruction set are inputs; its result is reset
// first. Returns true if the row holds.
bool stability_measure(const StabilityRow *row, StabilityRun *run);

// --- for measuring functions ------------------------------------------------------------------

// Counts a case and keeps its error if it is the greatest so far. An error that is not a number
// counts as infinite. The format and its arguments name the case; the hash takes the name.
void stability_error(StabilityRun *run, double error, const char *format, ...) DIP_PRINTF(3, 4);

// Counts a case whose promise either holds or is broken: the error is 0 or 1.
void stability_expect(StabilityRun *run, bool holds, const char *format, ...) DIP_PRINTF(3, 4);

// Says that the row cannot be measured, for example because memory is short. The row then does not
// hold.
void stability_break(StabilityRun *run, const char *format, ...) DIP_PRINTF(2, 3);

// Adds results of Diptych to the hash. Pictures need no call: the functions that draw add them
// (pictures.h).
void stability_keep(StabilityRun *run, const double *results, size_t count);

// Returns the number of random cases for the run's depth.
int stability_count(const StabilityRun *run, int count_short, int count_full, int count_long);

#endif
