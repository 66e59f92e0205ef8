// Writes times into the log of the live report.
#include "tests/app/preview/made_live.h"

#include <math.h>
#include <stdlib.h>

enum { ROUNDS = 4 };

static double base_ms;

// Takes the times of a row, and those of the base beside them, out of the log.
static void forget_times(DipCostReport *report, int row) {
    int kept = 0;
    for (int i = 0; i < report->log_count; i++) {
        if (report->log[i].frame == 0 && report->log[i].cpu_ms != row) {
            report->log[kept++] = report->log[i];
        }
    }
    report->log_count = kept;
}

void dip_made_live(DipPrices *prices, const char *settings, double ms, double noise, double flip) {
    static const double deviations[ROUNDS] = {1.0, -1.0, 0.3, -0.3};
    DipQuality quality;
    const int row = dip_quality_parse(settings, &quality, NULL)
                        ? dip_prices_live_row(prices, &quality, NULL)
                        : -1;
    if (row < 0) {
        abort();
    }
    DipCostReport *report = dip_prices_live(prices);
    base_ms = row == 0 ? ms : base_ms;
    report->rounds = report->options.rounds = ROUNDS;
    forget_times(report, row);
    DipTimed list[2 * ROUNDS];
    int count = 0;
    for (int r = 0; r < ROUNDS; r++) { // cpu_ms marks the row that the times belong to.
        list[count++] = (DipTimed){
            .subject = 1, .round = r, .ms = ms * exp(noise * deviations[r]), .cpu_ms = row};
        if (row != 0) {
            list[count++] = (DipTimed){.subject = 0, .round = r, .ms = base_ms, .cpu_ms = row};
        }
    }
    const DipTimes times = {.list = list, .count = count, .starts = 1};
    const int rows[] = {0, row};
    if (flip >= 0.0) {
        DipMetricSums *sums = report->rows[row].viewpoints;
        *sums = (DipMetricSums){.bursts = 1.0};
        sums->regions[0].pixels = 10.0;
        sums->regions[0].flip = 10.0 * flip;
        sums->regions[0].squared_lin = 10.0; // An error far above the floor.
        report->rows[row].judged[0] = true;
    }
    if (!dip_cost_log_add(report, &times, rows, NULL) ||
        !dip_prices_update_live(prices, true, NULL)) {
        abort();
    }
}
