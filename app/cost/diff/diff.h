// Declares the parts of `diptych cost diff`, which finds what got slower or worse from one report
// or program to another.
//
// A comparison has two sides, A (side 0) and B (side 1). A side is a report or a program. Each row
// of the comparison is a combination of settings on a camera path that both sides have, with the
// values of some quantities on both sides. A quantity is an error, a counter or the number of
// pictures that differ. Quantities are exact, so any difference has a cause. A row also has times,
// which are noisy and have intervals.
#ifndef DIP_APP_COST_DIFF_DIFF_H
#define DIP_APP_COST_DIFF_DIFF_H

#include "app/cli/command.h"
#include "app/cli/measure_options.h"
#include "app/measure/timing/sample.h"
#include "app/report/format/fields.h"
#include "app/report/report.h"
#include "app/session/session_options.h"

#include <stdbool.h>
#include <stdio.h>

// --- the command line ----------------------------------------------------------------------------

enum {
    DIP_COST_DIFF_MAX_SETS = 24,
    DIP_COST_DIFF_STARTS = 6,
    DIP_COST_DIFF_ROUNDS = 8,
    DIP_COST_DIFF_FRAMES = 6
};

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostDiffArguments {
    DipProgramOptions program;
    DipSessionOptions session; // What the programs draw.
    const char *sides[2];      // A and B.
    int side_count;
    DipOptionSet sets[DIP_COST_DIFF_MAX_SETS]; // The combinations of settings to compare.
    int set_count;
    // If measure.rounds is 0, each start has DIP_COST_DIFF_ROUNDS rounds if both sides are
    // programs, and 1 round if only one side is.
    DipMeasureOptions measure;
    int frames;       // 0 means DIP_COST_DIFF_FRAMES. Used only if both sides are programs.
    double fail_over; // 1.03 for --fail-over 3%; 0 without this option.
    const char *json;
} DipCostDiffArguments;

// --- comparisons ---------------------------------------------------------------------------------

// Indices of the quantities: errors, then the number of pictures that differ, then the counters.
enum {
    DIP_COST_DIFF_rmse,
    DIP_COST_DIFF_psnr,
    DIP_COST_DIFF_ssim,
    DIP_COST_DIFF_flip,
    DIP_COST_DIFF_flicker,
    DIP_COST_DIFF_two_mean,
    DIP_COST_DIFF_ERROR_COUNT,
    DIP_COST_DIFF_pictures = DIP_COST_DIFF_ERROR_COUNT,
    DIP_COST_DIFF_FIRST_COUNTER,
    DIP_COST_DIFF_QUANTITY_COUNT = DIP_COST_DIFF_FIRST_COUNTER + DIP_COUNTER_COUNT
};

enum {
    DIP_COST_DIFF_MAX_NOTES = 32,
    DIP_COST_DIFF_NOTE = 640, // Room for the texts of two settings.
    // Number of stages of a frame, without the total.
    DIP_COST_DIFF_STAGES = DIP_BENCH_STAGE_total
};

typedef enum DipCostDiffMark {
    DIP_COST_DIFF_SAME,
    DIP_COST_DIFF_SLOWER,
    DIP_COST_DIFF_FASTER
} DipCostDiffMark;

typedef struct DipCostDiffRow {
    DipQuality quality;
    char path[16];
    double values[2][DIP_COST_DIFF_QUANTITY_COUNT]; // NAN if not known or not comparable.
    bool timed;                                     // True if both sides have a time.
    bool is_base;                                   // Reports only: true if the row is the
                                                    // baseline.
    double ms[2];                                   // Mean time of a frame.
    DipEstimate ratios[2];                          // Reports only: time / the baseline's time.
    // The change from A to B with its 95 % interval: B's time / A's time for programs, B's ratio /
    // A's ratio for reports.
    DipEstimate change;
    // The change is surely greater than surely_above and less than surely_below. For programs,
    // these two bounds are the ends of the change's 95 % interval. For reports, they lie so far
    // apart that the bounds of all rows hold together with a probability of 95 %.
    double surely_above;
    double surely_below;
    // Programs only, for each stage of a frame: 1 + (B's time in the stage - A's time in it) / A's
    // time of the frame.
    DipEstimate stages[DIP_COST_DIFF_STAGES];
    DipCostDiffMark mark;
} DipCostDiffRow;

// What the times come from. If one side is a report and the other a program, the program's
// measurements become a second report, and the kind is DIP_COST_DIFF_REPORTS.
typedef enum DipCostDiffKind {
    DIP_COST_DIFF_REPORTS, // Ratios to the baseline, measured in two runs.
    DIP_COST_DIFF_PROGRAMS // Two programs that took turns.
} DipCostDiffKind;

typedef struct DipCostDiff {
    DipCostDiffKind kind;
    const char *names[2]; // As on the command line. Borrowed.
    // "Xeon, 2 threads, avx512"; for two programs "Xeon, 2 threads".
    char machines[2][DIP_COST_TEXT + 64];
    char builds[2][33];        // Hash of the program's file; "" if not known.
    char scene[DIP_COST_TEXT]; // "court.gltf, 640x480 pixels"; "" for two programs, and if reports
                               // differ in scene or size.
    bool some_rows;    // True if one side is a program that measured only some rows of the other
                       // side's report.
    bool same_machine; // True if both sides have the same processor, number of threads and
                       // instruction set. Always true for two programs.
    bool has_times;    // True if the times may be compared.
    DipCostVerdict verdicts[2]; // How quiet each side's machine was; for programs both are equal.
    char reasons[2][DIP_COST_REASON];
    DipCostDiffRow *rows; // Owned.
    int row_count;
    // Texts that say in what the sides differ as a whole, or what is not compared.
    char notes[DIP_COST_DIFF_MAX_NOTES][DIP_COST_DIFF_NOTE];
    int note_count;
    char cause[512];   // What dip_cost_diff_explain writes; "" for reports and if no row is slower.
    double limit;      // A row is slower if its change is surely greater than this.
    double fail_over;  // 1.03 for --fail-over 3%; 0 without this option.
    int slower;        // Number of rows that are marked as slower.
    int faster;        // Number of rows that are marked as faster.
    int failed_times;  // Number of rows whose change is surely greater than fail_over.
    int failed_errors; // Number of rows with an error that grew by more than fail_over - 1.
} DipCostDiff;

// Appends a note. Does nothing if there are DIP_COST_DIFF_MAX_NOTES already.
void dip_cost_diff_note(DipCostDiff *diff, const char *format, ...) DIP_PRINTF(2, 3);

// Fills *err with DIP_ERROR_MEMORY and returns false.
bool dip_cost_diff_no_memory(DipError *err);

// Frees the rows.
void dip_cost_diff_free(DipCostDiff *diff);

// Returns the title of a quantity: "FLIP", "texels_fetched".
const char *dip_cost_diff_title(int quantity);

// Returns whether a row's quantity is known on both sides and differs.
bool dip_cost_diff_differs(const DipCostDiffRow *row, int quantity);

// Returns by what share a quantity grew from A to B: 0.1 if B's value is 10 % greater. Returns 0 if
// the quantity does not differ or is not known, and INFINITY if it is 0 in A only. PSNR and SSIM
// are turned into errors that grow when the picture gets worse: the root mean square difference
// that PSNR stands for, and 1 - SSIM.
double dip_cost_diff_growth(const DipCostDiffRow *row, int quantity);

// Leaves out the counters that are 0 in all rows of one side and in no row of the other, and adds a
// note with their names: perhaps an older build does not count what a newer one counts.
void dip_cost_diff_leave_out_uncounted(DipCostDiff *diff);

// Computes the rows' marks, and the numbers of slower, faster and failed rows. A row is marked as
// slower if surely_above is greater than the limit, and as faster if surely_below is less than
// 1/limit. Marks no baseline of a report, and no row at all if the times may not be compared, if a
// machine's verdict is red, or if two reports come from different machines.
void dip_cost_diff_mark(DipCostDiff *diff);

// --- groups of exact differences -----------------------------------------------------------------

// How one quantity differs over the rows of a group.
typedef struct DipCostDiffChange {
    int quantity;
    int rows;     // Number of rows in which the quantity differs.
    int greatest; // Index of the row whose growth has the greatest absolute value.
    double least; // Least growth in these rows (dip_cost_diff_growth).
    double most;  // Greatest growth in these rows.
} DipCostDiffChange;

// A group of quantities that differ in the same rows. All errors that differ are in one group, even
// if not all of them differ in the same rows.
typedef struct DipCostDiffGroup {
    char which[DIP_COST_TEXT +
               64]; // Says in which rows the quantities differ: "all 12 rows with af=16".
    int row_count;  // Number of rows in which any of the quantities differs.
    DipCostDiffChange changes[DIP_COST_DIFF_QUANTITY_COUNT];
    int change_count;
} DipCostDiffGroup;

// Finds all groups, so that a reader sees the few causes of the differences and not one line per
// row. Each quantity that differs is in one group. Returns the number of groups, or -1 when memory
// runs out.
int dip_cost_diff_group(const DipCostDiff *diff,
                        DipCostDiffGroup groups[DIP_COST_DIFF_QUANTITY_COUNT]);

// --- causes of a slowdown ------------------------------------------------------------------------

// How much longer B takes than A in some rows (the additional times), and the amounts of work that
// may explain this. Arrays are borrowed.
typedef struct DipCauseData {
    int rows;
    int starts;
    int kinds;               // Number of kinds of work.
    const double *per_start; // [row * starts + start]: additional time; NAN if not known.
    const double *work;      // [kind * rows + row]: amount of work, at least 0.
} DipCauseData;

typedef struct DipCause {
    int kind;     // The kind of work that explains the additional times best; -1 if none is sure.
    double price; // Additional time per unit of this work.
    double share; // Share of the sum of squares of the additional times that this work explains.
} DipCause;

// Finds the kind of work that explains the additional times y of the rows best. For each kind by
// itself, fits y = price * work by least squares, with a price above 0, and takes the kind that
// leaves the least error. This kind is sure if it also leaves the least error in at least 90 % of
// 200 draws of the starts with replacement (bootstrap), and if it explains at least 90 % of the sum
// of squares. Kinds of work that are proportional over the rows to within a few per cent (the
// cosine of their angle is above .999) cannot be told apart, and the first of them is taken. Fails
// with DIP_ERROR_MEMORY.
bool dip_cause_find(const DipCauseData *data, DipCause *cause, DipError *err);

// Returns whether two kinds of work are proportional over the rows, so that they cannot be told
// apart.
bool dip_cause_is_same_work(const DipCauseData *data, int a, int b);

// Writes diff->cause from the times of two programs: the stage that takes most of the additional
// time of the slower rows. If the comparison has at least four rows, slower or not, also names the
// kind of work with which the additional time in this stage grows, if this kind is sure
// (dip_cause_find). In `times` and `fit`, the subject 2 * row + side stands for a row on one side.
// Fails with DIP_ERROR_MEMORY.
bool dip_cost_diff_explain(DipCostDiff *diff, const DipTimes *times, const DipTimesFit *fit,
                           DipError *err);

// --- comparing -----------------------------------------------------------------------------------

// Returns whether times are compared, but a side's machine was too busy for its times to be
// believed.
bool dip_cost_diff_is_busy(const DipCostDiff *diff);

// Compares two reports. The members names, limit, fail_over and some_rows of *diff must be filled
// in before. Fails with DIP_ERROR_MEMORY. On success the caller frees the comparison.
bool dip_cost_diff_reports(const DipCostReport *a, const DipCostReport *b, DipCostDiff *diff,
                           DipError *err);

// Draws the settings of `arguments` with both programs, which take turns at every frame, and fills
// in the comparison. Fails if a program does not start or does not answer, if the user presses
// Ctrl-C or if memory runs out. On success the caller frees the comparison.
bool dip_cost_diff_programs(const DipCostDiffArguments *arguments, const char *const programs[2],
                            DipCostDiff *diff, DipError *err);

// Measures rows of a report again with another program: the rows of the report's first path whose
// settings `arguments` lists, except the baseline. Makes a new report with the baseline and these
// rows. The new report has no errors, only times and counters. Each row's ratio is the row's time
// divided by the baseline's time in the same program. Fails as dip_cost_diff_programs does, and
// with DIP_ERROR_MISSING if the report has no times or none of these rows. On success the caller
// frees the new report.
bool dip_cost_diff_measure_report(const DipCostDiffArguments *arguments, const char *program,
                                  const DipCostReport *report, DipCostReport *measured,
                                  DipError *err);

// Prints the comparison for a terminal. Fails with DIP_ERROR_MEMORY.
bool dip_cost_diff_print(const DipCostDiff *diff, FILE *out, DipError *err);

extern const DipRecord dip_cost_diff_record; // The fields of a DipCostDiff in the JSON file.

// Writes the comparison to a JSON file.
bool dip_cost_diff_write_json(const DipCostDiff *diff, const char *file, DipError *err);

#endif
