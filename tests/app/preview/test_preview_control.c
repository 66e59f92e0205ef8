// Tests of the control channel on the preview: requests over a socket change what the panes show.
// The preview runs on a fake display.
#include "app/preview/control/control.h"
#include "app/preview/loop/view.h"
#include "tests/app/control/line_client.h"
#include "tests/app/control/random_lines.h"
#include "tests/app/preview/made_preview.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

// The panes are 100 pixels high: the dock's bar takes 32.
enum { WIDTH = 130, HEIGHT = 132, PANE_WIDTH = (WIDTH - DIP_PANE_GAP_PX) / 2 };

static DipRemote *remote;
static char folder[64];
static char socket_path[96];
static LineClient client;

// --- the fixture ---------------------------------------------------------------------------------

static const char *take(void) {
    const char *line;
    for (int i = 0; i < 6; ++i) {
        if (line_client_take(&client, &line)) {
            return line;
        }
        dip_made_turn();
    }
    return "nothing";
}

static const char *ask(const char *line) {
    line_client_line(&client, line);
    return take();
}

static int set_up(void **state) {
    (void)state;
    static const DipSessionOptions options = {.config = "made up"};
    dip_made_open_session(1, 2, NULL);
    made.session.options = &options;
    dip_camtrack_set(&made.session.track, DIP_CATEGORY_AF, made.path, 30.0);
    dip_made_open_display(WIDTH, HEIGHT);
    strcpy(folder, "/tmp/test_preview_control.XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(socket_path, sizeof socket_path, "%s/socket", folder);
    remote = dip_remote_open(socket_path, NULL);
    assert_non_null(remote);
    const DipPreviewDef def = {.control = dip_remote_control(remote), .measures_prices = true};
    assert_true(dip_made_create_preview(&def, NULL));
    line_client_open(&client, socket_path);
    assert_non_null(strstr(take(), "\"protocol\":1"));
    assert_string_equal(ask("{\"request\":\"pause\"}"), "{\"id\":null,\"ok\":true}");
    return 0;
}

static int tear_down(void **state) {
    line_client_close(&client);
    dip_made_tear_down(state);
    dip_remote_close(&remote);
    return rmdir(folder);
}

static const DipPreviewState *state_now(void) {
    return dip_preview_state(made.preview);
}

static void assert_quality(int pane, const char *expected) {
    DipQuality quality;
    assert_true(dip_quality_parse(expected, &quality, NULL));
    assert_memory_equal(&state_now()->quality[pane], &quality, sizeof quality);
}

static void assert_ok(const char *line) {
    const char *reply = ask(line);
    if (!strstr(reply, "\"ok\":true")) {
        fail_msg("%s: %s", line, reply);
    }
}

static void assert_refused(const char *line, const char *says) {
    const char *reply = ask(line);
    if (!strstr(reply, "\"ok\":false") || !strstr(reply, says)) {
        fail_msg("%s: %s", line, reply);
    }
}

// --- requests ------------------------------------------------------------------------------------

static void settings_are_pushed_and_applied(void **state) {
    (void)state;
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4,aaa=on,asd=2\"}");
    assert_quality(DIP_PANE_REQUESTED, "aa=4,aaa=on,asd=2");
    assert_quality(DIP_PANE_CURRENT, "");
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=8\"}");
    assert_quality(DIP_PANE_REQUESTED, "aa=4,aaa=on,asd=2,af=8");
    assert_string_equal(state_now()->notice, "Requested: AA 4x, adaptive AA, groups of 2, AF 8x");
    assert_ok("{\"request\":\"apply\"}");
    assert_quality(DIP_PANE_CURRENT, "aa=4,aaa=on,asd=2,af=8");
    assert_ok("{\"request\":\"set\",\"pane\":[\"current\",\"requested\"],\"settings\":\"af=2\"}");
    assert_quality(DIP_PANE_CURRENT, "af=2");
    assert_quality(DIP_PANE_REQUESTED, "af=2");
}

// A panel that answers polls need not fill the status line, and can hide the preview's own panel.
static void notices_and_the_panel_can_be_off(void **state) {
    (void)state;
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4\"}");
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=8\",\"notices\":"
              "\"off\"}");
    assert_quality(DIP_PANE_REQUESTED, "aa=4,af=8");
    assert_string_equal(state_now()->notice, "Requested: AA 4x");
    assert_refused("{\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=8\",\"notices\":"
                   "\"loud\"}",
                   "\"field\":\"notices\"");
    assert_ok("{\"request\":\"panel\",\"show\":\"off\"}");
    assert_true(state_now()->tools.bare);
    assert_ok("{\"request\":\"panel\",\"show\":\"on\"}");
    assert_false(state_now()->tools.bare);
}

// A panel that changes settings while time runs leaves the camera where it is.
static void settings_move_no_camera(void **state) {
    (void)state;
    assert_ok("{\"request\":\"play\"}");
    const int64_t before_ns = state_now()->play_ns;
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=8\"}");
    dip_made_turn();
    assert_ok("{\"request\":\"set\",\"pane\":[\"current\",\"requested\"],\"settings\":\"aa=2\"}");
    dip_made_turn();
    assert_int_equal(state_now()->track->active, DIP_CATEGORY_DEFAULT);
    assert_true(state_now()->play_ns > before_ns);
    assert_true(state_now()->play_ns < before_ns + INT64_C(1000000000));
    assert_false(state_now()->manual);
}

// One pane's settings would allow the change, the other's would not: neither changes.
static void a_refused_change_changes_no_pane(void **state) {
    (void)state;
    assert_ok("{\"request\":\"set\",\"pane\":\"current\",\"settings\":\"aa=4\"}");
    assert_refused("{\"request\":\"set\",\"pane\":[\"current\",\"requested\"],\"change\":"
                   "\"asd=2\"}",
                   "\"code\":\"CONFLICT\",\"field\":\"asd\"");
    assert_quality(DIP_PANE_CURRENT, "aa=4");
    assert_quality(DIP_PANE_REQUESTED, "");
}

static void settings_that_a_pane_has_already_draw_nothing(void **state) {
    (void)state;
    const unsigned changes = state_now()->scene_changes;
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=none\"}");
    assert_int_equal(state_now()->scene_changes, changes);
}

static void time_and_path_follow_requests(void **state) {
    (void)state;
    assert_ok("{\"request\":\"seek\",\"time_s\":3.25}");
    assert_non_null(strstr(ask("{\"request\":\"get\",\"what\":\"state\"}"),
                           "{\"paused\":true,\"time_s\":3.25,\"category\":\"DEFAULT\","
                           "\"free_camera\":false,\"scene\":\"models\",\"animation\":"
                           "\"none\",\"width\":64,\"height\":100}"));
    assert_ok("{\"request\":\"seek\",\"time_s\":23.5}"); // The path lasts 10 seconds.
    assert_non_null(strstr(ask("{\"request\":\"get\",\"what\":\"state\"}"), "\"time_s\":3.5,"));
    assert_ok("{\"request\":\"path\",\"category\":\"AF\"}");
    assert_int_equal(state_now()->track->active, DIP_CATEGORY_AF);
    assert_refused("{\"request\":\"path\",\"category\":\"AA\"}", "accepted DEFAULT AF\"");
    assert_int_equal(state_now()->track->active, DIP_CATEGORY_AF);
    assert_ok("{\"request\":\"play\"}");
    assert_false(state_now()->paused);
    assert_ok("{\"request\":\"play\"}");
    assert_false(state_now()->paused);
    assert_ok("{\"request\":\"pause\"}");
    assert_true(state_now()->paused);
}

static void scenes_that_are_not_there_are_refused(void **state) {
    (void)state;
    assert_ok("{\"request\":\"scene\",\"name\":\"models\"}");
    assert_refused("{\"request\":\"scene\",\"name\":\"moon\"}", "\"field\":\"name\"");
    assert_refused("{\"request\":\"scene\",\"name\":\"tour\"}", "\"code\":\"UNSUPPORTED\"");
}

static void the_size_of_the_panes_is_set(void **state) {
    (void)state;
    assert_non_null(strstr(ask("{\"request\":\"size\",\"width\":192,\"height\":220}"),
                           "\"ok\":true,\"width\":192,\"height\":220}"));
    assert_int_equal(dip_fake_display_picture(made.fake).width, 2 * 192 + DIP_PANE_GAP_PX);
    assert_non_null(
        strstr(ask("{\"request\":\"get\",\"what\":\"state\"}"), "\"width\":192,\"height\":220"));
}

// Returns the colours of a pixel as `pick` reports them.
static void pick(int x, int y, int colours[DIP_PANE_COUNT][3]) {
    char line[64];
    snprintf(line, sizeof line, "{\"request\":\"pick\",\"x\":%d,\"y\":%d}", x, y);
    cJSON *reply = cJSON_Parse(ask(line));
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const cJSON *colour = cJSON_GetObjectItemCaseSensitive(reply, dip_pane_names[p]);
        for (int c = 0; c < 3; ++c) {
            assert_true(cJSON_IsNumber(cJSON_GetArrayItem(colour, c)));
            colours[p][c] = cJSON_GetArrayItem(colour, c)->valueint;
        }
    }
    cJSON_Delete(reply);
}

// The picked colours are those on the display. The pixel lies between the label and the notice. A
// pick waits for the pictures of the settings before it, which are sent together with it.
static void picks_tell_the_colours_that_show(void **state) {
    (void)state;
    const int x = 40, y = 50;
    int colours[DIP_PANE_COUNT][3];
    line_client_line(&client, "{\"request\":\"set\",\"pane\":\"requested\",\"settings\":"
                              "\"mipdebug=on\"}");
    line_client_line(&client, "{\"request\":\"apply\"}");
    line_client_line(&client, "{\"request\":\"set\",\"pane\":\"current\",\"settings\":\"aa=8\"}");
    for (int i = 0; i < 3; ++i) {
        assert_non_null(strstr(take(), "\"ok\":true"));
    }
    pick(x, y, colours);
    const DipPixels shown = dip_fake_display_picture(made.fake);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const int left = p * (PANE_WIDTH + DIP_PANE_GAP_PX);
        const uint8_t *pixel =
            shown.rgba8 + (size_t)y * shown.stride_bytes + 4 * (size_t)(left + x);
        for (int c = 0; c < 3; ++c) {
            assert_int_equal(colours[p][c], pixel[c]);
        }
    }
    assert_memory_not_equal(colours[0], colours[1], sizeof colours[0]);
    assert_refused("{\"request\":\"pick\",\"x\":64,\"y\":0}", "accepted 0..63");
    assert_refused("{\"request\":\"pick\",\"x\":0,\"y\":100}", "accepted 0..99");
}

static void screenshots_are_written_to_the_named_file(void **state) {
    (void)state;
    char line[160];
    char file[96];
    snprintf(file, sizeof file, "%s/a.png", folder);
    snprintf(line, sizeof line, "{\"request\":\"screenshot\",\"file\":\"%s\"}", file);
    assert_ok(line);
    assert_int_equal(unlink(file), 0);
    assert_refused("{\"request\":\"screenshot\",\"file\":\"/nowhere/a.png\"}", "\"code\":\"IO\"");
}

static void lists_name_what_is_accepted(void **state) {
    (void)state;
    const char *reply = ask("{\"request\":\"get\",\"what\":[\"paths\",\"scenes\",\"steps\"]}");
    assert_non_null(strstr(reply, "{\"category\":\"AF\",\"title\":\"Anisotropic filtering\","
                                  "\"available\":true}"));
    assert_non_null(strstr(reply, "\"models\"]"));
    assert_non_null(strstr(reply, "\"steps\":[\"none\",\"2\",\"4\",\"8\",\"16\"],\"default\":"
                                  "\"none\",\"category\":\"AF\"}"));
    assert_null(strstr(reply, "\"state\""));
}

static void warnings_of_loading_are_told(void **state) {
    (void)state;
    static const char request[] = "{\"request\":\"get\",\"what\":\"warnings\"}";
    DipError warning = {.file = "m.gltf", .key = "k", .message = "a \"b\"\x1b\xff"};
    assert_non_null(strstr(ask(request), "\"warnings\":[],\"warnings_left_out\":0"));
    dip_error_list_add(&made.session.warnings, &warning);
    dip_error_list_add(&made.session.warnings, &(DipError){.line = 3, .message = "c"});
    made.session.warnings_left_out = 4;
    assert_non_null(strstr(ask(request),
                           "\"warnings\":[{\"file\":\"m.gltf\",\"line\":null,\"key\":\"k\","
                           "\"message\":\"a \\\"b\\\"??\"},{\"file\":null,\"line\":3,\"key\":null,"
                           "\"message\":\"c\"}],\"warnings_left_out\":4"));
    assert_null(strstr(ask("{\"request\":\"get\"}"), "warnings"));
    dip_error_list_free(&made.session.warnings);
}

static void a_scene_without_animations_plays_none(void **state) {
    (void)state;
    assert_non_null(
        strstr(ask("{\"request\":\"get\",\"what\":\"animations\"}"), "\"animations\":[]"));
    assert_non_null(strstr(ask("{\"request\":\"get\"}"), "\"animation\":\"none\""));
    assert_ok("{\"request\":\"animation\",\"name\":\"none\"}");
    assert_refused("{\"request\":\"animation\",\"name\":\"run\"}",
                   "'run' is no animation of the models, accepted none");
    assert_refused("{\"request\":\"animation\"}", "\"field\":\"name\"");
}

static void quit_ends_the_preview_with_a_reply(void **state) {
    (void)state;
    const char *line;
    line_client_line(&client, "{\"id\":9,\"request\":\"quit\"}");
    dip_made_turn();
    assert_true(dip_preview_state(made.preview)->quit);
    assert_true(line_client_take(&client, &line));
    assert_string_equal(line, "{\"id\":9,\"ok\":true}");
}

// --- events --------------------------------------------------------------------------------------

static bool await_event(const char *part) {
    for (int i = 0; i < 20; ++i) {
        if (strstr(take(), part)) {
            return true;
        }
    }
    return false;
}

// Keys change the settings as well; subscribers hear of it.
static void subscribers_hear_of_every_change(void **state) {
    (void)state;
    assert_ok("{\"request\":\"subscribe\",\"to\":[\"settings\",\"notices\"]}");
    assert_true(await_event("{\"event\":\"settings\",\"current\":\"aa=none,"));
    dip_fake_display_press(made.fake, (DipKeycode)'f', 0);
    assert_true(await_event("\"requested\":\"aa=none,taa=off,aaa=off,asd=1,af=2,"));
    assert_true(await_event("{\"event\":\"notices\",\"text\":\"Anisotropic filtering: 2\"}"));
    line_client_line(&client, "{\"request\":\"path\",\"category\":\"AF\"}");
    assert_true(await_event("{\"event\":\"notices\",\"text\":\"Path: Anisotropic filtering\"}"));
}

static void times_come_while_the_camera_moves(void **state) {
    (void)state;
    assert_ok("{\"request\":\"subscribe\",\"to\":\"times\"}");
    assert_true(await_event("\"event\":\"times\""));
    assert_ok("{\"request\":\"play\"}");
    int events = 0;
    for (int i = 0; i < 70; ++i) {
        const char *line;
        dip_made_turn();
        while (line_client_take(&client, &line)) {
            events += strstr(line, "\"stages_ms\":{\"geometry\":") != NULL;
        }
    }
    assert_in_range(events, 3, 6); // 70 pictures are 1.17 seconds; four events a second.
}

// Runs turns until an event tells the errors, which another thread measures. Returns the event.
static const char *await_measured_errors(void) {
    const char *line = "";
    for (int i = 0; i < 120000 && !strstr(line, "\"flip\":"); ++i) {
        const struct timespec millisecond = {0, 1000000};
        nanosleep(&millisecond, NULL);
        dip_made_turn();
        if (!line_client_take(&client, &line)) {
            line = "";
        }
    }
    return line;
}

static void errors_are_measured_for_subscribers(void **state) {
    (void)state;
    assert_ok("{\"request\":\"subscribe\",\"to\":\"errors\"}");
    assert_true(await_event("\"event\":\"errors\""));
    const char *line = await_measured_errors();
    assert_non_null(strstr(line, "\"requested\":{\"rmse_lin\":"));
    assert_non_null(strstr(line, "\"current\":{\"rmse_lin\":"));
    assert_false(dip_preview_shows_times(state_now()));
}

// A pane that shows mip colours is not judged: its error is left out and not sent as 0.
static void a_pane_that_is_not_judged_has_no_error(void **state) {
    (void)state;
    assert_ok("{\"request\":\"set\",\"pane\":\"current\",\"change\":\"mipdebug=on\"}");
    assert_ok("{\"request\":\"subscribe\",\"to\":\"errors\"}");
    const char *line = await_measured_errors();
    assert_non_null(strstr(line, "\"requested\":{\"rmse_lin\":"));
    assert_null(strstr(line, "\"current\":{\"rmse_lin\":"));
}

// Returns the price of a step in an event of prices, or NULL.
static const cJSON *step_in(const cJSON *event, const char *setting, int step) {
    const cJSON *settings = cJSON_GetObjectItemCaseSensitive(event, "settings");
    return cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(settings, setting), step);
}

static double number_in(const cJSON *object, const char *name) {
    const cJSON *number = cJSON_GetObjectItemCaseSensitive(object, name);
    assert_true(cJSON_IsNumber(number));
    return number->valuedouble;
}

// The panel is folded: prices are measured, with their errors, because a client asks for them.
static void prices_are_measured_for_subscribers(void **state) {
    (void)state;
    assert_false(state_now()->tools.open);
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4\"}");
    assert_ok("{\"request\":\"pause\"}");
    assert_ok("{\"request\":\"subscribe\",\"to\":\"prices\"}");
    cJSON *event = NULL;
    bool known = false;
    for (int i = 0; i < 120000 && !known; ++i) {
        const struct timespec millisecond = {0, 1000000};
        const char *line;
        nanosleep(&millisecond, NULL); // The truth is drawn by another thread.
        dip_made_turn();
        if (line_client_take(&client, &line)) {
            cJSON_Delete(event);
            event = cJSON_Parse(line);
            const cJSON *requested = cJSON_GetObjectItemCaseSensitive(event, "requested");
            known = cJSON_HasObjectItem(requested, "flip") && cJSON_HasObjectItem(requested, "ms");
        }
    }
    assert_true(known);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(event, "source")->valuestring, "rough");
    const cJSON *base = step_in(event, "aa", 0), *four = step_in(event, "aa", 2);
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(base, "state")->valuestring, "base");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(four, "step")->valuestring, "4");
    assert_true(number_in(base, "ms") > 0.0);
    assert_true(number_in(four, "ms_low") <= number_in(four, "ms"));
    assert_true(number_in(four, "flip") < 0.0); // Antialiasing lessens the error.
    const cJSON *requested = cJSON_GetObjectItemCaseSensitive(event, "requested");
    assert_true(fabs(number_in(requested, "ms") - number_in(base, "ms") - number_in(four, "ms")) <
                1e-6);
    cJSON_Delete(event);
    assert_ok("{\"request\":\"unsubscribe\",\"to\":\"prices\"}");
    assert_false(state_now()->wants_prices);
}

// The errors of prices need the scene's file once more. If it has become bad, the prices go on
// without errors, and the file is not read again and again.
static void prices_read_a_broken_scene_file_only_once(void **state) {
    (void)state;
    made.scene_is_broken = true;
    assert_ok("{\"request\":\"set\",\"pane\":\"requested\",\"settings\":\"aa=4\"}");
    assert_ok("{\"request\":\"pause\"}");
    assert_ok("{\"request\":\"subscribe\",\"to\":\"prices\"}");
    for (int i = 0; i < 120000 && made.scene_reads == 0; ++i) {
        const char *line;
        dip_made_turn();
        line_client_take(&client, &line);
    }
    assert_int_equal(made.scene_reads, 1);
    assert_non_null(strstr(state_now()->notice, "the importer crashed"));
    for (int i = 0; i < 200; ++i) {
        const char *line;
        dip_made_turn();
        line_client_take(&client, &line);
    }
    assert_int_equal(made.scene_reads, 1);
    assert_true(state_now()->wants_prices);
}

static void clicks_are_picks(void **state) {
    (void)state;
    int colours[DIP_PANE_COUNT][3];
    pick(10, 60, colours);
    assert_ok("{\"request\":\"subscribe\",\"to\":\"picks\"}");
    dip_fake_display_click(made.fake, DIP_MOUSE_RIGHT, PANE_WIDTH + DIP_PANE_GAP_PX + 10, 60, 1);
    char expected[128];
    snprintf(expected, sizeof expected,
             "{\"event\":\"picks\",\"pane\":\"requested\",\"button\":\"right\",\"x\":10,"
             "\"y\":60,\"current\":[%d,%d,%d],",
             colours[0][0], colours[0][1], colours[0][2]);
    assert_true(await_event(expected));
    dip_fake_display_click(made.fake, DIP_MOUSE_LEFT, PANE_WIDTH, 60, 1); // In the gap.
    assert_string_equal(take(), "nothing");
}

// Where one picture takes the place of both panes, a press picks the pixel of the picture that
// shows there, and the pane that shows it.
static void clicks_pick_in_every_comparison(void **state) {
    (void)state;
    static const struct {
        int presses; // How often a key chooses the next comparison.
        int x;
        const char *event;
    } cases[] = {
        {1, 20, "\"pane\":\"current\",\"button\":\"left\",\"x\":20,\"y\":60,"},
        {1, 110, "\"pane\":\"requested\",\"button\":\"left\",\"x\":110,\"y\":60,"},
        {2, 110, "\"pane\":\"current\",\"button\":\"left\",\"x\":110,\"y\":60,"},
        {3, 110, "\"pane\":\"current\",\"button\":\"left\",\"x\":110,\"y\":60,"},
    };
    assert_ok("{\"request\":\"subscribe\",\"to\":\"picks\"}");
    for (size_t i = 0, pressed = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        for (; pressed < (size_t)cases[i].presses; ++pressed) {
            dip_fake_display_press(made.fake, (DipKeycode)'j', 0);
            dip_made_turn();
        }
        assert_ok("{\"request\":\"panel\",\"show\":\"off\"}"); // The drawer would cover a pane.
        dip_made_turn();
        dip_fake_display_click(made.fake, DIP_MOUSE_LEFT, cases[i].x, 60, 1);
        if (!await_event(cases[i].event)) {
            fail_msg("no event with %s", cases[i].event);
        }
    }
}

// The preview asks for settings four times a second; the panel answers with `set`.
static void polls_ask_for_settings(void **state) {
    (void)state;
    assert_ok("{\"request\":\"subscribe\",\"to\":\"polls\"}");
    int polls = 0;
    for (int i = 0; i < 40; ++i) { // Each turn of the resting preview waits 30 ms.
        const char *line;
        dip_made_turn();
        if (line_client_take(&client, &line)) {
            polls += strstr(line, "\"event\":\"polls\",\"current\":") != NULL;
        }
    }
    assert_in_range(polls, 4, 6);
}

// --- random lines --------------------------------------------------------------------------------

static DipPreviewState checked_state(void) {
    DipPreviewState copy;
    memcpy(&copy, state_now(), sizeof copy); // Also copies the padding, which is compared.
    copy.notice_end_ns = 0;                  // Notices end by themselves.
    memset(copy.notice, 0, sizeof copy.notice);
    copy.wants_prices = false; // Subscriptions change it.
    return copy;
}

static int line_count = 10000; // --lines gives fewer.

static void send_random(const RandomLine *line) {
    assert_int_equal(line_client_send(&client, line->bytes, line->length), line->length);
    assert_int_equal(line_client_send(&client, "\n", 1), 1);
}

// Takes the replies to `count` lines and ignores events.
static void take_replies(int count) {
    for (int i = 0; i < 200 && count > 0; ++i) {
        const char *line = take();
        count -= strncmp(line, "{\"id\":", 6) == 0;
    }
    assert_int_equal(count, 0);
}

static void random_lines_do_no_harm(void **state) {
    (void)state;
    uint32_t random = 2006;
    RandomLine line;
    for (int id = 0; id < line_count; id += 50) {
        // Bad lines alone change nothing.
        const DipPreviewState before = checked_state();
        for (int i = 0; i < 25; ++i) {
            do {
                random_line_make(&line, &random, id + i);
            } while (line.kind != RANDOM_LINE_BAD);
            send_random(&line);
        }
        take_replies(25);
        if (before.paused) {
            const DipPreviewState after = checked_state();
            assert_memory_equal(&before, &after, sizeof before);
        }
        for (int i = 25; i < 50; ++i) {
            random_line_make(&line, &random, id + i);
            send_random(&line);
        }
        take_replies(25);
        assert_false(dip_preview_state(made.preview)->quit);
        line_client_line(&client, "{\"request\":\"unsubscribe\",\"to\":[\"times\",\"errors\","
                                  "\"settings\",\"prices\",\"notices\",\"picks\",\"polls\"]}");
        take_replies(1);
    }
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--lines") == 0) {
        line_count = atoi(argv[2]);
    }
#define CONTROL_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CONTROL_TEST(settings_are_pushed_and_applied),
        CONTROL_TEST(notices_and_the_panel_can_be_off),
        CONTROL_TEST(settings_move_no_camera),
        CONTROL_TEST(a_refused_change_changes_no_pane),
        CONTROL_TEST(settings_that_a_pane_has_already_draw_nothing),
        CONTROL_TEST(time_and_path_follow_requests),
        CONTROL_TEST(scenes_that_are_not_there_are_refused),
        CONTROL_TEST(the_size_of_the_panes_is_set),
        CONTROL_TEST(picks_tell_the_colours_that_show),
        CONTROL_TEST(screenshots_are_written_to_the_named_file),
        CONTROL_TEST(lists_name_what_is_accepted),
        CONTROL_TEST(warnings_of_loading_are_told),
        CONTROL_TEST(a_scene_without_animations_plays_none),
        CONTROL_TEST(quit_ends_the_preview_with_a_reply),
        CONTROL_TEST(subscribers_hear_of_every_change),
        CONTROL_TEST(times_come_while_the_camera_moves),
        CONTROL_TEST(errors_are_measured_for_subscribers),
        CONTROL_TEST(a_pane_that_is_not_judged_has_no_error),
        CONTROL_TEST(prices_are_measured_for_subscribers),
        CONTROL_TEST(prices_read_a_broken_scene_file_only_once),
        CONTROL_TEST(clicks_are_picks),
        CONTROL_TEST(clicks_pick_in_every_comparison),
        CONTROL_TEST(polls_ask_for_settings),
        CONTROL_TEST(random_lines_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
