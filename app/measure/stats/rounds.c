// Which frames a round draws.
#include "app/measure/stats/rounds.h"

#include "app/measure/stats/random.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "timing", "out of memory");
}

// In each stretch of successive frames, copy k of a frame goes to the round that stands k steps
// further in a shuffled list of the rounds, with steps that differ between copies.
bool dip_rounds_deal(int frames, int rounds, int copies, uint64_t seed, int *round_of,
                     DipError *err) {
    DIP_ASSERT(frames > 0 && rounds > 0 && copies > 0 && copies <= rounds);
    int *order = malloc(2 * (size_t)rounds * sizeof *order);
    if (!order) {
        return out_of_memory(err);
    }
    int *steps = order + rounds;
    uint64_t random = seed * UINT64_C(0x9e3779b97f4a7c15) + UINT64_C(0x632be59bd9b4e019);
    for (int first = 0; first < frames; first += rounds) {
        for (int i = 0; i < rounds; i++) {
            order[i] = i;
            steps[i] = i;
        }
        dip_random_shuffle(&random, order, rounds);
        dip_random_shuffle(&random, steps + 1, rounds - 1); // Copy 0 takes no step.
        for (int copy = 0; copy < copies; copy++) {
            for (int i = 0; i < rounds && first + i < frames; i++) {
                round_of[copy * frames + first + i] = order[(i + steps[copy]) % rounds];
            }
        }
    }
    free(order);
    return true;
}
