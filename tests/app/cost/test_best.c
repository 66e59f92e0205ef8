// Tests the search for the best settings on made-up machines, whose times and errors are known for
// every combination. The models of work and of FLIP are wrong there by several per cent. The
// combinations that are measured and advised are compared with the best of all.
#include "app/cost/steps.h"
#include "app/report/combinations.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define BIT(NAME) (1u << DIP_SETTING_##NAME)

enum { MOST = 1 << 16 };

static int machines = 24;

// Bounds that the search kept on six other draws of 40 machines each: there, 75 to 88 % were good,
// and the means were .005 to .019. A search with one go has 50 to 55 % good ones and .026 to .033.
static const double least_good = 0.7;
static const double most_mean = 0.02;

static const unsigned combined = BIT(AA) | BIT(AAA) | BIT(ASD) | BIT(AF) | BIT(MIPLOD) |
                                 BIT(SCALE) | BIT(UPSCALE) | BIT(SHADOWS);

// What is true of each combination.
typedef struct True {
    DipQuality quality;
    double counters[DIP_COST_COUNTER_COUNT];
    double stage_ms[DIP_COST_STAGE_COUNT];
    double ms;
    double p95_ms;
    double flip;
} True;

typedef struct Machine {
    DipCostReport report;
    uint64_t seed;
    True *all;
    int count;
    int measured; // After those that the models were fitted to first.
} Machine;

// --- what is true --------------------------------------------------------------------------------

// Every group of settings multiplies the work by a factor of its own.
static void make_work(const DipQuality *quality, double *counters) {
    const uint8_t *step = quality->step;
    const double scale = dip_quality_scale(quality);
    const double samples = dip_quality_sample_count(quality);
    const double probes = 1.0 + 0.5 * step[DIP_SETTING_AF];
    memset(counters, 0, DIP_COST_COUNTER_COUNT * sizeof *counters);
    counters[DIP_COST_COUNTER_triangles_in] = 2e4;
    counters[DIP_COST_COUNTER_samples_shown] = 3e5 * samples * scale * scale;
    counters[DIP_COST_COUNTER_fragments_shaded] = 3e5 * scale * scale;
    counters[DIP_COST_COUNTER_fragments_clip_tested] =
        4e4 * scale * scale * (1.0 + step[DIP_SETTING_AAA]);
    counters[DIP_COST_COUNTER_texture_probes] = 3e5 * scale * scale * probes;
    counters[DIP_COST_COUNTER_texels_fetched] =
        2e6 * scale * scale * probes * (1.0 + 0.1 * step[DIP_SETTING_MIPLOD]);
    counters[DIP_COST_COUNTER_shadow_texels] = 1e5 * step[DIP_SETTING_SHADOWS];
    counters[DIP_COST_COUNTER_pixels_filtered] = 3e5 * dip_cost_pixels_filtered(quality);
}

// The usual prices of FLIP. Terms that are not listed have none.
static const struct {
    const char *term;
    double price;
} flip_prices[] = {
    {"picture", 0.03},
    {"one sample", 0.012},
    {"per sample", 0.015},
    {"several samples, per group", 0.012},
    {"one probe", 0.006},
    {"per probe", 0.012},
    {"miplod=quality", 0.01},
    {"miplod=performance", 0.01},
    {"miplod=high-performance", 0.01},
    {"miplod=sharp", -0.003},
    {"miplod=sharper", 0.004},
    {"scale above 1, per step", -0.03},
    {"scale below 1, bilinear", 0.05},
    {"scale below 1, bicubic", 0.045},
    {"scale below 1, EASU", 0.04},
    {"shadows", -0.004},
    {"shadows, per texel", 0.002},
};

// A number of the machine's between two bounds for a part's term. It depends on the term's name and
// not on its place, so that new terms leave the machines as they were.
static double draw_for(uint64_t seed, int part, int term, double least, double most) {
    Random random = {seed + 1000 * (uint64_t)part};
    for (const char *c = dip_cost_term_name(part, term); *c; c++) {
        random = (Random){random_u64(&random) ^ (uint64_t)(unsigned char)*c};
    }
    return random_real(&random, least, most);
}

static DipCostModels make_models(uint64_t seed) {
    DipCostModels models = {.times = {.what = DIP_COST_TIME, .rows = 1},
                            .errors = {.what = DIP_COST_FLIP_ERROR, .rows = 1}};
    for (int part = 0; part < DIP_COST_PART_FLIP; part++) {
        for (int t = 0; t < dip_cost_term_count(part); t++) {
            models.times.prices[part][t] = draw_for(seed, part, t, 0.0, 2e-6);
        }
    }
    double *prices = models.errors.prices[DIP_COST_PART_FLIP];
    for (int t = 0; t < dip_cost_term_count(DIP_COST_PART_FLIP); t++) {
        for (size_t i = 0; i < sizeof flip_prices / sizeof *flip_prices; i++) {
            if (strcmp(dip_cost_term_name(DIP_COST_PART_FLIP, t), flip_prices[i].term) == 0) {
                prices[t] = flip_prices[i].price * draw_for(seed, DIP_COST_PART_FLIP, t, 0.5, 1.5);
            }
        }
    }
    return models;
}

// A normal variable that depends on nothing but the seed.
static double normal_of(uint64_t seed) {
    Random random = {seed};
    const double u = random_real(&random, 1e-9, 1.0), v = random_real(&random, 0.0, 1.0);
    return sqrt(-2.0 * log(u)) * cos(6.283185307179586 * v);
}

static uint64_t hash_settings(const DipQuality *quality, unsigned settings, uint64_t seed) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (settings >> s & 1) {
            Random random = {seed ^ (uint64_t)quality->step[s] << 8 * (s % 7)};
            seed = random_u64(&random);
        }
    }
    return seed;
}

// Returns what no model of single groups explains, with a standard deviation of about 1 over all
// combinations: each two groups whose settings are off the baseline have an effect of their own.
static double together(const DipQuality *base, const DipQuality *quality, uint64_t seed) {
    double sum = 0.0;
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        for (int h = g + 1; h < DIP_WORK_GROUPS; h++) {
            const unsigned both[] = {dip_work_group(g), dip_work_group(h)};
            const DipQuality one = dip_cost_take_settings(base, quality, both[0]);
            const DipQuality other = dip_cost_take_settings(base, quality, both[1]);
            if (!dip_quality_equal(&one, base) && !dip_quality_equal(&other, base)) {
                sum += normal_of(
                    hash_settings(quality, both[0] | both[1], seed + (uint64_t)(100 * g + h)));
            }
        }
    }
    return sum / sqrt(10.0);
}

static const double *find_listed(const void *context, const DipQuality *quality) {
    const DipCostReport *report = context;
    const int found = dip_work_count_groups(&report->options.baseline, quality) <= 1
                          ? dip_report_find_predicted(&report->predicted, quality)
                          : -1;
    return found >= 0 ? report->predicted.list[found].counters : NULL;
}

// `miss` is the standard deviation by which the models of work miss times.
static void make_true(Machine *machine, const DipCostModels *models, True *is, double miss) {
    const DipCostReport *report = &machine->report;
    const DipQuality *base = &report->options.baseline, *quality = &is->quality;
    assert_true(dip_work_compose(find_listed, report, base, quality, is->counters));
    const uint64_t own = hash_settings(quality, ~0u, machine->seed);
    const double off = miss * (0.9 * together(base, quality, machine->seed) + 0.4 * normal_of(own));
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        double amounts[DIP_COST_MAX_TERMS];
        dip_cost_terms(stage, is->counters, quality, amounts);
        is->stage_ms[stage] = 0.0;
        for (int t = 0; t < dip_cost_term_count(stage); t++) {
            is->stage_ms[stage] += exp(off) * amounts[t] * models->times.prices[stage][t];
        }
        is->ms += is->stage_ms[stage];
    }
    is->p95_ms = 1.2 * is->ms * exp(0.01 * normal_of(own + 1));
    is->flip = dip_cost_model_value(&models->errors, is->counters, quality) *
               exp(0.02 * together(base, quality, machine->seed + 77) + 0.002 * normal_of(own + 2));
}

// --- measuring it --------------------------------------------------------------------------------

static const True *find_true(const Machine *machine, const DipQuality *quality) {
    for (int i = 0; i < machine->count; i++) {
        if (dip_quality_equal(&machine->all[i].quality, quality)) {
            return &machine->all[i];
        }
    }
    fail_msg("a combination is not among all of them");
    return NULL;
}

// Times are known to .4 %, as after races.
static DipEstimate measure_ms(double ms, uint64_t seed) {
    return dip_estimate_make(ms * exp(0.003 * normal_of(seed)), 0.004, 15.0);
}

static bool measure(void *context, const int *rows, int count, DipError *err) {
    Machine *machine = context;
    DipCostReport *report = &machine->report;
    for (int i = 0; i < count; i++) {
        DipCostRow *row = &report->rows[rows[i]];
        const True *is = find_true(machine, &row->quality);
        const uint64_t seed = machine->seed + 1000 * (uint64_t)rows[i];
        row->time = (DipPathEstimate){.mean_ms = measure_ms(is->ms, seed),
                                      .p95_ms = measure_ms(is->p95_ms, seed + 1),
                                      .ratio_error = 0.003,
                                      .p95_error = 0.003,
                                      .worst_error = 0.003,
                                      .level_error = 0.002};
        memcpy(row->stage_ms, is->stage_ms, sizeof row->stage_ms);
        memcpy(row->counters, is->counters, sizeof row->counters);
        row->viewpoints[0].regions[0].pixels = 1.0;
        row->viewpoints[0].regions[0].flip = is->flip;
        row->judged[0] = true;
    }
    machine->measured += count;
    return dip_cost_choose(report, err);
}

static void open_machine(Machine *machine, uint64_t seed, double miss) {
    static DipQuality list[MOST];
    static True all[MOST];
    DipCostReport *report = &machine->report;
    *machine = (Machine){.seed = seed * UINT64_C(0x9e3779b97f4a7c15), .all = all};
    memset(all, 0, sizeof all);
    *report = (DipCostReport){.path_count = 1, .rounds = 16};
    report->options = (DipCostOptions){.baseline = dip_quality_default(),
                                       .places = 1,
                                       .rounds = 16,
                                       .timed_frames = 1,
                                       .combined = combined};
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    assert_non_null(report->rows);
    assert_true(dip_cost_report_alloc(report, NULL));
    assert_true(dip_cost_list_predictions(report, NULL));
    for (int i = 0; i < report->predicted.count; i++) {
        make_work(&report->predicted.list[i].quality, report->predicted.list[i].counters);
    }
    const DipCostModels models = make_models(seed);
    machine->count = dip_cost_list_combinations(&report->options.baseline, combined, list, MOST);
    assert_true(machine->count > DIP_COST_MAX_ROWS && machine->count <= MOST);
    for (int i = 0; i < machine->count; i++) {
        all[i].quality = list[i];
        make_true(machine, &models, &all[i], miss);
    }
    // The budget is 1.5 to 4 times the baseline's time.
    Random random = {seed + 5};
    report->options.budgets_ms[0] =
        random_real(&random, 1.5, 4.0) * find_true(machine, &report->options.baseline)->p95_ms;
    report->options.budget_count = 1;
}

static void measure_training(Machine *machine) {
    DipCostReport *report = &machine->report;
    DipCostPredictions *predicted = &report->predicted;
    int chosen[DIP_COST_MAX_ROWS], rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_training_count(combined, predicted->count);
    dip_cost_drop_slow_sample(report);
    assert_true(dip_cost_choose_training(report, count, chosen, NULL));
    assert_true(dip_cost_add_rows(report, chosen, count, rows, NULL));
    assert_true(measure(machine, rows, count, NULL));
    predicted->trained = count;
    predicted->times_left_out = dip_cost_model_leave_one_out(report, DIP_COST_TIME, rows, count);
    predicted->errors_left_out =
        dip_cost_model_leave_one_out(report, DIP_COST_FLIP_ERROR, rows, count);
    machine->measured = 0;
}

// Returns by what share the FLIP of the advised settings lies above that of the best ones of all
// that fit. Adds to *measured how many combinations were measured in the search.
static double search(uint64_t seed, double miss, int *measured) {
    Machine machine;
    open_machine(&machine, seed, miss);
    measure_training(&machine);
    DipCostReport *report = &machine.report;
    assert_true(dip_cost_measure_best(report, NULL, measure, &machine, NULL));
    const DipCandidate *chosen = dip_cost_chosen(report, 0);
    const double budget_ms = report->options.budgets_ms[0];
    double best = INFINITY;
    for (int i = 0; i < machine.count; i++) {
        // A measurement tells surely that it fits.
        const bool fits = 1.01 * machine.all[i].p95_ms <= budget_ms;
        best = fits ? fmin(best, machine.all[i].flip) : best;
    }
    assert_non_null(chosen);
    assert_true(find_true(&machine, &chosen->quality)->p95_ms < 1.005 * budget_ms);
    const double share = chosen->flip / best - 1.0;
    *measured += machine.measured;
    dip_cost_report_free(report);
    return share;
}

// Times are missed by 6 to 12 %. On most machines no other combination that fits the budget is
// better than the advised one by more than 1 % FLIP. No search that measures few of them finds the
// best on all: what two settings do together is known only where both were measured.
static void none_that_fits_is_clearly_better(void **state) {
    (void)state;
    int good = 0, measured = 0;
    double sum = 0.0;
    for (int i = 0; i < machines; i++) {
        const double miss = 0.06 + 0.06 * i / (machines - 1);
        const double share = search((uint64_t)i + 1, miss, &measured);
        good += share <= DIP_CLEARLY_BETTER;
        sum += fmax(share, 0.0);
    }
    print_message(
        "none is clearly better on %d of %d machines, the advised settings have %.4f more "
        "FLIP in the mean, %.1f combinations measured\n",
        good, machines, sum / machines, (double)measured / machines);
    assert_true(good >= least_good * machines);
    assert_true(sum / machines <= most_mean);
}

// Usage: test_best [MACHINES]
int main(int argc, char **argv) {
    machines = argc > 1 ? atoi(argv[1]) : machines;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(none_that_fits_is_clearly_better),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
