// Listing the rows of `diptych cost axes`.
#include "app/cost/axes/axes.h"

#include "app/cost/plan.h"
#include "app/cli/machine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SIZE = DIP_MAX_FRAME_SIZE };

static const double default_scales[] = {0.5, 0.7071, 0.85, 1.0};
enum { DEFAULT_SCALES = sizeof default_scales / sizeof *default_scales };

// --- sizes ---------------------------------------------------------------------------------------

static int divisor(int a, int b) {
    while (b != 0) {
        const int rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static int scaled(int size, double scale) {
    const int rounded = (int)(size * scale + 0.5);
    return rounded > 0 ? rounded : 1;
}

void dip_cost_axes_scaled_size(int width, int height, double scale, int *to_width, int *to_height) {
    const int steps = divisor(width, height); // Sizes of the same shape that are at most as large.
    const int step = scaled(steps, scale);
    *to_width = width / steps * step;
    *to_height = height / steps * step;
    if (fabs(*to_width - scale * width) > 0.02 * scale * width) {
        *to_width = scaled(width, scale);
        *to_height = scaled(height, scale);
    }
}

// --- rows ----------------------------------------------------------------------------------------

// Adds a row that is like the base, and returns it for the caller to change.
static DipCostAxisRow *add_row(DipCostAxes *axes, DipCostAxis axis) {
    DipCostReport *report = &axes->report;
    DipCostAxisRow *row = &axes->rows[report->row_count];
    report->rows[report->row_count++] = (DipCostRow){.quality = report->options.baseline};
    if (row != axes->rows) {
        *row = axes->rows[0];
    }
    row->axis = axis;
    return row;
}

static void add_bases(DipCostAxes *axes, const DipSession *session) {
    const DipConfigSize size = session->pane_size;
    DipCostAxisRow *base = add_row(axes, DIP_COST_AXIS_BASE);
    *base = (DipCostAxisRow){
        .axis = DIP_COST_AXIS_BASE,
        .name = "base",
        .width = size.width,
        .height = size.height,
        .shown_width = size.width,
        .shown_height = size.height,
        .threads = dip_pool_thread_count(session->pool),
        .isa = session->isa,
        .memory_bytes = NAN,
        .frame_mj = NAN,
    };
    snprintf(add_row(axes, DIP_COST_AXIS_BASE)->name, DIP_COST_AXIS_NAME, "base again");
}

static void add_size(DipCostAxes *axes, int width, int height) {
    DipCostAxisRow *row = add_row(axes, DIP_COST_AXIS_SIZE);
    row->width = row->shown_width = width;
    row->height = row->shown_height = height;
    snprintf(row->name, sizeof row->name, "%dx%d", width, height);
}

// Half the base's size, the same, and twice, if it is not too large for a frame.
static void add_default_sizes(DipCostAxes *axes) {
    const int width = axes->rows[0].width, height = axes->rows[0].height;
    if (width > 1 && height > 1) {
        add_size(axes, width / 2, height / 2);
    }
    add_size(axes, width, height);
    if (2 * width <= MAX_SIZE && 2 * height <= MAX_SIZE) {
        add_size(axes, 2 * width, 2 * height);
    } else {
        snprintf(axes->note, sizeof axes->note,
                 "Twice the size, %dx%d, is left out: a frame has at most %d pixels in each "
                 "direction.",
                 2 * width, 2 * height, MAX_SIZE);
    }
}

static void add_scale(DipCostAxes *axes, double scale) {
    DipCostAxisRow *row = add_row(axes, DIP_COST_AXIS_SCALE);
    dip_cost_axes_scaled_size(row->shown_width, row->shown_height, scale, &row->width,
                              &row->height);
    snprintf(row->name, sizeof row->name, "%.10g", scale);
}

static void add_threads(DipCostAxes *axes, int threads) {
    DipCostAxisRow *row = add_row(axes, DIP_COST_AXIS_THREADS);
    row->threads = threads;
    snprintf(row->name, sizeof row->name, "%d", threads);
}

static void add_default_threads(DipCostAxes *axes) {
    int most = dip_machine_processor_count();
    most = most < DIP_MAX_THREADS ? most : DIP_MAX_THREADS;
    for (int threads = 1; threads < most; threads *= 2) {
        add_threads(axes, threads);
    }
    add_threads(axes, most);
}

static void add_isa(DipCostAxes *axes, DipIsa isa) {
    DipCostAxisRow *row = add_row(axes, DIP_COST_AXIS_ISA);
    row->isa = isa;
    snprintf(row->name, sizeof row->name, "%s", dip_isa_name(isa));
}

static void add_axes(DipCostAxes *axes, const DipCostAxisValues *v) {
    const unsigned wanted = v->axes;
    for (int i = 0; i < v->size_count; i++) {
        add_size(axes, v->sizes[i].width, v->sizes[i].height);
    }
    if (!v->size_count && (wanted & 1u << DIP_COST_AXIS_SIZE)) {
        add_default_sizes(axes);
    }
    const double *scales = v->scale_count ? v->scales : default_scales;
    const int scale_count = v->scale_count ? v->scale_count : DEFAULT_SCALES;
    for (int i = 0; i < scale_count && (wanted & 1u << DIP_COST_AXIS_SCALE); i++) {
        add_scale(axes, scales[i]);
    }
    for (int i = 0; i < v->threads_count; i++) {
        add_threads(axes, v->threads[i]);
    }
    if (!v->threads_count && (wanted & 1u << DIP_COST_AXIS_THREADS)) {
        add_default_threads(axes);
    }
    for (int i = 0; i < v->isa_count; i++) {
        add_isa(axes, v->isas[i]);
    }
    for (int isa = 0; isa < DIP_ISA_COUNT && !v->isa_count; isa++) {
        if ((wanted & 1u << DIP_COST_AXIS_ISA) && dip_isa_available((DipIsa)isa)) {
            add_isa(axes, (DipIsa)isa);
        }
    }
}

bool dip_cost_axes_plan(DipCostAxes *axes, const DipSession *session,
                        const DipCostAxesArguments *arguments, DipError *err) {
    *axes = (DipCostAxes){.report = {.options = arguments->cost}};
    DipCostReport *report = &axes->report;
    dip_cost_set_measure(&report->options, &arguments->measure, 1);
    report->rows = calloc(DIP_COST_AXES_MAX_ROWS, sizeof *report->rows);
    if (!report->rows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes", "out of memory");
    }
    dip_cost_describe(report, session);
    const int active = session->track.active;
    const bool has_path = active < DIP_CATEGORY_COUNT && session->track.categories[active].path;
    snprintf(report->paths[0], sizeof report->paths[0], "%s",
             dip_session_category(has_path ? active : 0));
    report->path_count = 1;
    add_bases(axes, session);
    report->same_rows[0] = 1;
    add_axes(axes, &arguments->values);
    report->combined_first = report->row_count;
    // Errors are measured at end_place viewpoints. The report's arrays have room for at least one.
    report->options.end_place = report->options.places;
    report->options.places += report->options.places == 0;
    axes->scene_texture_bytes =
        session->scene ? (int64_t)dip_scene_texture_bytes(session->scene) : 0;
    return dip_cost_report_alloc(report, err);
}

void dip_cost_axes_free(DipCostAxes *axes) {
    dip_cost_report_free(&axes->report);
}

// --- comparing -----------------------------------------------------------------------------------

bool dip_cost_axes_has_base_picture(const DipCostAxes *axes, int row) {
    const DipCostAxisRow *r = &axes->rows[row], *base = &axes->rows[0];
    return r->width == base->width && r->height == base->height &&
           r->shown_width == base->shown_width && r->shown_height == base->shown_height;
}

bool dip_cost_axes_check_picture(const DipCostAxes *axes, int row, int frame, const char *hash,
                                 const char *base_hash, DipError *err) {
    const DipCostAxisRow *r = &axes->rows[row];
    return strcmp(hash, base_hash) == 0 ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost axes",
                         "the picture of frame %d with %s %s has the hash %s, but the base's has "
                         "%s; they must be the same",
                         frame, dip_cost_axis_titles[r->axis], r->name, hash, base_hash);
}

void dip_cost_axes_compare_threads(DipCostAxes *axes) {
    int fewest = -1;
    for (int r = 0; r < axes->report.row_count; r++) {
        if (axes->rows[r].axis == DIP_COST_AXIS_THREADS &&
            (fewest < 0 || axes->rows[r].threads < axes->rows[fewest].threads)) {
            fewest = r;
        }
    }
    for (int r = 0; fewest >= 0 && r < axes->report.row_count; r++) {
        DipCostAxisRow *row = &axes->rows[r];
        if (row->axis != DIP_COST_AXIS_THREADS) {
            continue;
        }
        row->speed_up = dip_cost_ratio(&axes->report, fewest, r);
        row->efficiency = row->speed_up.value * axes->rows[fewest].threads / row->threads;
    }
}
