// Timing combinations of settings beside the base, in blocks.
#include "app/preview/live/price_job.h"

#include "app/measure/timing/driver.h"
#include "app/preview/prices/price_question.h"
#include "app/report/verdict.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK = 4,            // Combinations of a block, besides the base.
    VISITS = BLOCK + 1,   // The base is one of them.
    LEVELS = 64,          // Blocks whose times of the base are kept.
    FRAMES_OF_A_VISIT = 2 // One untimed, one timed.
};

// A combination that was timed.
typedef struct Timed {
    DipQuality quality;
    DipEstimate ratio; // Of its time to that of the base.
    int rounds;        // In which it was timed.
} Timed;

struct DipPriceJob {
    DipPriceJobCalls calls;
    DipPrices *prices;
    DipQuality current;
    DipQuality requested;
    bool follows; // The panes' settings are known.
    bool failed;
    DipError failure; // Why, if `failed`.
    bool idle;        // Every combination is known.
    DipQuality wanted[DIP_PRICE_MAX_WANTED];
    int wanted_count;
    int rounds; // That each combination gets now: the first rounds, until all have them.

    // The block.
    DipDriver *driver; // Times the members; NULL: there is no block.
    DipQuality members[VISITS];
    int member_count; // Member 0 is the base.

    Timed timed[DIP_PRICE_MAX_WANTED * 2];
    int timed_count;
    double base_ms[LEVELS]; // Median time of the base in each of the last blocks.
    int blocks;             // Blocks that are complete.
    double drawn_ms;        // Time and number of the frames of this picture.
    int drawn;
    // Sums over the pairs of times of this picture: the share that the threads waited, and
    // disturbed ones.
    double waited;
    int disturbed;
    int judged;
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
    dip_prices_forget_rough(job->prices);
    dip_prices_set_rough_doubtful(job->prices, false);
    job->timed_count = 0;
    job->blocks = 0;
    job->drawn_ms = 0.0;
    job->drawn = 0;
    job->waited = 0.0;
    job->disturbed = job->judged = 0;
    job->failed = false;
    job->idle = false;
    job->rounds = DIP_PRICE_JOB_FIRST_ROUNDS;
}

// --- what to time --------------------------------------------------------------------------------

static Timed *find_timed(DipPriceJob *job, const DipQuality *quality) {
    for (int i = 0; i < job->timed_count; i++) {
        if (dip_quality_equal(&job->timed[i].quality, quality)) {
            return &job->timed[i];
        }
    }
    return NULL;
}

// Lists the combinations that are not timed yet in `rounds` rounds. The base is part of every
// block, so it is not in the list.
static void list_with_rounds(DipPriceJob *job, int rounds) {
    const DipQuality base = dip_prices_base(job->prices);
    DipQuality all[DIP_PRICE_MAX_WANTED];
    const int count =
        dip_price_list_wanted(&base, &job->current, &job->requested, all, DIP_PRICE_MAX_WANTED);
    job->rounds = rounds;
    job->wanted_count = 0;
    for (int i = 0; i < count; i++) {
        const Timed *timed = find_timed(job, &all[i]);
        if (!dip_quality_equal(&all[i], &base) && (!timed || timed->rounds < rounds)) {
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

static void drop_block(DipPriceJob *job) {
    dip_driver_destroy(&job->driver);
    job->member_count = 0;
}

// Each round begins with the pattern of temporal AA that the round before timed last.
static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    DipPriceJob *job = context;
    (void)timed;
    const bool is_timed = turn->phase == DIP_DRIVER_TIMED;
    const uint64_t index = (uint64_t)(FRAMES_OF_A_VISIT * turn->round + is_timed + turn->round % 2);
    const int64_t begin_ns = now_ns(job);
    if (!job->calls.draw(job->calls.context, &job->members[turn->subject], index, err)) {
        return false;
    }
    job->drawn_ms += 1e-6 * (double)(now_ns(job) - begin_ns);
    job->drawn++;
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
    if (job->idle || job->timed_count + BLOCK > (int)(sizeof job->timed / sizeof *job->timed)) {
        job->idle = true;
        return false;
    }
    job->members[0] = dip_prices_base(job->prices);
    job->member_count = 1;
    while (job->member_count < VISITS && job->member_count <= job->wanted_count) {
        job->members[job->member_count] = job->wanted[job->member_count - 1];
        job->member_count++;
    }
    static const int base_of[VISITS] = {0};
    const DipDriverDef def = {
        .subjects = job->member_count,
        .base_of = base_of,
        .block_subjects = BLOCK,
        .starts = 1,
        .rounds = job->rounds,
        .frames = 1,
        .seed = (uint64_t)job->blocks,
        .most_wait = DIP_TIMED_MOST_WAIT,
    };
    const DipDriverCalls calls = {
        .draw = draw,
        .clock_ns = clock_ns,
        .thread_use = job->calls.thread_use ? thread_use : NULL,
        .context = job,
    };
    job->driver = dip_driver_create(&def, &calls, &job->failure);
    job->failed = !job->driver;
    job->member_count = job->failed ? 0 : job->member_count;
    return !job->failed;
}

// Returns the time of the base: the median over the blocks.
static double base_ms_of(const DipPriceJob *job) {
    double ms[LEVELS];
    const int count = job->blocks < LEVELS ? job->blocks : LEVELS;
    memcpy(ms, job->base_ms, (size_t)count * sizeof *ms);
    return dip_median(ms, count);
}

// Publishes all prices anew, because the base's time has become better known.
static bool publish(DipPriceJob *job) {
    const double base_ms = base_ms_of(job);
    const DipQuality base = dip_prices_base(job->prices);
    bool added = dip_prices_add_rough(job->prices, &base, base_ms, base_ms, base_ms, -1.0);
    for (int i = 0; added && i < job->timed_count; i++) {
        const Timed *timed = &job->timed[i];
        added = dip_prices_add_rough(job->prices, &timed->quality, timed->ratio.value * base_ms,
                                     timed->ratio.low * base_ms, timed->ratio.high * base_ms, -1.0);
    }
    return added ||
           dip_error_set(&job->failure, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
}

// Tells whether the machine was too busy: by the rule of a report, as far as its signs are known.
static void judge(DipPriceJob *job, double wait, int disturbed, int rounds) {
    job->waited += wait * rounds;
    job->disturbed += disturbed;
    job->judged += rounds;
    const DipCostSigns signs = {.wait = job->waited / job->judged,
                                .disturbed = (double)job->disturbed / job->judged,
                                .settled = true};
    char reason[DIP_COST_REASON];
    dip_prices_set_rough_doubtful(job->prices, dip_cost_verdict_of(&signs, reason) == DIP_COST_RED);
}

static bool end_block(DipPriceJob *job) {
    const DipTimes times = dip_driver_times(job->driver);
    DipTimesFit *fit = dip_times_fit(&times, &job->failure);
    int disturbed = 0;
    for (int m = 1; fit && m < job->member_count; m++) {
        const DipAlong along = dip_times_along(fit, m);
        Timed *before = find_timed(job, &job->members[m]);
        disturbed += along.timed - along.kept;
        *(before ? before : &job->timed[job->timed_count++]) =
            (Timed){job->members[m], dip_times_ratio(fit, m), times.rounds};
    }
    if (fit) {
        job->base_ms[job->blocks++ % LEVELS] = dip_times_frames(fit, 0)[0];
        judge(job, dip_driver_machine(job->driver, job->calls.threads).wait, disturbed,
              times.rounds * (job->member_count - 1));
    }
    drop_block(job);
    job->failed = !fit || !publish(job);
    dip_times_fit_free(&fit);
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
            drop_block(job);
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
    const int blocks = (job->wanted_count + BLOCK - 1) / BLOCK; // With the one that is being timed.
    const int visits = job->wanted_count + blocks;
    const int frames = visits * FRAMES_OF_A_VISIT * job->rounds;
    const DipDriverProgress block =
        job->driver ? dip_driver_progress(job->driver) : (DipDriverProgress){0};
    progress.first = job->rounds == DIP_PRICE_JOB_FIRST_ROUNDS;
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
