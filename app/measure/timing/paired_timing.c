// Rounds of blocks: each block times a few subjects and their base, in random order.
#include "app/measure/timing/paired_timing.h"

#include "app/measure/stats/random.h"
#include "app/measure/timing/runner.h"
#include "app/measure/stats/statistics.h"
#include "renderer/base/assert.h"

#include <stdlib.h>
#include <string.h>

// A subject keeps its pairs if at least this share of them is undisturbed.
static const double enough_undisturbed = 0.75;

typedef struct Block {
    int base;
    int first; // Index of its first subject in PairedTiming.members.
    int count;
} Block;

typedef struct PairedTiming {
    const DipPairedTimingDef *def;
    const DipPairedTimingCalls *calls;
    DipTimingRunner runner;
    DipThreadWatch *watch; // NULL if the caller has its own, or if the machine does not tell.
    uint64_t random;
    DipTimePair *pairs;       // All pairs; the caller's.
    DipTimePair *round_pairs; // Those of one round.
    int *members;             // Subjects of the round, grouped by base.
    Block *blocks;
    int *block_order;
    int *visit_order;    // Within a block: indices of members, and `count` for the base.
    double *base_ms;     // [block * frames_per_round + f]
    DipTimePair *visits; // Runs of one block: [visit * frames_per_round + f].
    int block_count;
    double wait_ms, cpu_ms, run_ms; // Sums over all timed runs.
    bool has_wait;
    int repeated;
} PairedTiming;

static int frame_count(const PairedTiming *t) {
    return t->def->rounds * t->def->frames_per_round;
}

static int frame_of(const PairedTiming *t, int round, int f) {
    return round % t->def->rounds + f * t->def->rounds;
}

static DipTimePair *pair_of(const PairedTiming *t, int subject, int frame) {
    return &t->pairs[(size_t)subject * (size_t)frame_count(t) + (size_t)frame];
}

static bool is_base(const PairedTiming *t, int subject) {
    return t->def->base_of[subject] == subject;
}

// --- one visit ---------------------------------------------------------------------------------

static DipThreadUse thread_use(const PairedTiming *t) {
    return t->calls->thread_use ? t->calls->thread_use(t->calls->context)
                                : dip_thread_watch_read(t->watch);
}

static bool run_timed(PairedTiming *t, const DipTimingTurn *turn, DipTimePair *to, DipError *err) {
    const DipThreadUse before = thread_use(t);
    double ms;
    if (!dip_timing_run_once(&t->runner, turn, &ms, err)) {
        return false;
    }
    const DipThreadUse after = thread_use(t);
    *to = (DipTimePair){
        .ms = ms,
        .wait = ms > 0.0 ? 1e-6 * (double)(after.wait_ns - before.wait_ns) / ms : 0.0,
        .cpu_ms = 1e-6 * (double)(after.cpu_ns - before.cpu_ns),
        .switches = (double)(after.switches - before.switches),
    };
    if (t->calls->part_ms && ms > 0.0) {
        t->calls->part_ms(t->calls->context, to->shares);
        for (int i = 0; i < DIP_TIME_PARTS; i++) {
            to->shares[i] /= ms;
        }
    }
    return true;
}

static bool visit(PairedTiming *t, int round, int subject, DipTimePair *to, DipError *err) {
    DipTimingTurn turn = {.phase = DIP_TIMING_REWARM,
                          .round = round,
                          .subject = subject,
                          .frame = frame_of(t, round, 0)};
    double untimed;
    bool done = dip_timing_run_once(&t->runner, &turn, &untimed, err);
    turn.phase = DIP_TIMING_TIMED;
    for (int f = 0; done && f < t->def->frames_per_round; f++) {
        turn.frame = frame_of(t, round, f);
        done = run_timed(t, &turn, &to[f], err);
    }
    return done;
}

// --- rounds ------------------------------------------------------------------------------------

static bool is_needed(const PairedTiming *t, int subject, int round) {
    if (round < t->def->rounds) {
        return true;
    }
    int undisturbed = 0;
    for (int f = 0; f < frame_count(t); f++) {
        undisturbed += !dip_time_pair_is_disturbed(pair_of(t, subject, f));
    }
    bool here = false; // The round has a disturbed pair of the subject.
    for (int f = 0; f < t->def->frames_per_round; f++) {
        here |= dip_time_pair_is_disturbed(pair_of(t, subject, frame_of(t, round, f)));
    }
    return here && undisturbed < enough_undisturbed * frame_count(t);
}

// Lists the base's subjects that the round times, in random order, and cuts them into blocks.
static int add_blocks(PairedTiming *t, int base, int round, int first) {
    int count = 0;
    for (int s = 0; s < t->def->subject_count; s++) {
        if (t->def->base_of[s] == base && s != base && is_needed(t, s, round)) {
            t->members[first + count++] = s;
        }
    }
    dip_random_shuffle(&t->random, t->members + first, count);
    const bool alone =
        count == 0 && round < t->def->rounds; // A base that nothing is compared with.
    for (int at = 0; at < count || (alone && at == 0); at += t->def->block_subjects) {
        const int rest = count - at;
        const int size = rest < t->def->block_subjects ? rest : t->def->block_subjects;
        t->blocks[t->block_count++] = (Block){base, first + at, size};
    }
    return first + count;
}

// Each round has a seed of its own, so that its order does not depend on which rounds were known.
static void plan_round(PairedTiming *t, int round) {
    int first = 0;
    t->random = t->def->seed * UINT64_C(0x9e3779b97f4a7c15) + (uint64_t)round * 0x632be59bd9b4e019;
    t->block_count = 0;
    for (int s = 0; s < t->def->subject_count; s++) {
        if (is_base(t, s)) {
            first = add_blocks(t, s, round, first);
        }
    }
    for (int b = 0; b < t->block_count; b++) {
        t->block_order[b] = b;
    }
    dip_random_shuffle(&t->random, t->block_order, t->block_count);
}

static bool time_block(PairedTiming *t, int round, int index, DipError *err) {
    const Block *block = &t->blocks[index];
    const int frames = t->def->frames_per_round;
    for (int i = 0; i <= block->count; i++) {
        t->visit_order[i] = i;
    }
    dip_random_shuffle(&t->random, t->visit_order, block->count + 1);
    for (int i = 0; i <= block->count; i++) {
        const int which = t->visit_order[i];
        const int subject = which < block->count ? t->members[block->first + which] : block->base;
        if (!visit(t, round, subject, &t->visits[which * frames], err)) {
            return false;
        }
    }
    const DipTimePair *base = &t->visits[block->count * frames];
    for (int f = 0; f < frames; f++) {
        t->base_ms[index * frames + f] = base[f].ms;
        for (int i = 0; i < block->count; i++) {
            DipTimePair *pair = &t->round_pairs[t->members[block->first + i] * frames + f];
            *pair = t->visits[i * frames + f];
            pair->base_ms = base[f].ms;
            pair->base_wait = base[f].wait;
        }
        t->round_pairs[block->base * frames + f] = base[f];
    }
    return true;
}

// A base's own pairs have the median over its blocks, as both times.
static void pair_bases(PairedTiming *t) {
    const int frames = t->def->frames_per_round;
    double *ms = t->base_ms + (size_t)t->def->subject_count * (size_t)frames; // Scratch.
    for (int s = 0; s < t->def->subject_count; s++) {
        for (int f = 0; is_base(t, s) && f < frames; f++) {
            int count = 0;
            for (int b = 0; b < t->block_count; b++) {
                if (t->blocks[b].base == s) {
                    ms[count++] = t->base_ms[b * frames + f];
                }
            }
            DipTimePair *pair = &t->round_pairs[s * frames + f];
            pair->ms = count > 0 ? dip_stats_median(ms, count) : 0.0;
            pair->base_ms = pair->ms;
            pair->wait = 0.0;
        }
    }
}

static bool time_round(PairedTiming *t, int round, DipError *err) {
    const size_t values = (size_t)t->def->subject_count * (size_t)t->def->frames_per_round;
    memset(t->round_pairs, 0, values * sizeof *t->round_pairs);
    bool done = true;
    for (int b = 0; done && b < t->block_count; b++) {
        done = time_block(t, round, t->block_order[b], err);
    }
    if (done) {
        pair_bases(t);
    }
    return done;
}

// Keeps a round's pairs, of a repetition only those that are less disturbed than the ones before.
static void keep_pairs(PairedTiming *t, int round, const DipTimePair *from) {
    for (int s = 0; s < t->def->subject_count; s++) {
        for (int f = 0; f < t->def->frames_per_round; f++, from++) {
            DipTimePair *to = pair_of(t, s, frame_of(t, round, f));
            if (!(from->ms > 0.0)) {
                continue;
            }
            t->run_ms += from->ms;
            t->wait_ms += from->wait * from->ms;
            t->cpu_ms += from->cpu_ms;
            t->repeated += round >= t->def->rounds;
            if (round < t->def->rounds ||
                (!is_base(t, s) && dip_time_pair_is_disturbed(to) &&
                 from->wait + from->base_wait < to->wait + to->base_wait)) {
                *to = *from;
            }
        }
    }
}

static bool run_round(PairedTiming *t, int round, DipError *err) {
    const DipPairedTimingCalls *calls = t->calls;
    const DipTimePair *known =
        calls->known_round ? calls->known_round(calls->context, round) : NULL;
    plan_round(t, round);
    if (!known && t->block_count == 0) {
        return true; // A repetition for which there is no need.
    }
    if (!known && !time_round(t, round, err)) {
        return false;
    }
    const DipTimePair *pairs = known ? known : t->round_pairs;
    keep_pairs(t, round, pairs);
    return !calls->after_round ||
           calls->after_round(calls->context, round, pairs, known != NULL, err);
}

// --- the whole ---------------------------------------------------------------------------------

static bool open_timing(PairedTiming *t, DipError *err) {
    const size_t subjects = (size_t)t->def->subject_count;
    const size_t frames = (size_t)t->def->frames_per_round;
    t->members = malloc(subjects * sizeof *t->members);
    t->blocks = malloc(subjects * sizeof *t->blocks);
    t->block_order = malloc(subjects * sizeof *t->block_order);
    t->visit_order = malloc((subjects + 1) * sizeof *t->visit_order);
    t->base_ms = malloc(subjects * (frames + 1) * sizeof *t->base_ms);
    t->visits = malloc((subjects + 1) * frames * sizeof *t->visits);
    t->round_pairs = malloc(subjects * frames * sizeof *t->round_pairs);
    t->watch = t->calls->thread_use ? NULL : dip_thread_watch_open();
    return (t->members && t->blocks && t->block_order && t->visit_order && t->base_ms &&
            t->visits && t->round_pairs) ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

static void close_timing(PairedTiming *t) {
    free(t->members);
    free(t->blocks);
    free(t->block_order);
    free(t->visit_order);
    free(t->base_ms);
    free(t->visits);
    free(t->round_pairs);
    dip_thread_watch_close(&t->watch);
}

static bool warm_up(PairedTiming *t, DipError *err) {
    DipTimingTurn turn = {.phase = DIP_TIMING_WARM_UP, .round = -1};
    double ms;
    for (turn.subject = 0; turn.subject < t->def->subject_count; turn.subject++) {
        if (!dip_timing_run_once(&t->runner, &turn, &ms, err)) {
            return false;
        }
    }
    return true;
}

bool dip_paired_timing_run(const DipPairedTimingDef *def, const DipPairedTimingCalls *calls,
                           int threads, DipTimePair *pairs, DipPairedTimingResult *result,
                           DipError *err) {
    DIP_ASSERT(def->subject_count > 0 && def->block_subjects > 0 && def->rounds > 0 &&
               def->frames_per_round > 0 && threads > 0);
    PairedTiming t = {
        .def = def,
        .calls = calls,
        .runner = {calls->run, calls->after_run, calls->clock_ns, calls->context},
        .pairs = pairs,
    };
    *result = (DipPairedTimingResult){.settled = true};
    bool done = open_timing(&t, err);
    t.has_wait = done && thread_use(&t).has_wait;
    done = done && warm_up(&t, err) &&
           (!def->settle || dip_timing_settle(&t.runner, &result->settled, err));
    for (int round = 0; done && round < 2 * def->rounds; round++) {
        done = run_round(&t, round, err);
    }
    const double room_ms = t.run_ms * threads;
    result->has_wait = t.has_wait;
    result->repeated = t.repeated;
    if (room_ms > 0.0) {
        result->wait = (t.has_wait ? t.wait_ms : room_ms - t.cpu_ms) / room_ms;
    }
    close_timing(&t);
    return done;
}

int64_t dip_paired_timing_run_count(const DipPairedTimingDef *def, int known_rounds) {
    int64_t visits = 0;
    for (int s = 0; s < def->subject_count; s++) {
        int members = 0;
        for (int other = 0; def->base_of[s] == s && other < def->subject_count; other++) {
            members += def->base_of[other] == s && other != s;
        }
        const int blocks = (members + def->block_subjects - 1) / def->block_subjects;
        visits += def->base_of[s] == s ? (blocks > 0 ? blocks : 1) : 1;
    }
    return def->subject_count + (def->rounds - known_rounds) * visits * (def->frames_per_round + 1);
}
