// Terms: the kinds of work that explain how long each stage of a frame takes. The time of a stage
// is modelled as the sum of its terms, each the amount of one kind of work times a price (fit.h).
//
// Amounts come from the exact counters of a frame and from its settings. No counter tells what lies
// in the processor's caches, so texels that are read from the full set of mip levels, from textures
// that are not compressed, or by the probes of advanced AF are terms of their own.
#ifndef DIP_APP_REPORT_TERMS_H
#define DIP_APP_REPORT_TERMS_H

#include "app/report/report.h"

enum {
    DIP_COST_MAX_TERMS = 20,                                       // Greatest number for one stage.
    DIP_COST_ALL_TERMS = DIP_COST_STAGE_COUNT * DIP_COST_MAX_TERMS // The same for all stages.
};

// Returns the number of terms of a stage.
int dip_cost_term_count(DipCostStage stage);

// Returns the name of a term: "texel fetched". Static storage.
const char *dip_cost_term_name(DipCostStage stage, int term);

// Computes the amounts of a stage's terms. `counters` are those of a frame that was drawn with
// these settings, or their means over several frames.
void dip_cost_terms(DipCostStage stage, const double counters[DIP_COST_COUNTER_COUNT],
                    const DipQuality *quality, double amounts[DIP_COST_MAX_TERMS]);

// Error terms explain a picture's FLIP by its settings alone. There are terms for antialiasing, for
// the clipping of alpha-clipped surfaces, for anisotropic filtering and for the other settings, and
// products of two terms where one error hides a part of the other. Each term is 0 to 1.
enum { DIP_COST_ERROR_TERMS = 27 };

void dip_cost_error_terms(const DipQuality *quality, double terms[DIP_COST_ERROR_TERMS]);

#endif
