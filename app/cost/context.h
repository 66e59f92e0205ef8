// Declares the cost context, which the steps that make a report (steps.h) use: the session, the
// report, the journal, the reference renderer and the renderers. A row of the report (report.h) is
// one combination: quality settings on a camera path. A truth (app/measure/metrics/truth.h) is a
// converged picture.
#ifndef DIP_APP_COST_CONTEXT_H
#define DIP_APP_COST_CONTEXT_H

#include "app/cost/journal.h"
#include "app/cost/plan.h"
#include "app/report/page/report_pictures.h"
#include "app/cli/measure_options.h"
#include "app/gallery/gallery.h"
#include "app/measure/metrics/truth.h"
#include "renderer/reference/reference.h"

#include <limits.h>

// What the forecast of the time left knows (forecast.c). Times are guesses until they are measured.
typedef struct DipCostForecast {
    double picture_s;   // Time in which one picture is drawn and judged.
    double row_ms;      // Time of a frame of the rows that are timed first.
    int swept_rows;     // Rows whose errors are measured first.
    int timed_rows;     // Rows that are timed first.
    int counted_frames; // Frames that are drawn to count work.
    int goes;           // How often the best combinations have been measured (best.c).
} DipCostForecast;

// All pointers are borrowed, except the reference renderer, the gallery and the renderers. Not
// thread-safe.
typedef struct DipCostContext {
    const DipSession *session;
    DipCostReport *report;
    DipCostJournal *journal; // NULL if no rows are judged or timed (steps.h).
    const char *cache;       // Folder of the cached truths; NULL or "" for no cache.
    DipReference *reference; // NULL for scenes of the gallery, and without truths.
    DipGallery *gallery;     // NULL for models.
    // Renderer [0] draws the rows with gi=off (without instancing) and keeps the copies of meshes
    // that these rows need. Renderer [1] draws all other rows, so that they all use the same
    // memory.
    DipPainter *renderers[2];
    // The command line with which the program starts itself to time frames in another process.
    // NULL if frames are timed in this process.
    const DipServeOptions *start;
    bool has_warned; // The user was told that the machine is busy (dip_cost_look_at_machine).
    DipCostForecast forecast;
    double baseline_ms; // Time of a frame of the baseline at first sight; 0 if nothing is timed.
} DipCostContext;

// Opens the context of a report. Leaves `journal`, `cache` and `start` NULL; the caller may set
// them. If `judges` is false, the context has no reference renderer: it draws and times only.
bool dip_cost_context_open(DipCostContext *cost, const DipSession *session, DipCostReport *report,
                           bool judges, DipError *err);
void dip_cost_context_close(DipCostContext *cost);

// Draws the timed frame `index`, 0..dip_cost_frame_count - 1, of a path, whose settings must have
// been prepared for it. dip_cost_prepare_timed draws the frame before it if the settings have a
// history, with which the frame is blended.
bool dip_cost_prepare_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                            DipError *err);
bool dip_cost_draw_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                         DipFrame *frame, DipError *err);

// Draws the frame `index` of a row's burst at a viewpoint. (A burst is the successive frames that
// are drawn at a viewpoint.) Writes the packed pixels and the hash of the picture.
bool dip_cost_draw_viewpoint(DipCostContext *cost, int row, int viewpoint, int index,
                             uint8_t *rgba8, char hash[33], DipError *err);

// Returns the source of the HTML page's pictures (report_pictures.h). The source borrows the
// context and draws with its renderers.
DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost);

// Gets the truth of one frame of the burst at a viewpoint of a path. `progress` may be NULL; the
// work ends with DIP_ERROR_RUNTIME once the user has pressed Ctrl-C.
bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err);

// Finds the folder of the cached truths: `given` (--cache) if it is not NULL, otherwise the user's
// cache folder. Makes the folder. Writes "" if there is no cache.
bool dip_cost_find_cache(const char *given, char folder[PATH_MAX], DipError *err);

// Writes cost.html, cost.csv and cost.json into a folder that exists. The source draws the pictures
// of the page; it is not used with --pictures none.
bool dip_cost_write_report(const DipCostReport *report, const DipCostFrameSource *source,
                           const char *folder, DipError *err);

// Error message of a command that the user interrupted with Ctrl-C.
#define DIP_COST_INTERRUPTED "interrupted; run the same command again to continue"

// Returns true and fills *err if the user has pressed Ctrl-C. All measurements made before remain
// in the journal (journal.h).
bool dip_cost_interrupted(DipError *err);

// Copies the time of each pipeline stage of a frame to the parts of a DipTimed (rounds.h).
static inline void dip_cost_stage_parts(const DipFrame *frame, double parts_ms[DIP_TIMED_PARTS]) {
#define WRITE_STAGE(name, text) *parts_ms++ = frame->stages.name##_ms;
    DIP_STAGE_LIST(WRITE_STAGE)
#undef WRITE_STAGE
}

#endif
