// The options of `diptych preview`.
#include "app/preview/options.h"

#include "app/cost/options.h"
#include "renderer/base/assert.h"

#include <stdlib.h>
#include <string.h>

#define FIELD(name) offsetof(DipPreviewOptions, name)

// Reads an X11 identifier, 29 bits in decimal or, after 0x, in hexadecimal.
static bool read_window(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    const bool hexadecimal = value[0] == '0' && (value[1] == 'x' || value[1] == 'X');
    const char *digits = hexadecimal ? value + 2 : value;
    const size_t length = strspn(digits, hexadecimal ? "0123456789abcdefABCDEF" : "0123456789");
    const unsigned long id = length > 0 && length <= 10 && !digits[length]
                                 ? strtoul(digits, NULL, hexadecimal ? 16 : 10)
                                 : 0;
    if (id == 0 || id > 0x1ffffffful) {
        return dip_option_refuse(err, DIP_ERROR_TYPE, row->name, value,
                                 "an X11 window such as 12582914 or 0xc00002");
    }
    *(unsigned long *)((char *)fields + row->field) = id;
    return true;
}

// Finds a value in a list of names. Returns its index, or -1.
static int find_name(const char *value, const char *const *names, int count) {
    for (int i = 0; i < count; ++i) {
        if (strcmp(value, names[i]) == 0) {
            return i;
        }
    }
    return -1;
}

static bool read_display(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    static const char *const names[] = {"auto", "window", "terminal"}; // By DipDisplayChoice.
    DipPreviewOptions *options = fields;
    const int choice = find_name(value, names, (int)DIP_ARRAY_COUNT(names));
    if (choice < 0) {
        return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value,
                                 "a display; give one of auto|window|terminal");
    }
    options->display = (DipDisplayChoice)choice;
    return true;
}

static bool read_panel(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    static const char *const names[] = {"on", "off"};
    const int choice = find_name(value, names, (int)DIP_ARRAY_COUNT(names));
    if (choice < 0) {
        return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value,
                                 "a state of the panel; give on or off");
    }
    ((DipPreviewOptions *)fields)->hides_panel = choice == 1;
    return true;
}

static bool read_colours(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    static const char *const names[] = {"auto", "true", "256", "none"}; // By DipTerminalColours.
    DipPreviewOptions *options = fields;
    const int choice = find_name(value, names, (int)DIP_ARRAY_COUNT(names));
    if (choice < 0) {
        return dip_option_refuse(err, DIP_ERROR_UNKNOWN, row->name, value,
                                 "a number of colours; give one of auto|true|256|none");
    }
    options->terminal_colours = (DipTerminalColours)choice;
    return true;
}

static const DipOptionRow rows[] = {
    {.name = "--cost",
     .argument = "FILE",
     .text = "Read the cost.json that `diptych cost` wrote for this scene. The window then shows "
             "what each setting costs and advises the best settings for a time budget.",
     .kind = DIP_OPTION_TEXT,
     .field = FIELD(cost_report)},
    {.name = "--control",
     .argument = "PATH|-",
     .text = "Let other programs control the preview: it reads requests as lines of JSON and "
             "answers each of them. With a path, it listens on a Unix domain socket; with -, it "
             "uses standard input and output. docs/embedding.md describes the requests.",
     .kind = DIP_OPTION_TEXT,
     .field = FIELD(control)},
    {.name = "--window-id",
     .argument = "ID",
     .text = "Show the preview inside this X11 window of another program, in the window's size, "
             "until that program closes the window.",
     .kind = DIP_OPTION_CUSTOM,
     .field = FIELD(window_id),
     .read = read_window},
    {.name = "--watch",
     .text =
         "Reload the scene when the ini, a model, one of its pictures or a camera path changes. "
         "The camera, the time and the settings stay. If a file is bad, the window says so and "
         "keeps what it shows.",
     .kind = DIP_OPTION_FLAG,
     .field = FIELD(watch)},
    {.name = "--ui-scale",
     .argument = "F",
     .text = "Enlarge text and controls by F, from 0.75 to 4. The display's own scale counts, too. "
             "Ctrl+= and Ctrl+- change it in the window.",
     .kind = DIP_OPTION_NUMBER,
     .field = FIELD(ui_scale),
     .least = 0.75,
     .most = 4},
    {.name = "--panel",
     .argument = "on|off",
     .text = "Show the panel with all settings, which is the default, or nothing but the panes, "
             "for programs that have a panel of their own. The key / changes it in the window.",
     .kind = DIP_OPTION_CUSTOM,
     .read = read_panel},
    {.name = "--display",
     .argument = "auto|window|terminal",
     .text = "Where the preview shows. `terminal` draws half blocks and characters into the "
             "terminal of standard output. `auto`, the default, opens a window, and uses the "
             "terminal if there is no display to open a window on.",
     .kind = DIP_OPTION_CUSTOM,
     .read = read_display},
    {.name = "--terminal-colours",
     .argument = "auto|true|256|none",
     .text = "The colours of a preview in the terminal: 24 bits, a palette of 256, or characters "
             "without colours. `auto`, the default, follows COLORTERM, TERM and NO_COLOR.",
     .kind = DIP_OPTION_CUSTOM,
     .read = read_colours},
};

static const DipOptionTable table = {"Drawing", rows, DIP_ARRAY_COUNT(rows)};

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
const DipOptionParts dip_preview_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

bool dip_preview_options_check(const void *options, DipError *err) {
    return dip_session_options_check(&((const DipPreviewOptions *)options)->session, err);
}
