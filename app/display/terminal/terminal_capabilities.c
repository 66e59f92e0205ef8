// Judges a terminal by its name and by what the environment says about its colours.
#include "app/display/terminal/terminal_capabilities.h"

#include "renderer/base/assert.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool is_set(const char *value) {
    return value && value[0] != '\0';
}

DipTerminalEnvironment dip_terminal_environment(void) {
    const char *locale = getenv("LC_ALL");
    locale = is_set(locale) ? locale : getenv("LC_CTYPE");
    locale = is_set(locale) ? locale : getenv("LANG");
    return (DipTerminalEnvironment){getenv("TERM"), getenv("COLORTERM"), getenv("NO_COLOR"),
                                    locale};
}

static bool holds_one_of(const char *text, const char *const *parts, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        if (strstr(text, parts[i])) {
            return true;
        }
    }
    return false;
}

DipTerminalColours dip_terminal_best_colours(const DipTerminalEnvironment *environment) {
    static const char *const true_colours[] = {"direct",  "kitty",   "alacritty", "foot",
                                               "wezterm", "ghostty", "contour"};
    // The plain names of these terminals are old, but the terminals have shown 256 colours for many
    // years. The Linux console turns the 256 colours into its own 16.
    static const char *const many_colours[] = {"256color", "xterm", "screen", "tmux", "rxvt",
                                               "konsole",  "linux", "putty",  "vte"};
    const char *term = is_set(environment->term) ? environment->term : "dumb";
    const char *colorterm = is_set(environment->colorterm) ? environment->colorterm : "";
    if (is_set(environment->no_color)) {
        return DIP_TERMINAL_NONE;
    }
    if (strcmp(colorterm, "truecolor") == 0 || strcmp(colorterm, "24bit") == 0 ||
        holds_one_of(term, true_colours, DIP_ARRAY_COUNT(true_colours))) {
        return DIP_TERMINAL_TRUE;
    }
    return holds_one_of(term, many_colours, DIP_ARRAY_COUNT(many_colours)) ? DIP_TERMINAL_256
                                                                           : DIP_TERMINAL_NONE;
}

static bool ends_with_utf8(const char *locale) {
    const char *charset = strchr(locale, '.');
    char letters[8];
    size_t count = 0;
    if (!charset) {
        return false;
    }
    for (const char *c = charset + 1; *c && *c != '@' && count + 1 < sizeof letters; ++c) {
        if (*c != '-') {
            letters[count++] = (char)tolower((unsigned char)*c);
        }
    }
    letters[count] = '\0';
    return strcmp(letters, "utf8") == 0;
}

// Containers and remote shells often set no locale at all. Their terminals have UTF-8, as nearly
// all terminals do. A locale without a character set ("de_DE") is an old 8-bit locale.
bool dip_terminal_has_utf8(const DipTerminalEnvironment *environment) {
    return !is_set(environment->locale) || ends_with_utf8(environment->locale);
}

bool dip_terminal_can_place(const DipTerminalEnvironment *environment) {
    return is_set(environment->term) && strcmp(environment->term, "dumb") != 0;
}
