// Plans each start and each round of a measurement (driver.h explains these words) as a list of
// frames.
#include "app/measure/timing/driver_private.h"

#include "app/measure/stats/random.h"

#include <stdlib.h>

static void add_draw(DipDriver *d, DipDriverPhase phase, int subject, int block, int frame,
                     bool begins_visit) {
    if (d->plan_count == d->plan_room) {
        const int room = d->plan_room ? 2 * d->plan_room : 256;
        DipDriverDraw *plan = realloc(d->plan, (size_t)room * sizeof *plan);
        d->plan = plan ? plan : d->plan;
        DipTimed *fresh = realloc(d->fresh, (size_t)room * sizeof *fresh);
        d->fresh = fresh ? fresh : d->fresh;
        if (!plan || !fresh) {
            d->plan_failed = true;
            return;
        }
        d->plan_room = room;
    }
    d->plan[d->plan_count++] = (DipDriverDraw){phase, subject, block, frame, begins_visit};
}

bool dip_driver_plan_start(DipDriver *d) {
    d->plan_count = d->next = 0;
    for (int s = 0; s < d->def.subjects; s++) {
        for (int f = 0; f < d->def.warm_frames; f++) {
            add_draw(d, DIP_DRIVER_WARM_UP, s, 0, f, false);
        }
    }
    return !d->plan_failed;
}

static void list_frames(DipDriver *d, int round) {
    const int copies = d->deal && !dip_driver_repeats(d) ? d->def.base_copies : 1;
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
// in the round and if less than three quarters of its frames in the whole measurement are
// undisturbed.
static void find_needed(DipDriver *d, int round) {
    for (int s = 0; s < d->def.subjects; s++) {
        d->is_needed[s] = !dip_driver_repeats(d);
        d->score[s] = 0;
    }
    for (int i = 0; dip_driver_repeats(d) && i < d->log_count; i++) {
        const DipTimed *timed = &d->log[i];
        const bool disturbed = dip_driver_is_disturbed(d, timed->wait, d->base_wait[i]);
        d->score[timed->subject] += disturbed ? -3 : 1;
        d->is_needed[timed->subject] |= disturbed && dip_driver_round_of(d, timed) == round;
    }
    for (int s = 0; dip_driver_repeats(d) && s < d->def.subjects; s++) {
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
    const bool alone =
        count == 0 && !dip_driver_repeats(d); // No subject is compared with this base.
    for (int at = 0; at < count || (alone && at == 0); at += d->def.block_subjects) {
        const int rest = count - at;
        const int size = rest < d->def.block_subjects ? rest : d->def.block_subjects;
        d->blocks[(*block_count)++] =
            (DipDriverBlock){.base = base, .first = first + at, .count = size};
    }
    return first + count;
}

static int subject_of(const DipDriver *d, const DipDriverBlock *block, int visit) {
    return visit < block->count ? d->members[block->first + visit] : block->base;
}

static void plan_visit(DipDriver *d, int subject, const DipDriverBlock *block) {
    add_draw(d, DIP_DRIVER_UNTIMED, subject, block->number, d->frames[0], true);
    for (int f = 0; f < d->frame_count; f++) {
        add_draw(d, DIP_DRIVER_TIMED, subject, block->number, d->frames[f], false);
    }
    // The frames that only the base draws are divided evenly among its blocks.
    for (int f = d->frame_count + block->nth_of_base;
         dip_driver_is_base(d, subject) && f < d->all_frame_count; f += block->of_base) {
        add_draw(d, DIP_DRIVER_TIMED, subject, block->number, d->frames[f], false);
    }
}

static void plan_block(DipDriver *d, const DipDriverBlock *block, uint64_t *random) {
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
        const DipDriverBlock swap = d->blocks[i];
        d->blocks[i] = d->blocks[other];
        d->blocks[other] = swap;
    }
}

// Numbers the blocks, and counts the blocks of each base.
static void number_blocks(DipDriver *d, int count) {
    for (int b = 0; b < count; b++) {
        DipDriverBlock *block = &d->blocks[b];
        block->number = b + (dip_driver_repeats(d) ? d->def.subjects : 0);
        for (int other = 0; other < count; other++) {
            const bool same = d->blocks[other].base == block->base;
            block->of_base += same;
            block->nth_of_base += same && other < b;
        }
    }
}

// Plans a round. Each round has a seed of its own, so that its order is the same if earlier rounds
// were resumed instead of drawn.
bool dip_driver_plan_round(DipDriver *d) {
    const int round = dip_driver_first_round(d);
    uint64_t random = d->def.seed * UINT64_C(0x9e3779b97f4a7c15) +
                      (uint64_t)d->round * UINT64_C(0x632be59bd9b4e019);
    int blocks = 0, first = 0;
    d->plan_count = d->next = d->fresh_count = 0;
    list_frames(d, round);
    find_needed(d, round);
    for (int s = 0; s < d->def.subjects; s++) {
        if (dip_driver_is_base(d, s)) {
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
