// Chooses what stands for a pane's time.
#include "app/preview/tabs/pane_time.h"

#include "app/preview/prices/price_text.h"

#include <stdio.h>

// Returns the price of a pane's settings that was measured at rest, or one that is unknown.
static DipPriceSum measured_here(const DipWindow *window, int pane) {
    const DipPriceSum nothing = {.state = DIP_PRICE_UNKNOWN};
    const bool here = window->still && window->prices && dip_prices_are_rough(window->prices);
    return here ? dip_prices_sum(window->prices, &window->state->quality[pane]) : nothing;
}

DipPaneTime dip_pane_time(const DipWindow *window, int pane) {
    const DipPriceSum sum = measured_here(window, pane);
    const DipPaneFigures *figures = &window->figures[window->figures[pane].copied ? 0 : pane];
    if (dip_price_sum_trust(&sum) != DIP_PRICE_TRUST_UNKNOWN) {
        return (DipPaneTime){
            .ms = sum.ms, .trust = dip_price_sum_trust(&sum), .measured_here = true};
    }
    return (DipPaneTime){.ms = figures->ms,
                         .trust =
                             figures->frames > 0 ? DIP_PRICE_TRUST_KNOWN : DIP_PRICE_TRUST_UNKNOWN,
                         .single = figures->frames == 1};
}

void dip_pane_time_text(const DipPaneTime *time, char text[DIP_PANE_TIME_BYTES]) {
    char digits[DIP_STEP_NAME_BYTES];
    dip_ms_text(time->ms, time->trust, digits);
    if (time->trust == DIP_PRICE_TRUST_UNKNOWN) {
        snprintf(text, DIP_PANE_TIME_BYTES, "\u00b7 \u00b7 \u00b7 ms");
    } else {
        const bool rough = time->measured_here && time->trust != DIP_PRICE_TRUST_DOUBTFUL;
        snprintf(text, DIP_PANE_TIME_BYTES, "%s%s%.20s ms", time->single ? "one frame: " : "",
                 rough ? DIP_ROUGH_MARK : "", digits);
    }
}

DipPriceSum dip_pane_sum(const DipWindow *window, int pane) {
    const DipPaneTime time = dip_pane_time(window, pane);
    if (!dip_prices_are_rough(window->prices)) {
        const DipPriceSum sum = dip_prices_sum(window->prices, &window->state->quality[pane]);
        if (sum.state != DIP_PRICE_UNKNOWN) {
            return sum;
        }
    } else if (time.measured_here) {
        return measured_here(window, pane);
    }
    return (DipPriceSum){.ms = time.ms, .base_ms = time.ms};
}
