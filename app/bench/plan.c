// Makes every combination of the values of all axes, and writes their labels.
#include "app/bench/plan.h"

#include "app/bench/enlarge.h"
#include "app/cli/machine.h"

#include <stdio.h>
#include <string.h>

static void fill_in(DipBenchOptions *options, const DipSession *session) {
    const DipConfig *config = &session->config;
    if (!options->threads_count) {
        options->threads[options->threads_count++] = dip_pool_thread_count(session->pool);
    }
    for (int i = 0; i < options->threads_count; i++) {
        if (options->threads[i] == 0) {
            options->threads[i] = dip_machine_processor_count();
        }
    }
    if (!options->isa_count) {
        options->isas[options->isa_count++] = session->isa;
    }
    if (!options->size_count) {
        options->sizes[options->size_count++] =
            (DipOptionSize){config->res.width, config->res.height};
    }
    if (!options->scale_count) {
        options->scales[options->scale_count++] = 1.0;
    }
    options->measure.seed = dip_measure_seed(&options->measure);
}

void dip_bench_plan_make(DipBenchPlan *plan, const DipSession *session,
                         const DipBenchOptions *options) {
    plan->options = *options;
    fill_in(&plan->options, session);
    const DipBenchOptions *o = &plan->options;
    const int counts[DIP_BENCH_AXIS_COUNT] = {
        [DIP_BENCH_AXIS_GRID] = o->grid_count ? o->grid_count : 1,
        [DIP_BENCH_AXIS_SIZE] = o->size_count,
        [DIP_BENCH_AXIS_SCALE] = o->scale_count,
        [DIP_BENCH_AXIS_SET] = o->set_count,
        [DIP_BENCH_AXIS_ISA] = o->isa_count,
        [DIP_BENCH_AXIS_THREADS] = o->threads_count,
    };
    memcpy(plan->counts, counts, sizeof counts);
    plan->count = 1;
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        plan->count *= counts[axis];
    }
    for (int i = 0; i < plan->count; i++) {
        int rest = i;
        for (int axis = DIP_BENCH_AXIS_COUNT - 1; axis >= 0; axis--) {
            plan->combinations[i].at[axis] = rest % counts[axis];
            rest /= counts[axis];
        }
    }
    plan->base = 0;
    for (int i = 0; i < plan->count; i += o->set_count * o->isa_count * o->threads_count) {
        const int *at = plan->combinations[i].at;
        const int *base = plan->combinations[plan->base].at;
        if (at[DIP_BENCH_AXIS_GRID] + at[DIP_BENCH_AXIS_SIZE] == 0 &&
            o->scales[at[DIP_BENCH_AXIS_SCALE]] > o->scales[base[DIP_BENCH_AXIS_SCALE]]) {
            plan->base = i;
        }
    }
}

int dip_bench_fewest_threads(const DipBenchPlan *plan, int combination) {
    const int *threads = plan->options.threads;
    int fewest = 0;
    for (int t = 1; t < plan->options.threads_count; t++) {
        fewest = threads[t] < threads[fewest] ? t : fewest;
    }
    return combination - plan->combinations[combination].at[DIP_BENCH_AXIS_THREADS] + fewest;
}

int dip_bench_same_pictures(const DipBenchPlan *plan, int combination) {
    return combination - combination % (plan->options.isa_count * plan->options.threads_count);
}

void dip_bench_drawn_size(const DipBenchPlan *plan, const DipBenchCombination *combination,
                          int *width, int *height) {
    const DipOptionSize size = plan->options.sizes[combination->at[DIP_BENCH_AXIS_SIZE]];
    dip_enlarger_source_size(size.width, size.height,
                             plan->options.scales[combination->at[DIP_BENCH_AXIS_SCALE]], width,
                             height);
}

void dip_bench_value_name(const DipBenchPlan *plan, const DipBenchCombination *combination,
                          DipBenchAxis axis, char *name, size_t size_bytes) {
    const DipBenchOptions *options = &plan->options;
    const int at = combination->at[axis];
    *name = '\0';
    switch (axis) {
    case DIP_BENCH_AXIS_GRID:
        if (options->grid_count) {
            snprintf(name, size_bytes, "%d triangles", options->grids[at]);
        }
        break;
    case DIP_BENCH_AXIS_SIZE:
        snprintf(name, size_bytes, "%dx%d", options->sizes[at].width, options->sizes[at].height);
        break;
    case DIP_BENCH_AXIS_SCALE:
        if (plan->counts[axis] > 1 || options->scales[at] < 1.0) {
            int width, height;
            dip_bench_drawn_size(plan, combination, &width, &height);
            snprintf(name, size_bytes, "scale %.10g (%dx%d)", options->scales[at], width, height);
        }
        break;
    case DIP_BENCH_AXIS_SET:
        snprintf(name, size_bytes, "%s", options->sets[at].text);
        break;
    case DIP_BENCH_AXIS_ISA:
        snprintf(name, size_bytes, "%s", dip_isa_name(options->isas[at]));
        break;
    default:
        snprintf(name, size_bytes, "%d thread%s", options->threads[at],
                 options->threads[at] == 1 ? "" : "s");
    }
}

// Writes the values on the axes that vary, except `without`, or on those that do not.
static void write_label(const DipBenchPlan *plan, const DipBenchCombination *combination,
                        bool varies, DipBenchAxis without, char label[DIP_BENCH_LABEL_SIZE]) {
    *label = '\0';
    for (int axis = 0; axis < DIP_BENCH_AXIS_COUNT; axis++) {
        const size_t used = strlen(label);
        char value[DIP_BENCH_LABEL_SIZE];
        dip_bench_value_name(plan, combination, (DipBenchAxis)axis, value, sizeof value);
        if ((plan->counts[axis] > 1) == varies && axis != (int)without && *value) {
            snprintf(label + used, DIP_BENCH_LABEL_SIZE - used, "%s%.90s", used ? ", " : "", value);
        }
    }
}

void dip_bench_label(const DipBenchPlan *plan, const DipBenchCombination *combination,
                     DipBenchAxis without, char label[DIP_BENCH_LABEL_SIZE]) {
    write_label(plan, combination, true, without, label);
    if (!*label) {
        dip_bench_value_name(plan, combination, DIP_BENCH_AXIS_SET, label, DIP_BENCH_LABEL_SIZE);
    }
}

void dip_bench_fixed_label(const DipBenchPlan *plan, char label[DIP_BENCH_LABEL_SIZE]) {
    write_label(plan, plan->combinations, false, DIP_BENCH_AXIS_COUNT, label);
}
