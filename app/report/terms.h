// Terms explain how long each stage of a frame takes. A term is one kind of work. The time of a
// stage is modelled as a sum over its terms: of the amount of this work times a price (fit.h).
//
// Amounts come from the exact counters of a frame and from its settings. No counter tells which
// reads miss the processor's caches. Reads that miss them more often than others therefore have
// terms of their own: those of all mip levels (miplod=high-quality), those of uncompressed
// textures, and those of advanced AF's probes.
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
