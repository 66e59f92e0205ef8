// Searches all combinations of the settings for those that the models predict to be best. There may
// be millions, so they are not listed: each is predicted, and only those that may be worth
// measuring are kept.
#include "app/cost/steps.h"

#include "app/report/combinations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BINS = 512, // Each bin holds the best combination of a range of times, for the Pareto front.
    MIDDLE_BIN = 128 // The bin of the baseline's time.
};
static const double bin_width = 0.02; // Width of a bin's range, in the logarithm of time.

typedef struct Found {
    DipQuality quality;
    double ms;
    double loss; // The predicted FLIP, but at least the FLIP that the truth's noise makes.
    bool is_found;
} Found;

// What one task found: for each budget and each limit the best DIP_COST_PER_LIMIT combinations,
// best first, and for each range of times the best one.
typedef struct Best {
    Found (*limits)[DIP_COST_PER_LIMIT]; // [budget * DIP_COST_LIMITS + limit]
    Found bins[BINS];
    double *likeness; // [group][correction]: see try_groups.
} Best;

// The options of one group of settings (combinations.h): the baseline, and the combinations that
// differ from it in this group alone.
typedef struct Options {
    const DipCostPrediction **list;
    // [option][correction]: likeness of an option and a measured combination in this group.
    double *alike;
    int count;
} Options;

typedef struct Search {
    const DipCostReport *report;
    const DipCostModels *models;
    Options groups[DIP_WORK_GROUPS];
    DipWorkCorners corners;
    double floor_flip;
    double base_ms;
    Best *tasks; // [option of group 0]
} Search;

static bool is_better(const Found *a, const Found *b) {
    return !b->is_found || a->loss < b->loss ||
           (a->loss == b->loss && a->ms < b->ms); // NOLINT: exactly equal losses are meant.
}

// Puts the combination into a list of the best ones, if it is one of them.
static void insert(Found list[DIP_COST_PER_LIMIT], const Found *found) {
    int at = DIP_COST_PER_LIMIT;
    while (at > 0 && is_better(found, &list[at - 1])) {
        at--;
        if (at < DIP_COST_PER_LIMIT - 1) {
            list[at + 1] = list[at];
        }
        list[at] = *found;
    }
}

// Puts the combination into the list of each limit that it keeps, and into its bin, if it is one of
// the best there. `ms` is its mean time if budgets limit the mean, otherwise its 95th percentile.
static void keep(const Search *search, Best *best, const Found *found, double ms) {
    const int budgets = search->report->options.budget_count;
    for (int i = 0; i < budgets * DIP_COST_LIMITS; i++) {
        if (ms <= dip_cost_limit_ms(search->report, i / DIP_COST_LIMITS, i % DIP_COST_LIMITS)) {
            insert(best->limits[i], found);
        }
    }
    const int bin = MIDDLE_BIN + (int)floor(log(found->ms / search->base_ms) / bin_width);
    Found *of_bin = &best->bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin];
    if (is_better(found, of_bin)) {
        *of_bin = *found;
    }
}

static bool is_measured(const Search *search, const double *likeness) {
    bool measured = false;
    for (int c = 0; c < search->models->correction_count && !measured; c++) {
        measured = likeness[c] >= 1.0;
    }
    return measured;
}

// Predicts a combination that is not measured yet, and keeps it if it may be worth measuring.
static void predict(const Search *search, Best *best, const DipWorkSum *sum,
                    const DipQuality *quality, const double *likeness) {
    double counters[DIP_COST_COUNTER_COUNT];
    if (is_measured(search, likeness)) {
        return;
    }
    dip_work_end(sum, quality, counters);
    double values[DIP_COST_PREDICTED];
    dip_cost_predict_one(search->models, counters, quality, likeness, values);
    const Found found = {
        .quality = *quality,
        .ms = values[DIP_COST_PREDICTED_MS],
        .loss = fmax(values[DIP_COST_PREDICTED_FLIP], search->floor_flip),
        .is_found = true,
    };
    if (found.ms > 0.0) {
        const bool is_mean = search->report->options.budget_of == DIP_TIME_MEAN;
        keep(search, best, &found, is_mean ? found.ms : values[DIP_COST_PREDICTED_P95]);
    }
}

// Computes the likeness of the tried combination and each measured one in the settings of all
// groups up to this one. `likeness` holds their likeness in the groups before this one, one value
// for each measured combination, and the results are written behind these values.
static void compare(const Search *search, const Options *options, int option, double *likeness) {
    const int count = search->models->correction_count;
    const double *alike = options->alike + (size_t)option * (size_t)count;
    for (int c = 0; c < count; c++) {
        likeness[count + c] = likeness[c] * alike[c];
    }
}

// Tries all options of this group, each with all options of the groups after it. `likeness` holds
// the likeness of the tried combination and each measured one in the settings of the groups before
// this one (compare), and has room behind for the same of each group from this one on.
static void try_groups(const Search *search, Best *best, int group, const DipWorkSum *sum,
                       const DipQuality *quality, double *likeness) {
    if (group == DIP_WORK_GROUPS) {
        predict(search, best, sum, quality, likeness);
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
        compare(search, options, i, likeness);
        try_groups(search, best, group + 1, &more, &with,
                   likeness + search->models->correction_count);
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
    for (int c = 0; c < search->models->correction_count; c++) {
        best->likeness[c] = 1.0;
    }
    compare(search, &search->groups[0], index, best->likeness);
    try_groups(search, best, 1, &sum, &samples->quality,
               best->likeness + search->models->correction_count);
}

// --- what a search begins and ends with ----------------------------------------------------------

// Lists the options of each group: those combinations of report->predicted, whose work was counted,
// that differ from the baseline in this group alone. Option 0 is the baseline itself. `all` has
// room for every combination in each group. Returns false if the baseline was not counted.
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

// Joins what all tasks found, and adds it to the predicted combinations: first the best of each
// limit, and then, from fast bins to slow ones, the best of each bin whose FLIP is at least 1 %
// below that of the last one added.
static void end_search(const Search *search, DipCostReport *report) {
    Best *all = &search->tasks[0];
    const int limits = report->options.budget_count * DIP_COST_LIMITS;
    for (int t = 1; t < search->groups[0].count; t++) {
        for (int i = 0; i < limits * DIP_COST_PER_LIMIT; i++) {
            const int limit = i / DIP_COST_PER_LIMIT;
            const Found *found = &search->tasks[t].limits[limit][i % DIP_COST_PER_LIMIT];
            if (found->is_found) {
                insert(all->limits[limit], found);
            }
        }
        for (int b = 0; b < BINS; b++) {
            const Found *found = &search->tasks[t].bins[b];
            if (found->is_found && is_better(found, &all->bins[b])) {
                all->bins[b] = *found;
            }
        }
    }
    for (int i = 0; i < limits * DIP_COST_PER_LIMIT; i++) {
        add_found(report, &all->limits[i / DIP_COST_PER_LIMIT][i % DIP_COST_PER_LIMIT]);
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
    const DipCostPrediction **options;  // [group][option]
    double *alike;                      // [group][option][correction]
    Best *tasks;                        // [option of group 0]
    Found (*found)[DIP_COST_PER_LIMIT]; // [task][budget][limit]
    double *likeness; // [task][group][correction]: before the first group, and after each.
} Room;

static void free_room(Room *room) {
    free(room->options);
    free(room->alike);
    free(room->tasks);
    free(room->found);
    free(room->likeness);
}

// Computes the likeness of each option and each measured combination in the option's group.
static bool compare_options(Search *search, Room *room) {
    const size_t count = (size_t)search->models->correction_count;
    size_t options = 0;
    for (int g = 0; g < DIP_WORK_GROUPS; g++) {
        options += (size_t)search->groups[g].count;
    }
    double *alike = room->alike = malloc((options * count + 1) * sizeof *alike);
    for (int g = 0; alike && g < DIP_WORK_GROUPS; g++) {
        search->groups[g].alike = alike;
        for (int i = 0; i < search->groups[g].count; i++) {
            for (size_t c = 0; c < count; c++) {
                *alike++ = dip_cost_alike(&search->models->corrections[c].quality,
                                          &search->groups[g].list[i]->quality, dip_work_group(g));
            }
        }
    }
    return room->alike != NULL;
}

// Makes a task for each option of group 0.
static bool make_tasks(Search *search, Room *room) {
    const size_t limits = (size_t)search->report->options.budget_count * DIP_COST_LIMITS;
    const size_t likenesses = (size_t)search->models->correction_count * (DIP_WORK_GROUPS + 1);
    const size_t tasks = (size_t)search->groups[0].count;
    search->tasks = room->tasks = calloc(tasks, sizeof *room->tasks);
    room->found = calloc(tasks * limits + 1, sizeof *room->found);
    room->likeness = malloc((tasks * likenesses + 1) * sizeof *room->likeness);
    const bool made = room->tasks && room->found && room->likeness;
    for (size_t t = 0; made && t < tasks; t++) {
        search->tasks[t].limits = room->found + t * limits;
        search->tasks[t].likeness = room->likeness + t * likenesses;
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
