// The tab of the camera: the path that it follows, how it flies, and the path that the user makes
// key by key.
#include "app/preview/state/pilot.h"
#include "app/ui/style.h"
#include "app/preview/tabs/tabs.h"

#include <stdio.h>

enum { KEY_WIDTH = 34, NARROW = 400 };
enum { ID_EDIT, ID_CAMERA = 16, ID_END = 32, ID_KEYS = 64, MAX_SHOWN_KEYS = 64, ID_PATHS = 256 };

// What the tab's rows are declared with. A narrow tab has low, full rows and no notes.
typedef struct Flow {
    DipFlow row;
    DipUi *ui;
    DipPreviewState *state;
} Flow;

static bool flow_button(Flow *flow, unsigned id, const char *text, DipUiLook look,
                        const char *tip) {
    return dip_flow_button(&flow->row, id, text, look, tip);
}

// Begins a new row for other matters, where there is room for that.
static void next_group(Flow *flow) {
    if (!flow->row.narrow) {
        dip_flow_next_row(&flow->row);
    }
}

// Shows a note, which a narrow tab leaves out.
static void flow_text(Flow *flow, DipColour colour, const char *text) {
    if (!flow->row.narrow) {
        dip_flow_text(&flow->row, colour, text);
    }
}

static void act(Flow *flow, DipAction action, int argument, bool reverse) {
    dip_preview_act(flow->state, action, argument, reverse, dip_ui_now_ns(flow->ui));
}

// --- the path that plays -------------------------------------------------------------------------

// Lists the categories that have paths of their own. A path that several categories share is listed
// once, by the category that plays or else by the first one. Returns their number.
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

// Finds the first of the paths to show, so that the one that plays is among them in a row of the
// given width.
static int first_path(const Flow *flow, const int *paths, int playing, int width) {
    int first = playing;
    int used =
        dip_flow_button_width(&flow->row, dip_preview_path_title(flow->state, paths[playing]));
    while (first > 0) {
        used += flow->row.gap +
                dip_flow_button_width(&flow->row,
                                      dip_preview_path_title(flow->state, paths[first - 1]));
        if (used > width) {
            break;
        }
        --first;
    }
    return first;
}

// Declares one row of paths, with arrows if the row has no room for all.
static void declare_paths(Flow *flow) {
    DipPreviewState *state = flow->state;
    int paths[DIP_CAMTRACK_CATEGORIES];
    const int count = list_paths(state, paths);
    if (count < 2 || state->shows_gallery) {
        return;
    }
    int playing = 0;
    int width = 0;
    for (int i = 0; i < count; ++i) {
        playing = paths[i] == state->track->active ? i : playing;
        width += flow->row.gap +
                 dip_flow_button_width(&flow->row, dip_preview_path_title(state, paths[i]));
    }
    const int arrows = 2 * (dip_flow_button_width(&flow->row, "<") + flow->row.gap);
    const bool all = width <= flow->row.body.width;
    if (!all &&
        flow_button(flow, ID_PATHS - 2, "<", DIP_UI_PLAIN, "The path before (Left arrow).")) {
        act(flow, DIP_ACTION_NEXT_PATH, 0, true);
    }
    if (!all &&
        flow_button(flow, ID_PATHS - 1, ">", DIP_UI_PLAIN, "The next path (P, or Right arrow).")) {
        act(flow, DIP_ACTION_NEXT_PATH, 0, false);
    }
    const int row = flow->row.y;
    const int first = all ? 0 : first_path(flow, paths, playing, flow->row.body.width - arrows);
    for (int i = first; i < count; ++i) {
        const char *title = dip_preview_path_title(state, paths[i]);
        char tip[160];
        if (flow->row.x + dip_flow_button_width(&flow->row, title) >
                flow->row.body.x + flow->row.body.width &&
            i > first) {
            break;
        }
        snprintf(tip, sizeof tip, "The camera follows the path %s.",
                 dip_preview_path_name(state, paths[i]));
        const DipUiLook look = i == playing && !state->manual ? DIP_UI_CHOSEN : DIP_UI_PLAIN;
        if (flow->row.y == row &&
            flow_button(flow, ID_PATHS + (unsigned)paths[i], title, look, tip)) {
            act(flow, DIP_ACTION_PATH, paths[i], false);
        }
    }
}

// --- the path that the user makes ----------------------------------------------------------------

// Declares a button that edits the path. Without keys, only some edits are possible.
static void edit_button(Flow *flow, DipPathEdit edit, const char *text, DipUiLook look,
                        const char *tip) {
    const bool possible =
        edit == DIP_PATH_EDIT_ADD || edit == DIP_PATH_EDIT_TAKE || flow->state->editor->count > 0;
    if (flow_button(flow, ID_EDIT + (unsigned)edit, text, possible ? look : DIP_UI_OFF,
                    possible ? tip : "The path has no key yet.")) {
        act(flow, DIP_ACTION_PATH_EDIT, (int)edit, false);
    }
}

static void declare_edits(Flow *flow) {
    const DipPathEditor *editor = flow->state->editor;
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

static void declare_key(Flow *flow, size_t index) {
    DipPathEditor *editor = flow->state->editor;
    const DipCamKey key = editor->keys[index];
    char text[16], tip[160];
    snprintf(text, sizeof text, "%zu", index + 1);
    snprintf(tip, sizeof tip, "Key %zu at %.2f, %.2f, %.2f m. Click: the camera goes there.",
             index + 1, key.position_world[0], key.position_world[1], key.position_world[2]);
    const DipRect rect = dip_flow_next(&flow->row, dip_ui_px(flow->ui, KEY_WIDTH));
    if (!dip_rect_is_empty(rect) &&
        dip_ui_button(flow->ui, DIP_UI_ID(DIP_UI_PATH, ID_KEYS + index % MAX_SHOWN_KEYS), rect,
                      text, index == editor->chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, tip)) {
        dip_pilot_choose_key(flow->state, index, dip_ui_now_ns(flow->ui));
    }
}

// Declares one row of keys around the chosen one.
static void declare_keys(Flow *flow) {
    const DipPathEditor *editor = flow->state->editor;
    const int count = (int)editor->count;
    const int step = dip_ui_px(flow->ui, KEY_WIDTH) + flow->row.gap;
    const int room = flow->row.body.width / dip_max(1, step) - 2; // Two arrows take room, too.
    const int shown = dip_max(1, dip_min(room, MAX_SHOWN_KEYS));
    const int middle = (int)editor->chosen - shown / 2;
    const int first = dip_max(0, dip_min(middle, count - shown));
    edit_button(flow, DIP_PATH_EDIT_BEFORE, "<", DIP_UI_PLAIN, "The key before (Ctrl+Left).");
    edit_button(flow, DIP_PATH_EDIT_NEXT, ">", DIP_UI_PLAIN, "The next key (Ctrl+Right).");
    if (count == 0) {
        flow_text(flow, dip_style_dim, "Fly to a viewpoint, add it as a key, and so on.");
    }
    for (int i = first; i < count && i < first + shown; ++i) {
        declare_key(flow, (size_t)i);
    }
}

static void declare_period(Flow *flow) {
    const DipPathEditor *editor = flow->state->editor;
    const double period_s = 1e-9 * (double)editor->period_ns;
    char text[120];
    edit_button(flow, DIP_PATH_EDIT_FASTER, "-", DIP_UI_PLAIN,
                "Less time from key to key (Ctrl+Down).");
    edit_button(flow, DIP_PATH_EDIT_SLOWER, "+", DIP_UI_PLAIN,
                "More time from key to key (Ctrl+Up).");
    snprintf(text, sizeof text, "%.3g s from key to key", period_s);
    flow_text(flow, dip_style_soft, text);
    if (editor->file[0]) {
        snprintf(text, sizeof text, "Saved: %s%s", editor->file,
                 editor->unsaved ? ", changed since" : "");
        flow_text(flow, dip_style_dim, text);
    }
}

static void declare_ends(Flow *flow) {
    static const struct {
        const char *text;
        const char *tip;
    } ends[DIP_CAMPATH_END_COUNT] = {
        [DIP_CAMPATH_END_loop] = {"Loop", "Paths fly from the last key to the first one."},
        [DIP_CAMPATH_END_once] = {"Once", "Paths stop at the last key."},
        [DIP_CAMPATH_END_back] = {"There and back", "Paths fly back to the first key."}};
    const int now = (int)flow->state->track->end;
    flow_text(flow, dip_style_dim, "At the end (Ctrl+E):");
    for (int i = 0; i < DIP_CAMPATH_END_COUNT; ++i) {
        if (flow_button(flow, ID_END + (unsigned)i, ends[i].text,
                        i == now ? DIP_UI_CHOSEN : DIP_UI_PLAIN, ends[i].tip) &&
            i != now) {
            act(flow, DIP_ACTION_PATH_END, i - now, false);
        }
    }
}

// --- the camera ----------------------------------------------------------------------------------

static void declare_camera(Flow *flow) {
    const DipPreviewState *state = flow->state;
    const DipFlight *flight = &state->flight;
    char text[48];
    if (flow_button(flow, ID_CAMERA, "Free camera", state->manual ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                    "Takes the camera off its path, or back (C). Keys W A S D Q E and dragging "
                    "in a pane move it.")) {
        act(flow, DIP_ACTION_CAMERA, 0, false);
    }
    if (flow_button(flow, ID_CAMERA + 1, flight->orbits ? "Orbits" : "Turns", DIP_UI_PLAIN,
                    "Whether dragging orbits the scene or turns the camera on the spot (\\).")) {
        act(flow, DIP_ACTION_ORBIT, 0, false);
    }
    if (flow_button(flow, ID_CAMERA + 2, flow->row.narrow ? "Pose" : "Pose of the path",
                    state->manual ? DIP_UI_PLAIN : DIP_UI_OFF,
                    "Gives the free camera the pose of the path (Home).")) {
        act(flow, DIP_ACTION_CAMERA_BACK, 0, false);
    }
    if (flow_button(flow, ID_CAMERA + 3, "Slower", DIP_UI_PLAIN,
                    "Slows the free camera down, as the wheel over a pane does.")) {
        act(flow, DIP_ACTION_SPEED, 1, true);
    }
    if (flow_button(flow, ID_CAMERA + 4, "Faster", DIP_UI_PLAIN,
                    "Speeds the free camera up, as the wheel over a pane does.")) {
        act(flow, DIP_ACTION_SPEED, 1, false);
    }
    snprintf(text, sizeof text, "%.3g m/s", dip_flight_speed(flight));
    flow_text(flow, dip_style_soft, text);
}

static void declare_steps(Flow *flow) {
    static const struct {
        const char *text;
        int right, forward;
        const char *tip;
    } steps[] = {{"Forward", 0, 1, "Moves the free camera forward (W while held)."},
                 {"Back", 0, -1, "Moves the free camera back (S while held)."},
                 {"Left", -1, 0, "Moves the free camera to the left (A while held)."},
                 {"Right", 1, 0, "Moves the free camera to the right (D while held)."}};
    for (unsigned i = 0; i < sizeof steps / sizeof *steps; ++i) {
        if (flow_button(flow, ID_CAMERA + 5 + i, steps[i].text, DIP_UI_PLAIN, steps[i].tip)) {
            dip_pilot_step(flow->state, steps[i].right, steps[i].forward, dip_ui_now_ns(flow->ui));
        }
    }
}

void dip_tab_path(DipUi *ui, DipWindow *window, DipRect body) {
    Flow flow = {dip_flow_make(ui, DIP_UI_PATH, body, 12), ui, window->state};
    if (body.width < dip_ui_px(ui, NARROW)) {
        dip_flow_make_narrow(&flow.row);
    }
    declare_paths(&flow);
    dip_flow_next_row(&flow.row);
    if (window->state->editor) {
        declare_edits(&flow);
        next_group(&flow);
        declare_keys(&flow);
        next_group(&flow);
        declare_period(&flow);
        next_group(&flow);
    }
    declare_ends(&flow);
    next_group(&flow);
    declare_camera(&flow);
    declare_steps(&flow);
}
