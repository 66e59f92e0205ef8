// Printing advice per segment, and writing it as JSON.
#include "app/report/segments_output.h"

#include "app/files/put.h"

#include <cjson/cJSON.h>

static const DipCostSegmentValue *value_of(const DipCostSegmentList *list, int segment, int index) {
    return &list->segments->values[segment * list->segments->row_count + index];
}

static const DipQuality *quality_of(const DipCostSegmentList *list, int index) {
    return &list->report->rows[list->segments->rows[index]].quality;
}

static int viewpoints_of(const DipCostSegment *segment) {
    return segment->end_viewpoint - segment->first_viewpoint;
}

static bool is_fixed(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice) {
    bool same = true;
    for (int s = 0; s < list->segments->count; s++) {
        same = same && advice->chosen[s] == advice->fixed;
    }
    return same;
}

// --- text ----------------------------------------------------------------------------------------

static int fewest_viewpoints(const DipCostSegmentList *list) {
    int fewest = viewpoints_of(&list->segments->list[0]);
    for (int s = 1; s < list->segments->count; s++) {
        const int viewpoints = viewpoints_of(&list->segments->list[s]);
        fewest = viewpoints < fewest ? viewpoints : fewest;
    }
    return fewest;
}

static void print_heading(const DipCostSegmentList *list, FILE *out) {
    const DipCostBudgetOf of = list->report->options.budget_of;
    const int fewest = fewest_viewpoints(list);
    dip_put_text(out, "\nSettings per segment: path %s in %d segments. ", list->report->paths[0],
                 list->segments->count);
    if (of == DIP_COST_BUDGET_MEAN) {
        dip_put_text(out,
                     "Time is spent where it lowers FLIP most; the mean time of the path is surely "
                     "within the budget.\n");
    } else {
        dip_put_text(out, "The %s time of every segment is surely within the budget.\n",
                     dip_cost_budget_of_names[of]);
    }
    dip_put_text(
        out,
        "The FLIP of a segment comes from its viewpoints only, of which the segment with the "
        "fewest has %d; the gain is the more certain the more --places the report has.\n",
        fewest);
}

static void print_segment(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice, int s,
                          FILE *out) {
    const DipCostSegment *segment = &list->segments->list[s];
    const DipCostSegmentValue *value = value_of(list, s, advice->chosen[s]);
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(quality_of(list, advice->chosen[s]), settings);
    dip_put_text(out, "    %4.0f %% %4.0f %% %11d %7d %8.2f %8.2f %8.5f  %s\n",
                 100.0 * segment->from, 100.0 * segment->end, viewpoints_of(segment),
                 segment->end_frame - segment->first_frame, value->ms, value->bound, value->flip,
                 settings);
}

static void print_gain(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice,
                       FILE *out) {
    const DipCostBudgetOf of = list->report->options.budget_of;
    char settings[DIP_COST_TEXT];
    dip_put_text(out, "\n%g ms: mean FLIP %.5f, ", advice->budget_ms, advice->flip);
    if (advice->fixed >= 0) {
        dip_cost_settings_text(quality_of(list, advice->fixed), settings);
        dip_put_text(out, "%.1f %% below that of %s for the whole path (%.5f)",
                     100.0 * (1.0 - advice->flip / advice->fixed_flip), settings,
                     advice->fixed_flip);
    } else {
        dip_put_text(out, "and no single combination is surely that fast");
    }
    dip_put_text(out, "; %s %.2f ms, bound %.2f ms\n",
                 of == DIP_COST_BUDGET_MEAN ? "mean time" : "slowest segment", advice->ms,
                 advice->bound);
    dip_put_text(out, "    %6s %6s %11s %7s %8s %8s %8s  %s\n", "from", "to", "viewpoints",
                 "frames", "ms", "bound", "FLIP", "settings");
}

static void print_budget(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice,
                         FILE *out) {
    char settings[DIP_COST_TEXT];
    if (advice->chosen[0] < 0) {
        dip_put_text(out, "\n%g ms: no combination is surely that fast\n", advice->budget_ms);
        return;
    }
    if (is_fixed(list, advice)) {
        dip_cost_settings_text(quality_of(list, advice->fixed), settings);
        dip_put_text(out,
                     "\n%g ms: nothing is gained over %s for the whole path (mean FLIP %.5f)\n",
                     advice->budget_ms, settings, advice->flip);
        return;
    }
    print_gain(list, advice, out);
    for (int s = 0; s < list->segments->count; s++) {
        print_segment(list, advice, s, out);
    }
    if (advice->slope > 0.0) {
        dip_put_text(out, "    slope: 1 ms more would lower the mean FLIP by about %.5f\n",
                     advice->slope);
    }
}

void dip_cost_segments_print(const DipCostSegmentList *list, FILE *out) {
    print_heading(list, out);
    for (int i = 0; i < list->count; i++) {
        print_budget(list, &list->advice[i], out);
    }
}

// --- JSON ----------------------------------------------------------------------------------------

// Takes ownership of an item, even if memory runs out.
static void add_to_array(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

static void add_settings(cJSON *to, const DipQuality *quality) {
    char text[256];
    dip_quality_format(quality, text, sizeof text);
    cJSON_AddStringToObject(to, "settings", text);
}

static void add_segments(const DipCostSegmentList *list, cJSON *root) {
    cJSON *array = cJSON_AddArrayToObject(root, "segments");
    for (int s = 0; s < list->segments->count; s++) {
        const DipCostSegment *segment = &list->segments->list[s];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "from", segment->from);
        cJSON_AddNumberToObject(object, "end", segment->end);
        cJSON_AddNumberToObject(object, "viewpoints", viewpoints_of(segment));
        cJSON_AddNumberToObject(object, "frames", segment->end_frame - segment->first_frame);
        add_to_array(array, object);
    }
}

static void add_fixed(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice,
                      cJSON *object) {
    if (advice->fixed >= 0) {
        cJSON *fixed = cJSON_AddObjectToObject(object, "whole_path");
        add_settings(fixed, quality_of(list, advice->fixed));
        cJSON_AddNumberToObject(fixed, "mean_flip", advice->fixed_flip);
    }
}

static void add_chosen(const DipCostSegmentList *list, const DipCostSegmentAdvice *advice,
                       cJSON *object) {
    cJSON_AddNumberToObject(object, "mean_flip", advice->flip);
    cJSON_AddNumberToObject(object, "ms", advice->ms);
    cJSON_AddNumberToObject(object, "bound_ms", advice->bound);
    cJSON_AddNumberToObject(object, "flip_per_ms", advice->slope);
    cJSON *chosen = cJSON_AddArrayToObject(object, "chosen");
    for (int s = 0; s < list->segments->count; s++) {
        const DipCostSegmentValue *value = value_of(list, s, advice->chosen[s]);
        cJSON *item = cJSON_CreateObject();
        add_settings(item, quality_of(list, advice->chosen[s]));
        cJSON_AddNumberToObject(item, "ms", value->ms);
        cJSON_AddNumberToObject(item, "bound_ms", value->bound);
        cJSON_AddNumberToObject(item, "flip", value->flip);
        add_to_array(chosen, item);
    }
}

void dip_cost_segments_add_json(const DipCostSegmentList *list, struct cJSON *root) {
    add_segments(list, root);
    cJSON *array = cJSON_AddArrayToObject(root, "advice_per_segment");
    for (int i = 0; i < list->count; i++) {
        const DipCostSegmentAdvice *advice = &list->advice[i];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "budget_ms", advice->budget_ms);
        add_fixed(list, advice, object);
        if (advice->chosen[0] >= 0) {
            add_chosen(list, advice, object);
        }
        add_to_array(array, object);
    }
}
