// Makes the five plots. Each line of a plot is a series.
#include "app/bench/plots.h"

#include "app/cli/machine.h"
#include "app/measure/stats/estimate.h"
#include "app/report/page/plot.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef double AxisValue(const DipBenchPlan *plan, const DipBenchCombination *combination);

static double pixels(const DipBenchPlan *plan, const DipBenchCombination *combination) {
    const DipBenchSize *size = &plan->options.sizes[combination->at[DIP_BENCH_AXIS_SIZE]];
    return (double)size->width * size->height;
}

static double scale(const DipBenchPlan *plan, const DipBenchCombination *combination) {
    return plan->options.scales[combination->at[DIP_BENCH_AXIS_SCALE]];
}

static double triangles(const DipBenchPlan *plan, const DipBenchCombination *combination) {
    return plan->options.grid_count ? plan->options.grids[combination->at[DIP_BENCH_AXIS_GRID]] : 0;
}

static double samples(const DipBenchPlan *plan, const DipBenchCombination *combination) {
    return dip_quality_sample_count(
        &plan->options.sets[combination->at[DIP_BENCH_AXIS_SET]].quality);
}

static double threads(const DipBenchPlan *plan, const DipBenchCombination *combination) {
    return plan->options.threads[combination->at[DIP_BENCH_AXIS_THREADS]];
}

static const struct Kind {
    const char *file;
    const char *title;
    const char *x_title;
    DipBenchAxis axis;
    AxisValue *value;
    bool log_x;
    bool log_y;
} kinds[] = {
    {"time_pixels.svg", "Time against pixels", "pixels", DIP_BENCH_AXIS_SIZE, pixels, true, true},
    {"time_scale.svg", "Time against render scale", "render scale", DIP_BENCH_AXIS_SCALE, scale,
     true, true},
    {"time_triangles.svg", "Time against triangles", "triangles", DIP_BENCH_AXIS_GRID, triangles,
     true, true},
    {"time_samples.svg", "Time against samples", "samples per pixel", DIP_BENCH_AXIS_SET, samples,
     false, false},
    {"time_threads.svg", "Time against threads", "threads", DIP_BENCH_AXIS_THREADS, threads, true,
     true},
};

// The points of one series. All combinations of the series have the values of `like`, except on the
// plot's axis.
typedef struct Series {
    char name[DIP_BENCH_LABEL_SIZE];
    const DipBenchCombination *like;
    double x[DIP_BENCH_MAX_VALUES];
    double y[DIP_BENCH_MAX_VALUES];
    double low[DIP_BENCH_MAX_VALUES];
    double high[DIP_BENCH_MAX_VALUES];
    int count;
} Series;

static bool same_but_samples(const DipQuality *a, const DipQuality *b) {
    DipQuality other = *b;
    other.step[DIP_SETTING_AA] = a->step[DIP_SETTING_AA];
    return memcmp(a, &other, sizeof other) == 0;
}

// True if two combinations belong to the same series: they differ on the plot's axis only. In the
// plot against samples, their settings differ only in aa, the number of samples.
static bool belongs(const DipBenchPlan *plan, const struct Kind *kind, const DipBenchCombination *a,
                    const DipBenchCombination *b) {
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        if (axis != (int)kind->axis && a->at[axis] != b->at[axis]) {
            return false;
        }
    }
    const DipBenchSet *sets = plan->options.sets;
    return kind->axis != DIP_BENCH_AXIS_SET ||
           same_but_samples(&sets[a->at[DIP_BENCH_AXIS_SET]].quality,
                            &sets[b->at[DIP_BENCH_AXIS_SET]].quality);
}

// Writes the settings other than aa that differ from the defaults: "af=16", or "default settings".
static void name_without_samples(const DipQuality *quality, char *name, size_t size_bytes) {
    const DipQuality standard = dip_quality_default();
    *name = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (s != DIP_SETTING_AA && quality->step[s] != standard.step[s]) {
            const DipSettingInfo *info = dip_setting_info((DipSetting)s);
            const size_t used = strlen(name);
            snprintf(name + used, size_bytes - used, "%s%s=%s", used ? "," : "", info->key,
                     info->steps[quality->step[s]]);
        }
    }
    if (!*name) {
        snprintf(name, size_bytes, "default settings");
    }
}

static void name_series(const DipBenchPlan *plan, const struct Kind *kind, Series *series) {
    dip_bench_label(plan, series->like, kind->axis, series->name);
    if (kind->axis == DIP_BENCH_AXIS_SET) {
        char settings[64];
        char rest[DIP_BENCH_LABEL_SIZE];
        bool others = false;
        for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
            others = others || (axis != DIP_BENCH_AXIS_SET && plan->counts[axis] > 1);
        }
        name_without_samples(&plan->options.sets[series->like->at[DIP_BENCH_AXIS_SET]].quality,
                             settings, sizeof settings);
        snprintf(rest, sizeof rest, "%s", series->name);
        snprintf(series->name, sizeof series->name, "%s%s%.120s", settings, others ? ", " : "",
                 others ? rest : "");
    }
}

// Adds a point and keeps x ascending. Ignores the point if its x is already there, for example for
// two sizes of equal area.
static void add_point(Series *series, double x, const double *ms, int count, double *scratch) {
    int at = 0;
    while (at < series->count && series->x[at] < x) {
        at++;
    }
    if (series->count == DIP_BENCH_MAX_VALUES || (at < series->count && series->x[at] == x)) {
        return;
    }
    double *const columns[] = {series->x, series->y, series->low, series->high};
    const double values[] = {x, dip_percentile_of(ms, count, 0.5, scratch),
                             dip_percentile_of(ms, count, 0.05, scratch),
                             dip_percentile_of(ms, count, 0.95, scratch)};
    for (int c = 0; c < 4; c++) {
        memmove(columns[c] + at + 1, columns[c] + at,
                sizeof(double) * (size_t)(series->count - at));
        columns[c][at] = values[c];
    }
    series->count++;
}

static int collect(const DipBenchResult *result, const struct Kind *kind, Series *series,
                   double *scratch) {
    const DipBenchPlan *plan = result->plan;
    const int values = plan->options.measure.rounds * plan->options.frames;
    int count = 0;
    for (int c = 0; c < plan->count; c++) {
        const DipBenchCombination *combination = &plan->combinations[c];
        int s = 0;
        while (s < count && !belongs(plan, kind, series[s].like, combination)) {
            s++;
        }
        if (s == count) {
            series[count++] = (Series){.like = combination};
            name_series(plan, kind, &series[s]);
        }
        add_point(&series[s], kind->value(plan, combination),
                  dip_bench_result_ms(result, c, DIP_BENCH_STAGE_total), values, scratch);
    }
    return count;
}

static bool write_kind(const char *folder, const struct Kind *kind, const DipBenchPlan *plan,
                       const Series *series, int count, DipError *err) {
    DipPlotSeries lines[DIP_PLOT_MAX_SERIES];
    char processor[128];
    char fixed[DIP_BENCH_LABEL_SIZE];
    char subtitle[256];
    char file[PATH_MAX];
    const int shown = count < DIP_PLOT_MAX_SERIES ? count : DIP_PLOT_MAX_SERIES;
    bool any = false;
    for (int s = 0; s < count; s++) {
        any = any || series[s].count > 1;
    }
    if (!any) {
        return true;
    }
    for (int s = 0; s < shown; s++) {
        lines[s] = (DipPlotSeries){.name = series[s].name,
                                   .x = series[s].x,
                                   .y = series[s].y,
                                   .low = series[s].low,
                                   .high = series[s].high,
                                   .count = series[s].count};
    }
    dip_machine_processor(processor, sizeof processor);
    dip_bench_fixed_label(plan, fixed);
    snprintf(subtitle, sizeof subtitle, "%.50s, %.40s; %d drawings each", processor, fixed,
             plan->options.measure.rounds * plan->options.frames);
    const DipPlot plot = {.title = kind->title,
                          .subtitle = subtitle,
                          .x_title = kind->x_title,
                          .y_title = "ms per frame: median, bars from 5th to 95th percentile",
                          .log_x = kind->log_x,
                          .log_y = kind->log_y,
                          .series = lines,
                          .series_count = count};
    if (snprintf(file, sizeof file, "%s/%s", folder, kind->file) >= (int)sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--svg",
                                     "the name is too long");
    }
    if (!dip_plot_write(file, &plot, err)) {
        return false;
    }
    fprintf(stderr, "plot written: %s\n", file);
    return true;
}

bool dip_bench_write_plots(const char *folder, const DipBenchResult *result, DipError *err) {
    const DipBenchPlan *plan = result->plan;
    Series *series = calloc((size_t)plan->count, sizeof *series);
    double *scratch =
        malloc(sizeof *scratch * (size_t)(plan->options.measure.rounds * plan->options.frames));
    bool done = (series && scratch) ||
                dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--svg", "out of memory");
    for (size_t k = 0; done && k < sizeof kinds / sizeof *kinds; k++) {
        const int count = collect(result, &kinds[k], series, scratch);
        done = write_kind(folder, &kinds[k], plan, series, count, err);
    }
    free(series);
    free(scratch);
    return done;
}
