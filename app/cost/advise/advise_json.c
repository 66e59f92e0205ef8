// Writing common advice as JSON.
#include "app/cost/advise/advise_output.h"

#include "app/report/front.h"
#include "app/report/format/json_memory.h"
#include "app/files/whole_file.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

// Takes ownership of an item, even if memory runs out.
static void add_to_array(cJSON *array, cJSON *item) {
    if (!cJSON_AddItemToArray(array, item)) {
        cJSON_Delete(item);
    }
}

static void add_settings(cJSON *to, const char *name, const DipQuality *quality) {
    char text[256];
    dip_quality_format(quality, text, sizeof text);
    cJSON_AddStringToObject(to, name, text);
}

static void add_time(cJSON *to, const DipEstimate *time) {
    cJSON_AddNumberToObject(to, "ms", time->value);
    cJSON_AddNumberToObject(to, "ms_low", time->low);
    cJSON_AddNumberToObject(to, "ms_high", time->high);
}

static void add_reports(cJSON *root, const DipCostCommon *common) {
    cJSON *reports = cJSON_AddArrayToObject(root, "reports");
    for (int i = 0; i < common->report_count; i++) {
        const DipCostReport *report = &common->reports[i];
        int rows[DIP_COST_MAX_ROWS];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "name", common->names[i]);
        cJSON_AddStringToObject(object, "scene", report->scene);
        cJSON_AddStringToObject(object, "path", report->paths[0]);
        cJSON_AddNumberToObject(object, "width", report->width);
        cJSON_AddNumberToObject(object, "height", report->height);
        cJSON_AddStringToObject(object, "processor", report->processor);
        cJSON_AddNumberToObject(object, "threads", report->threads);
        cJSON_AddStringToObject(object, "verdict", dip_cost_verdict_names[report->verdict]);
        cJSON_AddNumberToObject(object, "combinations", dip_cost_list_plotted(report, rows));
        add_to_array(reports, object);
    }
}

// Adds what one report says about the chosen settings, and what it would choose alone.
static void add_line(cJSON *list, const DipCostCommon *common, const DipCostCommonAdvice *advice,
                     int index) {
    const DipCostReport *report = &common->reports[index];
    cJSON *line = cJSON_CreateObject();
    if (advice->chosen >= 0) {
        const DipEstimate time = dip_cost_common_time(common, advice->chosen, index);
        add_time(line, &time);
        cJSON_AddNumberToObject(line, "flip", dip_cost_common_flip(common, advice->chosen, index));
    }
    if (advice->alone[index] >= 0) {
        const DipEstimate time = dip_cost_budget_time(report, advice->alone[index]);
        cJSON *alone = cJSON_AddObjectToObject(line, "alone");
        add_settings(alone, "settings", &report->rows[advice->alone[index]].quality);
        add_time(alone, &time);
        cJSON_AddNumberToObject(alone, "flip",
                                dip_cost_row_metrics(report, advice->alone[index], 0).flip);
    }
    const double lost = dip_cost_common_share_lost(common, advice, index);
    if (isfinite(lost)) {
        cJSON_AddNumberToObject(line, "loss", lost);
    }
    add_to_array(list, line);
}

static void add_combination(cJSON *to, const char *name, const DipCostCommon *common,
                            int combination) {
    if (combination >= 0) {
        cJSON *object = cJSON_AddObjectToObject(to, name);
        add_settings(object, "settings", &common->qualities[combination]);
        cJSON_AddNumberToObject(object, "mean_flip",
                                dip_cost_common_mean_flip(common, combination));
    }
}

static void add_advice(cJSON *root, const DipCostCommon *common, const DipCostCommonAdvice *advice,
                       int count) {
    cJSON *array = cJSON_AddArrayToObject(root, "advice");
    for (int i = 0; i < count; i++) {
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "budget_ms", advice[i].budget_ms);
        add_combination(object, "chosen", common, advice[i].chosen);
        cJSON *lines = cJSON_AddArrayToObject(object, "reports");
        for (int r = 0; r < common->report_count; r++) {
            add_line(lines, common, &advice[i], r);
        }
        add_combination(object, "next_better", common, advice[i].next);
        if (advice[i].limit >= 0) {
            cJSON_AddNumberToObject(object, "limited_by_report", advice[i].limit);
        }
        add_combination(object, "undecided", common, advice[i].undecided);
        add_to_array(array, object);
    }
}

bool dip_cost_common_write_json(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                int count, const DipCostSegmentList *by_segment, const char *file,
                                DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    const DipCostBudgetOf of = common->reports[0].options.budget_of;
    cJSON_AddStringToObject(root, "budget_of", dip_cost_budget_of_names[of]);
    cJSON_AddNumberToObject(root, "combinations", common->count);
    add_reports(root, common);
    add_advice(root, common, advice, count);
    if (by_segment) {
        dip_cost_segments_add_json(by_segment, root);
    }
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    const bool complete = text && !dip_json_memory_ran_out();
    const bool written = complete
                             ? dip_whole_file_write(file, text, strlen(text), err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    cJSON_free(text);
    dip_json_memory_end();
    return written;
}
