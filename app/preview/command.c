// Defines the command `diptych preview`: its options and its help, and what it does. It opens the
// display and everything else that the preview needs, and runs the preview's loop.
#include "app/preview/command.h"

#include "app/cli/log.h"
#include "app/cost/context.h"
#include "app/cost/options.h"
#include "app/display/sdl/sdl_display.h"
#include "app/display/terminal/terminal_display.h"
#include "app/preview/control/control.h"
#include "app/preview/loop/loop.h"
#include "app/preview/loop/reload.h"
#include "app/preview/loop/view.h"
#include "app/session/session.h"
#include "renderer/base/assert.h"
#include "renderer/base/clock.h"

#include <stdlib.h>
#include <string.h>

// --- options -------------------------------------------------------------------------------------

// The display that the user asks for.
typedef enum DisplayChoice {
    DISPLAY_AUTO, // A window or, if there is no display for one, the terminal.
    DISPLAY_WINDOW,
    DISPLAY_TERMINAL
} DisplayChoice;

// The values of the options. Models that are given as arguments are added to those of --model, in
// session.models.
typedef struct Options {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *cost_report;  // The scene's cost.json or its folder; NULL without --cost. Borrowed.
    double pixels_per_degree; // Viewing distance for FLIP (a perceptual error); 0 if not given.
    const char *cache;        // Folder of cached truths (truth.h); NULL without --cache. Borrowed.
    const char *control;      // "-" or a socket's path; NULL without --control. Borrowed.
    unsigned long window_id;  // X11 window to open the preview in; 0 means a window of its own.
    bool watch;               // The scene is loaded again when one of its files changes.
    int hides_panel;          // 1 with --panel off, otherwise 0.
    double ui_scale;          // Factor by which controls are enlarged; 0 without the option.
    DisplayChoice display;
    DipTerminalColours terminal_colours;
} Options;

#define FIELD(name) offsetof(Options, name)

// Reads the identifier of an X11 window: a number from 1 to 0x1fffffff, in decimal or, after 0x, in
// hexadecimal.
static bool read_window(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    const bool hexadecimal = value[0] == '0' && (value[1] == 'x' || value[1] == 'X');
    const char *digits = hexadecimal ? value + 2 : value;
    const size_t length = strspn(digits, hexadecimal ? "0123456789abcdefABCDEF" : "0123456789");
    const bool read = length > 0 && length <= 10 && !digits[length];
    const unsigned long id = read ? strtoul(digits, NULL, hexadecimal ? 16 : 10) : 0;
    if (id == 0 || id > 0x1ffffffful) {
        return dip_option_refuse(err, DIP_ERROR_TYPE, row->name, value,
                                 "an X11 window such as 12582914 or 0xc00002");
    }
    *(unsigned long *)((char *)fields + row->field) = id;
    return true;
}

// The words that --display, --terminal-colours and --panel accept. A word's index is the value of
// the option: a DisplayChoice, a DipTerminalColours, or 0 or 1 for hides_panel.
static const char *const displays[] = {"auto", "window", "terminal"};
static const char *const colours[] = {"auto", "true", "256", "none"};
static const char *const panels[] = {"on", "off"};

static const DipOptionRow rows[] = {
    {"--cost", "FILE", DIP_OPTION_TEXT, FIELD(cost_report),
     .text = "Read the cost.json that `diptych cost` wrote for this scene. The window then shows "
             "what each setting costs and advises the best settings for a time budget."},
    {"--control", "PATH|-", DIP_OPTION_TEXT, FIELD(control),
     .text = "Let other programs control the preview: it reads requests as lines of JSON and "
             "answers each of them. With a path, it listens on a Unix domain socket; with -, it "
             "uses standard input and output. docs/embedding.md describes the requests."},
    {"--window-id", "ID", DIP_OPTION_CUSTOM, FIELD(window_id), .read = read_window,
     .text = "Show the preview inside this X11 window of another program, in the window's size, "
             "until that program closes the window."},
    {"--watch", NULL, DIP_OPTION_FLAG, FIELD(watch),
     .text =
         "Reload the scene when the ini, a model, one of its pictures or a camera path changes. "
         "The camera, the time and the settings stay. If a file is bad, the window says so and "
         "keeps what it shows."},
    {"--ui-scale", "F", DIP_OPTION_NUMBER, FIELD(ui_scale), .least = 0.75, .most = 4,
     .text = "Enlarge text and controls by F, from 0.75 to 4, on top of the display's own scale. "
             "Ctrl+= and Ctrl+- change it in the window."},
    {"--panel", "on|off", DIP_OPTION_CHOICE, FIELD(hides_panel), .names = panels,
     .most = DIP_ARRAY_COUNT(panels), .accepted = "a state of the panel; give on or off",
     .text = "Show the panel with all settings, which is the default, or nothing but the panes, "
             "for programs that have a panel of their own. The key / changes it in the window."},
    {"--display", "auto|window|terminal", DIP_OPTION_CHOICE, FIELD(display), .names = displays,
     .most = DIP_ARRAY_COUNT(displays), .accepted = "a display; give one of auto|window|terminal",
     .text = "Where the preview shows. `terminal` draws half blocks and characters into the "
             "terminal of standard output. `auto`, the default, opens a window, and uses the "
             "terminal if there is no display to open a window on."},
    {"--terminal-colours", "auto|true|256|none", DIP_OPTION_CHOICE, FIELD(terminal_colours),
     .names = colours, .most = DIP_ARRAY_COUNT(colours),
     .accepted = "a number of colours; give one of auto|true|256|none",
     .text = "The colours of a preview in the terminal: 24 bits, a palette of 256, or characters "
             "without colours. `auto`, the default, follows COLORTERM, TERM and NO_COLOR."},
};

static const DipOptionTable table = DIP_OPTION_TABLE("Drawing", rows);

static const DipOptionPart parts[] = {
    {&dip_scene_option_table, FIELD(session)},
    {&dip_path_option_table, FIELD(session)},
    {&dip_category_option_table, FIELD(session)},
    {&dip_camera_option_table, FIELD(session)},
    {&dip_pane_option_table, FIELD(session)},
    {&dip_size_option_table, FIELD(session)},
    {&dip_threads_option_table, FIELD(session)},
    {&table, 0},
    {&dip_viewing_option_table, FIELD(pixels_per_degree)},
    {&dip_cache_option_table, FIELD(cache)},
    {&dip_program_option_table, FIELD(program)},
};
static const DipOptionParts option_parts = {parts, DIP_ARRAY_COUNT(parts)};

// --- the display ---------------------------------------------------------------------------------

static bool open_window(DipDisplay *display, const DipSession *session, const Options *options,
                        DipError *err) {
    const DipToolState tools = {.ui_scale = options->ui_scale > 0.0 ? options->ui_scale : 1.0,
                                .fixed_scale = options->ui_scale > 0.0};
    const int pane_height = session->pane_size.height;
    int height = pane_height;
    // Iterates, because the scale depends on the height, and the height on the scale.
    for (int i = 0; i < 4 && !options->hides_panel; ++i) {
        const double scale = dip_layout_scale(1.0, &tools, height);
        height = pane_height + (int)(scale * dip_layout_dock_height() + 0.5);
    }
    return dip_sdl_display_open(display, options->window_id,
                                2 * session->pane_size.width + DIP_PANE_GAP_PX, height, err);
}

// Opens the terminal as the display. Also fails if --control is "-", because requests would then
// come from standard input, which the terminal needs.
static bool open_terminal(DipDisplay *display, const Options *options, DipError *err) {
    if (options->control && strcmp(options->control, "-") == 0) {
        return dip_error_set(
            err, DIP_ERROR_CONFLICT, NULL, 0, "--control",
            "standard input and output are the terminal; give the path of a socket");
    }
    return dip_terminal_display_open(display, options->terminal_colours, err);
}

// Opens the terminal or the window that the options ask for. If there is no display to open a
// window on, `auto` opens the terminal instead, unless --window-id or --control is given or
// standard output is no terminal. Sets *notice to a text that tells the user that the terminal
// replaces the window, or to NULL.
static bool open_display(DipDisplay *display, const DipSession *session, const Options *options,
                         const char **notice, DipError *err) {
    static const char no_window[] =
        "There is no display to open a window on, so the preview shows in the terminal";
    DipError failure = {0};
    *notice = NULL;
    if (options->display == DISPLAY_TERMINAL) {
        return open_terminal(display, options, err);
    }
    if (open_window(display, session, options, &failure)) {
        return true;
    }
    if (options->display == DISPLAY_AUTO && failure.code == DIP_ERROR_RUNTIME &&
        !options->window_id && !options->control && dip_terminal_is_there()) {
        dip_log_note("%s", no_window);
        *notice = no_window;
        return open_terminal(display, options, err);
    }
    if (err) {
        *err = failure;
    }
    return false;
}

// --- the preview ---------------------------------------------------------------------------------

// Creates what the preview needs besides its session and its display: prices, the reload
// (reload.h), the cost report, the cache of truths and the control channel. After a failure, the
// caller still closes what *def and *remote hold.
static bool open_parts(DipPreviewDef *def, DipRemote **remote, char cache[PATH_MAX],
                       const Options *options, DipError *err) {
    char scene[DIP_COST_TEXT];
    def->prices = dip_prices_create(err);
    def->reload = def->prices ? dip_reload_create(def->session, options->watch, err) : NULL;
    if (!def->reload) {
        return false;
    }
    if (options->cost_report) {
        dip_cost_scene_name(def->session, scene);
        def->costs = dip_costs_load(def->prices, options->cost_report, scene, err);
        if (!def->costs) {
            return false;
        }
    }
    dip_prices_set_viewing(def->prices, options->pixels_per_degree);
    if (dip_cost_find_cache(options->cache, cache, err)) {
        def->cache = cache[0] ? cache : NULL;
    } else if (options->cache) {
        return false; // Only a folder that --cache names must be usable.
    }
    if (options->control) {
        *remote = dip_remote_open(options->control, err);
        def->control = *remote ? dip_remote_control(*remote) : def->control;
    }
    return !options->control || *remote;
}

static bool run_loop(const DipPreviewDef *def, DipError *err) {
    DipPreview *preview = dip_preview_create(def, err);
    bool done = preview != NULL;
    while (done && !dip_preview_state(preview)->quit) {
        done = dip_preview_turn(preview, err);
    }
    def->session->times.ended_ns = dip_clock_ns();
    dip_preview_destroy(&preview);
    return done;
}

// Shows the session until the user or another program ends the preview. Fails if no display can be
// opened (RUNTIME) or a window has no font (MISSING), if the cost report, the cache of --cache or
// the control channel cannot be opened, or if drawing fails.
static bool run(DipSession *session, const void *context, DipError *err) {
    const Options *options = context;
    char cache[PATH_MAX];
    DipRemote *remote = NULL;
    DipPreviewDef def = {
        .session = session,
        .measures_prices = true,
        .ui_scale = options->ui_scale,
        .hides_panel = options->hides_panel,
        .load_scene_def = dip_session_keep_model,
    };
    bool done = open_parts(&def, &remote, cache, options, err) &&
                open_display(&def.display, session, options, &def.notice, err);
    if (done) {
        done = run_loop(&def, err);
        if (options->window_id && options->display != DISPLAY_TERMINAL &&
            dip_sdl_display_has_lost_host(&def.display)) {
            dip_log_note("the program that owns window %lu has closed it", options->window_id);
        }
        def.display.close(def.display.context);
    }
    dip_remote_close(&remote);
    dip_reload_destroy(&def.reload);
    dip_costs_free(&def.costs);
    dip_prices_destroy(&def.prices);
    return done;
}

// --- the command ---------------------------------------------------------------------------------

static bool check(const void *options, DipError *err) {
    return dip_session_options_check(&((const Options *)options)->session, err);
}

static void describe_session(const void *options, DipSessionDef *def) {
    const Options *preview = options;
    def->options = &preview->session;
    def->scene = true;
    def->renderers = true;
}

static const DipExample examples[] = {
    {"diptych", "opens the courtyard with the ini's settings"},
    {"diptych --current aa=none --requested aa=8,af=16", "compares two settings side by side"},
    {"diptych model.glb", "orbits a model of yours"},
    {"diptych --scene tour", "shows the scenes of the gallery, 15 seconds each"},
    {"diptych --window-id 0x2800003 --control -", "shows inside a window of another program"},
    {"diptych --config my.ini --watch", "shows each change of the ini or a texture at once"},
    {"diptych --cost report/cost.json", "also shows what `diptych cost` measured"},
};

const DipCommand dip_preview_command = {
    .name = "preview",
    .summary = "open the window: two panes, one camera path (the default)",
    .usage = "[OPTION]... [MODEL]...",
    .text = "Preview opens a window with two panes. Both show the same camera path, the left one "
            "with the current settings and the right one with the requested settings. Keys change "
            "the requested settings while the camera moves; F1 lists the keys.\n\n"
            "A game controller works, too: the sticks and triggers fly the camera, Y frees it, the "
            "shoulder buttons and the directional pad choose and change settings, A presses, X "
            "applies, B undoes, Start pauses, and Back leaves.\n\n"
            "Dragging in a pane with the right mouse button frees the camera from its path and "
            "turns it, or orbits a model. The keys W, A, S, D, Q and E move it, the wheel changes "
            "its speed or its distance, Home takes it back, and C lets it follow its path again. "
            "The tab Path (Ctrl+P) makes a camera path from its poses and saves it to a new "
            ".pth file.\n\n"
            "A model, a camera path, an ini or a cost report that is dropped onto the window takes "
            "the place of what it shows. If the file is bad, the window says so and stays as it "
            "is.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &option_parts,
    .operands = {offsetof(Options, session.models), offsetof(Options, session.model_count),
                 DIP_MAX_MODELS},
    .options_size = sizeof(Options),
    .check = check,
    .describe_session = describe_session,
    .run = run,
};
