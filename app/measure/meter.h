// Judging pictures: one meter per thread.
#ifndef DIP_APP_MEASURE_METER_H
#define DIP_APP_MEASURE_METER_H

#include "app/measure/flicker.h"
#include "app/measure/flip.h"
#include "app/measure/sums.h"

typedef struct DipCostMeter {
    DipFlip flip;
    DipFlipSide side;
    DipFlicker flicker;
    float *map;
    float *error_lin;
} DipCostMeter;

bool dip_cost_meter_init(DipCostMeter *meter, int width, int height, double pixels_per_degree);
void dip_cost_meter_free(DipCostMeter *meter);

// What a picture is held against.
typedef struct DipCostStandard {
    DipPicture picture;
    const float *rgb_lin;
    const DipFlipSide *side; // the picture, taken in
    const uint8_t *classes;
} DipCostStandard;

// Judges one picture of a burst (begun by restarting meter->flicker) and adds to *sums. test_lin:
// its linear light if it is known better than by its codes, else NULL. False when memory runs out.
bool dip_cost_meter_add(DipCostMeter *meter, const DipPicture *test, const float *test_lin,
                        const DipCostStandard *standard, DipCostSums *sums);

// Ends the burst: adds its flicker.
void dip_cost_meter_end_burst(DipCostMeter *meter, DipCostSums *sums);

#endif
