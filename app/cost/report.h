// Everything that a cost report says: what was measured, and every figure.
#ifndef DIP_APP_COST_REPORT_H
#define DIP_APP_COST_REPORT_H

#include "app/cost/options.h"
#include "app/measure/metrics.h"
#include "app/measure/statistics.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

// Counters in the list's order.
enum {
#define DIP_COST_COUNTER(name, text) DIP_COST_COUNTER_##name,
    DIP_COUNTER_LIST(DIP_COST_COUNTER)
#undef DIP_COST_COUNTER
        DIP_COST_COUNTER_COUNT
};

extern const char *const dip_cost_counter_names[DIP_COST_COUNTER_COUNT];

enum {
    DIP_COST_MAX_PATHS = 16,
    DIP_COST_MAX_SWEEPS = 24,
    DIP_COST_MAX_SWEEP_ROWS = 8,
    DIP_COST_MAX_REFUSED = 24,
    DIP_COST_MAX_ROWS = 4096,
    DIP_COST_TEXT = 160,
    DIP_COST_REASON = 512
};

// One measured thing: settings on a path.
typedef struct DipCostRow {
    DipQuality quality;
    int path;
    DipMetricSums *places;                   // one per place
    bool *judged;                            // likewise: the sums are there
    double *ms;                              // [round * timed_frames + frame]; NULL: not timed
    double counters[DIP_COST_COUNTER_COUNT]; // mean per timed frame
} DipCostRow;

// The steps of one setting, with everything else alike.
typedef struct DipCostSweep {
    char title[DIP_COST_TEXT]; // "Adaptive AA with aa=4"
    DipSetting setting;
    int path;
    int base; // row that times are compared with: the baseline's step
    int rows[DIP_COST_MAX_SWEEP_ROWS];
    int row_count;
} DipCostSweep;

// What to choose within a time.
typedef struct DipCostAdvice {
    double budget_ms;
    int row;            // -1: nothing measured is that fast
    double checked_ms;  // measured again: median
    double checked_low; // its 95 % interval
    double checked_high;
} DipCostAdvice;

typedef struct DipCostReport {
    char scene[DIP_COST_TEXT];
    char scene_hash[33];
    char processor[DIP_COST_TEXT];
    char isa[16];
    char version[32];
    int threads;
    int width;
    int height;
    DipCostOptions options;
    char paths[DIP_COST_MAX_PATHS][16];
    int path_count;
    DipCostRow *rows;
    int row_count;
    int same_row;       // the A/A row: the same as row 0
    int combined_first; // rows from here on are the combinations, on path 0
    DipCostSweep sweeps[DIP_COST_MAX_SWEEPS];
    int sweep_count;
    char refused[DIP_COST_MAX_REFUSED][DIP_COST_REASON]; // steps left out, with the reason
    int refused_count;
    int rounds;            // timed so far
    DipMetricSums *floors; // [path * places + place]: half of the truth against the other
    bool *has_floor;
    DipCostAdvice advice[DIP_COST_MAX_BUDGETS];
    int advice_count;
} DipCostReport;

// Room for the rows' places and times; rows, paths and options are filled in.
bool dip_cost_report_alloc(DipCostReport *report, DipError *err);
void dip_cost_report_free(DipCostReport *report);

// Settings that are not the defaults, "aa=4,af=16", or "defaults".
void dip_cost_settings_text(const DipQuality *quality, char text[DIP_COST_TEXT]);

// Over all places that are there; *places is their number.
DipMetricSums dip_cost_row_sums(const DipCostReport *report, int row, int *places);
DipMetricSums dip_cost_floor(const DipCostReport *report, int path);

// The floor's root mean square in linear light: of a truth whose halves differ by the sums.
double dip_cost_floor_rmse(const DipCostReport *report, int path, int region);

// Errors below three times the floor say nothing.
bool dip_cost_at_floor(const DipCostReport *report, int row);

bool dip_cost_is_timed(const DipCostReport *report, int row);

// Milliseconds of a frame: the mean over the frames of their medians over the rounds. dip_cost_ms
// gives the value without its interval, which takes the longest to find.
double dip_cost_ms(const DipCostReport *report, int row);
DipStatsEstimate dip_cost_time(const DipCostReport *report, int row);

// The median over rounds and frames of the row's time divided by the base's in the same round.
// dip_cost_median_ratio gives the value without its interval.
DipStatsEstimate dip_cost_ratio(const DipCostReport *report, int row, int base);
double dip_cost_median_ratio(const DipCostReport *report, int row, int base);

// Rows that no other one of the same list is at least as good as in time and in error; in order of
// time. Rows without both are left out. Returns how many.
int dip_cost_front(const DipCostReport *report, const int *rows, int count, int *front);

// The fastest combination that buys at least 1 % of FLIP over a row; -1: none.
int dip_cost_next(const DipCostReport *report, int row);

// Of the combinations whose latest time, by row, is within a budget the one of least FLIP; -1:
// none.
int dip_cost_choose(const DipCostReport *report, const double *latest_ms, double budget_ms);

// Leaves of a front its first row and those that buy at least 1 % of FLIP over the last one left.
int dip_cost_front_steps(const DipCostReport *report, int *front, int count);

#endif
