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

// Returns the row that stands for this one. Of all combinations with the same pictures, it is the
// one with the fewest settings off their defaults. If there are several of these, it is the first.
static int representative(const DipCostReport *report, int row) {
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

// Changes the indices of rows in the predictions and in the log to the new ones. A prediction gets
// the row that stands for its old row. The frames of rows that are gone are taken out of the log.
// stands[i] is the row that stands for row combined_first + i, and now[i] is this row's new index.
static void renumber(DipCostReport *report, const int *stands, const int *now) {
    const int first = report->combined_first;
    for (int i = 0; i < report->predicted.count; i++) {
        int *row = &report->predicted.list[i].row;
        *row = *row < first ? *row : now[stands[*row - first] - first];
    }
    size_t kept = 0;
    for (size_t i = 0; i < (size_t)report->log_count; i++) {
        DipTimed timed = report->log[i];
        const bool stays = timed.subject < first || stands[timed.subject - first] == timed.subject;
        if (stays) {
            timed.subject = timed.subject < first ? timed.subject : now[timed.subject - first];
            report->log[kept++] = timed;
        }
    }
    report->log_count = (int)kept;
}

bool dip_cost_join_same_pictures(DipCostReport *report, DipError *err) {
    const int first = report->combined_first;
    const int count = report->row_count - first;
    // renumber explains the two arrays.
    int *stands = malloc(((size_t)count + 1) * sizeof *stands);
    int *now = malloc(((size_t)count + 1) * sizeof *now);
    free(report->same);
    report->same = calloc((size_t)count + 1, sizeof *report->same);
    report->same_count = 0;
    if (!stands || !now || !report->same) {
        free(stands);
        free(now);
        return dip_cost_out_of_memory(err);
    }
    for (int i = 0; i < count; i++) {
        stands[i] = representative(report, first + i);
    }
    report->row_count = first;
    for (int i = 0; i < count; i++) {
        DipCostRow *row = &report->rows[first + i];
        if (stands[i] == first + i) {
            now[i] = report->row_count;
            report->rows[report->row_count++] = *row;
        } else {
            report->same[report->same_count++] = (DipCostSame){row->quality, stands[i]};
            dip_cost_row_free(row);
        }
    }
    for (int i = 0; i < report->same_count; i++) {
        report->same[i].row = now[report->same[i].row - first];
    }
    renumber(report, stands, now);
    free(stands);
    free(now);
    return true;
}
