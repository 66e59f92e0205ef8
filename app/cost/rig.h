// What a cost report is measured with.
#ifndef DIP_APP_COST_RIG_H
#define DIP_APP_COST_RIG_H

#include "app/cost/plan.h"
#include "app/cost/state.h"
#include "app/measure/truth.h"
#include "renderer/reference/reference.h"

typedef struct DipCostRig {
    const DipSession *session;
    DipCostReport *report;
    DipCostState *state;
    const char *cache; // folder of the truths; NULL: none
    DipReference *reference;
    // By the step of instancing: [1] for all settings that share meshes, so that none has its
    // memory in a better place; [0] keeps the copies that the others would throw away.
    DipRenderer *renderers[2];
} DipCostRig;

bool dip_cost_rig_open(DipCostRig *rig, const DipSession *session, DipCostReport *report,
                       DipCostState *state, const char *cache, DipError *err);
void dip_cost_rig_close(DipCostRig *rig);

// Draws a row's settings at a time on its path. frame_index: for temporal AA.
bool dip_cost_draw(DipCostRig *rig, int row, int64_t time_ns, int frame_index, DipFrame *frame,
                   DipError *err);

// Draws one of the frames that are timed.
bool dip_cost_draw_timed(DipCostRig *rig, int row, int index, DipFrame *frame, DipError *err);

// The truth of a burst's frame at a place of a path.
bool dip_cost_rig_truth(DipCostRig *rig, int path, int place, int frame, DipTruthProgress *progress,
                        void *context, DipTruth *truth, DipError *err);

// Ctrl-C: what is measured is kept, and the report not written.
bool dip_cost_interrupted(const DipCostRig *rig, DipError *err);

// --- the steps of a report, in order; each fills in its part -----------------------------------

// Makes the truths that are not in the cache, and notes the floors.
bool dip_cost_make_truths(DipCostRig *rig, DipError *err);

// Draws every row at every place of this run's part and judges the pictures.
bool dip_cost_judge(DipCostRig *rig, DipError *err);

// Times every row in rounds, and counts its work.
bool dip_cost_time_rows(DipCostRig *rig, DipError *err);

// Times one row alone, in as many rounds as the others had.
bool dip_cost_time_row_again(DipCostRig *rig, int row, DipStatsEstimate *time, DipError *err);

// Chooses rows for the budgets and times these again.
bool dip_cost_advise(DipCostRig *rig, DipError *err);

#endif
