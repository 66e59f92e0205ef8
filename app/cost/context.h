// The cost context: the session, the report, the journal, the reference renderer and the renderers.
// The steps that make a report (steps.h) use it. A row of the report (report.h) is one
// combination: quality settings on a camera path. A truth (app/measure/metrics/truth.h) is a
// converged picture.
#ifndef DIP_APP_COST_CONTEXT_H
#define DIP_APP_COST_CONTEXT_H

#include "app/cost/journal.h"
#include "app/cost/plan.h"
#include "app/measure/timing/driver.h"
#include "app/measure/metrics/truth.h"
#include "renderer/reference/reference.h"

// Session, report and journal are borrowed. Not thread-safe.
typedef struct DipCostContext {
    const DipSession *session;
    DipCostReport *report;
    DipCostJournal *journal;
    const char *cache;       // Folder of the cached truths; NULL for no cache.
    DipReference *reference; // NULL for scenes of the gallery, and without truths
    DipGallery *gallery;     // NULL for models
    // Indexed by the step of the setting gi (instancing). Renderer [0] draws the rows with gi=off
    // and keeps the copies of meshes that these rows need. Renderer [1] draws all other rows.
    // They share one renderer so that they are all drawn in the same memory.
    DipPainter *renderers[2];
    // The command line that a start of the measurement gets (starts.h); NULL: frames are timed
    // here.
    const DipServeOptions *start;
} DipCostContext;

// Opens the context of a report. Without `judges`, it has no truths: it draws and times only.
bool dip_cost_context_open(DipCostContext *cost, const DipSession *session, DipCostReport *report,
                           DipCostJournal *journal, const char *cache, bool judges, DipError *err);
void dip_cost_context_close(DipCostContext *cost);

// Draws a row's frame at a time on the row's camera path. frame_index selects the sample pattern of
// temporal AA.
bool dip_cost_draw(DipCostContext *cost, int row, int64_t time_ns, int frame_index, DipFrame *frame,
                   DipError *err);

// Draws the timed frame `index` of a path with any settings.
bool dip_cost_draw_settings(DipCostContext *cost, const DipQuality *quality, int path, int index,
                            DipFrame *frame, DipError *err);

// Draws the row's timed frame `index`, 0..dip_cost_frame_count - 1.
bool dip_cost_draw_timed(DipCostContext *cost, int row, int index, DipFrame *frame, DipError *err);

// Gets the truth of one frame at a viewpoint of a path. A burst is the successive frames that are
// drawn at a viewpoint. `frame` is the index of the frame in its burst.
bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err);

// Returns how the report's frames are timed, for the given number of subjects; the caller adds the
// bases. The seed is that of the report.
DipDriverDef dip_cost_driver_def(const DipCostReport *report, int subjects, int block_subjects);

// Writes the times of a frame's stages.
void dip_cost_stage_parts(const DipFrame *frame, double parts_ms[DIP_TIMED_PARTS]);

// What an interrupted command says.
#define DIP_COST_INTERRUPTED "interrupted; run the same command again to continue"

// Returns true and fills *err if the user has pressed Ctrl-C. All measurements made before remain
// in the journal (journal.h).
bool dip_cost_interrupted(const DipCostContext *cost, DipError *err);

#endif
