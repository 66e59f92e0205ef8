// The files of levels and ratios: a line per run with the baseline's milliseconds, and a line per
// step and run with the step's ratio.
#include "app/report/levels.h"

#include "renderer/base/hash.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

DipCostLevelSpread dip_cost_level_spread(const double *levels_ms, int count) {
    DipCostLevelSpread spread = {.runs = count};
    double mean = 0.0, squares = 0.0;
    if (count < DIP_COST_LEVEL_LEAST_RUNS) {
        return spread;
    }
    spread.least_ms = levels_ms[0];
    spread.most_ms = levels_ms[0];
    for (int i = 0; i < count; i++) {
        mean += log(levels_ms[i]) / count;
        spread.least_ms = fmin(spread.least_ms, levels_ms[i]);
        spread.most_ms = fmax(spread.most_ms, levels_ms[i]);
    }
    for (int i = 0; i < count; i++) {
        squares += (log(levels_ms[i]) - mean) * (log(levels_ms[i]) - mean);
    }
    spread.deviation = sqrt(squares / (count - 1));
    spread.factor = exp(dip_student_quantile(0.975, count - 1) * sqrt(2.0) * spread.deviation);
    return spread;
}

static int compare_ratios(const void *a, const void *b) {
    return strcmp(((const DipCostRememberedRatio *)a)->key,
                  ((const DipCostRememberedRatio *)b)->key);
}

double dip_cost_ratio_deviation(DipCostRememberedRatio *ratios, int count, int *runs) {
    double squares = 0.0;
    int free_values = 0;
    *runs = 0;
    qsort(ratios, (size_t)count, sizeof *ratios, compare_ratios);
    for (int first = 0, end = 0; first < count; first = end) {
        double mean = 0.0;
        while (end < count && strcmp(ratios[first].key, ratios[end].key) == 0) {
            mean += ratios[end++].log_ratio;
        }
        mean /= end - first;
        for (int i = first; i < end; i++) {
            squares += (ratios[i].log_ratio - mean) * (ratios[i].log_ratio - mean);
        }
        free_values += end - first - 1;
        *runs = end - first > *runs ? end - first : *runs;
    }
    return free_values > 0 ? sqrt(squares / free_values) : 0.0;
}

static bool name_file(const DipCostReport *report, const char *cache, const char *what,
                      char file[PATH_MAX]) {
    DipHash hash = dip_hash_begin(0);
    const int values[] = {report->threads, report->width, report->height, report->options.rounds,
                          report->options.timed_frames};
    dip_hash_text(&hash, report->build);
    dip_hash_text(&hash, report->processor);
    dip_hash_text(&hash, report->isa);
    dip_hash_text(&hash, report->scene_hash);
    dip_hash_text(&hash, report->path_hashes[0]);
    dip_hash_bytes(&hash, values, sizeof values);
    dip_hash_bytes(&hash, &report->options.baseline, sizeof report->options.baseline);
    char hex[33];
    dip_hash_hex(&hash, hex);
    const int length = snprintf(file, PATH_MAX, "%s/%s-%s.txt", cache, what, hex);
    return length > 0 && length < PATH_MAX;
}

// Reads the latest levels. Lines that are not a time are passed over. Returns their number.
static int read_levels(const char *file, double levels_ms[DIP_COST_LEVEL_MOST_RUNS]) {
    FILE *in = fopen(file, "r");
    char line[64];
    int count = 0;
    while (in && fgets(line, sizeof line, in)) {
        const double ms = strtod(line, NULL);
        if (ms > 1e-6 && ms < 1e9) {
            if (count == DIP_COST_LEVEL_MOST_RUNS) {
                memmove(levels_ms, levels_ms + 1, (size_t)--count * sizeof *levels_ms);
            }
            levels_ms[count++] = ms;
        }
    }
    if (in) {
        fclose(in);
    }
    return count;
}

// --- ratios --------------------------------------------------------------------------------------

static void name_step(const DipCostReport *report, const DipCostSweep *sweep, int row,
                      char key[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, report->path_hashes[sweep->path]);
    dip_hash_bytes(&hash, &report->rows[sweep->base].quality, sizeof(DipQuality));
    dip_hash_bytes(&hash, &report->rows[row].quality, sizeof(DipQuality));
    dip_hash_hex(&hash, key);
}

// Adds a line for each step of this run.
static void write_ratios(const DipCostReport *report, FILE *out) {
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        for (int i = 0; i < sweep->row_count; i++) {
            const double ratio =
                dip_cost_ms(report, sweep->rows[i]) / dip_cost_ms(report, sweep->base);
            char key[33];
            if (sweep->rows[i] != sweep->base && isfinite(ratio) && ratio > 0.0) {
                name_step(report, sweep, sweep->rows[i], key);
                fprintf(out, "%s %.9g\n", key, ratio);
            }
        }
    }
}

// Reads the latest ratios. Lines that are none are passed over. Returns their number.
static int read_ratios(FILE *in, DipCostRememberedRatio *ratios, int most) {
    char line[64], key[33];
    int64_t found = 0;
    double ratio;
    while (fgets(line, sizeof line, in)) {
        if (sscanf(line, "%32s %lf", key, &ratio) == 2 && ratio > 1e-6 && ratio < 1e6) {
            DipCostRememberedRatio *to = &ratios[found++ % most]; // Over the oldest.
            memcpy(to->key, key, sizeof key);
            to->log_ratio = log(ratio);
        }
    }
    return found < most ? (int)found : most;
}

static void remember_ratios(DipCostReport *report, const char *file) {
    enum { MOST = DIP_COST_LEVEL_MOST_RUNS * 64 };
    DipCostRememberedRatio *ratios = calloc(MOST, sizeof *ratios);
    FILE *both = ratios ? fopen(file, "a+") : NULL;
    if (both) {
        int runs;
        write_ratios(report, both);
        rewind(both);
        const int count = read_ratios(both, ratios, MOST);
        const double deviation = dip_cost_ratio_deviation(ratios, count, &runs);
        report->level_spread.ratio_deviation = deviation;
        if (runs >= DIP_COST_LEVEL_LEAST_RUNS) {
            report->level_spread.ratio_factor =
                exp(dip_student_quantile(0.975, runs - 1) * sqrt(2.0) * deviation);
        }
        fclose(both);
    }
    free(ratios);
}

void dip_cost_remember_level(DipCostReport *report, const char *cache) {
    char file[PATH_MAX];
    double levels_ms[DIP_COST_LEVEL_MOST_RUNS + 1];
    const double level_ms = dip_cost_ms(report, report->base_rows[0]);
    if (!cache || report->rounds == 0 || report->verdict == DIP_COST_RED || !(level_ms > 0.0) ||
        !name_file(report, cache, "levels", file)) {
        return;
    }
    int count = read_levels(file, levels_ms);
    levels_ms[count++] = level_ms;
    FILE *out = fopen(file, "a");
    if (out) {
        fprintf(out, "%.9g\n", level_ms); // One short write, so that two runs do not mix.
        fclose(out);
    }
    report->level_spread = dip_cost_level_spread(levels_ms, count);
    if (name_file(report, cache, "ratios", file)) {
        remember_ratios(report, file);
    }
}
