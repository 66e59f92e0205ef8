// Pictures for the HTML page. Each sweep (all steps of one setting) is shown by a crop: the part of
// the picture in which the steps differ most.
#ifndef DIP_APP_COST_REPORT_PICTURES_H
#define DIP_APP_COST_REPORT_PICTURES_H

#include "app/cost/context.h"

enum { DIP_COST_CROP_WIDTH = 200, DIP_COST_CROP_HEIGHT = 150 }; // Pixels, at most.

// The crops of one sweep: PNG files in base64, or NULL. Owned.
typedef struct DipCostCrops {
    char *truth;
    char *steps[DIP_COST_MAX_SWEEP_ROWS];
    char *maps[DIP_COST_MAX_SWEEP_ROWS]; // FLIP maps of the steps against the truth.
    int x;                               // Upper left corner of the crop, pixels.
    int y;
    int viewpoint;
} DipCostCrops;

typedef struct DipCostPictures {
    DipCostCrops sweeps[DIP_COST_MAX_SWEEPS]; // In the order of the report's sweeps.
} DipCostPictures;

// Draws every sweep once more at one viewpoint and cuts out the crops.
bool dip_cost_pictures_make(DipCostPictures *pictures, DipCostContext *cost, DipError *err);
void dip_cost_pictures_free(DipCostPictures *pictures);

#endif
