// Writes up to five plots of the time (plots.h). Each line of a plot is a series of points.
#include "app/bench/plots.h"

#include "app/cli/machine.h"
#include "app/report/page/plot.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct Kind {
    const char *name; // "pixels" makes the file time_pixels.svg, titled "Time against pixels".
    const char *x_title;
    DipBenchAxis axis;
} kinds[] = {
    {"pixels", "pixels", DIP_BENCH_AXIS_SIZE},
    {"scale", "render scale", DIP_BENCH_AXIS_SCALE},
    {"triangles", "triangles", DIP_BENCH_AXIS_GRID},
    {"samples", "samples per pixel", DIP_BENCH_AXIS_SET},
    {"threads", "threads", DIP_BENCH_AXIS_THREADS},
};

// Returns where a combination lies on the x axis.
static double value_of(const DipBenchPlan *plan, int combination, DipBenchAxis axis) {
    const DipBenchValues v = dip_bench_values(plan, combination);
    return axis == DIP_BENCH_AXIS_SIZE    ? (double)v.size.width * v.size.height
           : axis == DIP_BENCH_AXIS_SCALE ? v.scale
           : axis == DIP_BENCH_AXIS_GRID  ? v.triangles
           : axis == DIP_BENCH_AXIS_SET   ? dip_quality_sample_count(&v.set->quality)
                                          : v.threads;
}

// The points of one series. Each point shows a combination. All combinations of a series have the
// same values except on the plot's axis; in the plot against samples, their settings differ in aa
// only.
typedef struct Series {
    char name[DIP_BENCH_LABEL_SIZE];
    int first; // Index of the first combination.
    double x[DIP_BENCH_MAX_VALUES];
    double y[DIP_BENCH_MAX_VALUES];
    double low[DIP_BENCH_MAX_VALUES];
    double high[DIP_BENCH_MAX_VALUES];
    int count;
} Series;

static bool same_but_samples(const DipQuality *a, const DipQuality *b) {
    DipQuality other = *b;
    other.step[DIP_SETTING_AA] = a->step[DIP_SETTING_AA];
    return dip_quality_equal(a, &other);
}

// Returns whether two combinations belong to the same series, that is, whether they differ on the
// plot's axis only. In the plot against samples, their settings may differ only in aa, the number
// of samples.
static bool belongs(const DipBenchPlan *plan, const struct Kind *kind, int a, int b) {
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        if (axis != (int)kind->axis && plan->at[a][axis] != plan->at[b][axis]) {
            return false;
        }
    }
    return kind->axis != DIP_BENCH_AXIS_SET ||
           same_but_samples(&dip_bench_values(plan, a).set->quality,
                            &dip_bench_values(plan, b).set->quality);
}

static void name_series(const DipBenchPlan *plan, const struct Kind *kind, Series *series) {
    dip_bench_label(plan, series->first, kind->axis, series->name);
    if (kind->axis == DIP_BENCH_AXIS_SET) {
        // The settings that all points share: those of the first point, with aa at its default.
        DipQuality rest = dip_bench_values(plan, series->first).set->quality;
        char settings[64], others[DIP_BENCH_LABEL_SIZE] = "";
        const DipQuality standard = dip_quality_default();
        rest.step[DIP_SETTING_AA] = standard.step[DIP_SETTING_AA];
        dip_quality_format_changes(&rest, settings, sizeof settings);
        if (plan->count > plan->options.counts[DIP_BENCH_AXIS_SET]) {
            snprintf(others, sizeof others, ", %.120s", series->name);
        }
        snprintf(series->name, sizeof series->name, "%s%s",
                 dip_quality_equal(&rest, &standard) ? "default settings" : settings, others);
    }
}

// Adds a combination's point to the series, whose points are in ascending order of x. Ignores the
// point if the series has a point at this x, for example for two sizes of equal area.
static void add_point(Series *series, double x, const DipBenchResult *result, int combination) {
    static const double shares[] = {0.5, 0.05, 0.95};
    double *const columns[] = {series->x, series->y, series->low, series->high};
    int at = 0;
    while (at < series->count && series->x[at] < x) {
        at++;
    }
    if (series->count == DIP_BENCH_MAX_VALUES || (at < series->count && series->x[at] == x)) {
        return;
    }
    for (int c = 0; c < 4; c++) {
        memmove(columns[c] + at + 1, columns[c] + at,
                sizeof(double) * (size_t)(series->count - at));
        columns[c][at] = c == 0 ? x
                                : dip_bench_result_quantile(result, combination,
                                                            DIP_BENCH_STAGE_total, shares[c - 1]);
    }
    series->count++;
}

static int collect(const DipBenchResult *result, const struct Kind *kind, Series *series) {
    const DipBenchPlan *plan = result->plan;
    int count = 0;
    for (int c = 0; c < plan->count; c++) {
        int s = 0;
        while (s < count && !belongs(plan, kind, series[s].first, c)) {
            s++;
        }
        if (s == count) {
            series[count++] = (Series){.first = c};
            name_series(plan, kind, &series[s]);
        }
        add_point(&series[s], value_of(plan, c, kind->axis), result, c);
    }
    return count;
}

static bool write_kind(const char *folder, const struct Kind *kind, const DipBenchPlan *plan,
                       const Series *series, int count, DipError *err) {
    DipPlotSeries lines[DIP_PLOT_MAX_SERIES];
    char processor[128];
    char fixed[DIP_BENCH_LABEL_SIZE];
    char subtitle[256];
    char file[PATH_MAX], title[64];
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
    snprintf(title, sizeof title, "Time against %s", kind->name);
    const DipPlot plot = {.title = title,
                          .subtitle = subtitle,
                          .x_title = kind->x_title,
                          .y_title = "ms per frame: median, bars from 5th to 95th percentile",
                          .log_x = kind->axis != DIP_BENCH_AXIS_SET,
                          .log_y = kind->axis != DIP_BENCH_AXIS_SET,
                          .series = lines,
                          .series_count = count};
    if (snprintf(file, sizeof file, "%s/time_%s.svg", folder, kind->name) >= (int)sizeof file) {
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
    bool done = series || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--svg", "out of memory");
    for (size_t k = 0; done && k < sizeof kinds / sizeof *kinds; k++) {
        const int count = collect(result, &kinds[k], series);
        done = write_kind(folder, &kinds[k], plan, series, count, err);
    }
    free(series);
    return done;
}
