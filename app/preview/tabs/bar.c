// Declares and draws the dock's bar. The tabs are on the left. Playback, the time line, help and
// the button that folds the dock are on the right.
//
// In a narrow bar, the tabs first show symbols instead of their names. Then the bar leaves out
// parts that keys can replace: the steps by one frame, the time line, the name of the path,
// playback, and the buttons for help, for "panes only" and for the full screen.
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

// Numbers of buttons at the bar's right end. TAIL_FOLD counts only the button that folds the panel,
// TAIL_HELP also the button for help, and TAIL_ALL also the buttons for "panes only" and the full
// screen.
enum { TAIL_FOLD = 1, TAIL_HELP = 2, TAIL_ALL = 4 };
enum { TAB_SIZE = 13, TAB_PAD = 11, BUTTON = 28, ICON_TAB = 32, LEAST_LINE = 60, MOST_LINE = 270 };

typedef enum BarControl {
    BAR_TABS, // The first tab. The numbers of the other tabs follow.
    BAR_BACK = BAR_TABS + DIP_TAB_COUNT,
    BAR_PLAY,
    BAR_ON,
    BAR_TIME_LINE,
    BAR_PLACE,
    BAR_HELP,
    BAR_PANES,
    BAR_FULL_SCREEN,
    BAR_FOLD
} BarControl;

static const char *const tab_names[DIP_TAB_COUNT] = {"Settings", "Loupe", "Compare", "Maps",
                                                     "Advice",   "Times", "Path"};
static const char *const tab_tips[DIP_TAB_COUNT] = {
    "Settings: what each costs and gains",
    "Loupe: pixels enlarged, with their samples and values (Z)",
    "Compare: wipe, blink, difference, one picture alone, the converged picture (J)",
    "Maps: where error and work are (N)",
    "Advice: the best settings for a time budget (K)",
    "Times: stages, errors and work of both panes (R)",
    "Path: fly the camera, make a path from its poses (Ctrl+P)"};

// Which parts of the bar fit, and how wide they are.
typedef struct Bar {
    DipRect rect;
    int button; // Width of a button.
    bool words; // The tabs show their names; otherwise they show symbols.
    int tab_width[DIP_TAB_COUNT];
    int tabs_width;
    int tail;        // Number of buttons at the right end. The last button folds the panel.
    int play;        // Number of playback buttons: 3, 1 or 0.
    int line;        // Width of the time line, or 0 if there is none.
    char place[128]; // Says where the camera is.
    int place_width; // Room for `place`, or 0 if it does not show.
} Bar;

static DipUiId bar_id(int control) {
    return DIP_UI_ID(DIP_UI_BAR, control + 1);
}

static DipColour colour_of(const DipUiInput *input, bool chosen) {
    return chosen || input->hovered ? dip_style_white : dip_style_soft;
}

static void draw_ring(DipUi *ui, DipRect rect, const DipUiInput *input) {
    if (input->focused) {
        dip_ui_outline(ui, rect, dip_ui_px(ui, 3), dip_ui_px(ui, 2), dip_style_focus);
    }
}

// Cuts a button with a symbol, which carries out an action, from the left side of *rest.
static void declare_symbol(DipUi *ui, DipWindow *window, const Bar *bar, DipRect *rest, int control,
                           int icon, DipAction action, int argument, const char *tip) {
    const DipRect rect = dip_cut_left(rest, bar->button);
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = bar_id(control), .rect = rect, .tip = tip});
    draw_ring(ui, rect, &input);
    if (input.pressed) {
        dip_preview_act(window->state, action, argument, false, dip_ui_now_ns(ui));
    }
    dip_icon_draw(ui, icon, rect, colour_of(&input, control == BAR_PLAY));
}

// --- what fits -----------------------------------------------------------------------------------

// Writes where the camera is: the path and the time on it, the gallery's scene, or that the camera
// is free.
static void format_place(const DipPreviewState *state, int category, bool brief, int64_t path_ns,
                         char *text, size_t size_bytes) {
    const double seconds = 1e-9 * (double)path_ns;
    const double length = 1e-9 * (double)dip_preview_path_length_ns(state);
    // In a pause, two decimals show a step by one frame.
    const int decimals = state->paused ? 2 : 1;
    if (state->manual) {
        snprintf(text, size_bytes, "Free camera");
    } else if (state->scene_title) {
        snprintf(text, size_bytes, "%s%s%s  %.1f s", state->scene_title, brief ? "" : ": ",
                 brief ? "" : state->scene_look, 1e-9 * (double)state->play_ns);
    } else if (brief) {
        snprintf(text, size_bytes, "%s %.*f s", dip_session_path_name(state->track, category),
                 decimals, seconds);
    } else {
        snprintf(text, size_bytes, "%s  %.*f of %.0f s", dip_preview_path_title(state, category),
                 decimals, seconds, length);
    }
}

static void measure_tabs(const DipUi *ui, Bar *bar, bool words) {
    bar->words = words;
    bar->tabs_width = 0;
    for (int t = 0; t < DIP_TAB_COUNT; ++t) {
        bar->tab_width[t] =
            words ? dip_ui_text_width(ui, TAB_SIZE, tab_names[t]) + 2 * dip_ui_px(ui, TAB_PAD)
                  : dip_ui_px(ui, ICON_TAB);
        bar->tabs_width += bar->tab_width[t];
    }
}

// Returns the width of the widest text that format_place writes for any path. With this width, the
// buttons beside the text stand still while time passes and paths change. Every digit counts as a
// zero, since most fonts give all digits one width.
static int widest_place(const DipUi *ui, const DipPreviewState *state, bool brief) {
    DipPreviewState still = *state;
    char text[128];
    int widest = 0;
    still.paused = true;
    still.manual = false;
    for (int c = 0; c < DIP_CAMTRACK_CATEGORIES; ++c) {
        if (!state->track->categories[c].path && c != state->track->active) {
            continue;
        }
        format_place(&still, c, brief, dip_preview_path_length_ns(state), text, sizeof text);
        for (char *letter = text; *letter; ++letter) {
            *letter = *letter >= '0' && *letter <= '9' ? '0' : *letter;
        }
        widest = dip_max(widest, dip_ui_text_width(ui, TAB_SIZE, text));
    }
    return widest;
}

// Gives playback, the time line and the camera's place the room that the tabs leave.
static void share_room(const DipUi *ui, const DipPreviewState *state, Bar *bar, bool brief) {
    const int gap = dip_ui_px(ui, 10);
    int room = bar->rect.width - bar->tabs_width - bar->tail * bar->button - gap;
    format_place(state, state->track->active, brief, dip_preview_path_ns(state), bar->place,
                 sizeof bar->place);
    const int place_width = widest_place(ui, state, brief) + 2 * gap;
    bar->play = room >= 3 * bar->button ? 3 : room >= bar->button ? 1 : 0;
    room -= bar->play * bar->button;
    bar->place_width = room >= place_width ? place_width : 0;
    room -= bar->place_width;
    // While the camera is free, the time line does not show, and its room stays empty.
    const bool has_line = dip_preview_path_length_ns(state) > 0;
    bar->line =
        has_line && room >= dip_ui_px(ui, LEAST_LINE) ? dip_min(room, dip_ui_px(ui, MOST_LINE)) : 0;
}

static Bar measure(const DipUi *ui, const DipWindow *window) {
    const DipPreviewState *state = window->state;
    Bar bar = {.rect = window->layout->bar, .button = dip_ui_px(ui, BUTTON)};
    bar.tail = TAIL_ALL;
    for (int words = 1; words >= 0; --words) {
        measure_tabs(ui, &bar, words);
        share_room(ui, state, &bar, false);
        if (bar.play == 3 && bar.place_width && bar.line) {
            return bar;
        }
    }
    share_room(ui, state, &bar, true);
    if (bar.play < 3 || !bar.place_width) {
        bar.tail = TAIL_HELP;
        share_room(ui, state, &bar, true);
    }
    if (bar.tabs_width + 3 * bar.button > bar.rect.width) { // Moves the symbols closer together.
        bar.tail = TAIL_FOLD;
        const int narrow = dip_max(1, (bar.rect.width - bar.button) / DIP_TAB_COUNT);
        for (int t = 0; t < DIP_TAB_COUNT; ++t) {
            bar.tab_width[t] = dip_min(bar.tab_width[t], narrow);
        }
        bar.tabs_width = DIP_TAB_COUNT * bar.tab_width[0];
        share_room(ui, state, &bar, true);
    }
    return bar;
}

// --- controls ------------------------------------------------------------------------------------

// Returns whether a tab's tool is in use, so that it changes what the panes show even while another
// tab is open.
static bool is_tool_on(const DipToolState *tools, DipTab tab) {
    switch (tab) {
    case DIP_TAB_LOUPE:
        return tools->loupe;
    case DIP_TAB_COMPARE:
        return tools->comparison != DIP_COMPARE_SIDE_BY_SIDE;
    case DIP_TAB_MAPS:
        return tools->map != DIP_MAP_NONE;
    default:
        return false;
    }
}

static void declare_tabs(DipUi *ui, DipWindow *window, const Bar *bar) {
    const DipToolState *tools = &window->state->tools;
    DipRect rest = bar->rect;
    for (int t = 0; t < DIP_TAB_COUNT; ++t) {
        const DipRect rect = dip_cut_left(&rest, bar->tab_width[t]);
        char tip[240];
        bool chosen = tools->open && (int)tools->tab == t;
        const bool tool_shows = !chosen && is_tool_on(tools, (DipTab)t);
        snprintf(tip, sizeof tip, "%s%s", tab_tips[t],
                 chosen       ? "\nY folds the panel"
                 : tool_shows ? "\nIt shows over the panes now; Esc takes it away"
                              : "");
        const DipUiInput input = dip_ui_control(
            ui, &(DipUiControl){.id = bar_id(BAR_TABS + t), .rect = rect, .tip = tip});
        draw_ring(ui, rect, &input);
        // A second click must not fold the tab that the first click has opened.
        if (input.pressed && !chosen) {
            dip_preview_act(window->state, DIP_ACTION_TAB, t, false, dip_ui_now_ns(ui));
            chosen = true;
        }
        DipRect line = dip_rect_inset(rect, dip_ui_px(ui, 8), 0);
        if (chosen) {
            dip_ui_fill(ui, rect, dip_style_dock);
        }
        if (chosen || tool_shows) {
            dip_ui_fill(ui, dip_cut_bottom(&line, dip_ui_px(ui, 2)),
                        chosen ? dip_style_white : dip_style_accent);
        }
        if (bar->words) {
            dip_ui_label(ui, TAB_SIZE, colour_of(&input, chosen), DIP_ALIGN_CENTRE, rect,
                         tab_names[t]);
        } else {
            dip_icon_draw(ui, t, rect, colour_of(&input, chosen));
        }
    }
}

static void declare_playback(DipUi *ui, DipWindow *window, const Bar *bar, DipRect rest) {
    if (bar->play == 3) {
        declare_symbol(ui, window, bar, &rest, BAR_BACK, DIP_ICON_BACK, DIP_ACTION_STEP, -1,
                       "One frame back (,)");
    }
    if (bar->play > 0) {
        declare_symbol(ui, window, bar, &rest, BAR_PLAY,
                       window->state->paused ? DIP_ICON_PLAY : DIP_ICON_PAUSE, DIP_ACTION_PAUSE, 0,
                       "Pause or play (Space)");
    }
    if (bar->play == 3) {
        declare_symbol(ui, window, bar, &rest, BAR_ON, DIP_ICON_STEP, DIP_ACTION_STEP, 1,
                       "One frame on (.)");
    }
}

// Moves the time to the place of the pointer on the time line.
static void seek(DipPreviewState *state, const DipUiInput *input, DipRect rect) {
    const int64_t length_ns = dip_preview_path_length_ns(state);
    double share = rect.width > 1 ? (double)(input->x - rect.x) / (rect.width - 1) : 0.0;
    share = share < 0.0 ? 0.0 : share > 0.9999 ? 0.9999 : share;
    dip_preview_seek_path(state, (int64_t)(share * (double)length_ns));
}

// Declares the time line: a line for the time on the path, on which a click or a drag moves the
// time.
static void declare_time_line(DipUi *ui, DipWindow *window, DipRect rect) {
    DipPreviewState *state = window->state;
    const DipUiInput input =
        dip_ui_stepper(ui, bar_id(BAR_TIME_LINE), rect,
                       "Time on the camera path. Click or drag to move; arrow keys move by 1 s.");
    const int64_t length_ns = dip_preview_path_length_ns(state);
    if (input.began || (input.held && input.moved)) {
        seek(state, &input, rect);
    } else if (input.steps) {
        dip_preview_act(state, DIP_ACTION_SEEK, 1000 * input.steps, false, dip_ui_now_ns(ui));
    } else if (input.to_first || input.to_last) {
        dip_preview_seek_path(state, input.to_first ? 0 : length_ns - state->step_ns);
    }
    const double share =
        length_ns > 0 ? (double)dip_preview_path_ns(state) / (double)length_ns : 0.0;
    const int thick = dip_ui_px(ui, 2), width = dip_ui_px(ui, 4), reach = dip_ui_px(ui, 5);
    DipRect line = dip_rect_middle(rect, rect.width, thick);
    DipRect knob = {rect.x + (int)(share * (rect.width - width)), line.y, width, thick};
    dip_ui_fill(ui, line, dip_style_line);
    dip_ui_fill(ui, dip_cut_left(&line, knob.x - rect.x), dip_style_soft);
    dip_ui_fill(ui, dip_rect_inset(knob, 0, -reach), dip_style_white);
    draw_ring(ui, rect, &input);
}

// Declares the camera's place as a button that plays the next path or shows the next scene.
static void declare_place(DipUi *ui, DipWindow *window, const Bar *bar, DipRect rect) {
    DipPreviewState *state = window->state;
    const bool scene = state->scene_title != NULL;
    const DipUiInput input = dip_ui_control(
        ui, &(DipUiControl){.id = bar_id(BAR_PLACE),
                            .rect = rect,
                            .tip = scene ? "A click shows the next scene, the wheel the ones "
                                           "before and after it (Ctrl+PageDown)."
                                         : "A click plays the next camera path, the wheel the ones "
                                           "before and after it (P).",
                            .takes_wheel = true});
    if (input.pressed || input.steps) {
        dip_preview_act(state, scene ? DIP_ACTION_NEXT_SCENE : DIP_ACTION_NEXT_PATH, 0,
                        input.steps > 0, dip_ui_now_ns(ui));
    }
    draw_ring(ui, rect, &input);
    dip_cut_right(&rect, dip_ui_px(ui, 10));
    dip_ui_label(ui, TAB_SIZE, colour_of(&input, false), DIP_ALIGN_RIGHT, rect, bar->place);
}

static void declare_tail(DipUi *ui, DipWindow *window, const Bar *bar, DipRect rest) {
    const DipPreviewState *state = window->state;
    const bool full = state->full_screen, open = state->tools.open;
    if (bar->tail >= TAIL_HELP) {
        declare_symbol(ui, window, bar, &rest, BAR_HELP, DIP_ICON_HELP, DIP_ACTION_HELP, 0,
                       "All keys (F1)");
    }
    if (bar->tail >= TAIL_ALL) {
        declare_symbol(ui, window, bar, &rest, BAR_PANES, DIP_ICON_PANES, DIP_ACTION_BARE, 0,
                       "Panes only: no panel and no text (/)");
        declare_symbol(ui, window, bar, &rest, BAR_FULL_SCREEN, DIP_ICON_FULL_SCREEN,
                       DIP_ACTION_FULL_SCREEN, 0,
                       full ? "Back to a window (F11)" : "Full screen (F11)");
    }
    declare_symbol(ui, window, bar, &rest, BAR_FOLD, open ? DIP_ICON_FOLD : DIP_ICON_OPEN,
                   DIP_ACTION_DOCK, 0, open ? "Fold the panel (Y)" : "Open the panel (Y)");
}

void dip_bar_declare(DipUi *ui, DipWindow *window) {
    const Bar bar = measure(ui, window);
    DipRect rest = bar.rect, edge = bar.rect;
    dip_ui_fill(ui, bar.rect, dip_style_bar);
    dip_ui_fill(ui, dip_cut_top(&edge, 1), dip_style_line);
    const DipRect tail = dip_cut_right(&rest, bar.tail * bar.button);
    const DipRect place = dip_cut_right(&rest, bar.place_width);
    DipRect line = dip_cut_right(&rest, bar.line);
    declare_tabs(ui, window, &bar);
    declare_playback(ui, window, &bar, dip_cut_right(&rest, bar.play * bar.button));
    if (bar.line && !window->state->manual) {
        dip_cut_left(&line, dip_ui_px(ui, 10) / 2);
        declare_time_line(ui, window, line);
    }
    if (bar.place_width) {
        declare_place(ui, window, &bar, place);
    }
    declare_tail(ui, window, &bar, tail);
}
