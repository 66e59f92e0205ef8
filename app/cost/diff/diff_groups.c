// Groups the quantities that differ between A and B: all errors are one group, and other quantities
// share a group if they differ in the same rows. Describes the rows of each group in a few words.
#include "app/cost/diff/diff.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- describing rows -----------------------------------------------------------------------------

enum { NOT_DEFAULT = -1, MOST_TERMS = 2 };

// A condition on rows: on their path, and on their steps of some settings.
typedef struct Condition {
    const char *path; // NULL if rows on any path meet the condition.
    int count;        // Number of settings that the condition names.
    int settings[MOST_TERMS];
    int steps[MOST_TERMS]; // NOT_DEFAULT stands for any step but the default.
} Condition;

static bool meets(const DipCostDiffRow *row, const Condition *condition) {
    const DipQuality standard = dip_quality_default();
    bool met = !condition->path || strcmp(row->path, condition->path) == 0;
    for (int i = 0; met && i < condition->count; i++) {
        const int setting = condition->settings[i], step = row->quality.step[setting];
        met = condition->steps[i] == NOT_DEFAULT ? step != standard.step[setting]
                                                 : step == condition->steps[i];
    }
    return met;
}

static int term_count(const Condition *condition) {
    return (condition->path != NULL) + condition->count;
}

// A search for the condition that describes some rows best.
typedef struct Search {
    const DipCostDiff *diff;
    const bool *rows; // [row]: true if the row is to be described.
    Condition best;
    int best_count; // Number of rows that meet the best condition; 0 if there is none yet.
} Search;

// Keeps a condition if all rows to describe meet it and it is better than the best one so far:
// fewer rows meet it, or as many rows meet it and it has fewer terms.
static void consider(Search *search, const Condition *condition) {
    int count = 0;
    for (int r = 0; r < search->diff->row_count; r++) {
        const bool met = meets(&search->diff->rows[r], condition);
        if (search->rows[r] && !met) {
            return;
        }
        count += met;
    }
    if (search->best_count == 0 || count < search->best_count ||
        (count == search->best_count && term_count(condition) < term_count(&search->best))) {
        search->best = *condition;
        search->best_count = count;
    }
}

// Considers a condition, and then all its extensions to at most MOST_TERMS settings. Each added
// setting comes after the condition's last setting, and is added with each of its steps and with
// NOT_DEFAULT.
static void consider_settings(Search *search, Condition condition) {
    consider(search, &condition);
    const int last = condition.count++;
    for (int s = last > 0 ? condition.settings[last - 1] + 1 : 0;
         last < MOST_TERMS && s < DIP_SETTING_COUNT; s++) {
        condition.settings[last] = s;
        for (int step = NOT_DEFAULT; step < dip_setting_info((DipSetting)s)->step_count; step++) {
            condition.steps[last] = step;
            consider_settings(search, condition);
        }
    }
}

static void format_condition(const Condition *condition, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < condition->count; i++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)condition->settings[i]);
        const int step = condition->steps[i];
        used += (size_t)snprintf(text + used, size - used, "%s%s%s%s", used ? " and " : " with ",
                                 info->key, step == NOT_DEFAULT ? " other than " : "=",
                                 info->steps[step == NOT_DEFAULT ? info->default_step : step]);
    }
    if (condition->path) {
        snprintf(text + used, size - used, " on path %s", condition->path);
    }
}

// Describes in a few words the rows for which rows[row] is true. There must be at least one.
static void describe(const DipCostDiff *diff, const bool *rows, char *text, size_t size) {
    Search search = {.diff = diff, .rows = rows};
    int count = 0, first = 0;
    for (int r = diff->row_count - 1; r >= 0; r--) {
        count += rows[r];
        first = rows[r] ? r : first;
    }
    if (count == 1) {
        char settings[DIP_COST_TEXT];
        dip_cost_settings_text(&diff->rows[first].quality, settings);
        snprintf(text, size, "1 of %d rows: %s on path %s", diff->row_count, settings,
                 diff->rows[first].path);
        return;
    }
    consider_settings(&search, (Condition){.path = NULL});
    consider_settings(&search, (Condition){.path = diff->rows[first].path});
    char condition[160];
    format_condition(&search.best, condition, sizeof condition);
    if (count == search.best_count) {
        snprintf(text, size, "all %d rows%s", count, condition);
    } else {
        snprintf(text, size, "%d of the %d rows%s", count, search.best_count, condition);
    }
}

// --- grouping ------------------------------------------------------------------------------------

static bool is_error(int quantity) {
    return quantity < DIP_COST_DIFF_ERROR_COUNT;
}

static DipCostDiffChange change_of(const DipCostDiff *diff, int quantity) {
    DipCostDiffChange change = {.quantity = quantity, .least = INFINITY, .most = -INFINITY};
    double greatest = -1.0;
    for (int r = 0; r < diff->row_count; r++) {
        if (!dip_cost_diff_differs(&diff->rows[r], quantity)) {
            continue;
        }
        const double growth = dip_cost_diff_growth(&diff->rows[r], quantity);
        change.rows++;
        change.least = fmin(change.least, growth);
        change.most = fmax(change.most, growth);
        if (fabs(growth) > greatest) {
            greatest = fabs(growth);
            change.greatest = r;
        }
    }
    return change;
}

// Marks the rows in which a quantity differs. Returns false if there is none.
static bool mark_rows(const DipCostDiff *diff, int quantity, bool *rows) {
    bool any = false;
    for (int r = 0; r < diff->row_count; r++) {
        rows[r] = dip_cost_diff_differs(&diff->rows[r], quantity);
        any |= rows[r];
    }
    return any;
}

// Returns the index of a quantity's group, or `count` if the quantity needs a new group. All errors
// share one group. Other quantities share a group if they differ in the same rows.
static int find_group(const DipCostDiffGroup *groups, int count, const bool *group_rows,
                      const bool *rows, int quantity, int row_count) {
    for (int g = 0; g < count; g++) {
        const int other = groups[g].changes[0].quantity;
        const bool same = memcmp(group_rows + g * row_count, rows, (size_t)row_count) == 0;
        if (is_error(quantity) ? is_error(other) : !is_error(other) && same) {
            return g;
        }
    }
    return count;
}

int dip_cost_diff_group(const DipCostDiff *diff,
                        DipCostDiffGroup groups[DIP_COST_DIFF_QUANTITY_COUNT]) {
    const int rows = diff->row_count;
    bool *group_rows = malloc((DIP_COST_DIFF_QUANTITY_COUNT + 1) * ((size_t)rows + 1));
    bool *differing = group_rows + DIP_COST_DIFF_QUANTITY_COUNT * rows;
    int count = 0;
    for (int q = 0; group_rows && q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
        if (!mark_rows(diff, q, differing)) {
            continue;
        }
        const int g = find_group(groups, count, group_rows, differing, q, rows);
        bool *kept = group_rows + g * rows;
        if (g == count) {
            groups[count++] = (DipCostDiffGroup){.change_count = 0};
            memset(kept, 0, (size_t)rows);
        }
        for (int r = 0; r < rows; r++) {
            kept[r] = kept[r] || differing[r];
        }
        groups[g].changes[groups[g].change_count++] = change_of(diff, q);
    }
    for (int g = 0; g < count; g++) {
        for (int r = 0; r < rows; r++) {
            groups[g].row_count += group_rows[g * rows + r];
        }
        describe(diff, group_rows + g * rows, groups[g].which, sizeof groups[g].which);
    }
    const bool made = group_rows != NULL;
    free(group_rows);
    return made ? count : -1;
}
