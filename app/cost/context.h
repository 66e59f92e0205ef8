// Declares the cost context, which the steps that make a report (steps.h) use: the session, the
// report, the journal, the reference renderer and the renderers. A row of the report (report.h) is
// one combination: quality settings on a camera path. A truth (app/measure/metrics/truth.h) is a
// converged picture.
#ifndef DIP_APP_COST_CONTEXT_H
#define DIP_APP_COST_CONTEXT_H

#include "app/cost/journal.h"
#include "app/cost/plan.h"
#include "app/report/page/report_pictures.h"
#include "app/cli/command.h"
#include "app/gallery/gallery.h"
#include "app/measure/metrics/truth.h"
#include "renderer/reference/reference.h"

#include <limits.h>

// What the forecast of the time left (forecast.c) is computed from. The times are guesses until
// they are measured.
typedef struct DipCostForecast {
    double picture_s;   // Time in which one picture is drawn and judged.
    double row_ms;      // Mean time of a frame of the rows of the phase TIMES (steps.h).
    int swept_rows;     // Number of rows of the phase SWEEPS.
    int timed_rows;     // Number of rows of the phase TIMES. Later phases time more.
    int counted_frames; // About how many frames are drawn to count work.
    int goes;           // How often best combinations have been measured so far (best.c).
} DipCostForecast;

// All pointers are borrowed, except the reference renderer, the gallery and the renderers. Not
// thread-safe.
typedef struct DipCostContext {
    const DipSession *session;
    DipCostReport *report;
    // Keeps errors and times for the next run. NULL if this context is passed to none of
    // dip_cost_judge, dip_cost_time_rows and dip_cost_predict (steps.h).
    DipCostJournal *journal;
    const char *cache;       // Folder of the cached truths; NULL or "" for no cache.
    DipReference *reference; // NULL for scenes of the gallery, and if the context draws no truths.
    DipGallery *gallery;     // NULL for models.
    // Renderer [0] draws the rows with gi=off (without instancing) and keeps the copies of meshes
    // that these rows need. Renderer [1] draws all other rows. A single renderer would free and
    // make the copies again whenever gi changes, and rows would be timed with their data at other
    // addresses.
    DipPainter *renderers[2];
    // Holds the command line with which the program starts itself to time frames in other processes
    // (--starts). If it is NULL, all frames are timed in this process.
    const DipProgramOptions *start;
    bool has_warned; // True if the user was told that the machine is busy (look.c).
    DipCostForecast forecast;
    double baseline_ms; // Mean time of a frame of the baseline, as dip_cost_look_at_machine
                        // measures it; 0 if nothing is timed.
} DipCostContext;

// Opens the context of a report. Leaves `journal`, `cache` and `start` NULL; the caller may set
// them. If `judges` is false, the context has no reference renderer: it draws and times only.
bool dip_cost_context_open(DipCostContext *cost, const DipSession *session, DipCostReport *report,
                           bool judges, DipError *err);
void dip_cost_context_close(DipCostContext *cost);

// dip_cost_draw_timed draws the timed frame `index` of a path, 0..dip_cost_frame_count - 1. Call
// dip_cost_prepare_timed with the same arguments before. dip_cost_prepare_timed lets the renderer's
// history begin anew. If frames are blended with a history of earlier frames (taa=history, for
// models only), dip_cost_prepare_timed then draws the frame that the path shows 1/30 s before, or
// at the timed frame before if that is nearer; before frame 0, there is none.
bool dip_cost_prepare_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                            DipError *err);
bool dip_cost_draw_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                         DipFrame *frame, DipError *err);

// Draws the frame `index` of a row's burst at a viewpoint. (A burst is the successive frames that
// are drawn at a viewpoint.) The frames of a burst must be drawn in order, from frame 0 on, since
// each may be blended with those before it. Writes the packed pixels and the hash of the picture.
bool dip_cost_draw_viewpoint(DipCostContext *cost, int row, int viewpoint, int index,
                             uint8_t *rgba8, char hash[33], DipError *err);

// Returns the source of the HTML page's pictures (report_pictures.h). The source borrows the
// context and draws with its renderers.
DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost);

// Gets the truth of one frame of the burst at a viewpoint of a path. `progress` can end the work
// early; if it is NULL, Ctrl-C does so. After Ctrl-C, the error is DIP_ERROR_RUNTIME.
bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err);

// Finds the folder of the cached truths: `given` (--cache) if it is not NULL, otherwise the user's
// cache folder (dip_truth_default_folder). Makes the folder, and fails if this is not possible.
// Writes "" if `given` is "" or if the user has no cache folder; truths are then not cached.
bool dip_cost_find_cache(const char *given, char folder[PATH_MAX], DipError *err);

// Writes cost.html, cost.csv and cost.json into a folder that exists. The source draws the pictures
// of the page; it is not used with --pictures none.
bool dip_cost_write_report(const DipCostReport *report, const DipCostFrameSource *source,
                           const char *folder, DipError *err);

// Returns the error message after the user has interrupted a command with Ctrl-C. If the context
// has a journal, the message says that the same command continues. Static storage.
const char *dip_cost_interrupted_text(const DipCostContext *cost);

// Returns true and fills *err if the user has pressed Ctrl-C. The journal, if there is one, keeps
// the measurements that it has so far (journal.h).
bool dip_cost_interrupted(const DipCostContext *cost, DipError *err);

// Copies the time of each pipeline stage of a frame to the parts of a DipTimed (rounds.h).
static inline void dip_cost_stage_parts(const DipFrame *frame, double parts_ms[DIP_TIMED_PARTS]) {
#define WRITE_STAGE(name, text) *parts_ms++ = frame->stages.name##_ms;
    DIP_STAGE_LIST(WRITE_STAGE)
#undef WRITE_STAGE
}

#endif
