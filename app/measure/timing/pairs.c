// Finding the base's frame beside each frame of a log.
#include "app/measure/timing/pairs.h"

#include "app/measure/stats/statistics.h"

#include <stdlib.h>
#include <string.h>

// Orders frames by round, block, frame and subject.
static int compare(const void *a, const void *b) {
    const DipTimed *x = *(const DipTimed *const *)a;
    const DipTimed *y = *(const DipTimed *const *)b;
    const int from[] = {x->start, x->round, x->block, x->frame, x->subject};
    const int to[] = {y->start, y->round, y->block, y->frame, y->subject};
    int order = 0;
    for (int i = 0; i < 5 && order == 0; i++) {
        order = (from[i] > to[i]) - (from[i] < to[i]);
    }
    return order;
}

static DipTimePair pair_of(const DipTimed *timed, const DipTimed *base) {
    DipTimePair pair = {
        .ms = timed->ms,
        .base_ms = base->ms,
        .wait = timed->wait,
        .base_wait = base->wait,
        .cpu_ms = timed->cpu_ms,
        .switches = timed->switches,
    };
    for (int i = 0; i < DIP_TIME_PARTS; i++) {
        pair.shares[i] = timed->parts_ms[i] / timed->ms;
    }
    return pair;
}

// Gives a base's own pairs the median of its times, with the rest of one of its frames.
static void pair_base(const DipTimes *times, int base, DipTimePair *pairs, double *ms) {
    for (int frame = 0; frame < times->frames; frame++) {
        int count = 0;
        for (int i = 0; i < times->count; i++) {
            const DipTimed *timed = &times->list[i];
            if (timed->subject == base && timed->frame == frame) {
                pairs[frame] = pair_of(timed, timed);
                ms[count++] = timed->ms;
            }
        }
        if (count > 0) {
            pairs[frame].ms = pairs[frame].base_ms = dip_stats_median(ms, count);
            pairs[frame].wait = pairs[frame].base_wait = 0.0;
        }
    }
}

bool dip_times_pairs(const DipTimes *times, DipTimePair *pairs, DipError *err) {
    const size_t count = (size_t)times->count;
    const DipTimed **sorted = malloc((count + 1) * sizeof(DipTimed *));
    double *ms = malloc((count + 1) * sizeof *ms);
    const bool made =
        (sorted && ms) || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
    memset(pairs, 0, (size_t)times->subjects * (size_t)times->frames * sizeof *pairs);
    for (size_t i = 0; made && i < count; i++) {
        sorted[i] = &times->list[i];
    }
    if (made) {
        qsort(sorted, count, sizeof *sorted, compare);
    }
    for (int i = 0; made && i < times->count; i++) {
        const DipTimed *timed = &times->list[i];
        DipTimed key = *timed;
        const DipTimed *wanted = &key;
        key.subject = times->base_of[timed->subject];
        const DipTimed *const *base = bsearch(&wanted, sorted, count, sizeof *sorted, compare);
        if (base && key.subject != timed->subject) {
            pairs[timed->subject * times->frames + timed->frame] = pair_of(timed, *base);
        }
    }
    for (int s = 0; made && s < times->subjects; s++) {
        if (times->base_of[s] == s) {
            pair_base(times, s, pairs + (size_t)s * (size_t)times->frames, ms);
        }
    }
    free(sorted);
    free(ms);
    return made;
}
