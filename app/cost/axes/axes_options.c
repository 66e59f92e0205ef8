// The options of `diptych cost axes`.
#include "app/cost/axes/axes_options.h"

#include "app/cost/axes/axes_energy.h"
#include "app/cli/machine.h"
#include "app/measure/metrics/truth.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define VALUE(name) offsetof(DipCostAxisValues, name)
#define COST(name)  offsetof(DipCostOptions, name)

const char *const dip_cost_axis_names[DIP_COST_AXIS_COUNT + 1] = {
#define AXIS_NAME(name, NAME, title) #name,
    DIP_COST_AXIS_LIST(AXIS_NAME)
#undef AXIS_NAME
        "base"};

const char *const dip_cost_axis_titles[DIP_COST_AXIS_COUNT + 1] = {
#define AXIS_TITLE(name, NAME, title) title,
    DIP_COST_AXIS_LIST(AXIS_TITLE)
#undef AXIS_TITLE
        "base"};

// --- the values of lists -------------------------------------------------------------------------

// A value that is given twice would make two rows of the same name.
static bool refuse_twice(const DipOptionRow *row, const char *value, DipError *err) {
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, row->name,
                         "'%.40s' is in the list twice; give each value once", value);
}

static bool read_axis(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostAxisValues *values = fields;
    for (int a = 0; a < DIP_COST_AXIS_COUNT; a++) {
        if (strcmp(value, dip_cost_axis_names[a]) == 0) {
            values->axes |= 1u << a;
            return true;
        }
    }
    return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value,
                             "size, scale, threads or isa");
}

static bool read_axes(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    ((DipCostAxisValues *)fields)->axes = 0;
    return dip_option_each(fields, row, value, ',', read_axis, err);
}

static bool read_size(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostAxisValues *values = fields;
    DipOptionSize size;
    if (!dip_option_size(row, value, &size, err)) {
        return false;
    }
    for (int i = 0; i < values->size_count; i++) {
        if (values->sizes[i].width == size.width && values->sizes[i].height == size.height) {
            return refuse_twice(row, value, err);
        }
    }
    values->sizes[values->size_count] = size;
    return true;
}

static bool read_scale(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostAxisValues *values = fields;
    double scale;
    if (!dip_number_parse(value, strlen(value), &scale) || !(scale >= 0.1 && scale <= 1.0)) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "a share of the width and height from 0.1 to 1");
    }
    for (int i = 0; i < values->scale_count; i++) {
        if (values->scales[i] == scale) {
            return refuse_twice(row, value, err);
        }
    }
    values->scales[values->scale_count] = scale;
    return true;
}

// More threads than processors would wait for each other, so that neither their time nor the
// verdict on the machine would tell anything.
static bool read_threads(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostAxisValues *values = fields;
    const int processors = dip_machine_processor_count();
    int count;
    if (dip_option_integers(value, ',', 1, &count) != 1 || count < 1 || count > processors ||
        count > DIP_MAX_THREADS) {
        char accepted[96];
        snprintf(accepted, sizeof accepted,
                 "a number of threads from 1 to %d, the processors of this machine", processors);
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value, accepted);
    }
    for (int i = 0; i < values->threads_count; i++) {
        if (values->threads[i] == count) {
            return refuse_twice(row, value, err);
        }
    }
    values->threads[values->threads_count] = count;
    return true;
}

static bool read_isa(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostAxisValues *values = fields;
    DipIsa isa;
    if (!dip_option_isa(row, value, &isa, err)) {
        return false;
    }
    for (int i = 0; i < values->isa_count; i++) {
        if (values->isas[i] == isa) {
            return refuse_twice(row, value, err);
        }
    }
    values->isas[values->isa_count] = isa;
    return true;
}

// --- the tables ----------------------------------------------------------------------------------

static const DipOptionRow value_rows[] = {
    {.name = "--axes",
     .argument = "LIST",
     .text = "What to vary: some of size, scale, threads and isa. The default is all of them.",
     .kind = DIP_OPTION_CUSTOM,
     .given = VALUE(has_axes),
     .read = read_axes},
    {.name = "--sizes",
     .argument = "LIST",
     .text = "Sizes of the picture, as WxH,WxH,... The default is half the width and height of "
             "--size, the same, and twice.",
     .kind = DIP_OPTION_LIST,
     .count = VALUE(size_count),
     .most = DIP_COST_AXIS_MAX_VALUES,
     .separator = ',',
     .read = read_size},
    {.name = "--scales",
     .argument = "LIST",
     .text = "Render scales from 0.1 to 1. The picture is drawn with this share of the width and "
             "height of --size, and enlarged to --size. The default is 0.5,0.7071,0.85,1.",
     .kind = DIP_OPTION_LIST,
     .count = VALUE(scale_count),
     .most = DIP_COST_AXIS_MAX_VALUES,
     .separator = ',',
     .read = read_scale},
    {.name = "--thread-counts",
     .argument = "LIST",
     .text = "Numbers of threads, such as 1,2,4, up to the number of processors. The default is 1, "
             "2, 4 and so on, and the number of processors.",
     .kind = DIP_OPTION_LIST,
     .count = VALUE(threads_count),
     .most = DIP_COST_AXIS_MAX_VALUES,
     .separator = ',',
     .read = read_threads},
    {.name = "--isas",
     .argument = "LIST",
     .text = "Instruction sets, such as scalar,avx2. The default is all that this machine has.",
     .kind = DIP_OPTION_LIST,
     .count = VALUE(isa_count),
     .most = DIP_COST_AXIS_MAX_VALUES,
     .separator = ',',
     .read = read_isa},
    {.name = "--json",
     .argument = "FILE",
     .text = "Also write everything, with the time of every frame, to this file.",
     .kind = DIP_OPTION_TEXT,
     .field = VALUE(json)},
    {.name = "--csv",
     .argument = "FILE",
     .text = "Also write a line per row to this file.",
     .kind = DIP_OPTION_TEXT,
     .field = VALUE(csv)},
    {.name = "--powercap",
     .argument = "DIR",
     .text = "Read the energy counters (intel-rapl:0/energy_uj and so on) in this folder. The "
             "default is " DIP_ENERGY_FOLDER ".",
     .kind = DIP_OPTION_TEXT,
     .field = VALUE(powercap)},
};

static const DipOptionRow cost_rows[] = {
    {.name = "--settings",
     .argument = "SET",
     .text = "The settings of all rows. By default, every setting has its default.",
     .kind = DIP_OPTION_SETTINGS,
     .field = COST(baseline)},
    {.name = "--timed",
     .argument = "N",
     .text = "Time this many frames in each round, spread evenly over the path. The default is 4.",
     .kind = DIP_OPTION_INTEGER,
     .field = COST(timed_frames),
     .least = 1,
     .most = 100},
    {.name = "--places",
     .argument = "N",
     .text = "Measure the errors of the render scales at this many viewpoints of the path; 0: "
             "measure no errors. The default is 3.",
     .kind = DIP_OPTION_INTEGER,
     .field = COST(places),
     .most = DIP_COST_MAX_PLACES},
    {.name = "--samples",
     .argument = "N",
     .text = "Draw the converged picture, with which errors are measured, in two halves with this "
             "many samples per pixel each. The number must be a square. The default is 64.",
     .kind = DIP_OPTION_CUSTOM,
     .read = dip_cost_read_samples},
    {.name = "--pixels-per-degree",
     .argument = "X",
     .text = "Pixels per degree of the viewer's field of view, for FLIP. The default is 67.02.",
     .kind = DIP_OPTION_NUMBER,
     .field = COST(pixels_per_degree),
     .least = DIP_FLIP_MIN_PIXELS_PER_DEGREE,
     .most = DIP_FLIP_MAX_PIXELS_PER_DEGREE},
    {.name = "--cache",
     .argument = "DIR",
     .text = "Keep the converged pictures in this folder, as `diptych cost` does.",
     .kind = DIP_OPTION_TEXT,
     .field = COST(cache)},
    {.name = "--require-quiet",
     .text = "Exit with code 1 if other programs kept the machine so busy that the times are "
             "wrong. The table and the files are written all the same.",
     .kind = DIP_OPTION_FLAG,
     .field = COST(require_quiet)},
};

static const DipOptionTable value_table = {"Rows and output", value_rows,
                                           DIP_ARRAY_COUNT(value_rows)};
static const DipOptionTable cost_table = {"Measuring", cost_rows, DIP_ARRAY_COUNT(cost_rows)};

static const DipOptionPart parts[] = {
    {&value_table, offsetof(DipCostAxesArguments, values)},
    {&cost_table, offsetof(DipCostAxesArguments, cost)},
    {&dip_measure_option_table, offsetof(DipCostAxesArguments, measure)},
    {&dip_scene_option_table, offsetof(DipCostAxesArguments, session)},
    {&dip_path_option_table, offsetof(DipCostAxesArguments, session)},
    {&dip_category_option_table, offsetof(DipCostAxesArguments, session)},
    {&dip_size_option_table, offsetof(DipCostAxesArguments, session)},
    {&dip_threads_option_table, offsetof(DipCostAxesArguments, session)},
    {&dip_program_option_table, offsetof(DipCostAxesArguments, program)},
};
const DipOptionParts dip_cost_axes_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

// --- defaults and checks -------------------------------------------------------------------------

void dip_cost_axes_options_default(void *arguments, int argc, char *const *argv) {
    (void)argc;
    (void)argv;
    DipCostAxesArguments *all = arguments;
    all->values.axes = (1u << DIP_COST_AXIS_COUNT) - 1;
    all->values.powercap = DIP_ENERGY_FOLDER;
    all->measure.rounds = 8;
    all->cost = (DipCostOptions){
        .baseline = dip_quality_default(),
        .places = 3,
        .burst = 1,
        .samples = DIP_TRUTH_SAMPLES,
        .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE,
        .timed_frames = 4,
    };
}

// A list of values of an axis that is left out would be ignored.
static bool check_list(const DipCostAxisValues *values, DipCostAxis axis, const char *option,
                       int count, DipError *err) {
    return count == 0 || (values->axes & 1u << axis) ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, option,
                         "--axes leaves out the axis %s; add it, or leave out the list",
                         dip_cost_axis_names[axis]);
}

bool dip_cost_axes_options_check(const void *arguments, DipError *err) {
    const DipCostAxesArguments *all = arguments;
    const DipCostAxisValues *v = &all->values;
    return dip_cost_check_rounds(&all->measure, 1, err) &&
           check_list(v, DIP_COST_AXIS_SIZE, "--sizes", v->size_count, err) &&
           check_list(v, DIP_COST_AXIS_SCALE, "--scales", v->scale_count, err) &&
           check_list(v, DIP_COST_AXIS_THREADS, "--thread-counts", v->threads_count, err) &&
           check_list(v, DIP_COST_AXIS_ISA, "--isas", v->isa_count, err) &&
           dip_session_options_check(&all->session, err);
}
