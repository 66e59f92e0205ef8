// Searches all combinations of the combined settings for those that the models predict to be best.
// There may be millions, so they are not listed: each is predicted, and only those that may be
// worth measuring are kept.
#include "app/cost/steps.h"

#include "app/report/combinations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BINS = 512, // Number of bins. A bin holds the best combination of a range of times, for the
                // Pareto front.
    MIDDLE_BIN = 128 // The bin of the baseline's time.
};
static const double bin_width = 0.02; // Width of a bin's range, in the logarithm of time.

typedef struct Found {
    DipQuality quality;
    double ms;
    double loss; // The predicted FLIP, but at least the FLIP that the truth's noise makes.
    double gain; // What measuring it gains (dip_cost_gain). Set only in the lists of budgets.
    bool is_found;
} Found;

// What one task found: for each budget the DIP_COST_PER_BUDGET combinations that gain most, in
// order of falling gain, and for each range of times the best combination.
typedef struct Best {
    Found (*budgets)[DIP_COST_PER_BUDGET];
    Found bins[BINS];
    int *distances; // [group][measured combination]: see try_groups.
} Best;

// The options of one group of settings (combinations.h): the baseline, and the combinations that
// differ from it in this group alone.
typedef struct Options {
    const DipCostPrediction **list;
    // [option][measured combination]: distance of an option and a measured combination in this
    // group.
    int *apart;
    int count;
} Options;

typedef struct Search {
    const DipCostReport *report;
    const DipCostModels *models;
    Options groups[DIP_WORK_GROUPS];
    DipWorkCorners corners;
    DipCostAim aims[DIP_COST_MAX_BUDGETS];
    double floor_flip;
    double base_ms;
    Best *tasks; // [option of group 0]
} Search;

static bool is_better(const Found *a, const Found *b) {
    return !b->is_found || a->loss < b->loss ||
           (a->loss == b->loss && a->ms < b->ms); // NOLINT: exactly equal losses are meant.
}

// Puts the combination into a budget's list if the list has room, or if the combination's gain is
// greater than the least gain in the list.
static void insert(Found list[DIP_COST_PER_BUDGET], const Found *found) {
    int at = DIP_COST_PER_BUDGET;
    while (at > 0 && (!list[at - 1].is_found || found->gain > list[at - 1].gain)) {
        at--;
        if (at < DIP_COST_PER_BUDGET - 1) {
            list[at + 1] = list[at];
        }
        list[at] = *found;
    }
}

// Puts the combination into the list of each budget for which it gains much, and into its bin, if
// it is the best there. `ms` is its mean time if budgets limit the mean, otherwise its 95th
// percentile. The error of FLIP takes long to compute, so it is computed only if its upper bound
// would make the gain great enough.
static void keep(const Search *search, Best *best, const Found *found, double ms, double flip,
                 const int *distances) {
    const DipFlipModel *model = &search->models->flip;
    const double bound = dip_flip_model_error_bound(model, distances);
    double error = NAN;
    for (int b = 0; b < search->report->options.budget_count; b++) {
        const Found *last = &best->budgets[b][DIP_COST_PER_BUDGET - 1];
        const double least =
            last->is_found ? fmax(last->gain, DIP_COST_LEAST_GAIN) : DIP_COST_LEAST_GAIN;
        if (dip_cost_gain(&search->aims[b], ms, flip, bound) >= least) {
            Found of_budget = *found;
            error = isnan(error) ? dip_flip_model_error(model, distances) : error;
            of_budget.gain = dip_cost_gain(&search->aims[b], ms, flip, error);
            if (of_budget.gain >= least) {
                insert(best->budgets[b], &of_budget);
            }
        }
    }
    const int bin = MIDDLE_BIN + (int)floor(log(found->ms / search->base_ms) / bin_width);
    Found *of_bin = &best->bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin];
    if (is_better(found, of_bin)) {
        *of_bin = *found;
    }
}

static bool is_measured(const Search *search, const int *distances) {
    bool measured = false;
    for (int c = 0; c < search->models->flip.count && !measured; c++) {
        measured = distances[c] == 0;
    }
    return measured;
}

// Predicts a combination that is not measured yet, and keeps it if it may be worth measuring.
static void predict(const Search *search, Best *best, const DipWorkSum *sum,
                    const DipQuality *quality, const int *distances) {
    double counters[DIP_COUNTER_COUNT];
    if (is_measured(search, distances)) {
        return;
    }
    dip_work_end(sum, quality, counters);
    double values[DIP_COST_PREDICTED];
    dip_cost_predict_one(search->models, counters, quality, distances, values);
    const Found found = {
        .quality = *quality,
        .ms = values[DIP_COST_PREDICTED_MS],
        .loss = fmax(values[DIP_COST_PREDICTED_FLIP], search->floor_flip),
        .is_found = true,
    };
    if (found.ms > 0.0) {
        const bool is_mean = search->report->options.budget_of == DIP_TIME_MEAN;
        keep(search, best, &found, is_mean ? found.ms : values[DIP_COST_PREDICTED_P95],
             values[DIP_COST_PREDICTED_FLIP], distances);
    }
}

// Computes the distance of the tried combination to each measured combination in the settings of
// all groups up to the group of `options`. `distances` holds the distances in the groups before
// that group, one for each measured combination. The results are written behind them.
static void compare(const Search *search, const Options *options, int option, int *distances) {
    const int count = search->models->flip.count;
    const int *apart = options->apart + (size_t)option * (size_t)count;
    for (int c = 0; c < count; c++) {
        distances[count + c] = distances[c] + apart[c];
    }
}

// Tries all options of this group, each with all options of the groups after it. `distances` holds
// the distances of the tried combination to the measured combinations in the settings of the groups
// before this group (compare). Behind them, it has room for such distances for this group and for
// each later group.
static void try_groups(const Search *search, Best *best, int group, const DipWorkSum *sum,
                       const DipQuality *quality, int *distances) {
    if (group == DIP_WORK_GROUPS) {
        predict(search, best, sum, quality, distances);
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
        compare(search, options, i, distances);
        try_groups(search, best, group + 1, &more, &with, distances + search->models->flip.count);
    }
}

static void run_task(void *context, int index, int worker) {
    const Search *search = context;
    const DipQuality *baseline = &search->report->options.baseline;
    const DipCostPrediction *samples = search->groups[0].list[index];
    Best *best = &search->tasks[index];
    DipWorkSum sum = dip_work_begin(baseline, search->groups[0].list[0]->counters);
    (void)worker;
    sum.corners = &search->corners;
    dip_work_add(&sum, &samples->quality, samples->counters);
    for (int c = 0; c < search->models->flip.count; c++) {
        best->distances[c] = 0;
    }
    compare(search, &search->groups[0], index, best->distances);
    try_groups(search, best, 1, &sum, &samples->quality,
               best->distances + search->models->flip.count);
}

// --- what a search begins and ends with ----------------------------------------------------------

// Lists the options of each group: those combinations of report->predicted, whose work was counted,
// that differ from the baseline in this group alone. Option 0 is the baseline itself. `all` has
// room for every combination in each group. Returns false if the baseline is not listed.
static bool list_options(Search *search, const DipCostPrediction **all) {
    const DipCostReport *report = search->report;
    const DipCostPredictions *predicted = &report->predicted;
    const DipQuality *baseline = &report->options.baseline;
    const int base = dip_report_find_predicted(predicted, baseline);
    for (int g = 0; base >= 0 && g < DIP_WORK_GROUPS; g++) {
        Options *options = &search->groups[g];
        options->list = all + (size_t)g * (size_t)predicted->count;
        options->list[options->count++] = &predicted->list[base];
        for (int i = 0; i < predicted->count; i++) {
            const DipQuality *quality = &predicted->list[i].quality;
            const DipQuality alone = dip_cost_take_settings(baseline, quality, dip_work_group(g));
            const DipQuality combined =
                dip_cost_take_settings(baseline, quality, report->options.combined);
            if (i != base && dip_quality_equal(&alone, quality) &&
                dip_quality_equal(&combined, quality)) {
                options->list[options->count++] = &predicted->list[i];
            }
        }
    }
    for (int i = 0; base >= 0 && i < predicted->count; i++) {
        const DipCostPrediction *p = &predicted->list[i];
        dip_work_note_corner(&search->corners, baseline, &p->quality, p->counters);
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

// Joins what all tasks found, and adds it to the predicted combinations: first those that gain most
// for each budget, and then, from fast bins to slow bins, the best of each bin if its FLIP is at
// least 1 % below that of the last one taken from a bin.
static void end_search(const Search *search, DipCostReport *report) {
    Best *all = &search->tasks[0];
    const int places = report->options.budget_count * DIP_COST_PER_BUDGET;
    for (int t = 1; t < search->groups[0].count; t++) {
        for (int i = 0; i < places; i++) {
            const int budget = i / DIP_COST_PER_BUDGET;
            const Found *found = &search->tasks[t].budgets[budget][i % DIP_COST_PER_BUDGET];
            if (found->is_found) {
                insert(all->budgets[budget], found);
            }
        }
        for (int b = 0; b < BINS; b++) {
            const Found *found = &search->tasks[t].bins[b];
            if (found->is_found && is_better(found, &all->bins[b])) {
                all->bins[b] = *found;
            }
        }
    }
    for (int i = 0; i < places; i++) {
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

// What a search allocates.
typedef struct Room {
    const DipCostPrediction **options;   // [group][option]
    int *apart;                          // [group][option][measured combination]
    Best *tasks;                         // [option of group 0]
    Found (*found)[DIP_COST_PER_BUDGET]; // [task][budget]
    // [task][group][measured combination]: distances in the settings of no group, of group 0, of
    // groups 0 and 1, and so on (try_groups).
    int *distances;
} Room;

static void free_room(Room *room) {
    free(room->options);
    free(room->apart);
    free(room->tasks);
    free(room->found);
    free(room->distances);
}

// Computes the distance of each option and each measured combination in the option's group.
static bool compare_options(Search *search, Room *room) {
    const size_t count = (size_t)search->models->flip.count;
    size_t options = 0;
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        options += (size_t)search->groups[g].count;
    }
    int *apart = room->apart = malloc((options * count + 1) * sizeof *apart);
    for (int g = 0; apart && g < DIP_WORK_GROUPS; g++) {
        search->groups[g].apart = apart;
        for (int i = 0; i < search->groups[g].count; i++) {
            for (size_t c = 0; c < count; c++) {
                *apart++ = dip_cost_distance(&search->models->flip.known[c],
                                             &search->groups[g].list[i]->quality, dip_work_group(g),
                                             search->models->flip.weights);
            }
        }
    }
    return room->apart != NULL;
}

// Makes a task for each option of group 0.
static bool make_tasks(Search *search, Room *room) {
    const size_t budgets = (size_t)search->report->options.budget_count;
    const size_t distances = (size_t)search->models->flip.count * (DIP_WORK_GROUPS + 1);
    const size_t tasks = (size_t)search->groups[0].count;
    search->tasks = room->tasks = calloc(tasks, sizeof *room->tasks);
    room->found = calloc(tasks * budgets + 1, sizeof *room->found);
    room->distances = malloc((tasks * distances + 1) * sizeof *room->distances);
    const bool made = room->tasks && room->found && room->distances;
    for (size_t t = 0; made && t < tasks; t++) {
        search->tasks[t].budgets = room->found + t * budgets;
        search->tasks[t].distances = room->distances + t * distances;
    }
    return made;
}

bool dip_cost_search(DipCostReport *report, DipPool *pool, const DipCostModels *models,
                     DipError *err) {
    const size_t count = (size_t)report->predicted.count;
    Search search = {
        .report = report, .models = models, .floor_flip = dip_cost_floor_flip(report, 0)};
    Room room = {.options = calloc(count * DIP_WORK_GROUPS + 1, sizeof *room.options)};
    bool made = room.options != NULL;
    for (int b = 0; b < report->options.budget_count; b++) {
        search.aims[b] = dip_cost_aim(report, b);
    }
    if (made && list_options(&search, room.options)) {
        const DipCostPrediction *base = search.groups[0].list[0];
        search.base_ms = dip_cost_model_value(&models->times, base->counters, &base->quality);
        made = compare_options(&search, &room) && make_tasks(&search, &room);
        if (made) {
            dip_pool_run(pool, search.groups[0].count, run_task, &search);
            end_search(&search, report);
        }
    }
    free_room(&room);
    return made || dip_cost_out_of_memory(err);
}
