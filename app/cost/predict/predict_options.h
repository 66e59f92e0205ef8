// Options of `diptych cost predict`.
#ifndef DIP_APP_COST_PREDICT_PREDICT_OPTIONS_H
#define DIP_APP_COST_PREDICT_PREDICT_OPTIONS_H

#include "app/cost/options.h"

enum { DIP_COST_MOST_TIMED = 200 };

// The whole command line. Texts are borrowed from argv.
typedef struct DipCostPredictArguments {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *report; // A cost.json, or a folder that has one.
    int report_count;
    int timed;        // Combinations to time there, to predict from; 0: from the report alone.
    int checked;      // Further combinations to time there, to compare the predictions with.
    const char *json; // Files to write, or NULL.
    const char *csv;
} DipCostPredictArguments;

extern const DipOptionParts dip_cost_predict_option_parts;

void dip_cost_predict_options_default(void *arguments, int argc, char *const *argv);
bool dip_cost_predict_options_check(const void *arguments, DipError *err);

#endif
