// Pictures for the report: for each sweep the part of a picture in which its steps differ most.
#ifndef DIP_APP_COST_GALLERY_H
#define DIP_APP_COST_GALLERY_H

#include "app/cost/rig.h"

enum { DIP_COST_CROP_WIDTH = 200, DIP_COST_CROP_HEIGHT = 150 }; // pixels, at most

// PNGs in base64; NULL where there is none.
typedef struct DipCostCrops {
    char *truth;
    char *steps[DIP_COST_MAX_SWEEP_ROWS];
    char *maps[DIP_COST_MAX_SWEEP_ROWS]; // FLIP against the truth
    int x;                               // of the crop's corner
    int y;
    int place;
} DipCostCrops;

typedef struct DipCostGallery {
    DipCostCrops sweeps[DIP_COST_MAX_SWEEPS];
} DipCostGallery;

bool dip_cost_gallery_make(DipCostGallery *gallery, DipCostRig *rig, DipError *err);
void dip_cost_gallery_free(DipCostGallery *gallery);

#endif
