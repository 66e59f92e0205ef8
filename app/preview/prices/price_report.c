// Reading prices from a cost report.
#include "app/preview/prices/prices_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
}

// --- lists ---------------------------------------------------------------------------------------

const DipPriceKnown *dip_price_list_find(const DipPriceList *list, const DipQuality *quality) {
    for (int i = 0; i < list->count; i++) {
        if (dip_quality_equal(&list->items[i].quality, quality)) {
            return &list->items[i];
        }
    }
    return NULL;
}

bool dip_price_list_add(DipPriceList *list, const DipPriceKnown *known) {
    if (list->count == list->room) {
        const int room = list->room ? 2 * list->room : 32;
        DipPriceKnown *items = realloc(list->items, (size_t)room * sizeof *items);
        if (!items) {
            return false;
        }
        list->items = items;
        list->room = room;
    }
    list->items[list->count++] = *known;
    return true;
}

// --- whole times ---------------------------------------------------------------------------------

static DipPriceKnown known_of_row(const DipCostReport *report, int row, const DipQuality *quality) {
    DipPriceKnown known = {.quality = *quality};
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    if (dip_cost_is_timed(report, row)) {
        const DipEstimate ms = report->rows[row].time.mean_ms;
        known.state = DIP_PRICE_MEASURED;
        known.ms = ms.value;
        known.ms_low = ms.low;
        known.ms_high = ms.high;
    }
    known.has_flip = viewpoints > 0;
    if (known.has_flip) {
        known.flip = dip_metrics_of(&sums, 0).flip;
        known.flip_at_floor = dip_cost_at_floor(report, row);
    }
    return known;
}

// Returns the share by which predictions of a report made with --predict miss: those that were
// measured later, or else the rows that were each predicted from the others.
static double miss_of_predictions(const DipCostPredictions *predicted) {
    return predicted->times.rows > 0 ? fmax(predicted->times.p90, predicted->times_left_out.p90)
                                     : predicted->times_left_out.p90;
}

static DipPriceKnown known_of_prediction(const DipCostPrediction *prediction, double miss,
                                         const DipQuality *quality) {
    return (DipPriceKnown){
        .quality = *quality,
        .state = DIP_PRICE_PREDICTED,
        .ms = prediction->ms,
        .ms_low = prediction->ms * (1.0 - miss),
        .ms_high = prediction->ms * (1.0 + miss),
        .has_flip = prediction->flip > 0.0,
        .flip = prediction->flip,
    };
}

// Adds a combination unless its picture is known already.
static bool add_known(DipPriceList *list, const DipPriceKnown *known) {
    return dip_price_list_find(list, &known->quality) || dip_price_list_add(list, known);
}

static bool list_known(DipPriceReport *made, const DipCostReport *report) {
    bool added = true;
    for (int r = 0; added && r < report->row_count; r++) {
        if (report->rows[r].path == 0) {
            const DipQuality normal = dip_price_normal(&made->base, &report->rows[r].quality);
            const DipPriceKnown known = known_of_row(report, r, &normal);
            made->has_errors |= known.has_flip;
            added = add_known(&made->known, &known);
        }
    }
    for (int i = 0; added && i < report->same_count; i++) {
        const DipQuality normal = dip_price_normal(&made->base, &report->same[i].quality);
        const DipPriceKnown known = known_of_row(report, report->same[i].row, &normal);
        added = add_known(&made->known, &known);
    }
    const double miss = miss_of_predictions(&report->predicted);
    for (int i = 0; added && i < report->predicted.count; i++) {
        const DipCostPrediction *prediction = &report->predicted.list[i];
        const DipQuality normal = dip_price_normal(&made->base, &prediction->quality);
        const DipPriceKnown known = known_of_prediction(prediction, miss, &normal);
        added = prediction->row >= 0 || add_known(&made->known, &known);
    }
    return added;
}

// --- tags ----------------------------------------------------------------------------------------

// Finds a row with these settings on a path, or the row that stands for them. Returns -1 if there
// is none.
static int find_row(const DipCostReport *report, int path, const DipQuality *base,
                    const DipQuality *quality) {
    for (int r = 0; r < report->row_count; r++) {
        const DipQuality normal = dip_price_normal(base, &report->rows[r].quality);
        if (report->rows[r].path == path && dip_quality_equal(&normal, quality)) {
            return r;
        }
    }
    for (int i = 0; path == 0 && i < report->same_count; i++) {
        const DipQuality normal = dip_price_normal(base, &report->same[i].quality);
        if (dip_quality_equal(&normal, quality)) {
            return report->same[i].row;
        }
    }
    return -1;
}

// Finds the path on which a price was measured: path 0 if it has both rows, otherwise the first
// path that has them. Returns -1 if there is none.
static int find_path(const DipCostReport *report, const DipQuality *base,
                     const DipPriceQuestion *question) {
    for (int path = 0; path < report->path_count; path++) {
        if (find_row(report, path, base, &question->with) >= 0 &&
            find_row(report, path, base, &question->without) >= 0) {
            return path;
        }
    }
    return -1;
}

// The path of the base's own step is the path of the setting's other steps.
static int find_base_path(const DipCostReport *report, const DipQuality *base, DipSetting setting,
                          const DipQuality *pane) {
    for (int step = 0; step < dip_setting_info(setting)->step_count; step++) {
        const DipPriceQuestion question = dip_price_question(base, setting, step, pane);
        const int path = question.is_base ? -1 : find_path(report, base, &question);
        if (path >= 0) {
            return path;
        }
    }
    return -1;
}

static void fill_base(DipPrice *price, const DipCostReport *report, int row) {
    const DipPriceKnown known = known_of_row(report, row, &report->rows[row].quality);
    price->state = known.state == DIP_PRICE_MEASURED ? DIP_PRICE_BASE : DIP_PRICE_UNKNOWN;
    price->ms = known.ms;
    price->ms_low = known.ms_low;
    price->ms_high = known.ms_high;
    price->has_flip = known.has_flip;
    price->flip = known.flip;
    price->flip_at_floor = known.flip_at_floor;
}

// The time is the difference of the rows' times, that is of their ratios to the path's baseline,
// times the baseline's time. The interval is that of the rows' own ratio, because both rows share
// the level of the machine.
static void fill_step(DipPrice *price, const DipCostReport *report, int row, int without) {
    const DipEstimate change = dip_cost_flip_change(report, row, without);
    if (dip_cost_is_timed(report, row) && dip_cost_is_timed(report, without)) {
        const DipEstimate ratio = dip_cost_ratio(report, row, without);
        const double base_ms = dip_cost_ms(report, without);
        price->state = DIP_PRICE_MEASURED;
        price->ms = dip_cost_ms(report, row) - base_ms;
        if (row != without) { // The same row stands for both: they differ by nothing.
            price->ms_low = price->ms - (ratio.value - ratio.low) * base_ms;
            price->ms_high = price->ms + (ratio.high - ratio.value) * base_ms;
        }
        price->without_ms = base_ms;
    }
    price->has_flip = !isnan(change.value);
    if (price->has_flip) {
        price->flip = change.value;
        price->flip_at_floor = dip_cost_at_floor(report, row);
    }
}

const DipPrice *dip_price_report_find(const DipPriceReport *report, DipSetting setting,
                                      const DipPriceQuestion *question) {
    for (int i = 0; i < report->tag_count; i++) {
        const DipPriceTag *tag = &report->tags[i];
        if (dip_quality_equal(&tag->with, &question->with) &&
            dip_quality_equal(&tag->without, &question->without) &&
            (!question->is_base || tag->setting == setting)) {
            return &tag->price;
        }
    }
    return NULL;
}

// Returns room for another tag, or NULL if memory runs out.
static DipPriceTag *new_tag(DipPriceReport *made) {
    if (made->tag_count == made->tag_room) {
        const int room = made->tag_room ? 2 * made->tag_room : 64;
        DipPriceTag *tags = realloc(made->tags, (size_t)room * sizeof *tags);
        if (!tags) {
            return NULL;
        }
        made->tags = tags;
        made->tag_room = room;
    }
    return &made->tags[made->tag_count++];
}

static bool add_tag(DipPriceReport *made, const DipCostReport *report, DipSetting setting, int step,
                    const DipQuality *pane, DipError *err) {
    const DipPriceQuestion question = dip_price_question(&made->base, setting, step, pane);
    if (dip_price_report_find(made, setting, &question)) {
        return true;
    }
    const int path = question.is_base ? find_base_path(report, &made->base, setting, pane)
                                      : find_path(report, &made->base, &question);
    const int with = path >= 0 ? find_row(report, path, &made->base, &question.with) : -1;
    if (with < 0) {
        return true;
    }
    DipPriceTag *tag = new_tag(made);
    if (!tag) {
        return out_of_memory(err);
    }
    *tag = (DipPriceTag){.with = question.with, .without = question.without, .setting = setting};
    snprintf(tag->price.path, sizeof tag->price.path, "%s", report->paths[path]);
    tag->price.doubtful = made->doubtful;
    if (question.is_base) {
        fill_base(&tag->price, report, with);
        return true;
    }
    const int without = find_row(report, path, &made->base, &question.without);
    fill_step(&tag->price, report, with, without);
    return true;
}

// Makes the tags of the steps of a combination, each beside the company that it has there.
static bool add_tags_of(DipPriceReport *made, const DipCostReport *report,
                        const DipQuality *quality, DipError *err) {
    bool done = true;
    for (int s = 0; done && s < DIP_SETTING_COUNT; s++) {
        done = add_tag(made, report, (DipSetting)s, quality->step[s], quality, err);
    }
    return done;
}

// Makes the tags of every step beside every company that the report has.
static bool make_tags(DipPriceReport *made, const DipCostReport *report, DipError *err) {
    bool done = true;
    for (int r = 0; done && r < report->row_count; r++) {
        done = add_tags_of(made, report, &report->rows[r].quality, err);
    }
    for (int i = 0; done && i < report->same_count; i++) {
        done = add_tags_of(made, report, &report->same[i].quality, err);
    }
    return done;
}

// --- the whole -----------------------------------------------------------------------------------

bool dip_price_report_make(DipPriceReport *made, const DipCostReport *report, DipError *err) {
    *made = (DipPriceReport){
        .threads = report->threads,
        .width = report->width,
        .height = report->height,
        .has_times = report->rounds > 0,
        .pixels_per_degree = report->options.pixels_per_degree,
        .doubtful = report->rounds > 0 && report->verdict == DIP_COST_RED,
    };
    made->base = dip_price_normal(&report->options.baseline, &report->options.baseline);
    snprintf(made->scene, sizeof made->scene, "%s", report->scene);
    snprintf(made->processor, sizeof made->processor, "%s", report->processor);
    snprintf(made->isa, sizeof made->isa, "%s", report->isa);
    snprintf(made->path, sizeof made->path, "%s", report->paths[0]);
    const bool done = (list_known(made, report) || out_of_memory(err)) &&
                      make_tags(made, report, err) &&
                      dip_price_model_create(report, &made->base, &made->model, err);
    if (!done) {
        dip_price_report_free(made);
    }
    return done;
}

void dip_price_report_free(DipPriceReport *report) {
    free(report->known.items);
    free(report->tags);
    dip_price_model_destroy(&report->model);
    *report = (DipPriceReport){0};
}
