// Reads and checks the options of `diptych cost`, and defines tables of options that other commands
// share.
#include "app/cost/options.h"

#include "app/measure/metrics/truth.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FIELD(name) offsetof(DipCostOptions, name)

// --- reading values ------------------------------------------------------------------------------

static bool read_part(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostOptions *cost = fields;
    int range[2];
    if (dip_option_integers(value, ':', 2, range) != 2 || range[0] < 0 || range[1] <= range[0]) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "A:B with 0 <= A < B <= the number of --places");
    }
    cost->first_place = range[0];
    cost->end_place = range[1];
    return true;
}

static bool read_samples(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostOptions *cost = fields;
    int count;
    if (!dip_integer_parse(value, strlen(value), &count) || count < 1 || count > 4096 ||
        lround(sqrt(count)) * lround(sqrt(count)) != count) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "a square number from 1 to 4096, such as 64 or 100");
    }
    cost->samples = count;
    return true;
}

static bool add_combined(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostOptions *cost = fields;
    char known[160] = "";
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const char *key = dip_setting_info((DipSetting)s)->key;
        if (strcmp(key, value) == 0) {
            cost->combined |= 1u << s;
            return true;
        }
        strcat(strcat(known, s ? ", " : ""), key);
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, row->name,
                         "'%.40s' is not a setting; give none, or some of %s", value, known);
}

static bool read_combined(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    const DipOptionRow list = {row->name, row->argument, DIP_OPTION_CUSTOM, .separator = ',',
                               .read = add_combined};
    ((DipCostOptions *)fields)->combined = 0;
    return strcmp(value, "none") == 0 || dip_option_store(&list, value, fields, err);
}

// Reads a budget in milliseconds, or for --fps a rate in frames a second.
static bool read_budget(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostOptions *cost = fields;
    double number;
    if (!dip_number_parse(value, strlen(value), &number) || number < 0.01 || number > 100000.0) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value, row->accepted);
    }
    if (cost->budget_count == DIP_COST_MAX_BUDGETS) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, row->name,
                             "lists more than %d values", DIP_COST_MAX_BUDGETS);
    }
    cost->budgets_ms[cost->budget_count++] =
        strcmp(row->name, "--fps") == 0 ? 1000.0 / number : number;
    return true;
}

void dip_cost_default_budgets(DipCostOptions *options) {
    if (options->budget_count == 0) {
        options->budgets_ms[options->budget_count++] = 1000.0 / 60.0;
        options->budgets_ms[options->budget_count++] = 1000.0 / 30.0;
    }
}

// Reads --viewing, which names a display and a distance. The pixels per degree are the distance
// times one degree in radians, divided by a pixel's width. A phone has 1170 pixels on 65 mm and is
// seen from 0.3 m. A monitor has 1920 pixels on 531 mm (24 inches) and is seen from 0.6 m. UHD is
// 3840 pixels on 0.7 m, seen from 0.7 m. For a headset, the value is the one that makers of
// headsets with 2000 pixels per eye stated in 2023.
static bool read_viewing(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    static const struct {
        const char *name;
        double pixels_per_degree;
    } viewings[] = {
        {"phone", 94.2}, {"monitor", 37.9}, {"uhd", DIP_FLIP_PIXELS_PER_DEGREE}, {"headset", 25.0}};
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(viewings); i++) {
        if (strcmp(value, viewings[i].name) == 0) {
            *(double *)fields = viewings[i].pixels_per_degree;
            return true;
        }
    }
    return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value,
                             "phone, monitor, uhd or headset");
}

// --- the tables ----------------------------------------------------------------------------------

static const DipOptionRow out_rows[] = {
    {"--out", "DIR", DIP_OPTION_TEXT,
     .text = "Write cost.json, cost.csv and cost.html into this folder. To continue an interrupted "
             "run of cost, give the same command again."},
};

static const DipOptionRow quick_rows[] = {
    {"--quick", NULL, DIP_OPTION_FLAG,
     .text = "Answer in a minute or two, with wider intervals: the same as --predict --starts 2 "
             "--rounds 3 --places 2 --burst 1 --samples 16, unless these options are given."},
};

static const DipOptionRow choice_rows[] = {
    {"--baseline", "SET", DIP_OPTION_SETTINGS, FIELD(baseline),
     .text = "The settings to start from. Cost changes one of them at a time and compares the "
             "result with the baseline. By default, every setting has its default."},
    {"--combine", "LIST", DIP_OPTION_CUSTOM, .given = FIELD(has_combined), .read = read_combined,
     .text = "Also measure every combination of the steps of these settings. The default is aa,af. "
             "With "
             "the word none, no combinations are measured. With --predict, these settings are "
             "searched."},
    {"--predict", NULL, DIP_OPTION_FLAG, FIELD(predict),
     .text =
         "Instead of measuring every combination, measure the steps of each setting and the few "
         "combinations that tell most about all others, predict the others, and measure those that "
         "the prediction finds best. Searches all settings but mipdebug, or those of --combine. "
         "This is the default with --fps or --budget-ms, unless --combine or --part is given."},
};

static const DipOptionRow budget_rows[] = {
    {"--fps", "LIST", DIP_OPTION_CUSTOM, .separator = ',', .read = read_budget,
     .accepted = "a number of frames a second from 0.01 to 100000",
     .text = "Advise settings that keep each of these numbers of frames a second, such as 60,120. "
             "The default is 60,30."},
    {"--budget-ms", "LIST", DIP_OPTION_CUSTOM, .separator = ',', .read = read_budget,
     .accepted = "a number of milliseconds from 0.01 to 100000",
     .text = "Advise settings for each of these times of a frame in milliseconds, such as 8,12. "
             "They may be given beside --fps. Four budgets are also printed as the tiers low, "
             "medium, high and ultra."},
    {"--budget-of", "TIME", DIP_OPTION_CHOICE, FIELD(budget_of), .names = dip_time_kind_names,
     .most = DIP_TIME_KIND_COUNT, .accepted = "p95, mean or worst",
     .text = "The time that must be within the budget: p95 (the 95th percentile of the frames "
             "along the path), mean or worst. The default is p95."},
};
static const DipOptionRow picture_rows[] = {
    {"--pictures", "KIND", DIP_OPTION_CHOICE, FIELD(pictures), .names = dip_cost_picture_kind_names,
     .most = DIP_ARRAY_COUNT(dip_cost_picture_kind_names), .accepted = "crops, full or none",
     .text = "The pictures in cost.html: crops (the part of each picture in which the steps differ "
             "most), full (whole frames, as many as fit in 10 MB, and otherwise crops) or none. "
             "The default is crops."},
};

static const DipOptionRow cache_rows[] = {
    {"--cache", "DIR", DIP_OPTION_TEXT,
     .text = "Keep the converged pictures in this folder. The default is $XDG_CACHE_HOME/diptych. "
             "If XDG_CACHE_HOME is not set, it is ~/.cache/diptych."},
};

static const DipOptionRow error_rows[] = {
    {"--places", "N", DIP_OPTION_INTEGER, FIELD(places), .least = 1, .most = DIP_COST_MAX_PLACES,
     .text = "Measure errors at this many viewpoints on each camera path. The default is 3."},
    {"--burst", "N", DIP_OPTION_INTEGER, FIELD(burst), .least = 1, .most = DIP_COST_MAX_BURST,
     .text = "Draw this many successive frames at each viewpoint, to measure flicker. The default "
             "is 2."},
    {"--samples", "N", DIP_OPTION_CUSTOM, .read = read_samples,
     .text = "Draw the converged picture in two halves with this many samples per pixel each. The "
             "number must be a square. The default is 64."},
    {"--part", "A:B", DIP_OPTION_CUSTOM, .read = read_part,
     .text = "Measure errors only at the viewpoints A to B - 1; the first viewpoint is 0. This "
             "lets several machines share the work. `diptych cost merge` joins their reports."},
    {"--save-truths", "DIR", DIP_OPTION_TEXT, FIELD(truths),
     .text = "Also write the converged pictures into this folder, as PFM files in linear light. "
             "Other programs can check the errors with them."},
};

static const DipOptionRow viewing_rows[] = {
    {"--pixels-per-degree", "X", DIP_OPTION_NUMBER, .least = DIP_FLIP_MIN_PIXELS_PER_DEGREE,
     .most = DIP_FLIP_MAX_PIXELS_PER_DEGREE,
     .text = "Pixels per degree of the viewer's field of view, for FLIP. The default 67.02 is for "
             "a display that is 0.7 m wide, has 3840 pixels in a row and is seen from 0.7 m."},
    {"--viewing", "HOW", DIP_OPTION_CUSTOM, .read = read_viewing,
     .text =
         "Set --pixels-per-degree for a usual way of viewing: phone (94.2), monitor (37.9, full "
         "HD), uhd (67.02, the default) or headset (25)."},
};

static const DipOptionRow time_rows[] = {
    {"--errors-only", NULL, DIP_OPTION_FLAG, FIELD(errors_only),
     .text = "Measure only errors, and no times."},
    {"--timed", "N", DIP_OPTION_INTEGER, FIELD(timed_frames), .least = 1, .most = 100,
     .text = "Time this many frames in each round, spread evenly over the path. The default is 4."},
    {"--require-quiet", NULL, DIP_OPTION_FLAG, FIELD(require_quiet),
     .text = "Exit with code 1 if other programs kept the machine so busy that the times are "
             "wrong. The report is written all the same."},
};

const DipOptionTable dip_out_option_table = DIP_OPTION_TABLE("What to measure", out_rows);
static const DipOptionTable quick_table = DIP_OPTION_TABLE("What to measure", quick_rows);
static const DipOptionTable choice_table = DIP_OPTION_TABLE("What to measure", choice_rows);
static const DipOptionTable error_table = DIP_OPTION_TABLE("Errors", error_rows);
static const DipOptionTable time_table = DIP_OPTION_TABLE("Times", time_rows);
const DipOptionTable dip_picture_option_table = DIP_OPTION_TABLE("Pictures", picture_rows);
const DipOptionTable dip_cost_budget_option_table = DIP_OPTION_TABLE("Budgets", budget_rows);
const DipOptionTable dip_viewing_option_table = DIP_OPTION_TABLE("Errors", viewing_rows);
const DipOptionTable dip_cache_option_table = DIP_OPTION_TABLE("Pictures", cache_rows);

static const DipOptionPart cost_parts[] = {
    {&dip_out_option_table, offsetof(DipCostArguments, out)},
    {&quick_table, offsetof(DipCostArguments, quick)},
    {&choice_table, offsetof(DipCostArguments, cost)},
    {&dip_cost_budget_option_table, offsetof(DipCostArguments, cost)},
    {&error_table, offsetof(DipCostArguments, cost)},
    {&dip_viewing_option_table, offsetof(DipCostArguments, cost.pixels_per_degree)},
    {&time_table, offsetof(DipCostArguments, cost)},
    {&dip_measure_option_table, offsetof(DipCostArguments, measure)},
    {&dip_starts_option_table, offsetof(DipCostArguments, measure)},
    {&dip_serve_option_table, offsetof(DipCostArguments, serve)},
    {&dip_picture_option_table, offsetof(DipCostArguments, cost)},
    {&dip_cache_option_table, offsetof(DipCostArguments, cost.cache)},
    {&dip_scene_option_table, offsetof(DipCostArguments, session)},
    {&dip_path_option_table, offsetof(DipCostArguments, session)},
    {&dip_size_option_table, offsetof(DipCostArguments, session)},
    {&dip_threads_option_table, offsetof(DipCostArguments, session)},
    {&dip_program_option_table, offsetof(DipCostArguments, program)},
};
const DipOptionParts dip_cost_option_parts = {cost_parts, DIP_ARRAY_COUNT(cost_parts)};

// --- defaults and checks -------------------------------------------------------------------------

void dip_cost_options_default(void *arguments) {
    DipCostArguments *all = arguments;
    all->measure = (DipMeasureOptions){.rounds = 4, .starts = 4};
    all->cost = (DipCostOptions){
        .baseline = dip_quality_default(),
        .places = 3,
        .burst = 2,
        .samples = DIP_TRUTH_SAMPLES,
        .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE,
        .timed_frames = 4,
    };
    // --quick sets defaults, so this function looks for it before the options are read. Otherwise
    // it would override the options that stand before it on the command line.
    for (int i = 0; i < all->program.argc; i++) {
        if (strcmp(all->program.argv[i], "--quick") == 0) {
            all->measure = (DipMeasureOptions){.rounds = 3, .starts = 2};
            all->cost.predict = true;
            all->cost.places = 2;
            all->cost.burst = 1;
            all->cost.samples = 16;
        }
    }
}

bool dip_cost_check_out(const char *out, DipError *err) {
    return out || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--out",
                                "there is no folder for the report; give one with --out DIR");
}

// Fails if all starts together have too few or too many rounds. There must be at least two, since
// the times of a single round have no interval.
static bool check_rounds(const DipMeasureOptions *measure, DipError *err) {
    const int rounds = measure->rounds * measure->starts;
    return (rounds >= 2 && rounds <= DIP_MEASURE_MOST_ROUNDS) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--rounds",
                         "there are %d rounds of all starts; accepted are 2 to %d", rounds,
                         DIP_MEASURE_MOST_ROUNDS);
}

bool dip_cost_options_check(const void *arguments, DipError *err) {
    const DipCostArguments *all = arguments;
    const DipCostOptions *cost = &all->cost;
    if (!dip_cost_check_out(all->out, err) || !check_rounds(&all->measure, err)) {
        return false;
    }
    if (cost->end_place > cost->places) {
        return dip_error_set(
            err, DIP_ERROR_RANGE, NULL, 0, "--part",
            "ends at %d of %d viewpoints; give an end up to %d, or a greater --places",
            cost->end_place, cost->places, cost->places);
    }
    if (cost->errors_only && cost->budget_count) {
        return dip_error_set(
            err, DIP_ERROR_CONFLICT, NULL, 0, "--budget-ms",
            "advice needs times; leave out --fps and --budget-ms, or --errors-only");
    }
    if (cost->predict && (cost->errors_only || cost->first_place > 0 || cost->end_place > 0)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--predict",
                             "a prediction needs times and all viewpoints; leave out "
                             "--errors-only and --part, or --predict");
    }
    return dip_session_options_check(&all->session, err);
}
