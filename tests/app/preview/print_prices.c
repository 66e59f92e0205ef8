// Prints prices of a cost report, for scripts:
//
//     print_prices COST.JSON
//
// Standard input asks for prices, one per line (price_lines.h).
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
    DipError err;
    DipPrices *prices = argc == 2 ? dip_prices_create(&err) : NULL;
    if (!prices || !dip_prices_load_report(prices, argv[1], &err)) {
        fprintf(stderr, "print_prices: %s\n", prices ? err.message : "give one report");
        dip_prices_destroy(&prices);
        return 2;
    }
    const int code = answer_lines(prices);
    dip_prices_destroy(&prices);
    return code;
}
