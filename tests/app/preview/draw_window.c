// Draws the preview's window on a fake display and writes it as a PNG. Also prints how long the
// passes over the controls take. A tool for looking at the window; it tests nothing by itself.
//
// Usage: draw_window INI WIDTHxHEIGHT[@SCALE] FILE.png [ACTION]...
// An action is a letter, digit or sign for a key, the name of a key (tab, enter, left, right, up,
// down, home, end, escape, f1), click:X,Y, move:X,Y or wheel:X,Y,STEPS. The camera rests.
// cost:FILE, as the first action, gives the window a cost report.
#include "app/cost/plan.h"
#include "tests/app/display/fake_display.h"
#include "app/files/pictures.h"
#include "app/preview/loop/loop.h"
#include "app/session/session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static DipFakeDisplay *fake;
static DipPreview *preview;

// Processor time of this thread.
static int64_t cpu_ns(void) {
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1000000000 * (int64_t)time.tv_sec + time.tv_nsec;
}

static void turn(void) {
    DipError err;
    if (!dip_preview_turn(preview, &err)) {
        fprintf(stderr, "draw_window: %s\n", err.message);
        exit(1);
    }
}

static DipKeycode key_of(const char *name) {
    static const struct {
        const char *name;
        DipKeycode key;
    } keys[] = {{"tab", DIP_KEYCODE_TAB},       {"enter", DIP_KEYCODE_ENTER},
                {"left", DIP_KEYCODE_LEFT},     {"right", DIP_KEYCODE_RIGHT},
                {"up", DIP_KEYCODE_UP},         {"down", DIP_KEYCODE_DOWN},
                {"home", DIP_KEYCODE_HOME},     {"end", DIP_KEYCODE_END},
                {"escape", DIP_KEYCODE_ESCAPE}, {"f1", DIP_KEYCODE_F1}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i) {
        if (strcmp(keys[i].name, name) == 0) {
            return keys[i].key;
        }
    }
    return (DipKeycode)name[0];
}

static void act(const char *action) {
    DipEvent event = {.kind = DIP_EVENT_MOUSE_MOVE};
    int steps = 0;
    if (sscanf(action, "click:%d,%d", &event.x, &event.y) == 2) {
        dip_fake_display_click(fake, DIP_MOUSE_LEFT, event.x, event.y, 1);
    } else if (sscanf(action, "move:%d,%d", &event.x, &event.y) == 2) {
        dip_fake_display_push(fake, &event);
    } else if (sscanf(action, "wheel:%d,%d,%d", &event.x, &event.y, &steps) == 3) {
        event.kind = DIP_EVENT_MOUSE_WHEEL;
        event.wheel_y = steps;
        dip_fake_display_push(fake, &event);
    } else {
        dip_fake_display_press(fake, key_of(action), 0);
    }
    turn();
    dip_fake_display_advance(fake, 3000000000); // Lets notices end and tips appear.
    turn();
    turn();
}

// Measures turns in which nothing is drawn but the window: the pointer moves over the controls.
static void measure(int width, int height) {
    enum { TURNS = 300 };
    double worst_ms = 0.0, sum_ms = 0.0;
    for (int i = 0; i < TURNS; ++i) {
        const DipEvent event = {.kind = DIP_EVENT_MOUSE_MOVE,
                                .x = (i * 97) % width,
                                .y = height - 1 - (i * 31) % (height / 3)};
        dip_fake_display_push(fake, &event);
        dip_fake_display_advance(fake, 20000000);
        const int64_t from_ns = cpu_ns();
        turn();
        const double ms = 1e-6 * (double)(cpu_ns() - from_ns);
        worst_ms = ms > worst_ms ? ms : worst_ms;
        sum_ms += ms;
    }
    printf("pointer over the controls: mean %.3f ms, worst %.3f ms of %d turns\n", sum_ms / TURNS,
           worst_ms, TURNS);
}

int main(int argc, char **argv) {
    int width, height;
    double scale = 1.0;
    DipDisplay display;
    DipErrorList faults = {0};
    DipSession session;
    if (argc < 4 || sscanf(argv[2], "%dx%d@%lf", &width, &height, &scale) < 2) {
        fprintf(stderr, "usage: draw_window INI WIDTHxHEIGHT[@SCALE] FILE.png [ACTION]...\n");
        return 2;
    }
    DipSessionOptions options = {.config = argv[1], .has_threads = true, .threads = 1};
    const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
    if (!dip_session_open(&session, &def, &faults)) {
        fprintf(stderr, "draw_window: the session did not open\n");
        return 1;
    }
    fake = dip_fake_display_open(&display, width, height);
    dip_fake_display_rescale(fake, scale);
    DipPrices *prices = dip_prices_create(NULL);
    DipCostReport *costs = NULL;
    const bool has_costs = argc > 4 && strncmp(argv[4], "cost:", 5) == 0;
    if (has_costs) {
        char scene[DIP_COST_TEXT];
        DipError err;
        dip_cost_scene_name(&session, scene);
        costs = dip_costs_load(prices, argv[4] + 5, scene, &err);
        if (!costs) {
            fprintf(stderr, "draw_window: %s\n", err.message);
            return 1;
        }
    }
    const DipPreviewDef preview_def = {.costs = costs,
                                       .prices = prices,
                                       .session = &session,
                                       .display = display,
                                       .load_scene_def = dip_session_keep_model};
    preview = dip_preview_create(&preview_def, NULL);
    turn();
    act(" ");
    for (int i = 4 + has_costs; i < argc; ++i) {
        act(argv[i]);
    }
    const DipPixels shown = dip_fake_display_picture(fake);
    const DipFrame frame = {.rgba8 = shown.rgba8,
                            .stride_bytes = shown.stride_bytes,
                            .width = shown.width,
                            .height = shown.height};
    const bool written = dip_png_write(argv[3], &frame, NULL);
    measure(width, height);
    dip_preview_destroy(&preview);
    dip_prices_destroy(&prices);
    display.close(display.context);
    dip_session_close(&session);
    dip_error_list_free(&faults);
    return written ? 0 : 1;
}
