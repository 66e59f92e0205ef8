// Searches all combinations of the settings for those that the models predict to be best. There may
// be millions, so they are not listed: each is predicted, and only those that may be worth
// measuring are kept.
#include "app/cost/steps.h"

#include "app/report/combinations.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BINS = 512, // Each bin holds the best combination of a range of times, for the Pareto front.
    MIDDLE_BIN = 128, // The bin of the baseline's time.
    MOST_OPTIONS = 96 // Greatest number of combinations of the settings of one group.
};
static const double bin_width = 0.02; // Width of a bin's range on the scale of log time.

typedef struct Found {
    DipQuality quality;
    double ms;
    double loss; // The predicted FLIP, but at least the FLIP of the truth's noise.
    bool is_found;
} Found;

// What one task found: for each budget the best DIP_COST_PER_BUDGET combinations, best first, and
// for each range of times the best one.
typedef struct Best {
    Found (*budgets)[DIP_COST_PER_BUDGET];
    Found bins[BINS];
} Best;

// The combinations that differ from the baseline in the settings of one group, and the baseline.
typedef struct Options {
    const DipCostPrediction *list[MOST_OPTIONS];
    int count;
} Options;

typedef struct Search {
    const DipCostReport *report;
    const DipCostModels *models;
    Options groups[DIP_WORK_GROUPS];
    double floor_flip;
    double base_ms;
    Best *tasks; // [option of group 0]
} Search;

static bool is_better(const Found *a, const Found *b) {
    return !b->is_found || a->loss < b->loss ||
           (a->loss == b->loss && a->ms < b->ms); // NOLINT: an order, not a test.
}

// Puts the combination into a list of the best ones, if it is one of them.
static void insert(Found list[DIP_COST_PER_BUDGET], const Found *found) {
    int at = DIP_COST_PER_BUDGET;
    while (at > 0 && is_better(found, &list[at - 1])) {
        at--;
        if (at < DIP_COST_PER_BUDGET - 1) {
            list[at + 1] = list[at];
        }
        list[at] = *found;
    }
}

// Puts the combination among the best of each budget that it may fit, and into its bin.
static void keep(const Search *search, Best *best, const Found *found) {
    const DipCostOptions *options = &search->report->options;
    const double ms =
        options->budget_of == DIP_TIME_MEAN ? found->ms : found->ms * search->models->p95;
    for (int b = 0; b < options->budget_count; b++) {
        if (ms <= DIP_COST_MAY_FIT * options->budgets_ms[b]) {
            insert(best->budgets[b], found);
        }
    }
    const int bin = MIDDLE_BIN + (int)floor(log(found->ms / search->base_ms) / bin_width);
    Found *of_bin = &best->bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin];
    if (is_better(found, of_bin)) {
        *of_bin = *found;
    }
}

static void predict(const Search *search, Best *best, const DipWorkSum *sum,
                    const DipQuality *quality) {
    double counters[DIP_COST_COUNTER_COUNT];
    dip_work_end(sum, quality, counters);
    const double flip = dip_cost_model_value(&search->models->errors, counters, quality);
    const Found found = {
        .quality = *quality,
        .ms = dip_cost_model_value(&search->models->times, counters, quality),
        .loss = fmax(flip, search->floor_flip),
        .is_found = true,
    };
    if (found.ms > 0.0) {
        keep(search, best, &found);
    }
}

// Tries all options of this group and of those after it.
static void try_groups(const Search *search, Best *best, int group, const DipWorkSum *sum,
                       const DipQuality *quality) {
    if (group == DIP_WORK_GROUPS) {
        predict(search, best, sum, quality);
        return;
    }
    const Options *options = &search->groups[group];
    for (int i = 0; i < options->count; i++) {
        const DipCostPrediction *option = options->list[i];
        const DipQuality with =
            dip_cost_take_settings(quality, &option->quality, dip_work_group(group));
        DipWorkSum more = *sum;
        if (i > 0) {
            dip_work_add(&more, &option->quality, option->counters);
        }
        try_groups(search, best, group + 1, &more, &with);
    }
}

static void run_task(void *context, int index, int worker) {
    const Search *search = context;
    const DipQuality *baseline = &search->report->options.baseline;
    const DipCostPrediction *samples = search->groups[0].list[index];
    DipWorkSum sum = dip_work_begin(baseline, search->groups[0].list[0]->counters);
    (void)worker;
    dip_work_add(&sum, &samples->quality, samples->counters);
    try_groups(search, &search->tasks[index], 1, &sum, &samples->quality);
}

// --- what a search begins and ends with ----------------------------------------------------------

// Lists the options of each group. They are combinations whose work was counted (report->predicted
// holds these before the search). Option 0 is the baseline.
static bool list_options(Search *search) {
    const DipCostReport *report = search->report;
    const DipCostPredictions *predicted = &report->predicted;
    const DipQuality *baseline = &report->options.baseline;
    const int base = dip_report_find_predicted(predicted, baseline);
    for (int g = 0; base >= 0 && g < DIP_WORK_GROUPS; g++) {
        Options *options = &search->groups[g];
        options->list[options->count++] = &predicted->list[base];
        for (int i = 0; i < predicted->count; i++) {
            const DipQuality *quality = &predicted->list[i].quality;
            const DipQuality alone = dip_cost_take_settings(baseline, quality, dip_work_group(g));
            const DipQuality combined =
                dip_cost_take_settings(baseline, quality, report->options.combined);
            if (i != base && dip_quality_equal(&alone, quality) &&
                dip_quality_equal(&combined, quality)) {
                DIP_ASSERT(options->count < MOST_OPTIONS);
                options->list[options->count++] = &predicted->list[i];
            }
        }
    }
    return base >= 0;
}

static void add_found(DipCostReport *report, const Found *found) {
    DipCostPredictions *predicted = &report->predicted;
    if (found->is_found && predicted->count < DIP_COST_MAX_ROWS &&
        dip_report_find_predicted(predicted, &found->quality) < 0) {
        DipCostPrediction *to = &predicted->list[predicted->count];
        *to = (DipCostPrediction){.quality = found->quality, .row = -1};
        if (dip_cost_compose_counters(report, to)) {
            predicted->count++;
        }
    }
}

// Joins what all tasks found, and adds it to the predicted combinations: first the best of each
// budget, then those of the bins that are on the front.
static void end_search(const Search *search, DipCostReport *report) {
    Best *all = &search->tasks[0];
    const int budgets = report->options.budget_count;
    for (int t = 1; t < search->groups[0].count; t++) {
        for (int i = 0; i < budgets * DIP_COST_PER_BUDGET; i++) {
            const int b = i / DIP_COST_PER_BUDGET;
            const Found *found = &search->tasks[t].budgets[b][i % DIP_COST_PER_BUDGET];
            if (found->is_found) {
                insert(all->budgets[b], found);
            }
        }
        for (int b = 0; b < BINS; b++) {
            if (search->tasks[t].bins[b].is_found &&
                is_better(&search->tasks[t].bins[b], &all->bins[b])) {
                all->bins[b] = search->tasks[t].bins[b];
            }
        }
    }
    for (int i = 0; i < budgets * DIP_COST_PER_BUDGET; i++) {
        add_found(report, &all->budgets[i / DIP_COST_PER_BUDGET][i % DIP_COST_PER_BUDGET]);
    }
    double least = INFINITY;
    for (int b = 0; b < BINS; b++) {
        const Found *found = &all->bins[b];
        if (found->is_found && found->loss <= (1.0 - DIP_CLEARLY_BETTER) * least) {
            least = found->loss;
            add_found(report, found);
        }
    }
}

bool dip_cost_search(DipCostContext *cost, const DipCostModels *models, DipError *err) {
    DipCostReport *report = cost->report;
    const size_t budgets = (size_t)report->options.budget_count;
    Search search = {
        .report = report, .models = models, .floor_flip = dip_cost_floor_flip(report, 0)};
    if (!list_options(&search)) {
        return true;
    }
    const size_t tasks = (size_t)search.groups[0].count;
    Found(*found)[DIP_COST_PER_BUDGET] = calloc(tasks * budgets + 1, sizeof *found);
    search.tasks = calloc(tasks, sizeof *search.tasks);
    const bool made = found && search.tasks;
    if (made) {
        const DipCostPrediction *base = search.groups[0].list[0];
        search.base_ms =
            dip_cost_model_value(&search.models->times, base->counters, &base->quality);
        for (size_t t = 0; t < tasks; t++) {
            search.tasks[t].budgets = found + t * budgets;
        }
        dip_pool_run(cost->session->pool, (int)tasks, run_task, &search);
        end_search(&search, report);
    }
    free(found);
    free(search.tasks);
    return made || dip_cost_out_of_memory(err);
}
