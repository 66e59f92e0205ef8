// Answering for prices: from the report's tags, or from the differences of whole times.
#include "app/preview/prices.h"

#include "app/cost/formats.h"
#include "app/preview/prices_private.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The widest interval that holds 0 and stands for a price of 0, as a share of the time without the
// step. A wider interval comes from a busy machine or from a prediction, and tells nothing.
static const double widest_zero = 0.2;

struct DipPrices {
    bool has_report;
    DipPriceReport report;
    bool prefers_rough;
    DipPriceList rough;
    DipPriceConditions conditions;
    char progress[DIP_PRICE_PROGRESS];
};

DipPrices *dip_prices_create(DipError *err) {
    DipPrices *prices = calloc(1, sizeof *prices);
    if (!prices) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
    }
    return prices;
}

void dip_prices_destroy(DipPrices **prices) {
    if (*prices) {
        dip_price_report_free(&(*prices)->report);
        free((*prices)->rough.items);
        free(*prices);
        *prices = NULL;
    }
}

void dip_prices_set_conditions(DipPrices *prices, const DipPriceConditions *conditions) {
    prices->conditions = *conditions;
}

bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err) {
    dip_price_report_free(&prices->report);
    prices->has_report = dip_price_report_make(&prices->report, report, err);
    return prices->has_report;
}

bool dip_prices_load_report(DipPrices *prices, const char *file, DipError *err) {
    DipCostReport report;
    if (!dip_cost_read_json(&report, file, err)) {
        return false;
    }
    const bool taken = dip_prices_set_report(prices, &report, err);
    dip_cost_report_free(&report);
    return taken;
}

bool dip_prices_has_report(const DipPrices *prices) {
    return prices->has_report;
}

void dip_prices_prefer_rough(DipPrices *prices, bool prefer) {
    prices->prefers_rough = prefer;
}

bool dip_prices_are_rough(const DipPrices *prices) {
    return !prices->has_report || prices->prefers_rough;
}

DipQuality dip_prices_base(const DipPrices *prices) {
    return prices->has_report ? prices->report.base : dip_quality_default();
}

// --- rough prices --------------------------------------------------------------------------------

bool dip_prices_add_rough(DipPrices *prices, const DipQuality *quality, double ms, double ms_low,
                          double ms_high, double flip) {
    const DipQuality base = dip_prices_base(prices);
    DipPriceKnown known = {
        .quality = dip_price_normal(&base, quality),
        .state = DIP_PRICE_ROUGH,
        .ms = ms,
        .ms_low = ms_low,
        .ms_high = ms_high,
        .has_flip = flip >= 0.0,
        .flip = flip,
    };
    const DipPriceKnown *before = dip_price_list_find(&prices->rough, &known.quality);
    if (!before) {
        return dip_price_list_add(&prices->rough, &known);
    }
    if (!known.has_flip) {
        known.has_flip = before->has_flip;
        known.flip = before->flip;
    }
    prices->rough.items[before - prices->rough.items] = known;
    return true;
}

void dip_prices_add_rough_flip(DipPrices *prices, const DipQuality *quality, double flip) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    const DipPriceKnown *known = dip_price_list_find(&prices->rough, &normal);
    if (known) {
        DipPriceKnown *item = &prices->rough.items[known - prices->rough.items];
        item->has_flip = true;
        item->flip = flip;
    }
}

void dip_prices_forget_rough_flip(DipPrices *prices) {
    for (int i = 0; i < prices->rough.count; i++) {
        prices->rough.items[i].has_flip = false;
    }
}

int dip_prices_list_without_flip(const DipPrices *prices, DipQuality *list, int room) {
    int count = 0;
    for (int i = 0; i < prices->rough.count && count < room; i++) {
        if (!prices->rough.items[i].has_flip) {
            list[count++] = prices->rough.items[i].quality;
        }
    }
    return count;
}

bool dip_prices_has_rough(const DipPrices *prices, const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    return dip_price_list_find(&prices->rough, &normal) != NULL;
}

void dip_prices_forget_rough(DipPrices *prices) {
    prices->rough.count = 0;
}

bool dip_prices_set_progress(DipPrices *prices, const char *text) {
    char before[DIP_PRICE_PROGRESS];
    memcpy(before, prices->progress, sizeof before);
    snprintf(prices->progress, sizeof prices->progress, "%s", text);
    return strcmp(before, prices->progress) != 0;
}

const char *dip_prices_progress(const DipPrices *prices) {
    return prices->progress;
}

// --- steps ---------------------------------------------------------------------------------------

static const DipPriceList *list_of(const DipPrices *prices) {
    return dip_prices_are_rough(prices) ? &prices->rough : &prices->report.known;
}

// Makes the price of the base's own step from its whole time.
static DipPrice whole_price(const DipPriceKnown *known) {
    return (DipPrice){
        .state = known->state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : DIP_PRICE_BASE,
        .ms = known->ms,
        .ms_low = known->ms_low,
        .ms_high = known->ms_high,
        .has_flip = known->has_flip,
        .flip = known->flip,
        .flip_at_floor = known->flip_at_floor,
    };
}

// Makes a price of two whole times, whose errors are independent.
static DipPrice difference(const DipPriceKnown *with, const DipPriceKnown *without) {
    DipPrice price = {.has_flip = with->has_flip && without->has_flip};
    if (with->state != DIP_PRICE_UNKNOWN && without->state != DIP_PRICE_UNKNOWN) {
        price.state = with->state > without->state ? with->state : without->state;
        price.ms = with->ms - without->ms;
        price.ms_low = price.ms - hypot(with->ms - with->ms_low, without->ms_high - without->ms);
        price.ms_high = price.ms + hypot(with->ms_high - with->ms, without->ms - without->ms_low);
        price.ms_is_zero = price.ms_low <= 0.0 && price.ms_high >= 0.0 &&
                           price.ms_high - price.ms_low <= widest_zero * without->ms;
    }
    if (price.has_flip) {
        price.flip = with->flip - without->flip;
        price.flip_at_floor = with->flip_at_floor;
    }
    return price;
}

// Answers from whole times: rough prices, and those that a report predicted.
static DipPrice price_of_list(const DipPrices *prices, const DipPriceQuestion *question) {
    const DipPriceKnown *with = dip_price_list_find(list_of(prices), &question->with);
    const DipPriceKnown *without = dip_price_list_find(list_of(prices), &question->without);
    if (!with || !without) {
        return (DipPrice){.state = DIP_PRICE_UNKNOWN};
    }
    DipPrice price = question->is_base ? whole_price(with) : difference(with, without);
    if (!dip_prices_are_rough(prices)) {
        price.doubtful = prices->report.doubtful;
        snprintf(price.path, sizeof price.path, "%s", prices->report.path);
    }
    return price;
}

static DipPrice answer(const DipPrices *prices, DipSetting setting,
                       const DipPriceQuestion *question) {
    const DipPrice *tag = dip_prices_are_rough(prices)
                              ? NULL
                              : dip_price_report_find(&prices->report, setting, question);
    return tag ? *tag : price_of_list(prices, question);
}

DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipPriceQuestion question = dip_price_question(&base, setting, step, quality);
    DipPrice price = answer(prices, setting, &question);
    price.needs_company = question.needs[0] != '\0';
    snprintf(price.needs, sizeof price.needs, "%s", question.needs);
    return price;
}

// --- sums ----------------------------------------------------------------------------------------

// What is added to a whole time: the prices of some settings.
typedef struct Parts {
    DipPrice prices[DIP_SETTING_COUNT];
    bool is_part[DIP_SETTING_COUNT];
} Parts;

static Parts list_parts(const DipPrices *prices, const DipQuality *base, const DipQuality *normal) {
    Parts parts = {.is_part = {false}};
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (normal->step[s] != base->step[s] && s != DIP_SETTING_ASD) {
            parts.is_part[s] = true;
            parts.prices[s] = dip_prices_step(prices, (DipSetting)s, normal->step[s], normal);
        }
    }
    return parts;
}

// Adds the parts that `from` lacks to the whole time of `from`.
static DipPriceKnown add_parts(const DipPriceKnown *from, const Parts *parts,
                               const DipQuality *base) {
    DipPriceKnown sum = *from;
    double below = sum.ms - sum.ms_low, above = sum.ms_high - sum.ms;
    sum.state = sum.state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : DIP_PRICE_ROUGH;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipPrice *part = &parts->prices[s];
        if (!parts->is_part[s] || from->quality.step[s] != base->step[s]) {
            continue;
        }
        sum.state = part->state == DIP_PRICE_UNKNOWN ? DIP_PRICE_UNKNOWN : sum.state;
        sum.ms += part->ms;
        below = hypot(below, part->ms - part->ms_low);
        above = hypot(above, part->ms_high - part->ms);
        sum.has_flip = sum.has_flip && part->has_flip;
        sum.flip += part->flip;
    }
    sum.flip = fmax(sum.flip, 0.0);
    sum.ms_low = sum.ms - below;
    sum.ms_high = sum.ms + above;
    return sum;
}

// Returns the combination with the settings that path 0 does not have as in the base: those whose
// price was measured on another path.
static DipQuality without_other_paths(const DipPrices *prices, const DipQuality *base,
                                      const DipQuality *normal, const Parts *parts) {
    DipQuality rest = *normal;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (parts->is_part[s] && strcmp(parts->prices[s].path, prices->report.path) != 0) {
            rest.step[s] = base->step[s];
        }
    }
    return dip_price_normal(base, &rest);
}

static bool predict(const DipPrices *prices, const DipQuality *normal, DipPriceKnown *known) {
    DipPricePrediction prediction;
    if (dip_prices_are_rough(prices) || !prices->report.model ||
        !dip_price_model_predict(prices->report.model, normal, &prediction)) {
        return false;
    }
    *known = (DipPriceKnown){
        .quality = *normal,
        .state = DIP_PRICE_PREDICTED,
        .ms = prediction.ms,
        .ms_low = prediction.ms * (1.0 - prediction.miss),
        .ms_high = prediction.ms * (1.0 + prediction.miss),
        .has_flip = prediction.has_flip,
        .flip = prediction.flip,
    };
    return true;
}

// Finds the whole time of a combination: as measured, as predicted, or as the sum of its parts.
static DipPriceKnown whole_time(const DipPrices *prices, const DipQuality *base,
                                const DipQuality *normal, const Parts *parts) {
    const DipPriceKnown *known = dip_price_list_find(list_of(prices), normal);
    const DipPriceKnown nothing = {.quality = *base};
    DipPriceKnown predicted;
    if (known && known->state != DIP_PRICE_UNKNOWN) {
        return *known;
    }
    if (predict(prices, normal, &predicted)) {
        return predicted;
    }
    if (!known && !dip_prices_are_rough(prices)) {
        const DipQuality rest = without_other_paths(prices, base, normal, parts);
        known = dip_price_list_find(list_of(prices), &rest);
    }
    if (!known) {
        known = dip_price_list_find(list_of(prices), base);
    }
    return add_parts(known ? known : &nothing, parts, base);
}

DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality) {
    const DipQuality base = dip_prices_base(prices);
    const DipQuality normal = dip_price_normal(&base, quality);
    const DipPriceKnown *alone = dip_price_list_find(list_of(prices), &base);
    const Parts parts = list_parts(prices, &base, &normal);
    const DipPriceKnown whole = whole_time(prices, &base, &normal, &parts);
    DipPriceSum sum = {
        .state = whole.state,
        .ms_low = whole.ms_low,
        .ms_high = whole.ms_high,
        .has_flip = whole.has_flip,
        .flip = whole.flip,
        .base_ms = alone ? alone->ms : 0.0,
        .doubtful = !dip_prices_are_rough(prices) && prices->report.doubtful,
    };
    double known_ms = sum.base_ms;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        sum.parts_ms[s] = parts.is_part[s] ? parts.prices[s].ms : 0.0;
        known_ms += sum.parts_ms[s];
    }
    sum.together_ms = whole.ms - known_ms;
    sum.ms = known_ms + sum.together_ms; // Rounded as a reader who adds the parts rounds it.
    return sum;
}

// --- the source ----------------------------------------------------------------------------------

typedef struct Text {
    char *at;
    size_t size_bytes;
} Text;

__attribute__((format(printf, 2, 3))) static void say(Text *text, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text->at, text->size_bytes, format, arguments);
    va_end(arguments);
    const size_t left = text->size_bytes > 0 ? text->size_bytes - 1 : 0;
    const size_t used = length > 0 && (size_t)length < left ? (size_t)length : left;
    text->at += used;
    text->size_bytes -= used;
}

static bool differs(const char *now, const char *then) {
    return now && strcmp(now, then) != 0;
}

// Says what differs between the report and the panes. Returns whether anything does.
static bool say_differences(const DipPrices *prices, int width, int height, Text *text) {
    const DipPriceReport *report = &prices->report;
    const DipPriceConditions *now = &prices->conditions;
    bool stale = false;
    if (differs(now->scene, report->scene)) {
        say(text, " The panes show %s.", now->scene);
        stale = true;
    }
    if (width != report->width || height != report->height) {
        say(text, " The panes are %dx%d.", width, height);
        stale = true;
    }
    if (now->threads != 0 && now->threads != report->threads) {
        say(text, " The panes have %d thread%s.", now->threads, now->threads == 1 ? "" : "s");
        stale = true;
    }
    if (differs(now->processor, report->processor)) {
        say(text, " The report is from another machine.");
        stale = true;
    } else if (differs(now->isa, report->isa)) {
        say(text, " The report is for %s, the panes use %s.", report->isa, now->isa);
        stale = true;
    }
    return stale;
}

bool dip_prices_are_of_other_scene(const DipPrices *prices) {
    return prices->has_report && differs(prices->conditions.scene, prices->report.scene);
}

bool dip_prices_source(const DipPrices *prices, int width, int height, char *out,
                       size_t size_bytes) {
    const DipPriceReport *report = &prices->report;
    Text text = {out, size_bytes};
    if (dip_prices_are_rough(prices)) {
        say(&text, "%s",
            prices->rough.count > 0
                ? "Prices: measured here, in this picture, a few frames each (rough)."
                : "Prices: not measured yet. They are measured while the camera rests.");
        return false;
    }
    say(&text, "Prices: report of %.80s, path %s, %dx%d, %d thread%s.",
        differs(prices->conditions.scene, report->scene) ? report->scene : "this scene",
        report->path, report->width, report->height, report->threads,
        report->threads == 1 ? "" : "s");
    const bool stale = say_differences(prices, width, height, &text);
    if (report->doubtful) {
        say(&text, " The machine was too busy, so the times are wrong.");
    }
    if (!report->has_times) {
        say(&text, " The report has no times.");
    }
    if (!report->has_errors) {
        say(&text, " The report has no errors.");
    }
    return stale;
}
