// Trains the prediction on a few combinations of a report, and prints how far it misses the others.
//
//     prediction_study REPORT/cost.json [THERE.json]...
//
// The report has combinations (diptych cost --combine aa,aaa,asd,af,aaf). The first lines are about
// these. THERE.json has combinations of the same scene that were timed beside the report's baseline
// at another size or on another camera path:
//
//     diptych cost predict REPORT --size 1280x960 --time 0 --check 200 --json THERE.json
//
// They are predicted from the trained ones of the report, and from these and six that were timed
// there.
#include "app/report/format/cost_fields.h"
#include "app/report/fit.h"
#include "app/report/format/formats.h"
#include "app/cost/steps.h"
#include "renderer/base/file.h"
#include "renderer/base/assert.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRAINED = 16, TIMED_THERE = 6, MOST_THERE = 1024, MOST_BYTES = 1 << 26 };

static void print_misses(const char *what, const DipCostMisses *misses) {
    printf("  %-52s median %5.1f %%, 90 %% within %5.1f %%, %3.0f %% within 10 %%, %3.0f %% within "
           "5 %% (%d rows)\n",
           what, 100.0 * misses->median, 100.0 * misses->p90, 100.0 * misses->within_10,
           100.0 * misses->within_5, misses->rows);
}

// Lists the combinations of a report as predictions, so that training rows can be chosen.
static bool list_combinations(DipCostReport *report) {
    const int count = report->row_count - report->combined_first;
    free(report->predicted.list);
    report->predicted.list = calloc((size_t)count + 1, sizeof *report->predicted.list);
    report->predicted.count = report->predicted.list ? count : 0;
    for (int i = 0; i < report->predicted.count; i++) {
        const DipCostRow *row = &report->rows[report->combined_first + i];
        DipCostPrediction *p = &report->predicted.list[i];
        *p = (DipCostPrediction){.quality = row->quality, .row = -1};
        memcpy(p->counters, row->counters, sizeof p->counters);
    }
    return report->predicted.list != NULL;
}

// Chooses the rows to train on. Returns their number, or 0 if there are too few combinations.
static int choose(DipCostReport *report, int count, int *rows, DipError *err) {
    if (!list_combinations(report) || report->predicted.count <= count ||
        !dip_cost_choose_training(report, count, rows, err)) {
        return 0;
    }
    for (int i = 0; i < count; i++) {
        rows[i] += report->combined_first;
    }
    return count;
}

static int list_others(const DipCostReport *report, const int *rows, int count, int *others) {
    int found = 0;
    for (int r = report->combined_first; r < report->row_count; r++) {
        bool trained = false;
        for (int i = 0; i < count; i++) {
            trained |= rows[i] == r;
        }
        if (!trained) {
            others[found++] = r;
        }
    }
    return found;
}

// What the predictions come from: the trained rows of a report.
typedef struct Trained {
    DipCostReport *report;
    int rows[DIP_COST_MAX_ROWS];
    int count;
} Trained;

// Returns how far the model of times misses rows to which it was not fitted.
static DipCostMisses time_misses_of(const DipCostReport *report, const DipCostModel *model,
                                    const int *rows, int count) {
    double misses[DIP_COST_MAX_ROWS];
    for (int i = 0; i < count; i++) {
        const DipCostRow *row = &report->rows[rows[i]];
        const double ms = dip_cost_model_value(model, row->counters, &row->quality);
        misses[i] = fabs(ms / dip_cost_ms(report, rows[i]) - 1.0);
    }
    return dip_cost_misses_of(misses, count);
}

// Returns how far the model of FLIP misses such rows.
static DipCostMisses flip_misses_of(const DipCostReport *report, const DipFlipModel *model,
                                    const int *rows, int count) {
    double misses[DIP_COST_MAX_ROWS];
    int distances[DIP_COST_MAX_ROWS];
    for (int i = 0; i < count; i++) {
        dip_flip_model_distances(model, &report->rows[rows[i]].quality, distances);
        misses[i] = fabs(dip_flip_model_value(model, distances) /
                             dip_cost_row_metrics(report, rows[i]).flip -
                         1.0);
    }
    return dip_cost_misses_of(misses, count);
}

static bool study_own(Trained *trained, DipError *err) {
    DipCostReport *report = trained->report;
    int others[DIP_COST_MAX_ROWS];
    const int *rows = trained->rows;
    const int count = choose(report, TRAINED, trained->rows, err);
    trained->count = count;
    if (count == 0) {
        return false;
    }
    const int other_count = list_others(report, rows, count, others);
    const DipCostModel times = dip_cost_model_fit(report, rows, count);
    DipFlipModel errors;
    if (!dip_flip_model_fit(report, rows, count, 0, &errors)) {
        dip_flip_model_free(&errors);
        return dip_cost_out_of_memory(err);
    }
    const DipCostMisses time_misses = time_misses_of(report, &times, others, other_count);
    const DipCostMisses flip_misses = flip_misses_of(report, &errors, others, other_count);
    dip_flip_model_free(&errors);
    const DipCostMisses left_out = dip_cost_model_leave_one_out(report, rows, count);
    printf("trained on %d of %d combinations:\n", count, report->predicted.count);
    print_misses("times of the others", &time_misses);
    print_misses("times, each trained row from the other trained rows", &left_out);
    print_misses("FLIP of the others", &flip_misses);
    return true;
}

// --- elsewhere -----------------------------------------------------------------------------------

typedef struct There {
    DipCostElsewhere rows[MOST_THERE];
    int count;
} There;

static bool read_combinations(const cJSON *root, There *there) {
    const cJSON *object;
    cJSON_ArrayForEach(object, cJSON_GetObjectItemCaseSensitive(root, "combinations")) {
        const cJSON *timed = cJSON_GetObjectItemCaseSensitive(object, "timed");
        const DipFieldAt at = {NULL, &there->rows[there->count], there->count, NULL};
        if (cJSON_IsObject(timed) && there->count < MOST_THERE) {
            if (!dip_fields_read_json(&dip_cost_elsewhere_record, &at, timed, "", NULL)) {
                return false;
            }
            there->count++;
        }
    }
    return there->count > TIMED_THERE;
}

static bool read_there(const char *file, There *there, DipError *err) {
    unsigned char *text;
    size_t size_bytes;
    there->count = 0;
    if (!dip_file_read(file, "prediction", MOST_BYTES, &text, &size_bytes, err)) {
        return false;
    }
    cJSON *root = cJSON_ParseWithLength((const char *)text, size_bytes);
    const bool read = root && read_combinations(root, there);
    cJSON_Delete(root);
    free(text);
    return read || dip_error_set(err, DIP_ERROR_FORMAT, file, 0, NULL,
                                 "has no more than %d timed combinations", TIMED_THERE);
}

// Misses of all combinations from index `first` on.
static DipCostMisses misses_there(const There *there, const DipCostModel *model, int first) {
    double misses[MOST_THERE];
    for (int i = first; i < there->count; i++) {
        const DipCostElsewhere *row = &there->rows[i];
        misses[i - first] =
            fabs(dip_cost_model_value(model, row->counters, &row->quality) / row->ms.value - 1.0);
    }
    return dip_cost_misses_of(misses, there->count - first);
}

// Moves the combinations that tell most about all others to the front.
static bool choose_there(const Trained *trained, There *there, DipError *err) {
    DipCostReport place = {.options = trained->report->options};
    int chosen[TIMED_THERE];
    place.predicted.list = calloc((size_t)there->count, sizeof *place.predicted.list);
    if (!place.predicted.list) {
        return false;
    }
    place.predicted.count = there->count;
    for (int i = 0; i < there->count; i++) {
        DipCostPrediction *p = &place.predicted.list[i];
        *p = (DipCostPrediction){.quality = there->rows[i].quality, .row = -1};
        memcpy(p->counters, there->rows[i].counters, sizeof p->counters);
    }
    const bool done = dip_cost_choose_timed(&place, TIMED_THERE, chosen, err);
    free(place.predicted.list);
    for (int i = 0; done && i < TIMED_THERE; i++) {
        const DipCostElsewhere moved = there->rows[chosen[i]];
        there->rows[chosen[i]] = there->rows[i];
        there->rows[i] = moved;
        for (int k = i + 1; k < TIMED_THERE; k++) {
            chosen[k] = chosen[k] == i ? chosen[i] : chosen[k];
        }
    }
    return done;
}

static bool study_there(const Trained *trained, const char *file, DipError *err) {
    static There there;
    if (!read_there(file, &there, err) || !choose_there(trained, &there, err)) {
        return false;
    }
    const DipCostModel alone = dip_cost_model_fit(trained->report, trained->rows, trained->count);
    const DipCostModel fitted = dip_cost_model_fit_there(
        trained->report, trained->rows, trained->count, there.rows, TIMED_THERE, false);
    const DipCostMisses all = misses_there(&there, &alone, 0);
    const DipCostMisses others = misses_there(&there, &fitted, TIMED_THERE);
    printf("%s:\n", file);
    print_misses("from the trained rows alone", &all);
    print_misses("from these and six that were timed there", &others);
    return true;
}

int main(int argc, char **argv) {
    static DipCostReport report;
    static Trained trained = {.report = &report};
    DipError err = {0};
    if (argc < 2 || !dip_cost_read_json(&report, argv[1], &err)) {
        fprintf(stderr, "%s\n", argc < 2 ? "give a report" : err.message);
        return 2;
    }
    printf("%s: %s, %dx%d, %d threads, path %s, %s\n", argv[1], report.scene, report.width,
           report.height, report.threads, report.paths[0], dip_cost_verdict_names[report.verdict]);
    bool done = study_own(&trained, &err) ||
                dip_error_set(&err, DIP_ERROR_MISSING, argv[1], 0, NULL,
                              "has no times, or no more than %d combinations", TRAINED);
    for (int i = 2; done && i < argc; i++) {
        done = study_there(&trained, argv[i], &err);
    }
    if (!done) {
        fprintf(stderr, "%s\n", err.message);
    }
    dip_cost_report_free(&report);
    return done ? 0 : 2;
}
