// Makes every combination of the values of all axes (plan.h), and writes the labels of
// combinations.
#include "app/bench/plan.h"

#include "app/cli/machine.h"
#include "app/files/put.h"

#include <math.h>
#include <stdio.h>

// Gives each axis without values its default (plan.h), replaces 0 threads by the number of
// processors, and chooses the seed.
static void fill_in(DipBenchOptions *options, const DipSession *session) {
    const DipConfig *config = &session->config;
    int *counts = options->counts;
    if (!counts[DIP_BENCH_AXIS_THREADS]) {
        options->threads[0] = dip_pool_thread_count(session->pool);
    }
    for (int i = 0; i < counts[DIP_BENCH_AXIS_THREADS]; i++) {
        if (options->threads[i] == 0) {
            options->threads[i] = dip_machine_processor_count();
        }
    }
    if (!counts[DIP_BENCH_AXIS_ISA]) {
        options->isas[0] = session->isa;
    }
    if (!counts[DIP_BENCH_AXIS_SIZE]) {
        options->sizes[0] = (DipOptionSize){config->res.width, config->res.height};
    }
    if (!counts[DIP_BENCH_AXIS_SCALE]) {
        options->scales[0] = 1.0;
    }
    if (!counts[DIP_BENCH_AXIS_GRID]) {
        options->grids[0] = 0;
    }
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        counts[axis] = counts[axis] ? counts[axis] : 1;
    }
    options->measure.seed = dip_measure_seed(&options->measure);
}

void dip_bench_plan_make(DipBenchPlan *plan, const DipSession *session,
                         const DipBenchOptions *options) {
    plan->options = *options;
    fill_in(&plan->options, session);
    const DipBenchOptions *o = &plan->options;
    const int *counts = o->counts;
    plan->count = 1;
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        plan->count *= counts[axis];
    }
    for (int i = 0; i < plan->count; i++) {
        int rest = i;
        for (int axis = DIP_BENCH_AXIS_COUNT - 1; axis >= 0; axis--) {
            plan->at[i][axis] = rest % counts[axis];
            rest /= counts[axis];
        }
    }
    plan->base = 0;
    for (int i = 0; i < plan->count; i += counts[DIP_BENCH_AXIS_SET] * counts[DIP_BENCH_AXIS_ISA] *
                                          counts[DIP_BENCH_AXIS_THREADS]) {
        const int *at = plan->at[i];
        const int *base = plan->at[plan->base];
        if (at[DIP_BENCH_AXIS_GRID] + at[DIP_BENCH_AXIS_SIZE] == 0 &&
            o->scales[at[DIP_BENCH_AXIS_SCALE]] > o->scales[base[DIP_BENCH_AXIS_SCALE]]) {
            plan->base = i;
        }
    }
}

int dip_bench_fewest_threads(const DipBenchPlan *plan, int combination) {
    const int *threads = plan->options.threads;
    int fewest = 0;
    for (int t = 1; t < plan->options.counts[DIP_BENCH_AXIS_THREADS]; t++) {
        fewest = threads[t] < threads[fewest] ? t : fewest;
    }
    return combination - plan->at[combination][DIP_BENCH_AXIS_THREADS] + fewest;
}

int dip_bench_same_pictures(const DipBenchPlan *plan, int combination) {
    return combination - combination % (plan->options.counts[DIP_BENCH_AXIS_ISA] *
                                        plan->options.counts[DIP_BENCH_AXIS_THREADS]);
}

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

void dip_bench_drawn_size(int width, int height, double scale, int *to_width, int *to_height) {
    // The number of sizes up to width x height that have exactly this aspect ratio.
    const int steps = divisor(width, height);
    const int step = scaled(steps, scale);
    *to_width = width / steps * step;
    *to_height = height / steps * step;
    if (fabs(*to_width - scale * width) > 0.02 * scale * width) {
        *to_width = scaled(width, scale);
        *to_height = scaled(height, scale);
    }
}

DipBenchValues dip_bench_values(const DipBenchPlan *plan, int combination) {
    const DipBenchOptions *options = &plan->options;
    const int *at = plan->at[combination];
    DipBenchValues values = {
        .triangles = options->grids[at[DIP_BENCH_AXIS_GRID]],
        .size = options->sizes[at[DIP_BENCH_AXIS_SIZE]],
        .scale = options->scales[at[DIP_BENCH_AXIS_SCALE]],
        .set = &options->sets[at[DIP_BENCH_AXIS_SET]],
        .isa = options->isas[at[DIP_BENCH_AXIS_ISA]],
        .threads = options->threads[at[DIP_BENCH_AXIS_THREADS]],
    };
    dip_bench_drawn_size(values.size.width, values.size.height, values.scale, &values.drawn.width,
                         &values.drawn.height);
    return values;
}

void dip_bench_value_name(const DipBenchPlan *plan, int combination, DipBenchAxis axis, char *name,
                          size_t size_bytes) {
    const DipBenchValues v = dip_bench_values(plan, combination);
    *name = '\0';
    switch (axis) {
    case DIP_BENCH_AXIS_GRID:
        if (v.triangles) {
            snprintf(name, size_bytes, "%d triangles", v.triangles);
        }
        break;
    case DIP_BENCH_AXIS_SIZE:
        snprintf(name, size_bytes, "%dx%d", v.size.width, v.size.height);
        break;
    case DIP_BENCH_AXIS_SCALE:
        if (plan->options.counts[axis] > 1 || v.scale < 1.0) {
            snprintf(name, size_bytes, "scale %.10g (%dx%d)", v.scale, v.drawn.width,
                     v.drawn.height);
        }
        break;
    case DIP_BENCH_AXIS_SET:
        snprintf(name, size_bytes, "%.90s", v.set->text);
        break;
    case DIP_BENCH_AXIS_ISA:
        snprintf(name, size_bytes, "%s", dip_isa_name(v.isa));
        break;
    default:
        snprintf(name, size_bytes, "%d thread%s", v.threads, v.threads == 1 ? "" : "s");
    }
}

// If `varies` is true, writes a combination's values on the axes that vary, otherwise its values on
// the axes that do not vary. Leaves out the axis `without`.
static void write_label(const DipBenchPlan *plan, int combination, bool varies,
                        DipBenchAxis without, char label[DIP_BENCH_LABEL_SIZE]) {
    *label = '\0';
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        char value[DIP_BENCH_LABEL_SIZE];
        dip_bench_value_name(plan, combination, (DipBenchAxis)axis, value, sizeof value);
        if ((plan->options.counts[axis] > 1) == varies && axis != (int)without && *value) {
            dip_put_append(label, DIP_BENCH_LABEL_SIZE, "%s%.90s", *label ? ", " : "", value);
        }
    }
}

void dip_bench_label(const DipBenchPlan *plan, int combination, DipBenchAxis without,
                     char label[DIP_BENCH_LABEL_SIZE]) {
    write_label(plan, combination, true, without, label);
    if (!*label) {
        dip_bench_value_name(plan, combination, DIP_BENCH_AXIS_SET, label, DIP_BENCH_LABEL_SIZE);
    }
}

void dip_bench_fixed_label(const DipBenchPlan *plan, char label[DIP_BENCH_LABEL_SIZE]) {
    write_label(plan, 0, false, DIP_BENCH_AXIS_COUNT, label);
}
