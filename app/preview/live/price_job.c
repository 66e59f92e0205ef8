// Timing combinations of settings beside the base, in blocks.
#include "app/preview/live/price_job.h"

#include "app/measure/stats/paired.h"
#include "app/preview/prices/price_question.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK = 4,            // Combinations of a block, besides the base.
    VISITS = BLOCK + 1,   // Visit i of a round draws members[order[i]]; member 0 is the base.
    LEVELS = 64,          // Blocks whose times of the base are kept.
    FRAMES_OF_A_VISIT = 2 // One untimed, one timed.
};

// A combination that was timed.
typedef struct Timed {
    DipQuality quality;
    DipStatsEstimate ratio; // Of its time to that of the base.
    int rounds;             // In which it was timed.
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
    DipQuality members[VISITS];
    int member_count; // 0: there is no block. Member 0 is the base.
    int order[VISITS];
    int block_rounds;
    int round;
    int visit;
    int frame; // Within the visit.
    double ms[VISITS][DIP_PRICE_JOB_ROUNDS];
    uint64_t random;

    Timed timed[DIP_PRICE_MAX_WANTED * 2];
    int timed_count;
    double base_ms[LEVELS]; // Median time of the base in each of the last blocks.
    int blocks;             // Blocks that are complete.
    double drawn_ms;        // Time and number of the frames of this picture.
    int drawn;
};

DipPriceJob *dip_price_job_create(const DipPriceJobCalls *calls, DipPrices *prices, DipError *err) {
    DipPriceJob *job = calloc(1, sizeof *job);
    if (!job) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
        return NULL;
    }
    job->calls = *calls;
    job->prices = prices;
    job->random = 1;
    job->rounds = DIP_PRICE_JOB_FIRST_ROUNDS;
    return job;
}

void dip_price_job_destroy(DipPriceJob **job) {
    free(*job);
    *job = NULL;
}

void dip_price_job_interrupt(DipPriceJob *job) {
    job->member_count = 0;
}

void dip_price_job_forget(DipPriceJob *job) {
    dip_price_job_interrupt(job);
    dip_prices_forget_rough(job->prices);
    job->timed_count = 0;
    job->blocks = 0;
    job->drawn_ms = 0.0;
    job->drawn = 0;
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

static uint64_t next_random(DipPriceJob *job) {
    job->random = job->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return job->random >> 33;
}

static void shuffle(DipPriceJob *job) {
    for (int i = 0; i < job->member_count; i++) {
        job->order[i] = i;
    }
    for (int i = job->member_count - 1; i > 0; i--) {
        const int other = (int)(next_random(job) % (uint64_t)(i + 1));
        const int swap = job->order[i];
        job->order[i] = job->order[other];
        job->order[other] = swap;
    }
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
    job->block_rounds = job->rounds;
    job->round = job->visit = job->frame = 0;
    shuffle(job);
    return true;
}

// Returns the time of the base: the median over the blocks.
static double base_ms_of(const DipPriceJob *job) {
    double ms[LEVELS];
    const int count = job->blocks < LEVELS ? job->blocks : LEVELS;
    memcpy(ms, job->base_ms, (size_t)count * sizeof *ms);
    return dip_stats_median(ms, count);
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

static bool end_block(DipPriceJob *job) {
    bool done = true;
    for (int m = 1; done && m < job->member_count; m++) {
        const DipPairedTimes times = {job->ms[m], job->ms[0], job->round, 1};
        Timed *before = find_timed(job, &job->members[m]);
        Timed timed = {.quality = job->members[m], .rounds = job->round};
        done = dip_paired_ratio(&times, &timed.ratio, &job->failure);
        if (done) {
            *(before ? before : &job->timed[job->timed_count++]) = timed;
        }
    }
    double base_ms[DIP_PRICE_JOB_ROUNDS];
    memcpy(base_ms, job->ms[0], sizeof base_ms);
    job->base_ms[job->blocks++ % LEVELS] = dip_stats_median(base_ms, job->round);
    job->member_count = 0;
    done = done && publish(job);
    job->failed = !done;
    list_wanted(job);
    return done;
}

// --- frames --------------------------------------------------------------------------------------

static int64_t now_ns(const DipPriceJob *job) {
    return job->calls.now_ns ? job->calls.now_ns(job->calls.context) : dip_clock_ns();
}

static bool draw_frame(DipPriceJob *job) {
    const int member = job->order[job->visit];
    const uint64_t index = (uint64_t)(FRAMES_OF_A_VISIT * job->round + job->frame + job->round % 2);
    const int64_t begin_ns = now_ns(job);
    if (!job->calls.draw(job->calls.context, &job->members[member], index, &job->failure)) {
        return false;
    }
    const double ms = 1e-6 * (double)(now_ns(job) - begin_ns);
    job->drawn_ms += ms;
    job->drawn++;
    if (job->frame == FRAMES_OF_A_VISIT - 1) {
        job->ms[member][job->round] = fmax(ms, 1e-6); // A clock may stand still for a frame.
    }
    return true;
}

// Moves on to the next frame. Returns whether a block has ended.
static bool move_on(DipPriceJob *job) {
    if (++job->frame < FRAMES_OF_A_VISIT) {
        return false;
    }
    job->frame = 0;
    if (++job->visit < job->member_count) {
        return false;
    }
    job->visit = 0;
    shuffle(job);
    return ++job->round == job->block_rounds;
}

bool dip_price_job_step(DipPriceJob *job, double budget_ms) {
    const int64_t end_ns = now_ns(job) + (int64_t)(1e6 * budget_ms);
    bool news = false;
    do {
        if (!job->follows || job->failed || job->idle ||
            (job->member_count == 0 && !begin_block(job))) {
            return news;
        }
        if (!draw_frame(job)) {
            job->failed = true;
            job->member_count = 0;
            return news;
        }
        news |= move_on(job) && end_block(job);
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
    const int done = FRAMES_OF_A_VISIT * (job->round * job->member_count + job->visit) + job->frame;
    progress.first = job->rounds == DIP_PRICE_JOB_FIRST_ROUNDS;
    progress.rounds = job->member_count > 0 ? job->round : 0;
    progress.combinations = job->wanted_count;
    if (job->drawn > 0) {
        progress.seconds_left =
            1e-3 * job->drawn_ms / job->drawn * (frames - (job->member_count > 0 ? done : 0));
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
