// Finds the two combinations whose difference is a price, and lists the combinations that must be
// timed. The company of a setting is the other settings that it is priced with (view.h).
#include "app/report/prices/view.h"

#include "app/report/combinations.h"

#include <stdio.h>
#include <stdlib.h>

// Returns whether adaptive AA with these settings divides the samples into two groups or more.
static bool has_groups(const DipQuality *quality) {
    DipQuality on = *quality;
    on.step[DIP_SETTING_AAA] = DIP_AAA_ON;
    return dip_quality_effective(&on).step[DIP_SETTING_AAA] != 0;
}

DipQuality dip_price_normal(const DipQuality *base, const DipQuality *quality) {
    DipQuality normal = dip_quality_effective(quality);
    normal.step[DIP_SETTING_MIPDEBUG] = base->step[DIP_SETTING_MIPDEBUG];
    return normal;
}

// --- company -------------------------------------------------------------------------------------

static void need(DipPriceQuestion *question, const char *what) {
    snprintf(question->needs, sizeof question->needs, "%s", what);
}

// Gives both combinations the pane's step of the setting `company`. If the pane has this setting
// off, gives them the step `otherwise`, and notes that the pane lacks `name`.
static void keep_company(DipPriceQuestion *question, DipSetting company, uint8_t otherwise,
                         const DipQuality *quality, const char *name) {
    uint8_t step = quality->step[company];
    if (step == 0) {
        step = otherwise;
        need(question, name);
    }
    question->with.step[company] = question->without.step[company] = step;
}

// Gives both combinations the pane's scale if it is below 1. Otherwise gives them a scale that is
// below 1.
static void keep_scale(DipPriceQuestion *question, const DipQuality *quality) {
    uint8_t step = quality->step[DIP_SETTING_SCALE];
    if (!dip_quality_upscales(quality)) {
        step = DIP_COST_COMPANY_SCALE;
        need(question, "a scale below 1");
    }
    question->with.step[DIP_SETTING_SCALE] = question->without.step[DIP_SETTING_SCALE] = step;
}

// Sets the question to the difference between a step and another step of the same setting.
static void ask_alone(DipPriceQuestion *question, DipSetting setting, int step, uint8_t other) {
    question->with.step[setting] = (uint8_t)step;
    question->without.step[setting] = other;
    question->is_base = step == other;
}

// Gives both combinations AA without adaptive AA: the pane's AA if it can be divided into groups of
// this size, otherwise the fewest samples that can be divided so. If the pane has no AA and the
// group size is the first one, gives them DIP_COST_COMPANY_AA.
static void keep_samples(DipPriceQuestion *question, int asd, const DipQuality *quality) {
    const DipSettingInfo *aa = dip_setting_info(DIP_SETTING_AA);
    DipQuality try = question->without;
    try.step[DIP_SETTING_ASD] = (uint8_t)asd;
    try.step[DIP_SETTING_AA] = quality->step[DIP_SETTING_AA];
    for (int step = 1; !has_groups(&try) && step < aa->step_count; step++) {
        try.step[DIP_SETTING_AA] = (uint8_t)step;
        snprintf(question->needs, sizeof question->needs, "AA %.8sx", aa->steps[step]);
    }
    if (quality->step[DIP_SETTING_AA] == 0 && asd == 0) {
        try.step[DIP_SETTING_AA] = DIP_COST_COMPANY_AA;
        need(question, "AA");
    }
    question->without.step[DIP_SETTING_AA] = try.step[DIP_SETTING_AA];
    question->without.step[DIP_SETTING_AAA] = 0;
    question->without.step[DIP_SETTING_ASD] = 0;
    question->with = question->without;
}

static void ask_adaptive(DipPriceQuestion *question, int step, const DipQuality *quality) {
    const bool divides = step != DIP_AAA_COVERAGE;
    const int asd = divides && has_groups(quality) ? quality->step[DIP_SETTING_ASD] : 0;
    keep_samples(question, asd, quality);
    question->is_base = step == 0;
    if (!question->is_base) {
        question->with.step[DIP_SETTING_AAA] = (uint8_t)step;
        question->with.step[DIP_SETTING_ASD] = (uint8_t)asd;
        if (divides && quality->step[DIP_SETTING_AA] != 0 && !has_groups(quality)) {
            need(question, "smaller groups");
        }
    }
}

static void ask_group_size(DipPriceQuestion *question, int step, const DipQuality *quality) {
    keep_samples(question, step, quality);
    const bool all = quality->step[DIP_SETTING_AAA] == DIP_AAA_ALL;
    question->with.step[DIP_SETTING_AAA] = all ? DIP_AAA_ALL : DIP_AAA_ON;
    question->with.step[DIP_SETTING_ASD] = (uint8_t)step;
    if (!question->needs[0] && quality->step[DIP_SETTING_AAA] < DIP_AAA_ON) {
        need(question, "adaptive AA");
    }
}

DipPriceQuestion dip_price_question(const DipQuality *base, DipSetting setting, int step,
                                    const DipQuality *quality) {
    DipPriceQuestion question = {.with = *base, .without = *base};
    switch (setting) {
    case DIP_SETTING_AAA:
        ask_adaptive(&question, step, quality);
        break;
    case DIP_SETTING_ASD:
        ask_group_size(&question, step, quality);
        break;
    case DIP_SETTING_TAA:
        keep_company(&question, DIP_SETTING_AA, DIP_COST_COMPANY_AA, quality, "AA");
        ask_alone(&question, setting, step, 0);
        if (step == DIP_TAA_HISTORY) {
            question.needs[0] = '\0'; // Of the steps of temporal AA, only taa=alternate needs AA.
        }
        break;
    case DIP_SETTING_AAF:
        keep_company(&question, DIP_SETTING_AF, DIP_COST_COMPANY_AF, quality, "AF");
        ask_alone(&question, setting, step, 0);
        break;
    case DIP_SETTING_UPSCALE:
        keep_scale(&question, quality);
        ask_alone(&question, setting, step, 0);
        break;
    default:
        ask_alone(&question, setting, step, base->step[setting]);
        break;
    }
    if (question.is_base) {
        question.needs[0] = '\0';
    } else if (dip_price_filters(setting)) {
        const DipQuality pane = dip_price_normal(base, quality);
        question.with = dip_cost_take_settings(&question.with, &pane, DIP_PRICE_ANTIALIASING);
        question.without = dip_cost_take_settings(&question.without, &pane, DIP_PRICE_ANTIALIASING);
    }
    return question;
}

// --- the combinations to time --------------------------------------------------------------------

typedef struct Wanted {
    const DipQuality *base;
    DipQuality *list;
    int room;
    int count;
} Wanted;

static void want(Wanted *wanted, const DipQuality *quality) {
    const DipQuality normal = dip_price_normal(wanted->base, quality);
    for (int i = 0; i < wanted->count; i++) {
        if (dip_quality_equal(&wanted->list[i], &normal)) {
            return;
        }
    }
    if (wanted->count < wanted->room && dip_quality_check(&normal, NULL)) {
        wanted->list[wanted->count++] = normal;
    }
}

// Adds the combinations for the prices of a setting's steps that lie `distance` steps from the
// pane's own step.
static void want_steps_of(Wanted *wanted, const DipQuality *pane, DipSetting setting,
                          int distance) {
    for (int step = 0; step < dip_setting_info(setting)->step_count; step++) {
        if (abs(step - pane->step[setting]) == distance) {
            const DipPriceQuestion question = dip_price_question(wanted->base, setting, step, pane);
            want(wanted, &question.without);
            want(wanted, &question.with);
        }
    }
}

// Adds the combinations for the prices of AF and advanced AF with the base's antialiasing, which
// stand for the prices with other antialiasing until these are measured.
static void want_filtering_alone(Wanted *wanted, const DipQuality *pane) {
    const DipQuality plain = dip_cost_take_settings(pane, wanted->base, DIP_PRICE_ANTIALIASING);
    for (int distance = 0; distance < DIP_MAX_STEPS; distance++) {
        want_steps_of(wanted, &plain, DIP_SETTING_AF, distance);
        want_steps_of(wanted, &plain, DIP_SETTING_AAF, distance);
    }
}

// Adds the combinations that differ from the pane's by one step of one setting.
static void want_neighbours(Wanted *wanted, const DipQuality *pane) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        for (int way = -1; s != DIP_SETTING_MIPDEBUG && way <= 1; way += 2) {
            const int step = pane->step[s] + way;
            if (step >= 0 && step < dip_setting_info((DipSetting)s)->step_count) {
                DipQuality neighbour = *pane;
                neighbour.step[s] = (uint8_t)step;
                want(wanted, &neighbour);
            }
        }
    }
}

int dip_price_list_wanted(const DipQuality *base, const DipQuality *current,
                          const DipQuality *requested, DipQuality *list, int room) {
    Wanted wanted = {.base = base, .list = list, .room = room};
    want(&wanted, base);
    want(&wanted, requested);
    want(&wanted, current);
    for (int distance = 0; distance < DIP_MAX_STEPS; distance++) {
        for (int s = 0; s < DIP_SETTING_COUNT; s++) {
            if (s != DIP_SETTING_MIPDEBUG) {
                want_steps_of(&wanted, requested, (DipSetting)s, distance);
            }
        }
    }
    want_neighbours(&wanted, requested);
    want_filtering_alone(&wanted, requested);
    return wanted.count;
}
