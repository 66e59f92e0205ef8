// What the steps of a cost report work with: session, report, journal, reference and renderers.
#ifndef DIP_APP_COST_CONTEXT_H
#define DIP_APP_COST_CONTEXT_H

#include "app/cost/journal.h"
#include "app/cost/plan.h"
#include "app/measure/truth.h"
#include "renderer/reference/reference.h"

// Session, report and journal are borrowed. Not thread-safe.
typedef struct DipCostContext {
    const DipSession *session;
    DipCostReport *report;
    DipCostJournal *journal;
    const char *cache; // Folder of the truths; NULL for no cache.
    DipReference *reference;
    // Indexed by the step of instancing (gi). Renderer [1] draws all settings that share meshes, so
    // that they use the same memory. Renderer [0] keeps the copies of meshes that gi=off needs.
    DipRenderer *renderers[2];
} DipCostContext;

bool dip_cost_context_open(DipCostContext *cost, const DipSession *session, DipCostReport *report,
                           DipCostJournal *journal, const char *cache, DipError *err);
void dip_cost_context_close(DipCostContext *cost);

// Draws a row's settings at a time on its path. frame_index selects the pattern of temporal AA.
bool dip_cost_draw(DipCostContext *cost, int row, int64_t time_ns, int frame_index, DipFrame *frame,
                   DipError *err);

// Draws the row's timed frame `index`, 0..timed_frames - 1.
bool dip_cost_draw_timed(DipCostContext *cost, int row, int index, DipFrame *frame, DipError *err);

// Gets the truth of one frame of the burst at a viewpoint of a path.
bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err);

// True, with *err filled, after Ctrl-C. The journal then keeps what was measured.
bool dip_cost_interrupted(const DipCostContext *cost, DipError *err);

#endif
