// Keeps the frames of complete rounds, and replaces frames that other programs disturbed by frames
// of repetitions.
#include "app/measure/timing/driver_private.h"

#include "renderer/base/fp_mode.h"

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
    int i = d->log_begin[dip_driver_first_round(d)];
    while (d->log[i].subject != timed->subject || d->log[i].frame != timed->frame) {
        i++;
    }
    return i;
}

// Returns whether a base's frame of a repetition is in the log already. This is so if the new time
// of another subject in the same block was kept.
static bool is_in_log(const DipDriver *d, const DipTimed *timed) {
    bool found = false;
    for (int i = d->log_begin[dip_driver_round_count(d)]; i < d->log_count && !found; i++) {
        const DipTimed *other = &d->log[i];
        found = other->subject == timed->subject && other->block == timed->block &&
                other->frame == timed->frame &&
                dip_driver_round_of(d, other) == dip_driver_round_of(d, timed);
    }
    return found;
}

// Replaces disturbed frames in the log by the frames of a repetition whose threads waited less.
// Adds the base's frames of the same blocks to the log.
static void keep_better(DipDriver *d) {
    for (int at = 0; at < d->fresh_count; at++) {
        const DipTimed *timed = &d->fresh[at];
        if (dip_driver_is_base(d, timed->subject)) {
            continue;
        }
        const DipTimed *base = &d->fresh[find_beside(d, at)];
        const int to = find_in_log(d, timed);
        if (dip_driver_is_disturbed(d, d->log[to].wait, d->base_wait[to]) &&
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
        disturbed += dip_driver_is_disturbed(d, d->fresh[i].wait, d->fresh[find_beside(d, i)].wait);
    }
    return 2 * disturbed > d->fresh_count;
}

void dip_driver_end_round(DipDriver *d) {
    DIP_FP_MODE_SCOPE();
    for (int i = 0; i < d->fresh_count; i++) {
        const DipTimed *timed = &d->fresh[i];
        d->run_ms += timed->ms;
        d->wait_ms += timed->wait * timed->ms;
        d->cpu_ms += timed->cpu_ms;
    }
    if (dip_driver_repeats(d)) {
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
