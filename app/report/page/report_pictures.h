// Pictures for the HTML page: a set for each sweep (all steps of one setting), and a set for the
// combinations in the Pareto front of time and error.
#ifndef DIP_APP_REPORT_PAGE_REPORT_PICTURES_H
#define DIP_APP_REPORT_PAGE_REPORT_PICTURES_H

#include "app/report/page/picture_set.h"

typedef struct DipCostPictures {
    DipCostPictureSet sweeps[DIP_COST_MAX_SWEEPS]; // In the order of the report's sweeps.
    DipCostPictureSet front;
    int crops_left_out;  // Number of rows whose crops did not fit in the page.
    int frames_left_out; // Number of rows whose whole frames did not fit, if they were asked for.
} DipCostPictures;

// The greatest size of a page, in bytes.
#define DIP_COST_PAGE_BYTES 10000000.0

// Gets a frame of every row of the sweeps and of the front, at the run's middle viewpoint, and cuts
// out the crops, or with --pictures full whole frames. Leaves out what does not fit in a page. With
// --pictures none, there are no pictures.
bool dip_cost_pictures_make(DipCostPictures *pictures, const DipCostReport *report,
                            const DipCostFrameSource *source, DipError *err);
void dip_cost_pictures_free(DipCostPictures *pictures);

// Frees the pictures that do not fit in `room` bytes and counts the rows concerned. Each row has
// its crop first, the sweeps before the front. Then whole frames take the place of crops, the front
// before the sweeps.
void dip_cost_pictures_fit(DipCostPictures *pictures, double room);

#endif
