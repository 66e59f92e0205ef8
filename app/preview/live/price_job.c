// Times combinations of settings in blocks, each block together with the base settings.
#include "app/preview/live/price_job.h"

#include "app/cost/context.h"
#include "app/measure/timing/driver.h"
#include "app/measure/timing/sample.h"
#include "app/report/prices/prices.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK = 4,            // Combinations in a block, not counting the base.
    VISITS = BLOCK + 1,   // Combinations in a block, counting the base.
    FRAMES_OF_A_VISIT = 2 // Frames of a combination in a round: one untimed, one timed.
};

// A combination of the block that is being timed. The first member of a block is the base.
typedef struct Member {
    DipQuality quality;
    double counters[DIP_COUNTER_COUNT]; // Counters of the member's last frame.
} Member;

struct DipPriceJob {
    DipPriceJobCalls calls;
    DipPrices *prices;
    DipQuality current;
    DipQuality requested;
    bool follows; // The panes' settings are known.
    bool failed;
    DipError failure; // Why the job failed, if `failed`.
    bool idle;        // Nothing is left to time, or the report is full.
    DipQuality wanted[DIP_PRICE_MAX_WANTED];
    int wanted_count;
    // Rounds that each wanted combination gets: DIP_PRICE_JOB_FIRST_ROUNDS until all combinations
    // have had these rounds, then DIP_PRICE_JOB_ROUNDS.
    int rounds;

    DipDriver *driver; // Times the members; NULL if no block is being timed.
    Member members[VISITS];
    int member_count;
    int rounds_before; // Rounds that the members except the base had when the block began.

    int rounds_of[DIP_PRICES_LIVE_ROWS]; // Rounds in which each row except the base's was timed.
    int blocks;                          // Blocks that are complete.
    double drawn_ms;                     // Time of drawing all frames since dip_price_job_forget.
    int drawn;                           // Number of these frames.
    double waited;     // Share of a round's time that the threads waited, summed over all rounds.
    int waited_rounds; // Number of the rounds in that sum.
};

static int64_t now_ns(const DipPriceJob *job) {
    return job->calls.now_ns ? job->calls.now_ns(job->calls.context) : dip_clock_ns();
}

DipPriceJob *dip_price_job_create(const DipPriceJobCalls *calls, DipPrices *prices, DipError *err) {
    DipPriceJob *job = calloc(1, sizeof *job);
    if (!job) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
        return NULL;
    }
    job->calls = *calls;
    job->prices = prices;
    job->rounds = DIP_PRICE_JOB_FIRST_ROUNDS;
    return job;
}

void dip_price_job_destroy(DipPriceJob **job) {
    if (*job) {
        dip_driver_destroy(&(*job)->driver);
    }
    free(*job);
    *job = NULL;
}

void dip_price_job_interrupt(DipPriceJob *job) {
    if (job->driver) {
        dip_driver_drop_round(job->driver);
    }
}

void dip_price_job_forget(DipPriceJob *job) {
    dip_driver_destroy(&job->driver);
    dip_prices_forget_live(job->prices);
    memset(job->rounds_of, 0, sizeof job->rounds_of);
    job->blocks = job->drawn = job->waited_rounds = 0;
    job->drawn_ms = job->waited = 0.0;
    job->failed = false;
    job->idle = false;
    job->rounds = DIP_PRICE_JOB_FIRST_ROUNDS;
}

// --- what to time --------------------------------------------------------------------------------

// Lists the combinations that were timed in fewer than `rounds` rounds, without the base, which
// every block times.
static void list_with_rounds(DipPriceJob *job, int rounds) {
    const DipQuality base = dip_prices_base(job->prices);
    DipQuality all[DIP_PRICE_MAX_WANTED];
    const int count =
        dip_price_list_wanted(&base, &job->current, &job->requested, all, DIP_PRICE_MAX_WANTED);
    job->rounds = rounds;
    job->wanted_count = 0;
    for (int i = 0; i < count; i++) {
        const int row = dip_prices_find_live(job->prices, &all[i]);
        if (!dip_quality_equal(&all[i], &base) && (row < 0 || job->rounds_of[row] < rounds)) {
            job->wanted[job->wanted_count++] = all[i];
        }
    }
}

static void list_wanted(DipPriceJob *job) {
    list_with_rounds(job, DIP_PRICE_JOB_FIRST_ROUNDS);
    if (job->wanted_count == 0) {
        list_with_rounds(job, DIP_PRICE_JOB_ROUNDS);
    }
    job->idle = job->wanted_count == 0;
}

void dip_price_job_follow(DipPriceJob *job, const DipQuality *current,
                          const DipQuality *requested) {
    if (job->follows && dip_quality_equal(&job->current, current) &&
        dip_quality_equal(&job->requested, requested)) {
        return;
    }
    job->current = *current;
    job->requested = *requested;
    job->follows = true;
    list_wanted(job);
}

// --- blocks --------------------------------------------------------------------------------------

// Temporal AA has one sample pattern for frames with even indices and one for odd indices. Each
// round begins with the pattern that the previous round timed, so that the rounds time both
// patterns in turn.
static uint64_t frame_index_of(const DipDriverTurn *turn) {
    const bool is_timed = turn->phase == DIP_DRIVER_TIMED;
    return (uint64_t)(FRAMES_OF_A_VISIT * turn->round + is_timed + turn->round % 2);
}

static bool prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    const DipPriceJob *job = context;
    const DipQuality *quality = &job->members[turn->subject].quality;
    return turn->phase != DIP_DRIVER_TIMED || !dip_quality_has_history(quality) ||
           job->calls.prepare(job->calls.context, quality, frame_index_of(turn) - 1, err);
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    DipPriceJob *job = context;
    Member *member = &job->members[turn->subject];
    const uint64_t index = frame_index_of(turn);
    const int64_t begin_ns = now_ns(job);
    DipFrame frame = {0};
    if (!job->calls.draw(job->calls.context, &member->quality, index, &frame, err)) {
        return false;
    }
    job->drawn_ms += 1e-6 * (double)(now_ns(job) - begin_ns);
    job->drawn++;
    dip_cost_stage_parts(&frame, timed->parts_ms);
    memset(member->counters, 0, sizeof member->counters);
    dip_counters_add(&frame.counters, member->counters);
    return true;
}

static int64_t clock_ns(void *context) {
    return now_ns(context);
}

static DipThreadUse thread_use(void *context) {
    const DipPriceJob *job = context;
    return job->calls.thread_use(job->calls.context);
}

static bool begin_block(DipPriceJob *job) {
    list_wanted(job);
    if (job->idle || dip_prices_live(job->prices)->row_count + VISITS > DIP_PRICES_LIVE_ROWS) {
        job->idle = true;
        return false;
    }
    job->rounds_before = job->rounds == DIP_PRICE_JOB_FIRST_ROUNDS ? 0 : DIP_PRICE_JOB_FIRST_ROUNDS;
    job->members[0].quality = dip_prices_base(job->prices);
    job->member_count = 1;
    while (job->member_count < VISITS && job->member_count <= job->wanted_count) {
        job->members[job->member_count].quality = job->wanted[job->member_count - 1];
        job->member_count++;
    }
    static const int base_of[VISITS] = {0};
    const DipDriverDef def = {
        .subjects = job->member_count,
        .base_of = base_of,
        .block_subjects = BLOCK,
        .starts = 1,
        .rounds = job->rounds - job->rounds_before,
        .frames = 1,
        .seed = (uint64_t)job->blocks,
        .most_wait = DIP_TIMED_MOST_WAIT,
    };
    const DipDriverCalls calls = {
        .draw = draw,
        .prepare = job->calls.prepare ? prepare : NULL,
        .clock_ns = clock_ns,
        .thread_use = job->calls.thread_use ? thread_use : NULL,
        .context = job,
    };
    job->driver = dip_driver_create(&def, &calls, &job->failure);
    job->failed = !job->driver;
    return !job->failed;
}

// Adds the block's times to the report's log. Their rounds are numbered after those that the
// members except the base had before. The base has rounds of the same numbers in several blocks.
static bool log_block(DipPriceJob *job, const int rows[VISITS], DipError *err) {
    DipCostReport *report = dip_prices_live(job->prices);
    const DipTimes times = dip_driver_times(job->driver);
    const int before = job->rounds_before, first = report->log_count;
    if (!dip_cost_log_add(report, &times, rows, err)) {
        return false;
    }
    for (int i = first; i < report->log_count; i++) {
        report->log[i].round += before;
    }
    const int rounds = before + times.rounds;
    report->rounds = report->options.rounds = rounds > report->rounds ? rounds : report->rounds;
    job->waited += dip_driver_machine(job->driver, job->calls.threads).wait * times.rounds;
    job->waited_rounds += times.rounds;
    report->machine.wait = job->waited / job->waited_rounds;
    for (int m = 0; m < job->member_count; m++) {
        job->rounds_of[rows[m]] = rounds;
        memcpy(report->rows[rows[m]].counters, job->members[m].counters,
               sizeof job->members[m].counters);
    }
    return dip_prices_update_live(job->prices, true, err);
}

static bool end_block(DipPriceJob *job) {
    int rows[VISITS];
    bool done = true;
    for (int m = 0; done && m < job->member_count; m++) {
        rows[m] = dip_prices_live_row(job->prices, &job->members[m].quality, &job->failure);
        done = rows[m] >= 0;
    }
    done = done && log_block(job, rows, &job->failure);
    job->blocks++;
    dip_driver_destroy(&job->driver);
    job->failed = !done;
    list_wanted(job);
    return !job->failed;
}

// --- frames --------------------------------------------------------------------------------------

bool dip_price_job_step(DipPriceJob *job, double budget_ms) {
    const int64_t end_ns = now_ns(job) + (int64_t)(1e6 * budget_ms);
    bool news = false;
    do {
        if (!job->follows || job->failed || job->idle || (!job->driver && !begin_block(job))) {
            return news;
        }
        const DipDriverStep step = dip_driver_step(job->driver, &job->failure);
        if (step == DIP_DRIVER_FAILED) {
            job->failed = true;
            dip_driver_destroy(&job->driver);
            return news;
        }
        news |= step == DIP_DRIVER_DONE && end_block(job);
    } while (now_ns(job) < end_ns);
    return news;
}

// --- progress ------------------------------------------------------------------------------------

DipPriceProgress dip_price_job_progress(const DipPriceJob *job) {
    DipPriceProgress progress = {.working = job->follows && !job->failed && !job->idle,
                                 .failed = job->failed};
    if (!progress.working) {
        return progress;
    }
    const int blocks = (job->wanted_count + BLOCK - 1) / BLOCK; // The present block counts, too.
    const int visits = job->wanted_count + blocks;
    const bool first = job->rounds == DIP_PRICE_JOB_FIRST_ROUNDS;
    const int rounds = first ? job->rounds : job->rounds - DIP_PRICE_JOB_FIRST_ROUNDS;
    const int frames = visits * FRAMES_OF_A_VISIT * rounds;
    const DipDriverProgress block =
        job->driver ? dip_driver_progress(job->driver) : (DipDriverProgress){0};
    progress.first = first;
    progress.rounds = block.rounds;
    progress.combinations = job->wanted_count;
    if (job->drawn > 0) {
        progress.seconds_left = 1e-3 * job->drawn_ms / job->drawn * (frames - (double)block.drawn);
    }
    return progress;
}

void dip_price_job_describe(const DipPriceJob *job, char *text, size_t size_bytes) {
    const DipPriceProgress progress = dip_price_job_progress(job);
    if (progress.failed) {
        snprintf(text, size_bytes, "prices cannot be measured: %s", job->failure.message);
    } else if (!progress.working) {
        snprintf(text, size_bytes, "%s", "");
    } else {
        snprintf(text, size_bytes, "%s %d step%s left, %.0f s",
                 progress.first ? "times:" : "times again, more exactly:", progress.combinations,
                 progress.combinations == 1 ? "" : "s", ceil(progress.seconds_left));
    }
}
