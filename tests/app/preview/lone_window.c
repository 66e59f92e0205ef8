// Makes a window without a loop, a display or a scene, and feeds it events.
#include "tests/app/preview/lone_window.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

DipLoneWindow lone;

int dip_lone_set_up(void **unused) {
    (void)unused;
    static uint8_t pixels[4 * 16 * 16];
    const DipCamKey keys[3] = {
        {{0, 0, 0}, {0, 0, 0, 1}}, {{1, 1, 0}, {0, 0, 0, 1}}, {{3, 1, 0}, {0, 0, 0, 1}}};
    const DipQuality quality[2] = {dip_quality_default(), dip_quality_default()};
    assert_true(dip_campath_create(keys, 3, INT64_C(5000000000), &lone.path, NULL));
    lone.track = dip_camtrack_make(true);
    dip_camtrack_set(&lone.track, DIP_CATEGORY_DEFAULT, lone.path, 60.0);
    lone.state = dip_preview_state_make(quality, &lone.track);
    lone.view = dip_view_create(NULL, NULL);
    lone.prices = dip_prices_create(NULL);
    lone.tools = dip_tools_create(NULL);
    assert_true(lone.view && lone.prices && lone.tools);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipFrame frame = {.rgba8 = pixels, .stride_bytes = 64, .width = 16, .height = 16};
        dip_view_set_frame(lone.view, p, &frame);
        lone.figures[p] = (DipPaneFigures){.ms = 4.0 + p};
    }
    lone.input = (DipViewInput){.width = 1282,
                                .height = 720,
                                .scale = 1.0,
                                .window = {.state = &lone.state,
                                           .figures = lone.figures,
                                           .prices = lone.prices,
                                           .tools = lone.tools,
                                           .still = true}};
    return 0;
}

int dip_lone_tear_down(void **unused) {
    (void)unused;
    dip_tools_destroy(&lone.tools);
    dip_prices_destroy(&lone.prices);
    dip_view_destroy(&lone.view);
    dip_campath_destroy(&lone.path);
    return 0;
}

bool dip_lone_press(DipKeycode key) {
    return dip_view_handle(lone.view, &lone.input,
                           &(DipEvent){.kind = DIP_EVENT_KEY_DOWN, .key = key});
}

bool dip_lone_mouse(DipEventKind kind, DipMouseButton button, int x, int y) {
    return dip_view_handle(
        lone.view, &lone.input,
        &(DipEvent){.kind = kind, .x = x, .y = y, .button = button, .clicks = 1});
}

bool dip_lone_wheel(double steps, unsigned modifiers, int x, int y) {
    return dip_view_handle(lone.view, &lone.input,
                           &(DipEvent){.kind = DIP_EVENT_MOUSE_WHEEL,
                                       .x = x,
                                       .y = y,
                                       .wheel_y = steps,
                                       .modifiers = modifiers});
}
