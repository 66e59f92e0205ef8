// Interleaving combinations and programs.
#include "app/bench/measure.h"

#include "app/progress.h"

#include <stdlib.h>
#include <time.h>

typedef struct Measuring {
    const DipBenchPlan *plan;
    const DipBenchSource *sources;
    int source_count;
    DipBenchResult *results;
    uint64_t random;
    DipProgress progress;
    int64_t drawn; // frames of all sources
} Measuring;

static uint32_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33);
}

static void shuffle(int *order, int count, uint64_t *random) {
    for (int i = count - 1; i > 0; i--) {
        const int other = (int)(next_random(random) % (uint32_t)(i + 1));
        const int swap = order[i];
        order[i] = order[other];
        order[other] = swap;
    }
}

static bool draw(Measuring *m, int source, int combination, int frame, bool hash,
                 DipBenchSample *sample, DipError *err) {
    const DipBenchSource *from = &m->sources[source];
    dip_progress_show(&m->progress, m->drawn++);
    return from->draw(from->context, combination, frame, hash, sample, err);
}

static bool warm_up(Measuring *m, DipError *err) {
    const int frames = m->plan->options.frames;
    for (int c = 0; c < m->plan->count; c++) {
        for (int i = 0; i < frames; i++) {
            for (int s = 0; s < m->source_count; s++) {
                if (!draw(m, s, c, i, true, &m->results[s].first[c * frames + i], err)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static bool visit_alone(Measuring *m, int combination, int round, DipError *err) {
    DipBenchSample sample;
    if (!draw(m, 0, combination, 0, false, &sample, err)) {
        return false;
    }
    for (int i = 0; i < m->plan->options.frames; i++) {
        if (!draw(m, 0, combination, i, false, &sample, err)) {
            return false;
        }
        dip_bench_result_add(m->results, combination, round, i, &sample);
    }
    return true;
}

static bool visit_in_turn(Measuring *m, int combination, int round, DipError *err) {
    for (int i = 0; i < m->plan->options.frames; i++) {
        const int first = (int)(next_random(&m->random) >> 7 & 1);
        for (int turn = 0; turn < 2; turn++) {
            const int source = first ^ turn;
            DipBenchSample sample;
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
            if (!draw(m, source, combination, i, false, &sample, err)) {
                return false;
            }
            dip_bench_result_add(&m->results[source], combination, round, i, &sample);
        }
    }
    return true;
}

bool dip_bench_measure(const DipBenchPlan *plan, const DipBenchSource *sources, int source_count,
                       DipBenchResult *results, DipError *err) {
    Measuring m = {plan, sources, source_count, results, (uint64_t)plan->options.seed, {0}, 0};
    const int frames = plan->options.frames;
    const int per_round = source_count * frames + (source_count == 1);
    const int64_t per_combination =
        (int64_t)source_count * frames + (int64_t)plan->options.rounds * per_round;
    m.progress = dip_progress_begin("frames", plan->count * per_combination);
    int order[DIP_BENCH_MAX_COMBINATIONS];
    for (int i = 0; i < plan->count; i++) {
        order[i] = i;
    }
    bool done = warm_up(&m, err);
    for (int round = 0; done && round < plan->options.rounds; round++) {
        shuffle(order, plan->count, &m.random);
        for (int i = 0; done && i < plan->count; i++) {
            done = source_count == 1 ? visit_alone(&m, order[i], round, err)
                                     : visit_in_turn(&m, order[i], round, err);
        }
    }
    dip_progress_end(&m.progress, m.drawn);
    return done;
}
