// Predicts the time and the error of combinations that a report did not measure.
//
// The time comes from the report's model of work (app/report/fit.h) and the combination's composed
// work (app/report/work.h). FLIP comes from the report's model of errors.
#ifndef DIP_APP_PREVIEW_PRICES_PRICE_MODEL_H
#define DIP_APP_PREVIEW_PRICES_PRICE_MODEL_H

#include "app/report/report.h"

typedef struct DipPriceModel DipPriceModel;

typedef struct DipPricePrediction {
    double ms;
    double
        miss; // 90 % of the predictions of this kind miss the measured time by at most this share.
    bool has_flip;
    double flip;
} DipPricePrediction;

// base: the settings that the groups are compared with. *model becomes NULL if the report has too
// few times for a model. Fails with MEMORY.
bool dip_price_model_create(const DipCostReport *report, const DipQuality *base,
                            DipPriceModel **model, DipError *err);
void dip_price_model_destroy(DipPriceModel **model); // *model may be NULL.

// Returns false if, for one of the combination's groups, the report has no row that differs from
// the base in this group alone.
bool dip_price_model_predict(const DipPriceModel *model, const DipQuality *quality,
                             DipPricePrediction *prediction);

#endif
