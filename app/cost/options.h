// What `diptych cost` is asked to measure.
#ifndef DIP_APP_COST_OPTIONS_H
#define DIP_APP_COST_OPTIONS_H

#include "renderer/scene/quality.h"

#include <stdbool.h>

enum {
    DIP_COST_MAX_PLACES = 1000,
    DIP_COST_MAX_BURST = 16,
    DIP_COST_MAX_BUDGETS = 8,
    DIP_COST_MAX_PARTS = 256 // files that are merged
};

// Texts are borrowed from argv.
typedef struct DipCostOptions {
    DipQuality baseline;
    int places; // of each path where errors are measured
    int burst;  // frames in a row at each
    int first_place;
    int end_place; // of this run; 0: all of them
    int samples;   // of each half of the truth, per pixel: a square
    double pixels_per_degree;
    int rounds;
    int timed_frames;
    bool errors_only;
    bool has_seed;
    int seed;
    bool has_combined;
    unsigned combined; // bit s: every step of setting s with every step of the other ones
    double budgets_ms[DIP_COST_MAX_BUDGETS];
    int budget_count;
    const char *cache; // folder; NULL: the user's
    const char *parts[DIP_COST_MAX_PARTS];
    int part_count;
} DipCostOptions;

#endif
