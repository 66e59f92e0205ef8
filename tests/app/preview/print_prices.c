// Prints prices of a cost report, for scripts:
//
//     print_prices COST.JSON
//
// Standard input asks for prices, one per line (price_lines.h).
#include "app/report/format/formats.h"
#include "tests/app/preview/price_lines.h"

#include <stdio.h>

static int answer_lines(const DipPrices *prices) {
    char line[512];
    while (fgets(line, sizeof line, stdin)) {
        if (!dip_print_price(prices, line)) {
            fprintf(stderr, "print_prices: this line asks for nothing: %s", line);
            return 2;
        }
    }
    return 0;
}

int main(int argc, char **argv) {
    DipError err = {.message = "give one report"};
    DipCostReport report = {.rows = NULL};
    DipPrices *prices = argc == 2 ? dip_prices_create(&err) : NULL;
    const bool known = prices && dip_cost_read_json(&report, argv[1], &err) &&
                       dip_prices_set_report(prices, &report, &err);
    if (!known) {
        fprintf(stderr, "print_prices: %s: %s\n", err.key, err.message);
    }
    const int code = known ? answer_lines(prices) : 2;
    dip_prices_destroy(&prices);
    dip_cost_report_free(&report);
    return code;
}
