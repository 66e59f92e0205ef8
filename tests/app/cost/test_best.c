// Tests the search for the best settings on pictures that were really drawn: the FLIP of all
// combinations of recorded_space.h was recorded in several scenes (record_flip.c). Times are made
// up, and the models of work are wrong by several per cent. So the best combination within a budget
// is known, and those that the search measures and advises are compared with it.
#include "app/cost/steps.h"
#include "app/report/combinations.h"
#include "renderer/catalogue/random.h"
#include "recorded_space.h"
#include "recorded_scenes.inc"

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

enum { MOST = 1 << 13, BUDGETS = 6, SCENES = sizeof recorded_scenes / sizeof *recorded_scenes };

// On 60 other draws, 57 cases were good, the mean was .0026, and 25 combinations were measured for
// the budget (and 5 for the Pareto front). The search before this one had 54, .0048 and 36 in all.
static const double least_good = 0.9, most_mean = 0.004, most_measured = 32.0;

static const unsigned combined = BIT(AA) | BIT(TAA) | BIT(AAA) | BIT(AF) | BIT(AAF) | BIT(OPT) |
                                 BIT(MIPLOD) | BIT(SCALE) | BIT(UPSCALE) | BIT(POST) | BIT(SHARPEN);

// What is true of each combination.
typedef struct True {
    DipQuality quality;
    double counters[DIP_COUNTER_COUNT];
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
    const double shaded = dip_quality_groups_shade_all(quality) ? samples : 1.0;
    const double probes = 1.0 + 0.5 * step[DIP_SETTING_AF];
    memset(counters, 0, DIP_COUNTER_COUNT * sizeof *counters);
    counters[DIP_COUNTER_triangles_in] = 2e4;
    counters[DIP_COUNTER_samples_shown] = 3e5 * samples * scale * scale;
    counters[DIP_COUNTER_fragments_shaded] = 3e5 * scale * scale * shaded;
    counters[DIP_COUNTER_fragments_clip_tested] =
        4e4 * scale * scale * (1.0 + step[DIP_SETTING_AAA]);
    counters[DIP_COUNTER_texture_probes] = 3e5 * scale * scale * shaded * probes;
    counters[DIP_COUNTER_texels_fetched] =
        2e6 * scale * scale * shaded * probes * (1.0 + 0.1 * step[DIP_SETTING_MIPLOD]);
    counters[DIP_COUNTER_shadow_texels] = 1e5 * step[DIP_SETTING_SHADOWS];
    counters[DIP_COUNTER_pixels_filtered] = 3e5 * dip_cost_pixels_filtered(quality);
}

// A number of the machine's between two bounds for a stage's term. It depends on the term's name
// and not on its place, so that new terms leave the machines as they were.
static double draw_for(uint64_t seed, int stage, int term, double least, double most) {
    Random random = {seed + 1000 * (uint64_t)stage};
    for (const char *c = dip_cost_term_name(stage, term); *c; c++) {
        random = (Random){random_u64(&random) ^ (uint64_t)(unsigned char)*c};
    }
    return random_real(&random, least, most);
}

static DipCostModel make_model(uint64_t seed) {
    DipCostModel times = {.rows = 1};
    for (int stage = 0; stage < DIP_COST_STAGE_COUNT; stage++) {
        for (int t = 0; t < dip_cost_term_count(stage); t++) {
            times.prices[stage][t] = draw_for(seed, stage, t, 0.0, 2e-6);
        }
    }
    return times;
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
static void make_true(Machine *machine, const DipCostModel *times, True *is, double miss) {
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
            is->stage_ms[stage] += exp(off) * amounts[t] * times->prices[stage][t];
        }
        is->ms += is->stage_ms[stage];
    }
    is->p95_ms = 1.2 * is->ms * exp(0.01 * normal_of(own + 1));
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

// Lists what a run counts: the combinations of one option, those of two, and random ones of all.
static void list_predictions(DipCostReport *report, const True *all, int count, uint64_t seed) {
    DipCostPredictions *predicted = &report->predicted;
    Random random = {seed};
    predicted->list = calloc(DIP_COST_MAX_ROWS, sizeof *predicted->list);
    assert_non_null(predicted->list);
    predicted->searched = count;
    for (int i = 0; i < count; i++) {
        const int groups = dip_work_count_groups(&report->options.baseline, &all[i].quality);
        const bool corner = dip_work_is_corner(&report->options.baseline, &all[i].quality);
        if (groups <= 1 || corner || random_real(&random, 0.0, count) < 1024.0) {
            predicted->list[predicted->count++] =
                (DipCostPrediction){.quality = all[i].quality, .row = -1};
        }
    }
    for (int i = 0; i < predicted->count; i++) {
        make_work(&predicted->list[i].quality, predicted->list[i].counters);
    }
}

static void open_machine(Machine *machine, const RecordedScene *scene, uint64_t seed, double miss) {
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
    for (int i = 0; i < recorded_count(); i++) {
        const DipQuality quality = recorded_settings(i);
        assert_true(machine->count < MOST);
        all[machine->count].quality = quality;
        all[machine->count++].flip = recorded_value(scene->flip, i);
    }
    list_predictions(report, all, machine->count, seed);
    const DipCostModel times = make_model(seed);
    for (int i = 0; i < machine->count; i++) {
        make_true(machine, &times, &all[i], miss);
    }
    // The budget is 1.2 to 5 times the baseline's time.
    Random random = {seed + 5};
    report->options.budgets_ms[0] =
        random_real(&random, 1.2, 5.0) * find_true(machine, &report->options.baseline)->p95_ms;
    report->options.budget_count = 1;
}

static void measure_training(Machine *machine) {
    DipCostReport *report = &machine->report;
    DipCostPredictions *predicted = &report->predicted;
    int chosen[DIP_COST_MAX_ROWS], rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_training_count(combined, predicted->count);
    for (int i = 0; i < predicted->count; i++) { // As in a run, the sweeps are measured first.
        if (dip_work_count_groups(&report->options.baseline, &predicted->list[i].quality) <= 1) {
            assert_true(dip_cost_add_rows(report, &i, 1, rows, NULL));
        }
    }
    dip_cost_drop_slow_sample(report);
    assert_true(dip_cost_choose_training(report, count, chosen, NULL));
    assert_true(dip_cost_add_rows(report, chosen, count, rows, NULL));
    assert_true(measure(machine, rows, count, NULL));
    predicted->trained = count;
    predicted->times_left_out = dip_cost_model_leave_one_out(report, rows, count);
    machine->measured = 0;
}

// Returns by what share the FLIP of the advised settings lies above that of the best ones of all
// that fit. Adds to *measured how many combinations were measured in the search.
static double search(const RecordedScene *scene, uint64_t seed, double miss, int *measured) {
    Machine machine;
    open_machine(&machine, scene, seed, miss);
    measure_training(&machine);
    DipCostReport *report = &machine.report;
    assert_true(dip_cost_measure_best(report, NULL, measure, &machine, NULL));
    const DipCandidate *chosen = dip_cost_chosen(report, 0);
    const double budget_ms = report->options.budgets_ms[0];
    double best = INFINITY, found = INFINITY;
    for (int i = 0; i < machine.count; i++) {
        // A measurement tells surely that it fits.
        const bool fits = 1.01 * machine.all[i].p95_ms <= budget_ms;
        best = fits ? fmin(best, machine.all[i].flip) : best;
    }
    assert_non_null(chosen);
    assert_true(find_true(&machine, &chosen->quality)->p95_ms < 1.005 * budget_ms);
    // The fastest of those within 1 % of the least FLIP is advised: the least one counts.
    for (int r = 0; r < report->row_count; r++) {
        const True *is = find_true(&machine, &report->rows[r].quality);
        found = 1.01 * is->p95_ms <= budget_ms ? fmin(found, is->flip) : found;
    }
    const double share = found / best - 1.0;
    *measured += machine.measured;
    dip_cost_report_free(report);
    return share;
}

// Times are missed by 6 to 12 %. In nearly all cases the search measures a combination to which no
// other one that fits the budget is better by more than 1 % FLIP.
static void none_that_fits_is_clearly_better(void **state) {
    (void)state;
    int good = 0, measured = 0;
    double sum = 0.0;
    const char *given = getenv("DIPTYCH_TEST_BEST"); // How many budgets, and the first one's seed.
    int budgets = BUDGETS, first = 1;
    if (given) {
        sscanf(given, "%d:%d", &budgets, &first);
    }
    for (int s = 0; s < SCENES; s++) {
        int good_here = 0, measured_here = 0;
        double sum_here = 0.0;
        for (int i = 0; i < budgets; i++) {
            const double miss = 0.06 + 0.06 * i / budgets;
            const double share =
                search(&recorded_scenes[s], (uint64_t)(first + i + 1000 * s), miss, &measured_here);
            good_here += share <= DIP_CLEARLY_BETTER;
            sum_here += fmax(share, 0.0);
        }
        print_message("%s: %d of %d good, %.4f more FLIP in the mean, %.1f combinations measured\n",
                      recorded_scenes[s].name, good_here, budgets, sum_here / budgets,
                      (double)measured_here / budgets);
        good += good_here;
        measured += measured_here;
        sum += sum_here;
    }
    const double cases = (double)budgets * SCENES;
    print_message("all: %d of %.0f, %.4f, %.1f\n", good, cases, sum / cases, measured / cases);
    assert_true(good >= least_good * cases);
    assert_true(sum / cases <= most_mean);
    assert_true(measured / cases <= most_measured);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(none_that_fits_is_clearly_better),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
