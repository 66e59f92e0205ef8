// Writing common advice as JSON.
#include "app/cost/advise/advise_output.h"

#include "app/report/candidates.h"
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

// Adds what one report says about some settings.
static void add_candidate(cJSON *to, const DipCandidate *candidate) {
    const DipEstimate ms = dip_estimate_widen(&candidate->time, candidate->common_error);
    cJSON_AddNumberToObject(to, "ms", ms.value);
    cJSON_AddNumberToObject(to, "ms_low", ms.low);
    cJSON_AddNumberToObject(to, "ms_high", ms.high);
    cJSON_AddNumberToObject(to, "flip", candidate->flip);
}

static void add_reports(cJSON *root, const DipCostCommon *common) {
    cJSON *reports = cJSON_AddArrayToObject(root, "reports");
    for (int i = 0; i < common->report_count; i++) {
        const DipCostReport *report = &common->reports[i];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "name", common->names[i]);
        cJSON_AddStringToObject(object, "scene", report->scene);
        cJSON_AddStringToObject(object, "path", report->paths[0]);
        cJSON_AddNumberToObject(object, "width", report->width);
        cJSON_AddNumberToObject(object, "height", report->height);
        cJSON_AddStringToObject(object, "processor", report->processor);
        cJSON_AddNumberToObject(object, "threads", report->threads);
        cJSON_AddStringToObject(object, "verdict", dip_cost_verdict_names[report->verdict]);
        cJSON_AddNumberToObject(object, "combinations", report->choice.candidates.count);
        add_to_array(reports, object);
    }
}

// Adds what one report says about the chosen settings, and what it would choose alone.
static void add_line(cJSON *list, const DipCostCommon *common, const DipCostCommonAdvice *advice,
                     int index) {
    const DipCostReport *report = &common->reports[index];
    cJSON *line = cJSON_CreateObject();
    if (advice->all.chosen >= 0) {
        const DipCandidate c = dip_cost_common_candidate(common, advice->all.chosen, index);
        add_candidate(line, &c);
    }
    if (advice->alone[index] >= 0) {
        const DipCandidate c =
            dip_candidate_of_row(report, advice->alone[index], common->candidates.kind);
        cJSON *alone = cJSON_AddObjectToObject(line, "alone");
        add_settings(alone, "settings", &c.quality);
        add_candidate(alone, &c);
    }
    const double lost = dip_cost_common_share_lost(common, advice, index);
    if (isfinite(lost)) {
        cJSON_AddNumberToObject(line, "loss", lost);
    }
    add_to_array(list, line);
}

// Adds a combination, and with which probability it fits the budget in every report.
static void add_combination(cJSON *to, const char *name, const DipCostCommon *common,
                            int combination, double fits) {
    if (combination >= 0) {
        const DipCandidate *c = &common->candidates.list[combination];
        cJSON *object = cJSON_AddObjectToObject(to, name);
        add_settings(object, "settings", &c->quality);
        cJSON_AddNumberToObject(object, "mean_flip", c->flip);
        cJSON_AddNumberToObject(object, "fits", fits);
        cJSON_AddNumberToObject(object, "limited_by_report", c->report);
    }
}

static void add_advice(cJSON *root, const DipCostCommon *common, const DipCostCommonAdvice *advice,
                       int count) {
    cJSON *array = cJSON_AddArrayToObject(root, "advice");
    for (int i = 0; i < count; i++) {
        const DipAdvice *all = &advice[i].all;
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "budget_ms", all->budget_ms);
        add_combination(object, "chosen", common, all->chosen, all->fits);
        cJSON *ties = cJSON_AddArrayToObject(object, "ties");
        for (int t = 0; t < all->tie_count && t < DIP_ADVICE_TIES; t++) {
            char text[256];
            dip_quality_format(&common->qualities[all->ties[t]], text, sizeof text);
            add_to_array(ties, cJSON_CreateString(text));
        }
        cJSON_AddNumberToObject(object, "tie_count", all->tie_count);
        add_combination(object, "next_better", common, all->next, all->next_fits);
        if (all->next >= 0) {
            cJSON_AddNumberToObject(object, "next_ms", all->next_ms);
        }
        cJSON *lines = cJSON_AddArrayToObject(object, "reports");
        for (int r = 0; r < common->report_count; r++) {
            add_line(lines, common, &advice[i], r);
        }
        add_to_array(array, object);
    }
}

bool dip_cost_common_write_json(const DipCostCommon *common, const DipCostCommonAdvice *advice,
                                int count, const char *file, DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "budget_of", dip_time_kind_names[common->candidates.kind]);
    cJSON_AddNumberToObject(root, "combinations", common->count);
    add_reports(root, common);
    add_advice(root, common, advice, count);
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
