// Printing predictions of times elsewhere, and writing them as JSON and CSV.
#include "app/cost/predict/predict_elsewhere.h"

#include "app/report/format/json_memory.h"
#include "app/report/format/json_smaller.h"
#include "app/report/verdict.h"
#include "app/files/whole_file.h"
#include "app/files/put.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

enum { JSON_FORMAT = 1 };

// --- the table -----------------------------------------------------------------------------------

static void print_place(const char *what, const DipCostReport *place, FILE *out) {
    dip_put_text(out, "%-8s %dx%d pixels, path %s, %d thread%s, %s\n", what, place->width,
                 place->height, place->paths[0], place->threads, dip_cost_plural(place->threads),
                 place->isa);
}

static void print_misses(const char *what, const DipCostMisses *misses, FILE *out) {
    dip_put_text(out, "         %-46s median %5.1f %%, 90 %% within %5.1f %%\n", what,
                 100.0 * misses->median, 100.0 * misses->p90);
}

static void print_checks(const DipCostElsewherePrediction *p, FILE *out) {
    static const char alone[] = "the report alone misses them by";
    if (p->timed_count > 0) {
        dip_put_text(
            out,
            "timed    %d combination%s there, beside the report's baseline: %s %.3f times as long "
            "as the report alone predicts\n",
            p->timed_count, dip_cost_plural(p->timed_count),
            p->timed_count == 1 ? "it takes" : "they take", p->factor);
        print_misses(alone, &p->timed_as_is, out);
        print_misses("each predicted from the report and the others", &p->timed_left_out, out);
    } else {
        dip_put_text(out, "timed    nothing: the predictions come from the report alone\n");
    }
    if (p->checked_count > 0) {
        dip_put_text(out, "checked  %d other combination%s there\n", p->checked_count,
                     dip_cost_plural(p->checked_count));
        print_misses(alone, &p->checked_as_is, out);
        if (p->timed_count > 0) {
            print_misses("the predictions miss them by", &p->checked_fitted, out);
        }
    }
    if (p->wait > dip_cost_wait_limits.green) {
        dip_put_text(out,
                     "warning  the threads waited %.0f %% of their time for a core, which other "
                     "programs held, so the times that were taken there are %s\n",
                     100.0 * p->wait, p->wait > dip_cost_wait_limits.red ? "wrong" : "less sure");
    }
}

static void print_combination(const DipCostElsewherePrediction *p, const DipCostPredictedThere *c,
                              FILE *out) {
    char text[DIP_COST_TEXT];
    dip_cost_settings_text(&c->quality, text);
    dip_put_text(out, "  %-34s %9.2f %9.2f", text, c->report_ms, c->ms);
    if (c->timed >= 0) {
        const DipStatsEstimate *ms = &p->timed[c->timed].ms;
        dip_put_text(out, " %9.2f %8.2f to %.2f", ms->value, ms->low, ms->high);
    }
    dip_put_text(out, "\n");
}

void dip_cost_predict_there_print(const DipCostElsewherePrediction *p, FILE *out) {
    dip_put_text(out, "scene    %s\n", p->report.scene);
    print_place("report", &p->report, out);
    print_place("there", &p->there, out);
    dip_put_text(out, "model    prices of work from %d row%s", p->report.row_count,
                 dip_cost_plural(p->report.row_count));
    if (p->report.smaller_count > 0) {
        dip_put_text(out, " and %d at %dx%d", p->report.smaller_count, p->report.smaller_width,
                     p->report.smaller_height);
    }
    dip_put_text(out, " of the report\n");
    print_misses("each row predicted from the others", &p->fit, out);
    print_checks(p, out);
    const bool any_timed = p->timed_count + p->checked_count > 0;
    dip_put_text(out, "\nMean times of a frame, in milliseconds of the report's run:\n");
    dip_put_text(out, "  %-34s %9s %9s%s\n", "combination", "report", "predicted",
                 any_timed ? "     timed 95 % interval" : "");
    for (int i = 0; i < p->count; i++) {
        print_combination(p, &p->list[i], out);
    }
}

// --- files ---------------------------------------------------------------------------------------

static void add_place(cJSON *root, const char *name, const DipCostReport *place) {
    cJSON *object = cJSON_AddObjectToObject(root, name);
    cJSON_AddNumberToObject(object, "width", place->width);
    cJSON_AddNumberToObject(object, "height", place->height);
    cJSON_AddStringToObject(object, "path", place->paths[0]);
    cJSON_AddNumberToObject(object, "threads", place->threads);
    cJSON_AddStringToObject(object, "isa", place->isa);
}

static void add_misses(cJSON *root, const char *name, const DipCostMisses *misses) {
    if (misses->rows > 0) {
        cJSON *object = cJSON_AddObjectToObject(root, name);
        cJSON_AddNumberToObject(object, "combinations", misses->rows);
        cJSON_AddNumberToObject(object, "median", misses->median);
        cJSON_AddNumberToObject(object, "p90", misses->p90);
    }
}

static const char *role_of(const DipCostElsewherePrediction *p, const DipCostPredictedThere *c) {
    return c->timed < 0 ? "predicted" : c->timed < p->timed_count ? "timed" : "checked";
}

static void add_combination(cJSON *list, const DipCostElsewherePrediction *p,
                            const DipCostPredictedThere *c) {
    char settings[256];
    cJSON *object = cJSON_CreateObject();
    dip_quality_format(&c->quality, settings, sizeof settings);
    cJSON_AddStringToObject(object, "settings", settings);
    cJSON_AddStringToObject(object, "role", role_of(p, c));
    cJSON_AddNumberToObject(object, "report_ms", c->report_ms);
    cJSON_AddNumberToObject(object, "report_alone_ms", c->as_is_ms);
    cJSON_AddNumberToObject(object, "ms", c->ms);
    if (c->timed >= 0) {
        dip_cost_elsewhere_add_times(cJSON_AddObjectToObject(object, "timed"), &p->timed[c->timed]);
    }
    if (!cJSON_AddItemToArray(list, object)) {
        cJSON_Delete(object);
    }
}

static void add_all(cJSON *root, const DipCostElsewherePrediction *p) {
    cJSON_AddStringToObject(root, "what", "diptych cost predict");
    cJSON_AddNumberToObject(root, "format", JSON_FORMAT);
    cJSON_AddStringToObject(root, "scene", p->report.scene);
    cJSON_AddStringToObject(root, "scene_hash", p->report.scene_hash);
    add_place(root, "report", &p->report);
    add_place(root, "there", &p->there);
    cJSON_AddNumberToObject(root, "factor", p->factor);
    cJSON_AddNumberToObject(root, "wait", p->wait);
    cJSON *misses = cJSON_AddObjectToObject(root, "misses");
    add_misses(misses, "report_rows_left_out", &p->fit);
    add_misses(misses, "timed_by_report_alone", &p->timed_as_is);
    add_misses(misses, "timed_left_out", &p->timed_left_out);
    add_misses(misses, "checked_by_report_alone", &p->checked_as_is);
    add_misses(misses, "checked", &p->checked_fitted);
    cJSON *list = cJSON_AddArrayToObject(root, "combinations");
    for (int i = 0; i < p->count; i++) {
        add_combination(list, p, &p->list[i]);
    }
}

bool dip_cost_predict_there_write_json(const DipCostElsewherePrediction *p, const char *file,
                                       DipError *err) {
    dip_json_memory_begin();
    cJSON *root = cJSON_CreateObject();
    add_all(root, p);
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

static void print_csv(const DipCostElsewherePrediction *p, FILE *out) {
    dip_put_text(out, "width,height,path,threads,settings,role,report_ms,report_alone_ms,ms,"
                      "timed_ms,timed_ms_low,timed_ms_high\n");
    for (int i = 0; i < p->count; i++) {
        const DipCostPredictedThere *c = &p->list[i];
        char settings[256];
        dip_quality_format(&c->quality, settings, sizeof settings);
        dip_put_text(out, "%d,%d,", p->there.width, p->there.height);
        dip_put_csv_text(out, p->there.paths[0]);
        dip_put_text(out, ",%d,", p->there.threads);
        dip_put_csv_text(out, settings);
        dip_put_text(out, ",%s,%.6g,%.6g,%.6g", role_of(p, c), c->report_ms, c->as_is_ms, c->ms);
        if (c->timed >= 0) {
            const DipStatsEstimate *ms = &p->timed[c->timed].ms;
            dip_put_text(out, ",%.6g,%.6g,%.6g\n", ms->value, ms->low, ms->high);
        } else {
            dip_put_text(out, ",,,\n");
        }
    }
}

bool dip_cost_predict_there_write_csv(const DipCostElsewherePrediction *p, const char *file,
                                      DipError *err) {
    char *text = NULL;
    size_t size_bytes = 0;
    FILE *memory = open_memstream(&text, &size_bytes);
    if (!memory) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    print_csv(p, memory);
    bool complete = !ferror(memory);
    complete = fclose(memory) == 0 && complete && text; // NULL if memory runs out here.
    const bool written = complete
                             ? dip_whole_file_write(file, text, size_bytes, err)
                             : dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    free(text);
    return written;
}
