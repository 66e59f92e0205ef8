// Finds rows with the same pictures, and joins them.
#include "app/report/report.h"

#include <stdlib.h>
#include <string.h>

bool dip_cost_same_pictures(const DipCostReport *report, int a, int b) {
    const DipCostRow *x = &report->rows[a];
    const DipCostRow *y = &report->rows[b];
    bool same = x->path == y->path;
    for (int p = 0; same && p < report->options.places; p++) {
        same = x->judged[p] && y->judged[p] && x->pictures[p][0] &&
               strcmp(x->pictures[p], y->pictures[p]) == 0;
    }
    return same;
}

int dip_cost_simplest_row(const DipCostReport *report, int row) {
    const int base = report->base_rows[0];
    if (base >= report->combined_first &&
        (row == base || dip_cost_same_pictures(report, row, base))) {
        return base;
    }
    int best = row;
    int least = dip_quality_count_changes(&report->rows[row].quality);
    for (int r = report->combined_first; r < report->row_count; r++) {
        const int changes = dip_quality_count_changes(&report->rows[r].quality);
        if ((changes < least || (changes == least && r < best)) &&
            dip_cost_same_pictures(report, row, r)) {
            best = r;
            least = changes;
        }
    }
    return best;
}

// Tells where the rows of a report go. stands[i] is the row that stands for row combined_first + i.
// If a row stands for itself, now[i] is its new index.
typedef struct Joined {
    int first; // combined_first; the rows before it stay where they are.
    int *stands;
    int *now;
} Joined;

// Returns the new index of the row that stands for a row. A negative index stays as it is.
static int joined_row(const Joined *joined, int row) {
    return row < joined->first ? row
                               : joined->now[joined->stands[row - joined->first] - joined->first];
}

// Removes from the log the frames of rows for which another row stands. Gives the remaining frames
// the new indices of their rows.
static void renumber_log(DipCostReport *report, const Joined *joined) {
    const int first = joined->first;
    size_t kept = 0;
    for (size_t i = 0; i < (size_t)report->log_count; i++) {
        DipTimed timed = report->log[i];
        if (timed.subject < first || joined->stands[timed.subject - first] == timed.subject) {
            timed.subject = joined_row(joined, timed.subject);
            report->log[kept++] = timed;
        }
    }
    report->log_count = (int)kept;
}

// Changes all indices of rows in the report to the new ones.
static void renumber(DipCostReport *report, const Joined *joined) {
    for (int i = 0; i < report->same_count; i++) {
        report->same[i].row = joined_row(joined, report->same[i].row);
    }
    for (int i = 0; i < report->predicted.count; i++) {
        int *row = &report->predicted.list[i].row;
        *row = joined_row(joined, *row);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        DipCostSweep *sweep = &report->sweeps[s];
        sweep->base = joined_row(joined, sweep->base);
        for (int i = 0; i < sweep->row_count; i++) {
            sweep->rows[i] = joined_row(joined, sweep->rows[i]);
        }
    }
    renumber_log(report, joined);
}

bool dip_cost_join_same_pictures(DipCostReport *report, DipError *err) {
    const int first = report->combined_first;
    const int count = report->row_count - first;
    const size_t room = (size_t)count + 1;
    const Joined joined = {first, malloc(room * sizeof(int)), malloc(room * sizeof(int))};
    DipCostSame *same =
        realloc(report->same, (room + (size_t)report->same_count) * sizeof *report->same);
    report->same = same ? same : report->same;
    if (!joined.stands || !joined.now || !same) {
        free(joined.stands);
        free(joined.now);
        return dip_cost_out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        joined.stands[i] = dip_cost_simplest_row(report, first + i);
    }
    report->row_count = first;
    for (int i = 0; i < count; i++) {
        DipCostRow *row = &report->rows[first + i];
        if (joined.stands[i] == first + i) {
            joined.now[i] = report->row_count;
            report->rows[report->row_count++] = *row;
        } else {
            report->same[report->same_count++] = (DipCostSame){row->quality, joined.stands[i]};
            dip_cost_row_free(row);
        }
    }
    renumber(report, &joined);
    free(joined.stands);
    free(joined.now);
    return true;
}
