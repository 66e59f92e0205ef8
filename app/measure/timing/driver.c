// Plans each start and each round of a measurement (driver.h explains these words) as a list of
// frames. Each step draws the next frame of the list.
#include "app/measure/timing/driver.h"

#include "app/measure/stats/random.h"
#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    SETTLE_RUNS = 5,
    SETTLE_TRIES = 20,
    MOST_IN_VAIN = 2 // The driver is done after this many repetitions in vain (in_vain) in a row.
};
static const double settle_tolerance = 0.02;

// A frame to draw, in a plan.
typedef struct Draw {
    DipDriverPhase phase;
    int subject;
    int block;
    int frame;
    bool begins_visit;
} Draw;

// A block of a round: a few subjects and their base.
typedef struct Block {
    int base;
    int first;       // Index of its first subject in DipDriver.members.
    int count;       // Number of subjects besides the base.
    int number;      // No other block of the round or of its repetition has the same number.
    int nth_of_base; // Index of this block among those of its base in the round.
    int of_base;     // Number of blocks of this base in the round.
} Block;

// What the next step does.
typedef enum Stage { PLAN, WARM_UP, SETTLE, DRAW, DONE, FAILED } Stage;

struct DipDriver {
    DipDriverDef def; // `starts` and `rounds` change if starts take long (most_start).
    DipDriverCalls calls;
    DipThreadWatch *watch; // NULL if the caller has a function `thread_use`, or if the machine does
                           // not tell how long threads wait.
    int *base_of;          // Owned; the other arrays of int lie in the same memory.
    int *deal; // [copy * frames + frame]: the round that draws the frame (dip_rounds_deal); NULL if
               // every round draws all frames.
    Stage stage;
    int start; // The last start that has begun; -1 if there is none.
    // The round that is drawn next, counted over all starts. From round_count on, the rounds are
    // repetitions of the rounds from 0 on.
    int round;
    bool starts_are_fixed; // True once the number of starts cannot change any more.

    // The plan of the start or round that is being drawn.
    Draw *plan;
    int plan_count, plan_room;
    bool plan_failed; // Memory ran out.
    int next;         // Index in `plan` of the frame that the next step draws.
    int *members;     // Subjects of the round, grouped by base.
    Block *blocks;    // Blocks of the round, in the order in which they are drawn.
    int *order;       // Scratch for shuffling.
    int *frames;      // First the frames that all subjects draw, then those that only bases draw.
    // Number of the frames that all subjects draw, and number of all elements of `frames`.
    int frame_count, all_frame_count;
    int *is_needed; // [subject]: 1 if the round draws the subject.
    int *score;     // [subject]: number of undisturbed frames minus three times that of disturbed
                    // ones.

    DipTimed *fresh; // Frames of the incomplete round.
    int fresh_count;
    DipTimed *log;     // Frames of all complete rounds.
    double *base_wait; // [index in `log`]: `wait` of the base's frame in the same block.
    int log_count;
    int *log_begin; // [round]: index in `log` of the round's first frame.

    double settle_ms[SETTLE_RUNS];
    double settle_last_ms; // Median of the SETTLE_RUNS times before the current ones.
    int settle_runs;

    int64_t origin_ns, visit_ns, start_begin_ns, round_begin_ns, start_ns;
    bool has_begun;
    int64_t drawn;                  // As in DipDriverProgress.
    int64_t left;                   // Number of frames of rounds that are still to be drawn.
    double wait_ms, cpu_ms, run_ms; // Sums over all timed frames.
    bool has_wait, settled;
    int repeated;
    int in_vain; // Number of repetitions in a row, up to the last one, in which most frames were
                 // disturbed again.
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

static int round_count(const DipDriver *d) {
    return d->def.starts * d->def.rounds;
}

static bool is_base(const DipDriver *d, int subject) {
    return d->base_of[subject] == subject;
}

// Returns the round that the driver draws now. For a repetition, this is the round that is
// repeated.
static int first_round_of(const DipDriver *d) {
    return d->round % round_count(d);
}

// Returns the round of a frame, counted over all starts.
static int round_of(const DipDriver *d, const DipTimed *timed) {
    return timed->start * d->def.rounds + timed->round;
}

// Returns whether the round that the driver draws now repeats an earlier one.
static bool repeats(const DipDriver *d) {
    return d->round >= round_count(d);
}

static bool is_disturbed(const DipDriver *d, double wait, double base_wait) {
    return d->def.most_wait > 0.0 && (wait > d->def.most_wait || base_wait > d->def.most_wait);
}

// --- plans ---------------------------------------------------------------------------------------

static void add_draw(DipDriver *d, DipDriverPhase phase, int subject, int block, int frame,
                     bool begins_visit) {
    if (d->plan_count == d->plan_room) {
        const int room = d->plan_room ? 2 * d->plan_room : 256;
        Draw *plan = realloc(d->plan, (size_t)room * sizeof *plan);
        d->plan = plan ? plan : d->plan;
        DipTimed *fresh = realloc(d->fresh, (size_t)room * sizeof *fresh);
        d->fresh = fresh ? fresh : d->fresh;
        if (!plan || !fresh) {
            d->plan_failed = true;
            return;
        }
        d->plan_room = room;
    }
    d->plan[d->plan_count++] = (Draw){phase, subject, block, frame, begins_visit};
}

static bool plan_start(DipDriver *d) {
    d->plan_count = d->next = 0;
    for (int s = 0; s < d->def.subjects; s++) {
        for (int f = 0; f < d->def.warm_frames; f++) {
            add_draw(d, DIP_DRIVER_WARM_UP, s, 0, f, false);
        }
    }
    return !d->plan_failed;
}

static void list_frames(DipDriver *d, int round) {
    const int copies = d->deal && !repeats(d) ? d->def.base_copies : 1;
    d->all_frame_count = 0;
    for (int i = 0; i < copies * d->def.frames; i++) {
        if (i == d->def.frames) {
            d->frame_count = d->all_frame_count;
        }
        if (!d->deal || d->deal[i] == round) {
            d->frames[d->all_frame_count++] = i % d->def.frames;
        }
    }
    d->frame_count = copies == 1 ? d->all_frame_count : d->frame_count;
}

// Finds the subjects that the round draws. A repetition draws a subject if it has a disturbed frame
// in the round and if less than three quarters of all its frames are undisturbed.
static void find_needed(DipDriver *d, int round) {
    for (int s = 0; s < d->def.subjects; s++) {
        d->is_needed[s] = !repeats(d);
        d->score[s] = 0;
    }
    for (int i = 0; repeats(d) && i < d->log_count; i++) {
        const DipTimed *timed = &d->log[i];
        const bool disturbed = is_disturbed(d, timed->wait, d->base_wait[i]);
        d->score[timed->subject] += disturbed ? -3 : 1;
        d->is_needed[timed->subject] |= disturbed && round_of(d, timed) == round;
    }
    for (int s = 0; repeats(d) && s < d->def.subjects; s++) {
        d->is_needed[s] &= d->score[s] < 0;
    }
}

// Appends to d->members, from index `first` on, the subjects of the base that the round draws, in
// random order. Divides them into blocks. Returns the index after the last subject.
static int add_blocks(DipDriver *d, int base, int first, int *block_count, uint64_t *random) {
    int count = 0;
    for (int s = 0; s < d->def.subjects; s++) {
        if (d->base_of[s] == base && s != base && d->is_needed[s]) {
            d->members[first + count++] = s;
        }
    }
    dip_random_shuffle(random, d->members + first, count);
    const bool alone = count == 0 && !repeats(d); // No subject is compared with this base.
    for (int at = 0; at < count || (alone && at == 0); at += d->def.block_subjects) {
        const int rest = count - at;
        const int size = rest < d->def.block_subjects ? rest : d->def.block_subjects;
        d->blocks[(*block_count)++] = (Block){.base = base, .first = first + at, .count = size};
    }
    return first + count;
}

static int subject_of(const DipDriver *d, const Block *block, int visit) {
    return visit < block->count ? d->members[block->first + visit] : block->base;
}

static void plan_visit(DipDriver *d, int subject, const Block *block) {
    add_draw(d, DIP_DRIVER_UNTIMED, subject, block->number, d->frames[0], true);
    for (int f = 0; f < d->frame_count; f++) {
        add_draw(d, DIP_DRIVER_TIMED, subject, block->number, d->frames[f], false);
    }
    // The frames that only the base draws are divided evenly among its blocks.
    for (int f = d->frame_count + block->nth_of_base; is_base(d, subject) && f < d->all_frame_count;
         f += block->of_base) {
        add_draw(d, DIP_DRIVER_TIMED, subject, block->number, d->frames[f], false);
    }
}

static void plan_block(DipDriver *d, const Block *block, uint64_t *random) {
    for (int v = 0; v <= block->count; v++) {
        d->order[v] = v;
    }
    for (int f = 0; d->def.in_turn && f < d->frame_count; f++) {
        dip_random_shuffle(random, d->order, block->count + 1);
        for (int v = 0; v <= block->count; v++) {
            add_draw(d, DIP_DRIVER_TIMED, subject_of(d, block, d->order[v]), block->number,
                     d->frames[f], true);
        }
    }
    dip_random_shuffle(random, d->order, block->count + 1);
    for (int v = 0; !d->def.in_turn && v <= block->count; v++) {
        plan_visit(d, subject_of(d, block, d->order[v]), block);
    }
}

static void shuffle_blocks(DipDriver *d, int count, uint64_t *random) {
    for (int i = count - 1; i > 0; i--) {
        const int other = dip_random_below(random, i + 1);
        const Block swap = d->blocks[i];
        d->blocks[i] = d->blocks[other];
        d->blocks[other] = swap;
    }
}

// Numbers the blocks, and counts the blocks of each base.
static void number_blocks(DipDriver *d, int count) {
    for (int b = 0; b < count; b++) {
        Block *block = &d->blocks[b];
        block->number = b + (repeats(d) ? d->def.subjects : 0);
        for (int other = 0; other < count; other++) {
            const bool same = d->blocks[other].base == block->base;
            block->of_base += same;
            block->nth_of_base += same && other < b;
        }
    }
}

// Plans a round. Each round has a seed of its own, so that its order is the same if earlier rounds
// were resumed instead of drawn.
static bool plan_round(DipDriver *d) {
    const int round = first_round_of(d);
    uint64_t random = d->def.seed * UINT64_C(0x9e3779b97f4a7c15) +
                      (uint64_t)d->round * UINT64_C(0x632be59bd9b4e019);
    int blocks = 0, first = 0;
    d->plan_count = d->next = d->fresh_count = 0;
    list_frames(d, round);
    find_needed(d, round);
    for (int s = 0; s < d->def.subjects; s++) {
        if (is_base(d, s)) {
            first = add_blocks(d, s, first, &blocks, &random);
        }
    }
    shuffle_blocks(d, blocks, &random);
    number_blocks(d, blocks);
    for (int b = 0; b < blocks; b++) {
        plan_block(d, &d->blocks[b], &random);
    }
    return !d->plan_failed;
}

// --- complete rounds -----------------------------------------------------------------------------

static void add_to_log(DipDriver *d, const DipTimed *timed, double base_wait) {
    d->log[d->log_count] = *timed;
    d->base_wait[d->log_count++] = base_wait;
}

// Returns the index in d->fresh of the base's frame in the same block as frame `at`. For a frame of
// a base, this is `at` itself.
static int find_beside(const DipDriver *d, int at) {
    const DipTimed *timed = &d->fresh[at];
    const int base = d->base_of[timed->subject];
    int begin = at;
    while (begin > 0 && d->fresh[begin - 1].block == timed->block) {
        begin--;
    }
    while (d->fresh[begin].subject != base || d->fresh[begin].frame != timed->frame) {
        begin++;
    }
    return begin;
}

static int find_in_log(const DipDriver *d, const DipTimed *timed) {
    int i = d->log_begin[first_round_of(d)];
    while (d->log[i].subject != timed->subject || d->log[i].frame != timed->frame) {
        i++;
    }
    return i;
}

// Returns whether a base's frame of a repetition is in the log already. It is if the new time of
// another subject in the same block was kept.
static bool is_in_log(const DipDriver *d, const DipTimed *timed) {
    bool found = false;
    for (int i = d->log_begin[round_count(d)]; i < d->log_count && !found; i++) {
        const DipTimed *other = &d->log[i];
        found = other->subject == timed->subject && other->block == timed->block &&
                other->frame == timed->frame && round_of(d, other) == round_of(d, timed);
    }
    return found;
}

// Replaces disturbed frames in the log by the frames of a repetition whose threads waited less.
// Adds the base's frames of the same blocks to the log.
static void keep_better(DipDriver *d) {
    for (int at = 0; at < d->fresh_count; at++) {
        const DipTimed *timed = &d->fresh[at];
        if (is_base(d, timed->subject)) {
            continue;
        }
        const DipTimed *base = &d->fresh[find_beside(d, at)];
        const int to = find_in_log(d, timed);
        if (is_disturbed(d, d->log[to].wait, d->base_wait[to]) &&
            timed->wait + base->wait < d->log[to].wait + d->base_wait[to]) {
            d->log[to] = *timed;
            d->base_wait[to] = base->wait;
            if (!is_in_log(d, base)) {
                add_to_log(d, base, base->wait);
            }
        }
    }
}

// Returns whether more than half of the fresh frames are disturbed.
static bool is_mostly_disturbed(const DipDriver *d) {
    int disturbed = 0;
    for (int i = 0; i < d->fresh_count; i++) {
        disturbed += is_disturbed(d, d->fresh[i].wait, d->fresh[find_beside(d, i)].wait);
    }
    return 2 * disturbed > d->fresh_count;
}

// Adds the fresh frames to the log. The frames of a repetition only replace worse ones.
static void end_round(DipDriver *d) {
    for (int i = 0; i < d->fresh_count; i++) {
        const DipTimed *timed = &d->fresh[i];
        d->run_ms += timed->ms;
        d->wait_ms += timed->wait * timed->ms;
        d->cpu_ms += timed->cpu_ms;
    }
    if (repeats(d)) {
        keep_better(d);
        d->repeated += d->fresh_count;
        d->in_vain = is_mostly_disturbed(d) ? d->in_vain + 1 : 0;
    } else {
        d->log_begin[d->round] = d->log_count;
        for (int i = 0; i < d->fresh_count; i++) {
            add_to_log(d, &d->fresh[i], d->fresh[find_beside(d, i)].wait);
        }
        d->log_begin[d->round + 1] = d->log_count;
    }
    d->round++;
}

static bool use_two_starts(DipDriver *d) {
    const int rounds = round_count(d);
    if (rounds % 2 != 0) {
        return false;
    }
    d->def.starts = 2;
    d->def.rounds = rounds / 2;
    return true;
}

// Decides on the number of starts (most_start). This happens after the first round, which belongs
// to the first start in any case.
static void fix_starts(DipDriver *d, int64_t round_ns) {
    const double room_ns = d->def.most_start * (double)round_ns * d->def.rounds;
    if (!d->starts_are_fixed && d->def.starts > 2 && d->def.most_start > 0.0 && d->start == 0 &&
        (double)d->start_ns > room_ns) {
        use_two_starts(d);
    }
    d->starts_are_fixed = true;
}

// Returns whether a frame given to dip_driver_resume is the one that the plan of the round has.
static bool is_of_draw(const DipDriver *d, const DipTimed *timed, const Draw *draw) {
    return timed->subject == draw->subject && timed->block == draw->block &&
           timed->frame == draw->frame && round_of(d, timed) == first_round_of(d) &&
           timed->round >= 0 && timed->round < d->def.rounds && timed->ms > 0.0 &&
           isfinite(timed->ms) && timed->wait >= 0.0;
}

bool dip_driver_resume(DipDriver *d, const DipTimed *known, int count) {
    DIP_ASSERT(d->stage == PLAN && d->start < 0);
    // If the first start has more rounds than defined, the earlier measurement used two starts.
    for (int i = 0; i < count && !d->starts_are_fixed; i++) {
        d->starts_are_fixed =
            known[i].start == 0 && known[i].round >= d->def.rounds && use_two_starts(d);
    }
    for (int at = 0; at < count;) {
        if (d->round == 2 * round_count(d) || !plan_round(d)) {
            return false;
        }
        for (int p = 0; p < d->plan_count; p++) {
            const Draw *draw = &d->plan[p];
            if (draw->phase != DIP_DRIVER_TIMED) {
                continue;
            }
            const DipTimed *timed = &known[at + d->fresh_count];
            if (at + d->fresh_count == count || !is_of_draw(d, timed, draw)) {
                return false;
            }
            d->fresh[d->fresh_count++] = *timed;
        }
        at += d->fresh_count;
        d->left -= repeats(d) ? 0 : d->plan_count;
        if (d->fresh_count > 0) {
            d->origin_ns = -known[at - 1].begin_ns;
        }
        end_round(d);
    }
    return true;
}

// --- drawing -------------------------------------------------------------------------------------

static int64_t now_ns(const DipDriver *d) {
    return d->calls.clock_ns ? d->calls.clock_ns(d->calls.context) : dip_clock_ns();
}

static DipThreadUse thread_use(const DipDriver *d) {
    return d->calls.thread_use ? d->calls.thread_use(d->calls.context)
                               : dip_thread_watch_read(d->watch);
}

static void rest(int64_t ns) {
    const struct timespec time = {.tv_sec = (time_t)(ns / 1000000000),
                                  .tv_nsec = (long)(ns % 1000000000)};
    nanosleep(&time, NULL);
}

// Draws a frame and writes its times to *timed.
static bool draw_frame(DipDriver *d, const Draw *draw, DipTimed *timed, DipError *err) {
    const bool in_round = draw->phase >= DIP_DRIVER_UNTIMED;
    const int round = first_round_of(d);
    const DipDriverTurn turn = {
        .phase = draw->phase,
        .subject = draw->subject,
        .start = in_round ? round / d->def.rounds : d->start,
        .round = in_round ? round % d->def.rounds : -1,
        .frame = draw->frame,
    };
    if (d->calls.prepare && !d->calls.prepare(d->calls.context, &turn, err)) {
        return false;
    }
    if (draw->phase == DIP_DRIVER_TIMED && d->def.rest_ns > 0) {
        rest(d->def.rest_ns);
    }
    const DipThreadUse before = thread_use(d);
    const int64_t begin_ns = now_ns(d);
    if (!d->has_begun) {
        d->origin_ns += begin_ns; // It was 0, or minus the duration of the resumed rounds.
        d->has_begun = true;
    }
    d->visit_ns = draw->begins_visit ? begin_ns : d->visit_ns;
    *timed = (DipTimed){.subject = draw->subject,
                        .start = turn.start,
                        .round = turn.round,
                        .block = draw->block,
                        .frame = draw->frame,
                        .begin_ns = d->visit_ns - d->origin_ns,
                        .ms = NAN};
    if (!d->calls.draw(d->calls.context, &turn, timed, err)) {
        return false;
    }
    const int64_t ns = now_ns(d) - begin_ns;
    if (isnan(timed->ms)) {
        const DipThreadUse after = thread_use(d);
        timed->ms = fmax(1e-6 * (double)ns, 1e-6); // A clock may stand still for a frame.
        timed->wait = 1e-6 * (double)(after.wait_ns - before.wait_ns) / timed->ms;
        timed->cpu_ms = 1e-6 * (double)(after.cpu_ns - before.cpu_ns);
        timed->switches = (double)(after.switches - before.switches);
    } else if (isnan(timed->wait)) {
        timed->wait = 0.0;
        d->has_wait = false;
    }
    return true;
}

static bool draw_next(DipDriver *d, DipError *err) {
    const Draw *draw = &d->plan[d->next];
    DipTimed timed;
    if (!draw_frame(d, draw, &timed, err)) {
        return false;
    }
    if (draw->phase == DIP_DRIVER_TIMED) {
        d->fresh[d->fresh_count++] = timed;
    }
    const bool counts = d->stage == WARM_UP || !repeats(d);
    d->drawn += counts;
    d->left -= counts && d->stage == DRAW;
    d->next++;
    return true;
}

static bool draw_settling(DipDriver *d, DipError *err) {
    DipTimed timed;
    if (!draw_frame(d, &(Draw){.phase = DIP_DRIVER_SETTLE}, &timed, err)) {
        return false;
    }
    d->settle_ms[d->settle_runs++ % SETTLE_RUNS] = timed.ms;
    if (d->settle_runs % SETTLE_RUNS == 0) {
        const double median = dip_median(d->settle_ms, SETTLE_RUNS);
        d->settled = d->settle_runs > SETTLE_RUNS &&
                     fabs(median - d->settle_last_ms) <= settle_tolerance * d->settle_last_ms;
        d->settle_last_ms = median;
    }
    d->stage = d->settled || d->settle_runs == SETTLE_RUNS * SETTLE_TRIES ? PLAN : SETTLE;
    return true;
}

// --- steps ---------------------------------------------------------------------------------------

// Plans the next round that has frames to draw. Begins a start if the round needs another.
static bool begin_round(DipDriver *d, DipError *err) {
    const int rounds = round_count(d);
    do {
        if (d->round == 2 * rounds || d->in_vain == MOST_IN_VAIN ||
            (repeats(d) && !(d->has_wait && d->def.most_wait > 0.0))) {
            d->stage = DONE;
            return true;
        }
        if (!plan_round(d)) {
            return out_of_memory(err);
        }
        d->round += d->plan_count == 0; // No frame of this round has to be drawn again.
    } while (d->plan_count == 0);
    const int start = !repeats(d)     ? d->round / d->def.rounds
                      : d->start >= 0 ? d->start
                                      : d->def.starts - 1;
    d->stage = DRAW;
    if (start == d->start) {
        d->round_begin_ns = now_ns(d);
        return true;
    }
    d->start_begin_ns = now_ns(d);
    d->start = start;
    d->stage = WARM_UP;
    return (!d->calls.start || d->calls.start(d->calls.context, start, err)) &&
           (plan_start(d) || out_of_memory(err));
}

static bool complete_round(DipDriver *d, DipError *err) {
    d->stage = PLAN;
    end_round(d);
    fix_starts(d, now_ns(d) - d->round_begin_ns);
    return !d->calls.keep || d->calls.keep(d->calls.context, d->fresh, d->fresh_count, err);
}

// Plans what comes next if the plan is done, and draws a frame. Writes to *step only if a round is
// complete or all work is done.
static bool take_step(DipDriver *d, DipDriverStep *step, DipError *err) {
    while (d->stage == PLAN || (d->stage == WARM_UP && d->next == d->plan_count)) {
        if (d->stage == WARM_UP) {
            d->start_ns = now_ns(d) - d->start_begin_ns;
            d->stage = d->def.settle && d->settle_runs == 0 ? SETTLE : PLAN;
        } else if (!begin_round(d, err)) {
            return false;
        }
    }
    if (d->stage == SETTLE) {
        return draw_settling(d, err);
    }
    if (d->stage == DONE) {
        *step = DIP_DRIVER_DONE;
        return true;
    }
    if (!draw_next(d, err)) {
        return false;
    }
    if (d->stage == DRAW && d->next == d->plan_count) {
        *step = DIP_DRIVER_ROUND;
        return complete_round(d, err);
    }
    return true;
}

DipDriverStep dip_driver_step(DipDriver *d, DipError *err) {
    DipDriverStep step = DIP_DRIVER_WORKING;
    if (d->stage == FAILED || !take_step(d, &step, err)) {
        d->stage = FAILED;
        return DIP_DRIVER_FAILED;
    }
    return step;
}

void dip_driver_drop_round(DipDriver *d) {
    if (d->stage == DRAW) {
        d->drawn -= repeats(d) ? 0 : d->next;
        d->left += repeats(d) ? 0 : d->next;
        d->stage = PLAN;
    }
}

// --- the whole -----------------------------------------------------------------------------------

static bool open_driver(DipDriver *d, const DipDriverDef *def) {
    const size_t subjects = (size_t)def->subjects;
    const size_t deals = (size_t)def->base_copies * (size_t)def->frames;
    const size_t frames = def->base_copies > 0 ? deals : (size_t)def->frames;
    const size_t rounds = (size_t)round_count(d);
    d->base_of = calloc(5 * subjects + 1 + frames + rounds + 1 + deals, sizeof *d->base_of);
    d->blocks = malloc(subjects * sizeof *d->blocks);
    if (!d->base_of || !d->blocks) {
        return false;
    }
    d->members = d->base_of + subjects;
    d->is_needed = d->members + subjects;
    d->score = d->is_needed + subjects;
    d->order = d->score + subjects;
    d->frames = d->order + subjects + 1;
    d->log_begin = d->frames + frames;
    for (int s = 0; s < def->subjects; s++) {
        d->base_of[s] = def->base_of ? def->base_of[s] : s;
    }
    if (def->base_copies > 0) {
        d->deal = d->log_begin + rounds + 1;
        if (!dip_rounds_deal(def->frames, round_count(d), def->base_copies, def->seed, d->deal,
                             NULL)) {
            return false;
        }
    }
    for (d->round = 0; d->round < round_count(d); d->round++) {
        if (!plan_round(d)) {
            return false;
        }
        d->left += d->plan_count;
    }
    d->round = 0;
    // A repetition adds at most one frame of the base for each frame of the rounds.
    d->log = malloc(2 * (size_t)d->left * sizeof *d->log);
    d->base_wait = malloc(2 * (size_t)d->left * sizeof *d->base_wait);
    return d->log && d->base_wait;
}

DipDriver *dip_driver_create(const DipDriverDef *def, const DipDriverCalls *calls, DipError *err) {
    DIP_ASSERT(def->subjects > 0 && def->starts > 0 && def->rounds > 0 && def->frames > 0);
    DIP_ASSERT(def->block_subjects > 0 && def->warm_frames <= def->frames);
    DIP_ASSERT(def->base_copies == 0 || def->frames >= def->starts * def->rounds);
    DIP_ASSERT(def->base_copies <= def->starts * def->rounds);
    DipDriver *d = calloc(1, sizeof *d);
    if (!d) {
        out_of_memory(err);
        return NULL;
    }
    d->def = *def;
    d->calls = *calls;
    d->start = -1;
    d->settled = !def->settle;
    d->watch = calls->thread_use ? NULL : dip_thread_watch_open();
    d->has_wait = thread_use(d).has_wait;
    if (!open_driver(d, def)) {
        out_of_memory(err);
        dip_driver_destroy(&d);
    }
    return d;
}

void dip_driver_destroy(DipDriver **driver) {
    DipDriver *d = *driver;
    if (d) {
        dip_thread_watch_close(&d->watch);
        free(d->base_of);
        free(d->blocks);
        free(d->plan);
        free(d->fresh);
        free(d->log);
        free(d->base_wait);
        free(d);
    }
    *driver = NULL;
}

DipTimes dip_driver_times(const DipDriver *d) {
    return (DipTimes){
        .list = d->log,
        .count = d->log_count,
        .subjects = d->def.subjects,
        .starts = d->def.starts,
        .rounds = d->def.rounds,
        .frames = d->def.frames,
        .base_of = d->base_of,
        .complete = !d->deal,
    };
}

DipDriverProgress dip_driver_progress(const DipDriver *d) {
    const int rounds = round_count(d);
    const int begun = d->start >= 0 ? d->start + 1 : d->round / d->def.rounds;
    const int starts = d->round < rounds ? d->def.starts - begun : 0;
    const int64_t warming = d->stage == WARM_UP ? d->plan_count - d->next : 0;
    const int64_t left = d->left + warming + (int64_t)starts * d->def.subjects * d->def.warm_frames;
    return (DipDriverProgress){
        .drawn = d->drawn,
        .total = d->drawn + left,
        .rounds = repeats(d) ? rounds : d->round,
        .searched = repeats(d) ? d->round - rounds : 0,
        .all_rounds = rounds,
    };
}

DipDriverMachine dip_driver_machine(const DipDriver *d, int threads) {
    const double room_ms = d->run_ms * threads;
    DipDriverMachine machine = {
        .settled = d->settled || d->settle_runs == 0,
        .has_wait = d->has_wait,
        .repeated = d->repeated,
    };
    if (room_ms > 0.0) {
        machine.wait = (d->has_wait ? d->wait_ms : room_ms - d->cpu_ms) / room_ms;
    }
    return machine;
}
