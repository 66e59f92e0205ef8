// The tab of advice: the best settings for each time budget of the cost report.
#include "app/preview/style.h"
#include "app/preview/tabs.h"

#include <stdio.h>

enum { SIZE = 13, NOTE_SIZE = 11, ROW_HEIGHT = 30, TRY_WIDTH = 110, MAX_ROWS = 12 };
enum { ID_TRY = 1, ID_TABLE = 100 };

// Says how to make a report, when there is none.
static void declare_how_to(DipUi *ui, DipRect body) {
    static const char what[] =
        "Advice comes from a cost report, which measures every step of every "
        "setting in this scene:";
    static const char *const lines[] = {
        what,
        "diptych cost --out report        (with the same --config, --model and --size as now)",
        "diptych preview --cost report/cost.json",
    };
    const int line = dip_ui_line_height(ui, SIZE) + dip_ui_px(ui, 4);
    for (int i = 0; i < 3; ++i) {
        dip_ui_text(ui, SIZE, i ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                    body.x + dip_ui_px(ui, 12), body.y + dip_ui_px(ui, 12) + i * line,
                    body.width - dip_ui_px(ui, 24), lines[i]);
    }
}

static void declare_row(DipUi *ui, DipWindow *window, int index, DipRect row) {
    DipPreviewState *state = window->state;
    const DipCosts *costs = state->costs;
    const DipCostsAdvice *advice = &costs->advice[index];
    const int pad = dip_ui_px(ui, 12);
    const DipRect button = {row.x + row.width - pad - dip_ui_px(ui, TRY_WIDTH),
                            row.y + dip_ui_px(ui, 2), dip_ui_px(ui, TRY_WIDTH),
                            row.height - dip_ui_px(ui, 4)};
    char figures[200], settings[300], line[520];
    dip_costs_describe(costs, index, figures, sizeof figures);
    settings[0] = '\0';
    if (advice->found) {
        dip_preview_describe(&advice->quality, true, settings, sizeof settings);
    }
    snprintf(line, sizeof line, "%s   %s", figures, settings);
    dip_ui_text(ui, SIZE, dip_style_white, DIP_ALIGN_LEFT, row.x + pad,
                row.y + (row.height - dip_ui_line_height(ui, SIZE)) / 2, button.x - row.x - 2 * pad,
                line);
    if (advice->found &&
        dip_ui_button(ui, DIP_UI_ID(DIP_UI_ADVICE, ID_TRY + index), button, "Try it right",
                      DIP_UI_PLAIN,
                      "Gives the requested pane these settings. Apply is separate.")) {
        dip_preview_set_quality(state, DIP_PANE_REQUESTED, &advice->quality, dip_ui_now_ns(ui));
    }
}

void dip_tab_advice(DipUi *ui, DipWindow *window, DipRect body) {
    const DipCosts *costs = window->state->costs;
    const int pad = dip_ui_px(ui, 12), height = dip_ui_px(ui, ROW_HEIGHT);
    if (!costs) {
        declare_how_to(ui, body);
        return;
    }
    char text[400];
    snprintf(text, sizeof text, "Measured: %s. Panes now: %dx%d.", costs->heading,
             window->frames[0].width, window->frames[0].height);
    dip_ui_text(ui, NOTE_SIZE, dip_style_dim, DIP_ALIGN_LEFT, body.x + pad, body.y + pad / 2,
                body.width - 2 * pad, text);
    const int top = body.y + dip_ui_px(ui, 24);
    const int room = (body.y + body.height - top) / height - 1;
    const int shown = costs->advice_count < room ? costs->advice_count : room;
    for (int i = 0; i < shown; ++i) {
        declare_row(ui, window, i, (DipRect){body.x, top + i * height, body.width, height});
    }
    if (dip_ui_button(ui, DIP_UI_ID(DIP_UI_ADVICE, ID_TABLE),
                      (DipRect){body.x + pad, top + shown * height + dip_ui_px(ui, 2),
                                dip_ui_px(ui, 220), height - dip_ui_px(ui, 4)},
                      shown < costs->advice_count ? "All steps, more budgets: K" : "All steps (U)",
                      DIP_UI_PLAIN, "Shows the time and error of every step of every setting.")) {
        dip_preview_act(window->state, DIP_ACTION_COSTS, 0, false, dip_ui_now_ns(ui));
    }
}
