// Shrinks a sequence of choices: deletes, zeroes and lowers numbers while the same check fails.
#include "tests/stability/search/shrink.h"

#include <string.h>

enum { TRIES_WITHOUT_GAIN = 500 };

typedef struct Shrinker {
    const SearchBench *bench;
    Choices *best;
    SearchFinding *finding; // the failure of *best
    Choices candidate;
    const char *check; // the check that must fail
    int tries;
    int tries_without_gain;
} Shrinker;

static bool is_smaller(const Choices *a, const Choices *b) {
    if (a->count != b->count) {
        return a->count < b->count;
    }
    for (int i = 0; i < a->count; i++) {
        if (a->values[i] != b->values[i]) {
            return a->values[i] < b->values[i];
        }
    }
    return false;
}

// Removes the numbers that the generator did not read, and zeros at the end, which mean nothing.
static void trim(Choices *choices) {
    choices->count = choices->cursor < choices->count ? choices->cursor : choices->count;
    while (choices->count > 0 && choices->values[choices->count - 1] == 0) {
        choices->count--;
    }
}

// Reads the choices as the generator does, and stores each number as the generator reduces it.
static void trim_to_scene(Choices *choices) {
    static SearchScene scene;
    choices_rewind(choices);
    search_scene_make(&scene, choices);
    dip_test_scene_free(&scene.scene);
    trim(choices);
}

static bool is_done(const Shrinker *shrinker) {
    return shrinker->tries_without_gain >= TRIES_WITHOUT_GAIN;
}

// Keeps the candidate if it is smaller than the best sequence and fails in the same check.
static bool try_candidate(Shrinker *shrinker) {
    trim_to_scene(&shrinker->candidate);
    if (is_done(shrinker) || !is_smaller(&shrinker->candidate, shrinker->best)) {
        return false;
    }
    shrinker->tries++;
    shrinker->tries_without_gain++;
    SearchFinding finding;
    search_check(shrinker->bench, &shrinker->candidate, shrinker->check, &finding);
    if (!finding.check || strcmp(finding.check, shrinker->check) != 0) {
        return false;
    }
    *shrinker->best = shrinker->candidate;
    *shrinker->finding = finding;
    shrinker->tries_without_gain = 0;
    fprintf(stderr, "\rtry %d: %d numbers ", shrinker->tries, shrinker->best->count);
    return true;
}

static void delete_numbers(Choices *choices, int first, int count) {
    memmove(choices->values + first, choices->values + first + count,
            (size_t)(choices->count - first - count) * sizeof *choices->values);
    choices->count -= count;
}

// Deletes blocks of numbers, from the end to the beginning.
static void delete_blocks(Shrinker *shrinker, int length) {
    for (int first = shrinker->best->count - length; first >= 0 && !is_done(shrinker);
         first -= length > 4 ? length / 2 : 1) {
        if (first + length <= shrinker->best->count) {
            shrinker->candidate = *shrinker->best;
            delete_numbers(&shrinker->candidate, first, length);
            try_candidate(shrinker);
        }
    }
}

static void zero_blocks(Shrinker *shrinker, int length) {
    for (int first = 0; first < shrinker->best->count && !is_done(shrinker); first += length) {
        shrinker->candidate = *shrinker->best;
        for (int i = first; i < first + length && i < shrinker->candidate.count; i++) {
            shrinker->candidate.values[i] = 0;
        }
        try_candidate(shrinker);
    }
}

// Deletes elements of lists, from the last to the first.
static void delete_parts(Shrinker *shrinker) {
    for (int i = shrinker->best->part_count - 1; i >= 0 && !is_done(shrinker); i--) {
        if (i >= shrinker->best->part_count) {
            continue;
        }
        const ChoicesPart part = shrinker->best->parts[i];
        const int end = part.end < shrinker->best->count ? part.end : shrinker->best->count;
        if (part.first >= end ||
            (part.length_index >= 0 && shrinker->best->values[part.length_index] == 0)) {
            continue;
        }
        shrinker->candidate = *shrinker->best;
        if (part.length_index >= 0) {
            shrinker->candidate.values[part.length_index]--;
        }
        delete_numbers(&shrinker->candidate, part.first, end - part.first);
        try_candidate(shrinker);
    }
}

// Lowers each number as far as a search by halves finds the failure.
static void lower_numbers(Shrinker *shrinker) {
    for (int i = 0; i < shrinker->best->count && !is_done(shrinker); i++) {
        uint64_t step = shrinker->best->values[i];
        while (step > 0 && i < shrinker->best->count && !is_done(shrinker)) {
            shrinker->candidate = *shrinker->best;
            const bool possible = step <= shrinker->candidate.values[i];
            shrinker->candidate.values[i] -= possible ? step : 0;
            if (!possible || !try_candidate(shrinker)) {
                step /= 2;
            }
        }
    }
}

void search_shrink(const SearchBench *bench, Choices *choices, SearchFinding *finding) {
    static Shrinker shrinker;
    shrinker =
        (Shrinker){.bench = bench, .best = choices, .finding = finding, .check = finding->check};
    trim_to_scene(choices);
    int last_count = -1;
    uint64_t last_sum = 0;
    uint64_t sum = 1;
    while (!is_done(&shrinker) && (choices->count != last_count || sum != last_sum)) {
        last_count = choices->count;
        last_sum = sum;
        delete_parts(&shrinker);
        for (int length = 64; length >= 1; length /= 2) {
            delete_blocks(&shrinker, length);
        }
        for (int length = 16; length >= 1; length /= 4) {
            zero_blocks(&shrinker, length);
        }
        delete_parts(&shrinker);
        lower_numbers(&shrinker);
        sum = 0;
        for (int i = 0; i < choices->count; i++) {
            sum += choices->values[i];
        }
    }
    fprintf(stderr, "\r%d tries, %d numbers left\n", shrinker.tries, choices->count);
    choices_rewind(choices);
}
