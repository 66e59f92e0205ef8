// What `diptych cost axes` measures: rows that draw the same scene with the same settings, but at
// another size, at another render scale, with another number of threads or with another instruction
// set. Each row is timed beside the base, as the rows of a report are (report.h).
#ifndef DIP_APP_COST_AXES_AXES_H
#define DIP_APP_COST_AXES_AXES_H

#include "app/cost/axes/axes_options.h"
#include "app/report/format/fields.h"
#include "app/report/report.h"
#include "app/session/session.h"

#include <stdio.h>

enum {
    DIP_COST_AXIS_NAME = 32,
    // The base, the A/A row, and the rows of all axes.
    DIP_COST_AXES_MAX_ROWS = 2 + DIP_COST_AXIS_COUNT * DIP_COST_AXIS_MAX_VALUES
};

// A row. Its times, counters and errors are those of the report's row with the same index.
typedef struct DipCostAxisRow {
    DipCostAxis axis;
    char name[DIP_COST_AXIS_NAME]; // Its value: "320x240", "0.5", "2", "avx2".
    int width;                     // Pixels of the picture that is drawn.
    int height;
    int shown_width; // Pixels of the picture that is shown: larger on the axis scale.
    int shown_height;
    int threads;
    DipIsa isa;
    // Bytes that the row's renderer holds once it has drawn every timed frame; NAN if the allocator
    // does not tell.
    double memory_bytes;
    double frame_mj; // Energy per frame in millijoules; NAN if the machine does not tell.
    // Axis threads: how many times as fast as the row with the fewest threads.
    DipEstimate speed_up;
    double efficiency; // The speed-up over the ratio of the numbers of threads.
} DipCostAxisRow;

typedef struct DipCostAxes {
    DipCostReport report;                        // Row 0 is the base, row 1 the A/A row.
    DipCostAxisRow rows[DIP_COST_AXES_MAX_ROWS]; // report.row_count of them.
    char note[DIP_COST_REASON];   // What was left out of the default values, as a sentence, or "".
    char energy[DIP_COST_REASON]; // Where energy comes from, or why it is missing.
    int64_t scene_texture_bytes;  // Of the scene, which all rows share; 0 for the gallery.
    int64_t checked_pictures;     // Pictures that were compared with the base's and were the same.
} DipCostAxes;

// Lists the rows and allocates the report. Free the axes even after a failure. Fails with RANGE or
// MEMORY.
bool dip_cost_axes_plan(DipCostAxes *axes, const DipSession *session,
                        const DipCostAxesArguments *arguments, DipError *err);
void dip_cost_axes_free(DipCostAxes *axes);

// Writes the size at which a picture is drawn at a render scale of at most 1: the nearest size with
// exactly the same shape if its width is within 2 % of scale * width, so that the enlarged picture
// is not stretched; otherwise the width and the height are rounded.
void dip_cost_axes_scaled_size(int width, int height, double scale, int *to_width, int *to_height);

// True if the row's pictures must have the same bits as the base's: they show the same size, and
// are drawn at it.
bool dip_cost_axes_has_base_picture(const DipCostAxes *axes, int row);

// Compares a row's picture with the base's by their hashes. Fails with RUNTIME and names the row.
bool dip_cost_axes_check_picture(const DipCostAxes *axes, int row, int frame, const char *hash,
                                 const char *base_hash, DipError *err);

// Computes the speed-ups once the report's times are estimated.
void dip_cost_axes_compare_threads(DipCostAxes *axes);

// Writing. Each file is written whole or not at all.
extern const DipRecord dip_cost_axes_record; // DipCostAxes
void dip_cost_axes_print(const DipCostAxes *axes, FILE *out);
bool dip_cost_axes_write_json(const DipCostAxes *axes, const char *file, DipError *err);
bool dip_cost_axes_write_csv(const DipCostAxes *axes, const char *file, DipError *err);

#endif
