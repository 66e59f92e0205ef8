// Drawing the rows of `diptych cost axes`: each row has a renderer of its own, with its size, its
// threads and its instruction set. The A/A row shares the base's.
#ifndef DIP_APP_COST_AXES_AXES_DRAWING_H
#define DIP_APP_COST_AXES_AXES_DRAWING_H

#include "app/cost/axes/axes.h"
#include "app/cost/axes/axes_energy.h"
#include "app/cost/axes/axes_enlarge.h"

// What draws a row. Owned.
typedef struct DipCostAxisDrawer {
    DipPool *pool;       // NULL if the row draws with the session's threads.
    DipGallery *gallery; // NULL for models.
    DipPainter *painter;
    DipEnlarger *enlarger; // NULL unless the row is of the axis scale.
} DipCostAxisDrawer;

// Session and axes are borrowed.
typedef struct DipCostAxesDrawing {
    const DipSession *session;
    DipCostAxes *axes;
    DipCostAxisDrawer drawers[DIP_COST_AXES_MAX_ROWS];
    double draw_ms;    // Of the latest frame.
    double enlarge_ms; // Of the latest frame; 0 if it was not enlarged.
} DipCostAxesDrawing;

// Makes the renderers. With each, draws all timed frames once: fills in the row's memory and
// counters, and checks the pictures that must be those of the base. Shows progress. On failure, the
// drawing is closed. Fails with RUNTIME if a picture differs or after Ctrl-C, and as the renderer
// does.
bool dip_cost_axes_open_drawing(DipCostAxesDrawing *drawing, const DipSession *session,
                                DipCostAxes *axes, DipError *err);
void dip_cost_axes_close_drawing(DipCostAxesDrawing *drawing);

// Draws a row's frame at a time on the path, and enlarges it if the row has a render scale. The
// frame's pixels are then those of the enlarged picture, and its counters those of the drawing.
bool dip_cost_axes_draw(DipCostAxesDrawing *drawing, int row, int64_t time_ns, int frame_index,
                        DipFrame *frame, DipError *err);

// Draws the row's timed frame `index`, 0..dip_cost_frame_count - 1.
bool dip_cost_axes_draw_timed(DipCostAxesDrawing *drawing, int row, int index, DipFrame *frame,
                              DipError *err);

// Returns true and fills *err if the user has pressed Ctrl-C.
bool dip_cost_axes_interrupted(DipError *err);

// Measures the errors of the base and of the render scales against the truth (converged picture),
// at all viewpoints. `cache` is the folder of the cached truths, or NULL.
bool dip_cost_axes_judge(DipCostAxesDrawing *drawing, const char *cache, DipError *err);

// Times every row beside the base, measures energy, and estimates the report's times.
bool dip_cost_axes_time(DipCostAxesDrawing *drawing, const DipEnergyMeter *meter, DipError *err);

#endif
