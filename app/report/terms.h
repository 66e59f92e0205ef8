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
    DIP_COST_MAX_TERMS = 20,                                       // Of one stage.
    DIP_COST_ALL_TERMS = DIP_COST_STAGE_COUNT * DIP_COST_MAX_TERMS // Of all stages, at most.
};

// Returns the number of terms of a stage.
int dip_cost_term_count(DipCostStage stage);

// Returns the name of a term: "texel fetched". Static storage.
const char *dip_cost_term_name(DipCostStage stage, int term);

// Computes the amounts of a stage's terms from the counters of a frame (means over frames are
// amounts too) that is drawn with these settings.
void dip_cost_terms(DipCostStage stage, const double counters[DIP_COST_COUNTER_COUNT],
                    const DipQuality *quality, double amounts[DIP_COST_MAX_TERMS]);

// Terms that explain a picture's FLIP by its settings alone: of antialiasing, of the clipping of
// alpha-clipped surfaces, of anisotropic filtering and of the other settings, and products of two
// of them where one hides a part of the other. Each is 0 to 1.
enum { DIP_COST_ERROR_TERMS = 27 };

void dip_cost_error_terms(const DipQuality *quality, double terms[DIP_COST_ERROR_TERMS]);

#endif
