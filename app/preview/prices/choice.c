// Chooses settings for the preview (choice.h) by a report or by live prices, and puts the advice
// into words.
#include "app/preview/prices/choice.h"

#include "app/preview/prices/price_text.h"
#include "app/report/words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The share of the possible gain (choice.h) that each preset before DIP_PRESET_BEST must reach, in
// the order of DipPreset.
static const double shares[DIP_MEASURED_PRESETS - 1] = {0.5, 0.8, 0.95};

static void take_candidates(DipPreviewChoice *choice, const DipPrices *prices) {
    const DipPriceView *view = prices ? dip_prices_view(prices) : NULL;
    const DipCostReport *report = view ? dip_price_view_report(view) : NULL;
    free(choice->own_list);
    choice->own_list = NULL;
    choice->live = !prices || dip_prices_are_rough(prices);
    choice->of_like = report && (choice->live || dip_cost_is_view(report));
    choice->candidates = (DipCandidates){0};
    choice->known = DIP_PRICES_NO_TIMES;
    if (choice->of_like) {
        choice->known = dip_price_candidates(view, &choice->like, &choice->candidates);
        choice->own_list = choice->candidates.list;
    } else if (report && report->choice.candidates.count > 0) {
        choice->candidates = report->choice.candidates;
        choice->known = DIP_PRICES_KNOWN;
    }
}

// Lists the Pareto front of the candidates. If there is no memory for the front, the advice is
// still computed, and all presets are the advised settings.
static void list_front(DipPreviewChoice *choice) {
    const int count = choice->candidates.count;
    free(choice->front);
    choice->front = count > 0 ? calloc((size_t)count, sizeof *choice->front) : NULL;
    choice->front_count =
        choice->front ? dip_front(&choice->candidates, DIP_CLEARLY_BETTER, choice->front) : 0;
}

static void find_base(DipPreviewChoice *choice, const DipQuality *base) {
    choice->base = -1;
    for (int i = 0; i < choice->candidates.count; ++i) {
        if (dip_quality_equal(&choice->candidates.list[i].quality, base)) {
            choice->base = i;
        }
    }
}

// Finds the settings of the measured presets. These are at least as fast as the advised settings,
// so they keep within the budget as well.
static void make_presets(DipPreviewChoice *choice) {
    const DipCandidate *advised = dip_preview_advised(choice);
    const DipCandidate *fastest =
        choice->front_count > 0 ? &choice->candidates.list[choice->front[0]] : NULL;
    for (int p = 0; p < DIP_MEASURED_PRESETS; ++p) {
        choice->presets[p] = choice->advice.chosen;
        if (advised && fastest && p < DIP_MEASURED_PRESETS - 1) {
            const double loss = fastest->loss - shares[p] * (fastest->loss - advised->loss);
            const int found = dip_next_better(&choice->candidates, nextafter(loss, INFINITY), 0.0);
            choice->presets[p] = found >= 0 ? found : choice->advice.chosen;
        }
    }
}

void dip_preview_choice_set_budget(DipPreviewChoice *choice, double budget_ms) {
    choice->advice = dip_advise(&choice->candidates, budget_ms);
    make_presets(choice);
}

bool dip_preview_choose(DipPreviewChoice *choice, const DipPrices *prices, const DipQuality *like,
                        double budget_ms) {
    const unsigned changes = prices ? dip_prices_changes(prices) : 0;
    const bool same_list = choice->is_made && choice->price_changes == changes &&
                           (!choice->of_like || dip_quality_equal(&choice->like, like));
    if (same_list && fabs(choice->advice.budget_ms - budget_ms) < 1e-9) {
        return false;
    }
    if (!same_list) {
        choice->price_changes = changes;
        choice->like = *like;
        take_candidates(choice, prices);
        list_front(choice);
        const DipQuality base = prices ? dip_prices_base(prices) : dip_quality_default();
        find_base(choice, &base);
    }
    choice->is_made = true;
    dip_preview_choice_set_budget(choice, budget_ms);
    return true;
}

void dip_preview_choice_free(DipPreviewChoice *choice) {
    free(choice->front);
    free(choice->own_list);
    *choice = (DipPreviewChoice){0};
}

const DipCandidate *dip_preview_advised(const DipPreviewChoice *choice) {
    const bool advises = choice && choice->is_made && choice->advice.chosen >= 0;
    return advises ? &choice->candidates.list[choice->advice.chosen] : NULL;
}

void dip_preview_choice_why(const DipPreviewChoice *choice, const char *progress, char *text,
                            size_t size_bytes) {
    char ms[DIP_NUMBER_BYTES];
    if (!choice || !choice->is_made || (choice->live && choice->known == DIP_PRICES_NO_TIMES)) {
        snprintf(text, size_bytes, "Times are measured while the view rests. %s", progress);
    } else if (choice->known == DIP_PRICES_NO_TIMES) {
        snprintf(text, size_bytes, "The report has no combinations with times and errors.");
    } else if (choice->known == DIP_PRICES_NO_ERRORS) {
        snprintf(text, size_bytes, "Errors are measured while the view rests. %s", progress);
    } else if (choice->candidates.disturbed) {
        snprintf(text, size_bytes,
                 "The machine was too busy while the %s measured, so nothing is advised.",
                 choice->live ? "times were" : "report was");
    } else {
        dip_budget_ms_text(choice->advice.budget_ms, ms);
        snprintf(text, size_bytes, "Nothing measured surely fits %s ms.", ms);
    }
}

void dip_preview_choice_describe(const DipPreviewChoice *choice, char *text, size_t size_bytes) {
    const DipCandidate *advised = dip_preview_advised(choice);
    char ms[DIP_NUMBER_BYTES], fits[DIP_NUMBER_BYTES], flip[DIP_STEP_NAME_BYTES], base[96] = "";
    char time[DIP_STEP_NAME_BYTES];
    if (!advised) {
        dip_preview_choice_why(choice, "", text, size_bytes);
        return;
    }
    const double budget_ms = choice->advice.budget_ms;
    dip_budget_ms_text(budget_ms, ms);
    dip_fits_text(choice->advice.fits, fits);
    if (choice->base >= 0) {
        const DipCandidate *from = &choice->candidates.list[choice->base];
        dip_flip_text(from->flip, false, flip);
        dip_ms_text(from->time.value, DIP_PRICE_TRUST_KNOWN, budget_ms, time);
        snprintf(base, sizeof base, "; baseline %s ms, %s", time, flip);
    }
    dip_flip_text(advised->flip, false, flip);
    dip_ms_text(advised->time.value, DIP_PRICE_TRUST_KNOWN, budget_ms, time);
    snprintf(text, size_bytes, "Within %s ms: %s%s ms %s, FLIP %s, fits with %s%s", ms,
             choice->live ? DIP_ROUGH_MARK : "", time, dip_time_kind_names[choice->candidates.kind],
             flip, fits, base);
}
