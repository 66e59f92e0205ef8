// The file of levels: one line per run with the baseline's milliseconds.
#include "app/cost/levels.h"

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

static bool name_file(const DipCostReport *report, const char *cache, char file[PATH_MAX]) {
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
    const int length = snprintf(file, PATH_MAX, "%s/levels-%s.txt", cache, hex);
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

void dip_cost_remember_level(DipCostReport *report, const char *cache) {
    char file[PATH_MAX];
    double levels_ms[DIP_COST_LEVEL_MOST_RUNS + 1];
    const double level_ms = dip_cost_ms(report, report->base_rows[0]);
    if (!cache || report->rounds == 0 || report->verdict == DIP_COST_RED || !(level_ms > 0.0) ||
        !name_file(report, cache, file)) {
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
}
