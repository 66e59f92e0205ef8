// Defines the command `diptych preview`: its options, its help, and the session that it opens.
#include "app/preview/command.h"

#include "app/cost/options.h"
#include "app/preview/preview.h"
#include "renderer/base/assert.h"

#include <stdlib.h>
#include <string.h>

// --- options -------------------------------------------------------------------------------------

#define FIELD(name) offsetof(DipPreviewOptions, name)

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
// the option: a DipDisplayChoice, a DipTerminalColours, or 0 or 1 for hides_panel.
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

// --- the command ---------------------------------------------------------------------------------

static bool check(const void *options, DipError *err) {
    return dip_session_options_check(&((const DipPreviewOptions *)options)->session, err);
}

static bool run(DipSession *session, const void *options, DipError *err) {
    return dip_preview_run(session, options, err);
}

static void describe_session(const void *options, DipSessionDef *def) {
    const DipPreviewOptions *preview = options;
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
    .operands = {offsetof(DipPreviewOptions, session.models),
                 offsetof(DipPreviewOptions, session.model_count), DIP_MAX_MODELS},
    .options_size = sizeof(DipPreviewOptions),
    .check = check,
    .describe_session = describe_session,
    .run = run,
};
