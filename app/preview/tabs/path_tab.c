// Declares the path tab: the choice of the path that the camera follows and of the animation that
// the models play, the controls that fly the camera, and the editor of a path that the user makes
// from keys (poses).
#include "app/preview/prices/price_text.h"
#include "app/preview/state/pilot.h"
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

enum { KEY_WIDTH = 34, NARROW = 400 };
enum {
    ID_EDIT,
    ID_CAMERA = 16,
    ID_END = 32,
    ID_KEYS = 64,
    MAX_SHOWN_KEYS = 64,
    ID_PATHS = 256,
    ID_ANIMATIONS = 1024
};

static void act(DipFlow *flow, DipAction action, int argument, bool reverse) {
    dip_preview_act(flow->window->state, action, argument, reverse, dip_ui_now_ns(flow->ui));
}

// Declares a button that carries out an action.
static void action_button(DipFlow *flow, unsigned id, const char *text, DipUiLook look,
                          const char *tip, DipAction action, int argument) {
    if (dip_flow_button(flow, id, text, look, tip)) {
        act(flow, action, argument, false);
    }
}

// --- the path that plays -------------------------------------------------------------------------

// Lists the camera paths, each once. A category of settings may have a path (camtrack.h), and
// several categories may share a path. A path is listed as the index of a category that has it: the
// active category if this has the path, otherwise the first category with the path. Returns the
// number of paths.
static int list_paths(const DipPreviewState *state, int paths[DIP_CAMTRACK_CATEGORIES]) {
    const DipCamTrack *track = state->track;
    int count = 0;
    for (int c = 0; c < DIP_CAMTRACK_CATEGORIES; ++c) {
        const DipCamPath *path = track->categories[c].path;
        int same = 0;
        while (same < count && track->categories[paths[same]].path != path) {
            ++same;
        }
        if (path && same == count) {
            paths[count++] = c;
        } else if (path && c == track->active) {
            paths[same] = c;
        }
    }
    return count;
}

// --- rows of alternatives ------------------------------------------------------------------------

// A row of alternatives (paths or animations), of which one plays.
typedef struct Choices {
    const char *const *texts;
    int count;
    int playing;              // Index of the alternative that plays, or -1 for none.
    bool chosen;              // The button of the alternative that plays looks chosen.
    unsigned id;              // Id of the first button. The arrows have the two ids before it.
    const char *tip;          // Each button's tip: these words, then the name from `names`.
    const char *const *names; // The alternatives' names for the tips.
    const char *tip_before;   // Tip of the arrow to the alternative before.
    const char *tip_next;
} Choices;

// What declare_choices returns if no alternative was pressed.
enum { PRESSED_NOTHING = -1, PRESSED_BEFORE = -2, PRESSED_NEXT = -3 };

// Returns the index of the first alternative to show in a row of the given width, so that the
// alternative that plays shows, too.
static int first_choice(const DipFlow *flow, const Choices *choices, int width) {
    int first = dip_max(choices->playing, 0);
    int used = dip_flow_button_width(flow, choices->texts[first]);
    while (first > 0) {
        used += flow->gap + dip_flow_button_width(flow, choices->texts[first - 1]);
        if (used > width) {
            break;
        }
        --first;
    }
    return first;
}

// Declares the alternatives in the rest of the row, with arrows if not all have room there. Returns
// the index of the alternative that was pressed, or one of the numbers above.
static int declare_choices(DipFlow *flow, const Choices *choices) {
    const int room = dip_rect_right(flow->body) - flow->x;
    int width = -flow->gap, first = 0, pressed = PRESSED_NOTHING;
    for (int i = 0; i < choices->count; ++i) {
        width += flow->gap + dip_flow_button_width(flow, choices->texts[i]);
    }
    if (width > room) {
        const int arrows = 2 * (dip_flow_button_width(flow, "<") + flow->gap);
        first = first_choice(flow, choices, room - arrows);
        if (dip_flow_button(flow, choices->id - 2, "<", DIP_UI_PLAIN, choices->tip_before)) {
            pressed = PRESSED_BEFORE;
        }
        if (dip_flow_button(flow, choices->id - 1, ">", DIP_UI_PLAIN, choices->tip_next)) {
            pressed = PRESSED_NEXT;
        }
    }
    const int row = flow->y;
    for (int i = first; i < choices->count && flow->y == row; ++i) {
        char tip[160];
        if (flow->x + dip_flow_button_width(flow, choices->texts[i]) > dip_rect_right(flow->body) &&
            i > first) {
            break;
        }
        snprintf(tip, sizeof tip, "%s %.120s.", choices->tip, choices->names[i]);
        if (dip_flow_choice(flow, choices->id + (unsigned)i, choices->texts[i],
                            i == choices->playing && choices->chosen, tip)) {
            pressed = i;
        }
    }
    return pressed;
}

// Declares one row of paths, unless there is only one path or the gallery shows.
static void declare_paths(DipFlow *flow) {
    const DipPreviewState *state = flow->window->state;
    const char *texts[DIP_CAMTRACK_CATEGORIES], *names[DIP_CAMTRACK_CATEGORIES];
    int paths[DIP_CAMTRACK_CATEGORIES];
    Choices choices = {.texts = texts,
                       .count = list_paths(state, paths),
                       .chosen = !state->manual,
                       .id = ID_PATHS,
                       .tip = "The camera follows the path",
                       .names = names,
                       .tip_before = "The path before (Left arrow).",
                       .tip_next = "The next path (P, or Right arrow)."};
    if (choices.count < 2 || state->shows_gallery) {
        return;
    }
    for (int i = 0; i < choices.count; ++i) {
        texts[i] = dip_preview_path_title(state, paths[i]);
        names[i] = dip_session_path_name(state->track, paths[i]);
        choices.playing = paths[i] == state->track->active ? i : choices.playing;
    }
    const int pressed = declare_choices(flow, &choices);
    if (pressed >= 0) {
        act(flow, DIP_ACTION_PATH, paths[pressed], false);
    } else if (pressed != PRESSED_NOTHING) {
        act(flow, DIP_ACTION_NEXT_PATH, 0, pressed == PRESSED_BEFORE);
    }
}

// --- the animation that plays --------------------------------------------------------------------

// Begins a new row unless the rest of this row has room for some animations.
static void make_room(DipFlow *flow) {
    flow->x += 2 * flow->gap;
    if (flow->x + 4 * dip_flow_button_width(flow, "No animation") > dip_rect_right(flow->body)) {
        dip_flow_next_row(flow);
    }
}

// Declares the animations of the models, in the rest of the row or in a new row.
static void declare_animations(DipFlow *flow) {
    const DipPreviewState *state = flow->window->state;
    const DipSessionAnimations *animations = state->animations;
    if (!animations || state->shows_gallery) {
        return;
    }
    make_room(flow);
    dip_flow_text(flow, dip_style_dim,
                  animations->count ? "Animation:" : "Animation: the models have none.");
    if (animations->count == 0) {
        return;
    }
    const bool waits = state->wants_animation || state->opens_animation;
    const int now = waits ? state->wanted_animation : animations->playing;
    if (dip_flow_choice(flow, ID_ANIMATIONS - 3, flow->narrow ? "No animation" : "None", now < 0,
                        "The models stand still, in the shape of their files.")) {
        act(flow, DIP_ACTION_ANIMATION, -1, false);
    }
    const char *const *names = (const char *const *)animations->names;
    const Choices choices = {.texts = names,
                             .count = animations->count,
                             .playing = now,
                             .chosen = true,
                             .id = ID_ANIMATIONS,
                             .tip = "The models play the animation",
                             .names = names,
                             .tip_before = "The animation before.",
                             .tip_next = "The next animation."};
    const int pressed = declare_choices(flow, &choices);
    if (pressed >= 0) {
        act(flow, DIP_ACTION_ANIMATION, pressed, false);
    } else if (pressed != PRESSED_NOTHING) {
        const int by = pressed == PRESSED_NEXT ? 1 : -1;
        const int from = now < 0 && by < 0 ? 0 : now;
        act(flow, DIP_ACTION_ANIMATION, (from + by + animations->count) % animations->count, false);
    }
}

// --- the path that the user makes ----------------------------------------------------------------

// Declares a button that edits the path. Without keys, only some edits are possible.
static void edit_button(DipFlow *flow, DipPathEdit edit, const char *text, DipUiLook look,
                        const char *tip) {
    const bool possible = edit == DIP_PATH_EDIT_ADD || edit == DIP_PATH_EDIT_TAKE ||
                          flow->window->state->editor->count > 0;
    action_button(flow, ID_EDIT + (unsigned)edit, text, possible ? look : DIP_UI_OFF,
                  possible ? tip : "The path has no key yet.", DIP_ACTION_PATH_EDIT, (int)edit);
}

static void declare_edits(DipFlow *flow) {
    const DipPathEditor *editor = flow->window->state->editor;
    const bool flies = (editor->fly != NULL);
    edit_button(flow, DIP_PATH_EDIT_ADD, "Add key", editor->count ? DIP_UI_PLAIN : DIP_UI_PRIMARY,
                "Adds the camera's pose behind the chosen key (Ctrl+N).");
    edit_button(flow, DIP_PATH_EDIT_REPLACE, "Replace", DIP_UI_PLAIN,
                "Gives the chosen key the camera's pose (Ctrl+R).");
    edit_button(flow, DIP_PATH_EDIT_DELETE, "Delete", DIP_UI_PLAIN,
                "Deletes the chosen key (Ctrl+Delete).");
    edit_button(flow, DIP_PATH_EDIT_FLY, flies ? "Stop" : "Fly it",
                flies ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                "Flies the path from the chosen key on (Ctrl+F).");
    edit_button(flow, DIP_PATH_EDIT_SAVE, "Save .pth",
                editor->unsaved ? DIP_UI_PRIMARY : DIP_UI_PLAIN,
                "Saves the path to a new file in the working folder (Ctrl+W).");
    edit_button(flow, DIP_PATH_EDIT_TAKE, "Edit path", DIP_UI_PLAIN,
                "Takes the keys of the path that plays, in place of these keys (Ctrl+O).");
}

static void declare_key(DipFlow *flow, size_t index) {
    const DipPathEditor *editor = flow->window->state->editor;
    const double *position = editor->keys[index].position_world;
    char text[16], tip[160], at[3][DIP_STEP_NAME_BYTES];
    for (int i = 0; i < 3; i++) {
        dip_panel_number(position[i], 2, false, at[i]);
    }
    snprintf(text, sizeof text, "%zu", index + 1);
    snprintf(tip, sizeof tip, "Key %zu at %s, %s, %s m. Click: the camera goes there.", index + 1,
             at[0], at[1], at[2]);
    const DipRect rect = dip_flow_next(flow, dip_ui_px(flow->ui, KEY_WIDTH));
    if (!dip_rect_is_empty(rect) &&
        dip_ui_button(flow->ui, DIP_UI_ID(DIP_UI_PATH, ID_KEYS + index % MAX_SHOWN_KEYS), rect,
                      text, index == editor->chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, tip)) {
        dip_pilot_choose_key(flow->window->state, index, dip_ui_now_ns(flow->ui));
    }
}

// Declares a row of buttons for the path's keys around the chosen key.
static void declare_keys(DipFlow *flow) {
    const DipPathEditor *editor = flow->window->state->editor;
    const int count = (int)editor->count;
    const int step = dip_ui_px(flow->ui, KEY_WIDTH) + flow->gap;
    const int room = flow->body.width / dip_max(1, step) - 2; // Leaves room for two arrows.
    const int shown = dip_max(1, dip_min(room, MAX_SHOWN_KEYS));
    const int middle = (int)editor->chosen - shown / 2;
    const int first = dip_max(0, dip_min(middle, count - shown));
    edit_button(flow, DIP_PATH_EDIT_BEFORE, "<", DIP_UI_PLAIN, "The key before (Ctrl+Left).");
    edit_button(flow, DIP_PATH_EDIT_NEXT, ">", DIP_UI_PLAIN, "The next key (Ctrl+Right).");
    if (count == 0) {
        dip_flow_text(flow, dip_style_dim, "Fly to a viewpoint, add it as a key, and so on.");
    }
    for (int i = first; i < count && i < first + shown; ++i) {
        declare_key(flow, (size_t)i);
    }
}

static void declare_period(DipFlow *flow) {
    const DipPathEditor *editor = flow->window->state->editor;
    char text[120];
    edit_button(flow, DIP_PATH_EDIT_FASTER, "-", DIP_UI_PLAIN,
                "Less time from key to key (Ctrl+Down).");
    edit_button(flow, DIP_PATH_EDIT_SLOWER, "+", DIP_UI_PLAIN,
                "More time from key to key (Ctrl+Up).");
    snprintf(text, sizeof text, "%.3g s from key to key", 1e-9 * (double)editor->period_ns);
    dip_flow_text(flow, dip_style_soft, text);
    if (editor->file[0]) {
        snprintf(text, sizeof text, "Saved: %s%s", editor->file,
                 editor->unsaved ? ", changed since" : "");
        dip_flow_text(flow, dip_style_dim, text);
    }
}

static void declare_ends(DipFlow *flow) {
    static const char *const ends[DIP_CAMPATH_END_COUNT][2] = {
        [DIP_CAMPATH_END_loop] = {"Loop", "Paths fly from the last key to the first one."},
        [DIP_CAMPATH_END_once] = {"Once", "Paths stop at the last key."},
        [DIP_CAMPATH_END_back] = {"There and back", "Paths fly back to the first key."}};
    const int now = (int)flow->window->state->track->end;
    dip_flow_text(flow, dip_style_dim, "At the end (Ctrl+E):");
    for (int i = 0; i < DIP_CAMPATH_END_COUNT; ++i) {
        if (dip_flow_choice(flow, ID_END + (unsigned)i, ends[i][0], i == now, ends[i][1]) &&
            i != now) {
            act(flow, DIP_ACTION_PATH_END, i - now, false);
        }
    }
}

// --- the camera ----------------------------------------------------------------------------------

static void declare_camera(DipFlow *flow) {
    const DipPreviewState *state = flow->window->state;
    char text[48];
    action_button(flow, ID_CAMERA, "Free camera", state->manual ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                  "Takes the camera off its path, or back (C). Keys W A S D Q E and dragging "
                  "in a pane move it.",
                  DIP_ACTION_CAMERA, 0);
    action_button(flow, ID_CAMERA + 1, state->flight.orbits ? "Orbits" : "Turns", DIP_UI_PLAIN,
                  "Whether dragging orbits the scene or turns the camera on the spot (\\).",
                  DIP_ACTION_ORBIT, 0);
    action_button(flow, ID_CAMERA + 2, flow->narrow ? "Pose" : "Pose of the path",
                  state->manual ? DIP_UI_PLAIN : DIP_UI_OFF,
                  "Gives the free camera the pose of the path (Home).", DIP_ACTION_CAMERA_BACK, 0);
    if (dip_flow_button(flow, ID_CAMERA + 3, "Slower", DIP_UI_PLAIN,
                        "Slows the free camera down, as the wheel over a pane does.")) {
        act(flow, DIP_ACTION_SPEED, 1, true);
    }
    action_button(flow, ID_CAMERA + 4, "Faster", DIP_UI_PLAIN,
                  "Speeds the free camera up, as the wheel over a pane does.", DIP_ACTION_SPEED, 1);
    snprintf(text, sizeof text, "%.3g m/s", dip_flight_speed(&state->flight));
    dip_flow_text(flow, dip_style_soft, text);
}

static void declare_steps(DipFlow *flow) {
    static const struct {
        const char *text;
        int right, forward;
        const char *tip;
    } steps[] = {{"Forward", 0, 1, "Moves the free camera forward (W while held)."},
                 {"Back", 0, -1, "Moves the free camera back (S while held)."},
                 {"Left", -1, 0, "Moves the free camera to the left (A while held)."},
                 {"Right", 1, 0, "Moves the free camera to the right (D while held)."}};
    for (unsigned i = 0; i < sizeof steps / sizeof *steps; ++i) {
        if (dip_flow_button(flow, ID_CAMERA + 5 + i, steps[i].text, DIP_UI_PLAIN, steps[i].tip)) {
            dip_pilot_step(flow->window->state, steps[i].right, steps[i].forward,
                           dip_ui_now_ns(flow->ui));
        }
    }
}

void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body) {
    DipFlow flow =
        dip_flow_make(ui, window, DIP_UI_PATH, body, 12, body.width < dip_ui_px(ui, NARROW));
    declare_paths(&flow);
    dip_flow_next_row(&flow);
    if (window->state->editor) {
        declare_edits(&flow);
        dip_flow_next_group(&flow);
        declare_keys(&flow);
        dip_flow_next_group(&flow);
        declare_period(&flow);
        dip_flow_next_group(&flow);
    }
    declare_ends(&flow);
    declare_animations(&flow);
    dip_flow_next_group(&flow);
    declare_camera(&flow);
    declare_steps(&flow);
}
