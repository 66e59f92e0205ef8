// Declares what a report measures: the settings, viewpoints, frames and budgets that the command
// line asks for.
#ifndef DIP_APP_REPORT_REPORT_PLAN_H
#define DIP_APP_REPORT_REPORT_PLAN_H

#include "app/report/choice.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

enum {
    DIP_COST_MAX_PARTS = 256, // Greatest number of files that one merge joins.
    DIP_COST_MAX_PLACES = 1000,
    DIP_COST_MAX_BURST = 16,
    DIP_COST_MAX_BUDGETS = 64
};

// Which pictures the HTML page has.
typedef enum DipCostPictureKind {
    DIP_COST_PICTURES_CROPS, // The part of each picture in which the rows differ most.
    DIP_COST_PICTURES_FULL,  // Whole frames as far as the page's size limit allows, and crops for
                             // the rest.
    DIP_COST_PICTURES_NONE
} DipCostPictureKind;

extern const char *const dip_cost_picture_kind_names[3]; // "crops", "full", "none"

// What to measure. Texts are borrowed from argv.
typedef struct DipCostOptions {
    DipQuality baseline;
    int places;      // Number of viewpoints on each path, where errors are measured.
    int burst;       // Number of successive frames that are drawn at each viewpoint.
    int first_place; // Index of the first viewpoint of this run (--part).
    int end_place;   // Index of the viewpoint after the run's last one; 0 if the run has all
                     // viewpoints.
    int samples;     // Samples per pixel in each half of the converged picture; a square number.
    double pixels_per_degree;
    int rounds;       // Number of rounds of all processes together.
    int starts;       // Number of processes that draw the timed frames, one after another. If it is
                      // 1, this process draws them.
    int timed_frames; // Frames of each round along a path; 0 if the report is of one picture
                      // (dip_cost_is_view).
    bool errors_only;
    bool predict; // True to measure a few combinations and predict all others.
    bool has_seed;
    int seed;
    bool has_combined;
    unsigned combined; // Bit s is set if setting s takes part in the combinations.
    double budgets_ms[DIP_COST_MAX_BUDGETS];
    int budget_count;
    DipTimeKind budget_of;
    bool require_quiet;          // True to fail if the machine was too busy for the times to be
                                 // believed.
    const char *cache;           // Folder of the cached truths; NULL for the user's cache folder.
    DipCostPictureKind pictures; // Which pictures the HTML page has.
    const char *truths;          // Folder to write the truths to, as PFM; NULL to write none.
} DipCostOptions;

#endif
