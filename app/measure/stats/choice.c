// The odds of a choice, by drawing the true times.
#include "app/measure/stats/choice.h"

#include "app/measure/stats/random.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { DRAWS = 2000 };

// Draws from the standard normal distribution: Box and Muller 1958, one of the two values.
static double draw_normal(uint64_t *random) {
    const double u = (dip_random_next(random) + 0.5) / 2147483648.0;
    const double v = (dip_random_next(random) + 0.5) / 2147483648.0;
    return sqrt(-2.0 * log(u)) * cos(6.283185307179586 * v);
}

// Returns the candidate of least loss among those within the budget in one draw, or -1. The chosen
// one wins if its loss is within the tolerance of the least.
static int draw_best(const DipChoice *choices, int count, int chosen, double budget,
                     double common_error, double tolerance, uint64_t *random) {
    const double common = common_error * draw_normal(random);
    bool chosen_fits = false;
    int best = -1;
    for (int i = 0; i < count; i++) {
        const double shift = common + choices[i].error * draw_normal(random);
        if (choices[i].time * exp(shift) <= budget) {
            chosen_fits |= i == chosen;
            best = best < 0 || choices[i].loss < choices[best].loss ? i : best;
        }
    }
    const bool wins = chosen_fits && choices[best].loss >= (1.0 - tolerance) * choices[chosen].loss;
    return wins ? chosen : best;
}

bool dip_choice_odds(const DipChoice *choices, int count, int chosen, double budget,
                     double common_error, double tolerance, DipChoiceOdds *odds, DipError *err) {
    DIP_ASSERT(chosen >= 0 && chosen < count);
    uint64_t random = 1;
    int *wins = calloc((size_t)count, sizeof *wins);
    if (!wins) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "odds", "out of memory");
    }
    for (int draw = 0; draw < DRAWS; draw++) {
        const int best =
            draw_best(choices, count, chosen, budget, common_error, tolerance, &random);
        if (best >= 0) {
            wins[best]++;
        }
    }
    *odds = (DipChoiceOdds){.best = (double)wins[chosen] / DRAWS, .runner_up = -1};
    for (int i = 0; i < count; i++) {
        const double share = (double)wins[i] / DRAWS;
        if (i != chosen && share > odds->runner_up_best) {
            odds->runner_up = i;
            odds->runner_up_best = share;
        }
    }
    free(wins);
    return true;
}
