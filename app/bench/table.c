// Prints the bench's results as tables, and writes them as CSV.
#include "app/bench/table.h"

#include "app/files/whole_file.h"
#include "app/cli/machine.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// --- heading -----------------------------------------------------------------------------------

static void print_scene(const DipBenchPlan *plan, const DipSession *session, FILE *out) {
    const DipSessionOptions *options = session->options;
    const char *view = plan->options.grid_out_of_view ? ", out of view" : "";
    if (plan->options.grids[0]) {
        fprintf(out, "scene    grid%s\n", view);
        return;
    }
    fprintf(out, "scene    %s", dip_base_name(dip_session_scene_file(session)));
    if (session->scene) {
        fprintf(out, ", %" PRIu64 " triangles", dip_scene_triangle_count(session->scene));
    }
    if (session->shows_gallery) {
        fprintf(out, ", a scene of the gallery\n");
        return;
    }
    if (options->has_pose) {
        fprintf(out, ", one pose");
    } else if (!options->model_count && !options->path) {
        fprintf(out, ", path %s", dip_session_category(session->track.active));
    } else if (options->path) {
        fprintf(out, ", path %s", options->path);
    }
    fprintf(out, "\n");
}

void dip_bench_print_heading(const DipBenchPlan *plan, const DipSession *session, FILE *out) {
    char processor[128];
    char fixed[DIP_BENCH_LABEL_SIZE];
    dip_machine_processor(processor, sizeof processor);
    print_scene(plan, session, out);
    fprintf(out, "machine  %s, %d processors\n", processor, dip_machine_processor_count());
    dip_bench_fixed_label(plan, fixed);
    fprintf(out, "fixed    %s", fixed);
    fprintf(out,
            "\nframes   %d along the path, drawn in %d rounds, in a random order by seed %d\n\n",
            plan->options.frames, plan->options.measure.rounds, plan->options.measure.seed);
}

// --- times -------------------------------------------------------------------------------------

static int label_width(const DipBenchPlan *plan) {
    int width = 8;
    for (int c = 0; c < plan->count; c++) {
        char label[DIP_BENCH_LABEL_SIZE];
        dip_bench_label(plan, c, DIP_BENCH_AXIS_COUNT, label);
        const int length = (int)strlen(label);
        width = length > width ? length : width;
    }
    return width;
}

// Prints a value and its interval. Prints `unknown` instead of an interval that is not known.
static void print_estimate(const DipEstimate *estimate, const char *unknown, FILE *out) {
    char interval[48];
    snprintf(interval, sizeof interval, "%s", unknown);
    if (!isnan(estimate->low) && !isnan(estimate->high)) {
        snprintf(interval, sizeof interval, "%.3f to %.3f", estimate->low, estimate->high);
    }
    fprintf(out, " %8.3f %17s", estimate->value, interval);
}

static void print_comparison(const DipBenchResult *result, int combination, FILE *out) {
    print_estimate(&result->ratios[combination], combination == result->plan->base ? "base" : "-",
                   out);
    if (result->plan->options.counts[DIP_BENCH_AXIS_THREADS] > 1) {
        print_estimate(&result->speed_ups[combination], "-", out);
    }
}

void dip_bench_print_times(const DipBenchResult *result, FILE *out) {
    static const struct {
        const char *name;
        double share;
    } lines[] = {{"median", 0.5}, {"p95", 0.95}, {"min", 0.0}};
    const DipBenchPlan *plan = result->plan;
    const int width = label_width(plan);
    fprintf(out, "  #  %-*s        ", width, "ms/frame");
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        fprintf(out, " %9s", dip_bench_stage_names[stage]);
    }
    fprintf(out, " %8s %17s", "ratio", "95 % interval");
    if (plan->options.counts[DIP_BENCH_AXIS_THREADS] > 1) {
        fprintf(out, " %8s %17s", "speed-up", "95 % interval");
    }
    fprintf(out, "\n");
    for (int c = 0; c < plan->count; c++) {
        char label[DIP_BENCH_LABEL_SIZE];
        dip_bench_label(plan, c, DIP_BENCH_AXIS_COUNT, label);
        for (int line = 0; line < 3; line++) {
            fprintf(out, line ? "   " : "%3d", c + 1);
            fprintf(out, "  %-*s  %-6s", width, line ? "" : label, lines[line].name);
            for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
                fprintf(
                    out, " %9.3f",
                    dip_bench_result_quantile(result, c, (DipBenchStage)stage, lines[line].share));
            }
            if (line == 0) {
                print_comparison(result, c, out);
            }
            fprintf(out, "\n");
        }
    }
}

// --- work --------------------------------------------------------------------------------------

enum { WORK_COLUMNS = 6 };

static void print_work_block(const DipBenchResult *result, const int *shown, int count, FILE *out) {
    double means[WORK_COLUMNS][DIP_COUNTER_COUNT];
    fprintf(out, "\n%-22s", "row (means per frame)");
    for (int i = 0; i < count; i++) {
        fprintf(out, " %12d", shown[i] + 1);
        dip_bench_result_work(result, shown[i], means[i]);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        fprintf(out, "\n%-22s", dip_counter_names[c]);
        for (int i = 0; i < count; i++) {
            fprintf(out, " %12.0f", means[i][c]);
        }
    }
    fprintf(out, "\n");
}

void dip_bench_print_work(const DipBenchResult *result, FILE *out) {
    const DipBenchPlan *plan = result->plan;
    int shown[WORK_COLUMNS];
    int count = 0;
    fprintf(
        out,
        "\nThe work is the same with every instruction set and any number of threads, and so is "
        "every picture\nof the warm-up, to the bit.\n");
    for (int c = 0; c < plan->count; c++) {
        const int *at = plan->at[c];
        if (at[DIP_BENCH_AXIS_ISA] == 0 && at[DIP_BENCH_AXIS_THREADS] == 0) {
            shown[count++] = c;
        }
        if (count == WORK_COLUMNS || (count && c == plan->count - 1)) {
            print_work_block(result, shown, count, out);
            count = 0;
        }
    }
}

// --- ratios ------------------------------------------------------------------------------------

static int different_pictures(const DipBenchResult *here, const DipBenchResult *other,
                              int combination) {
    int different = 0;
    for (int i = 0; i < here->plan->options.frames; i++) {
        different += strcmp(dip_bench_result_first(here, combination, i)->hash,
                            dip_bench_result_first(other, combination, i)->hash) != 0;
    }
    return different;
}

static void print_ratio_row(const DipBenchResult *here, const DipBenchResult *other,
                            int combination, FILE *out) {
    double medians[2][DIP_BENCH_STAGE_COUNT];
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        const DipBenchStage s = (DipBenchStage)stage;
        medians[0][stage] = dip_bench_result_quantile(here, combination, s, 0.5);
        medians[1][stage] = dip_bench_result_quantile(other, combination, s, 0.5);
    }
    fprintf(out, " %8.3f %8.3f", medians[1][DIP_BENCH_STAGE_total],
            medians[0][DIP_BENCH_STAGE_total]);
    print_estimate(&other->ratios[combination], "-", out);
    fprintf(out, " %7.3f ",
            dip_bench_result_fastest_ms(other, combination, DIP_BENCH_STAGE_total) /
                dip_bench_result_fastest_ms(here, combination, DIP_BENCH_STAGE_total));
    for (int stage = 0; stage < DIP_BENCH_STAGE_total; stage++) {
        if (medians[0][stage] > 0.0) {
            fprintf(out, " %8.3f", medians[1][stage] / medians[0][stage]);
        } else {
            fprintf(out, " %8s", "-");
        }
    }
    const int different = different_pictures(here, other, combination);
    if (different) {
        fprintf(out, "  %d of %d differ\n", different, here->plan->options.frames);
    } else {
        fprintf(out, "  same\n");
    }
}

void dip_bench_print_ratios(const DipBenchResult *here, const DipBenchResult *other, FILE *out) {
    const DipBenchPlan *plan = here->plan;
    const int width = label_width(plan);
    fprintf(out,
            "Medians in ms per frame. A ratio is the other program's mean time divided by this\n"
            "program's. If the ratio is above 1, this program is faster.\n");
    fprintf(out, "%-*s %8s %8s %8s %17s %7s ", width, "", "other", "this", "ratio", "95 % interval",
            "fastest");
    for (int stage = 0; stage < DIP_BENCH_STAGE_total; stage++) {
        fprintf(out, " %8s", dip_bench_stage_names[stage]);
    }
    fprintf(out, "  pictures\n");
    for (int c = 0; c < plan->count; c++) {
        char label[DIP_BENCH_LABEL_SIZE];
        dip_bench_label(plan, c, DIP_BENCH_AXIS_COUNT, label);
        fprintf(out, "%-*s", width, label);
        print_ratio_row(here, other, c, out);
    }
}

// --- CSV ---------------------------------------------------------------------------------------

static int value_count(const DipBenchPlan *plan) {
    return plan->options.measure.rounds * plan->options.frames;
}

static void print_csv_heading(bool programs, FILE *out) {
    fprintf(out, "%ssettings,width_px,height_px,scale,threads,isa,grid_triangles,round,frame",
            programs ? "program," : "");
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        fprintf(out, ",%s_ms", dip_bench_stage_names[stage]);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        fprintf(out, ",%s_count", dip_counter_names[c]);
    }
    fprintf(out, "\n");
}

static void print_csv_line(const DipBenchResult *result, int combination, int value, FILE *out) {
    const DipBenchPlan *plan = result->plan;
    const int frames = plan->options.frames;
    const DipBenchValues v = dip_bench_values(plan, combination);
    fprintf(out, "\"%s\",%d,%d,%.10g,%d,%s,", v.set->text, v.size.width, v.size.height, v.scale,
            v.threads, dip_isa_name(v.isa));
    if (v.triangles) {
        fprintf(out, "%d", v.triangles);
    }
    fprintf(out, ",%d,%d", value / frames, value % frames);
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        fprintf(out, ",%.4f",
                dip_bench_result_ms(result, combination, (DipBenchStage)stage)[value]);
    }
    const DipCounters *counters =
        &dip_bench_result_first(result, combination, value % frames)->counters;
#define PRINT_COUNTER(name, text) fprintf(out, ",%" PRIu64, counters->name);
    DIP_COUNTER_LIST(PRINT_COUNTER)
#undef PRINT_COUNTER
    fprintf(out, "\n");
}

typedef struct CsvPrograms {
    const DipBenchResult *results;
    int count;
} CsvPrograms;

static bool print_csv(const void *context, FILE *out) {
    static const char *const names[] = {"this,", "other,"};
    const CsvPrograms *programs = context;
    print_csv_heading(programs->count > 1, out);
    for (int p = 0; p < programs->count; p++) {
        const DipBenchResult *result = &programs->results[p];
        for (int i = 0; i < result->plan->count * value_count(result->plan); i++) {
            fputs(programs->count > 1 ? names[p] : "", out);
            print_csv_line(result, i / value_count(result->plan), i % value_count(result->plan),
                           out);
        }
    }
    return true;
}

bool dip_bench_write_csv(const char *file, const DipBenchResult *results, int count,
                         DipError *err) {
    const CsvPrograms programs = {results, count};
    return dip_whole_file_print(file, print_csv, &programs, err);
}
