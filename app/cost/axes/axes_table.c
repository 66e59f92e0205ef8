// Printing the rows of `diptych cost axes` for a terminal.
#include "app/cost/axes/axes.h"

#include "app/files/put.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double mebibyte = 1024.0 * 1024.0;

static const DipPathEstimate *time_of(const DipCostAxes *axes, int row) {
    return &axes->report.rows[row].time;
}

static double ns_per_pixel(const DipCostAxes *axes, int row) {
    const DipCostAxisRow *r = &axes->rows[row];
    return 1e6 * time_of(axes, row)->mean_ms.value / ((double)r->shown_width * r->shown_height);
}

// The parts of a time that axes_time.c hands out.
static double draw_ms(const DipCostAxes *axes, int row) {
    return axes->report.rows[row].stage_ms[0];
}

static double enlarge_ms(const DipCostAxes *axes, int row) {
    return axes->report.rows[row].stage_ms[1];
}

static bool is_judged(const DipCostAxes *axes, int row) {
    return axes->report.rows[row].judged[0];
}

// --- the table -----------------------------------------------------------------------------------

static void print_errors_heading(const DipCostAxes *axes, FILE *out) {
    const DipCostReport *report = &axes->report;
    const int places = report->options.end_place;
    if (!is_judged(axes, 0)) {
        dip_put_text(out, "errors   not measured\n");
        return;
    }
    const DipMetrics base = dip_cost_row_metrics(report, 0, 0);
    dip_put_text(
        out,
        "errors   %d viewpoint%s, against a converged picture (truth) of 2 x %d samples per "
        "pixel; the base has RMSE %.5f, FLIP %.5f; the truth's own noise has RMSE %.5f, FLIP "
        "%.5f\n",
        places, dip_cost_plural(places), report->options.samples, base.rmse_lin, base.flip,
        dip_cost_floor_rmse(report, 0, 0), dip_cost_floor_flip(report, 0));
}

static double counter(const DipCostAxes *axes, const char *name) {
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        if (strcmp(dip_cost_counter_names[c], name) == 0) {
            return axes->report.rows[0].counters[c];
        }
    }
    return 0.0;
}

static void print_heading(const DipCostAxes *axes, FILE *out) {
    const DipCostReport *report = &axes->report;
    char settings[DIP_COST_TEXT];
    dip_cost_settings_text(&report->options.baseline, settings);
    dip_put_text(out, "scene    %s, path %s\n", report->scene, report->paths[0]);
    dip_put_text(out, "machine  %s\n", report->processor);
    dip_put_text(out, "base     %dx%d pixels, %d thread%s, %s, settings %s\n", report->width,
                 report->height, report->threads, dip_cost_plural(report->threads), report->isa,
                 settings);
    dip_put_text(
        out,
        "times    %d frames along the path in %d rounds, each beside the base, in an order by "
        "seed %d; ratio = time / the base's time\n",
        dip_cost_frame_count(report), report->rounds, report->options.seed);
    dip_put_text(out, "machine was %s: %s\n", dip_cost_verdict_names[report->verdict],
                 report->verdict_reason);
    dip_put_text(out, "energy   %s\n", axes->energy);
    print_errors_heading(axes, out);
    dip_put_text(
        out,
        "memory   of the row's renderer; all rows share the scene's textures, %.1f MiB, and "
        "geometry, %.1f MiB\n",
        (double)axes->scene_texture_bytes / mebibyte, counter(axes, "geometry_bytes") / mebibyte);
    dip_put_text(out, "pictures %lld were compared with the base's and have the same bits\n",
                 (long long)axes->checked_pictures);
    if (*axes->note) {
        dip_put_text(out, "note     %s\n", axes->note);
    }
}

// Prints a number in a column of 8, or a dash if it is not known.
static void print_known(double value, int digits, FILE *out) {
    if (isfinite(value)) {
        dip_put_text(out, " %8.*f", digits, value);
    } else {
        dip_put_text(out, " %8s", "-");
    }
}

static void print_estimate(const DipEstimate *estimate, int digits, FILE *out) {
    char interval[48];
    snprintf(interval, sizeof interval, "%.*f to %.*f", digits, estimate->low, digits,
             estimate->high);
    dip_put_text(out, " %8.*f %-17s", digits, estimate->value, interval);
}

static void print_columns(const DipCostAxes *axes, DipCostAxis axis, FILE *out) {
    dip_put_text(out, "\n%-22s %8s %-17s %8s %-17s %8s %8s", dip_cost_axis_titles[axis], "mean ms",
                 "95 % interval", "ratio", "95 % interval", "MiB", "mJ/frame");
    if (axis == DIP_COST_AXIS_SIZE) {
        dip_put_text(out, " %8s", "ns/pixel");
    } else if (axis == DIP_COST_AXIS_SCALE) {
        dip_put_text(out, " %8s %8s", "drawing", "enlarge");
        if (is_judged(axes, 0)) {
            dip_put_text(out, " %8s %8s", "RMSE", "FLIP");
        }
    } else if (axis == DIP_COST_AXIS_THREADS) {
        dip_put_text(out, " %8s %-17s %8s", "speed-up", "95 % interval", "of ideal");
    }
    dip_put_text(out, "\n");
}

static void print_row(const DipCostAxes *axes, int row, FILE *out) {
    const DipCostAxisRow *r = &axes->rows[row];
    char name[2 * DIP_COST_AXIS_NAME];
    snprintf(name, sizeof name, r->axis == DIP_COST_AXIS_SCALE ? "%s (%dx%d)" : "%s", r->name,
             r->width, r->height);
    dip_put_text(out, "  %-20s", name);
    print_estimate(&time_of(axes, row)->mean_ms, 2, out);
    print_estimate(&time_of(axes, row)->ratio, 3, out);
    print_known(r->memory_bytes / mebibyte, 2, out);
    print_known(r->frame_mj, 1, out);
    if (r->axis == DIP_COST_AXIS_SIZE) {
        print_known(ns_per_pixel(axes, row), 2, out);
    } else if (r->axis == DIP_COST_AXIS_SCALE) {
        print_known(draw_ms(axes, row), 2, out);
        print_known(enlarge_ms(axes, row), 2, out);
        if (is_judged(axes, row)) {
            const DipMetrics errors = dip_cost_row_metrics(&axes->report, row, 0);
            print_known(errors.rmse_lin, 5, out);
            print_known(errors.flip, 5, out);
        }
    } else if (r->axis == DIP_COST_AXIS_THREADS) {
        print_estimate(&r->speed_up, 2, out);
        dip_put_text(out, " %6.0f %%", 100.0 * r->efficiency);
    }
    dip_put_text(out, "\n");
}

void dip_cost_axes_print(const DipCostAxes *axes, FILE *out) {
    print_heading(axes, out);
    DipCostAxis axis = DIP_COST_AXIS_COUNT;
    for (int row = 0; row < axes->report.row_count; row++) {
        if (row == 0 || axes->rows[row].axis != axis) {
            axis = axes->rows[row].axis;
            print_columns(axes, axis, out);
        }
        print_row(axes, row, out);
    }
}
