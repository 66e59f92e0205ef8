// Measures frame times for the live report (app/preview/prices/prices.h), a frame at a time, while
// nothing in the preview moves.
//
// The job times combinations of settings in blocks. A block holds the base (the settings that
// prices start from) and a few combinations. Every round takes the combinations in an order that is
// shuffled anew. In a round, each combination is drawn twice: first untimed, because the previous
// combination has used the caches, and then timed. All times enter the log of the live report, from
// which the times and prices are computed anew after each block. At first every combination gets
// three rounds, so that all prices are soon known roughly; then each gets five more rounds. The
// panes' own settings come first, then most combinations by their distance from the requested
// settings (dip_price_list_wanted).
//
// The caller supplies the functions that draw and tell the time, so that tests can replace these
// functions.
#ifndef DIP_APP_PREVIEW_LIVE_PRICE_JOB_H
#define DIP_APP_PREVIEW_LIVE_PRICE_JOB_H

#include "app/measure/timing/thread_use.h"
#include "app/preview/prices/prices.h"
#include "renderer/base/error.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIP_PRICE_JOB_FIRST_ROUNDS = 3, DIP_PRICE_JOB_ROUNDS = 8 };

typedef struct DipPriceJobCalls {
    // Draws a frame with these settings. dip_renderer_set_frame_index explains frame_index. The job
    // uses the counters and the stage times of *frame. After a failure, the job measures nothing
    // until dip_price_job_forget.
    bool (*draw)(void *context, const DipQuality *quality, uint64_t frame_index, DipFrame *frame,
                 DipError *err);
    // Draws what comes before a timed frame whose settings have a history: the frame that a moving
    // camera would have shown before it. The next call of `draw` is for the timed frame. NULL: the
    // timed frame begins a history.
    bool (*prepare)(void *context, const DipQuality *quality, uint64_t frame_index, DipError *err);
    int64_t (*now_ns)(void *context);          // NULL: the job calls dip_clock_ns.
    DipThreadUse (*thread_use)(void *context); // NULL: the job watches this process's threads.
    int threads;                               // Number of threads that draw a frame.
    void *context;
} DipPriceJobCalls;

typedef struct DipPriceJob DipPriceJob;

// Creates a job that fills the live report of *prices, which is borrowed. Fails with MEMORY.
DipPriceJob *dip_price_job_create(const DipPriceJobCalls *calls, DipPrices *prices, DipError *err);
void dip_price_job_destroy(DipPriceJob **job); // *job may be NULL.

// Drops the block that is being timed and empties the live report. Call it when the picture's pose,
// time, size or scene changes.
void dip_price_job_forget(DipPriceJob *job);

// Drops the round that is being timed. Call it when something begins to move.
void dip_price_job_interrupt(DipPriceJob *job);

// Tells the job the panes' settings, by which the job chooses the combinations to time.
// Combinations that are known already are not timed again.
void dip_price_job_follow(DipPriceJob *job, const DipQuality *current, const DipQuality *requested);

// Draws frames until the budget (in milliseconds) is used up or nothing is left; draws at least one
// frame if one is left. Returns whether there are new prices.
bool dip_price_job_step(DipPriceJob *job, double budget_ms);

typedef struct DipPriceProgress {
    bool working;        // There are combinations left to time.
    bool first;          // Some combinations have not had their first rounds.
    bool failed;         // A frame could not be drawn, or memory ran out.
    int rounds;          // Complete rounds of the present block.
    int combinations;    // Combinations left to time, including those of the present block.
    double seconds_left; // Estimated time to draw the rest; 0 before the first frame.
} DipPriceProgress;

DipPriceProgress dip_price_job_progress(const DipPriceJob *job);

// Describes the progress for the panel: "times: 12 steps left, 4 s", why prices cannot be
// measured, or "" if nothing is left.
void dip_price_job_describe(const DipPriceJob *job, char *text, size_t size_bytes);

#endif
