// Finds out from the environment what a terminal can show, and encodes frames for the terminal.
#include "app/display/terminal/terminal_private.h"

#include "renderer/base/assert.h"
#include "renderer/base/utf8.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    UPPER_HALF = 0x2580,
    LOWER_HALF = 0x2584,
    // A cell takes at most 12 bytes to place, 38 to set both colours and 4 for its character.
    MAX_CELL_BYTES = 56,
    MAX_FRAME_BYTES = 64, // Bytes before and after the cells of a frame.
    TRUE_STEPS = 63,      // Steps of each channel in true colour, see true_channel.
    PLAIN_GREYS = 13
};

static const uint32_t no_colour = 0xffffffffu; // A colour that no cell has.
static const char begin_update[] = "\x1b[?2026h";
static const char end_update[] = "\x1b[?2026l";

// --- what the terminal can show ------------------------------------------------------------------

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
    // Some of these names are older than terminals with 256 colours, but today's terminals with
    // such a name show 256 colours. The Linux console turns the 256 colours into its own 16.
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

static bool names_utf8(const char *locale) {
    const char *dot = strchr(locale, '.');
    const char *charset = dot ? dot + 1 : "";
    const size_t length = strcspn(charset, "@");
    return (length == strlen("utf8") && strncasecmp(charset, "utf8", length) == 0) ||
           (length == strlen("utf-8") && strncasecmp(charset, "utf-8", length) == 0);
}

// Containers and remote shells often set no locale at all. Their terminals have UTF-8, as nearly
// all terminals do. A locale without a character set ("de_DE") is an old 8-bit locale.
bool dip_terminal_has_utf8(const DipTerminalEnvironment *environment) {
    return !is_set(environment->locale) || names_utf8(environment->locale);
}

bool dip_terminal_can_place(const DipTerminalEnvironment *environment) {
    return is_set(environment->term) && strcmp(environment->term, "dumb") != 0;
}

// --- memory ------------------------------------------------------------------------------------

bool dip_terminal_writer_resize(DipTerminalWriter *writer, int columns, int rows, DipError *err) {
    const size_t cell_count = (size_t)columns * (size_t)rows;
    DipTerminalCell *shown = malloc(cell_count * sizeof *shown);
    char *bytes = malloc(cell_count * MAX_CELL_BYTES + MAX_FRAME_BYTES);
    if (!shown || !bytes) {
        free(shown);
        free(bytes);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "terminal", "out of memory");
    }
    dip_terminal_writer_free(writer);
    writer->columns = columns;
    writer->rows = rows;
    writer->shown = shown;
    writer->bytes = bytes;
    dip_terminal_writer_forget(writer);
    return true;
}

void dip_terminal_writer_free(DipTerminalWriter *writer) {
    free(writer->shown);
    free(writer->bytes);
    writer->shown = NULL;
    writer->bytes = NULL;
    writer->columns = writer->rows = 0;
    writer->count = 0;
}

void dip_terminal_writer_forget(DipTerminalWriter *writer) {
    if (writer->shown) {
        memset(writer->shown, 0,
               (size_t)writer->columns * (size_t)writer->rows * sizeof *writer->shown);
    }
}

// --- colours -----------------------------------------------------------------------------------

// Rounds a channel to 64 values. The rounding changes a channel by at most 2 of 255. In a picture
// that moves slowly, many cells then stay the same and need not be sent.
static uint32_t true_channel(int value) {
    const int step = (value * TRUE_STEPS + 127) / 255;
    return (uint32_t)((step * 255 + TRUE_STEPS / 2) / TRUE_STEPS);
}

// The six values of a channel in the palette's cube are 0, 95, 135, 175, 215 and 255.
static int cube_index(int value) {
    return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40;
}

static int cube_value(int index) {
    return index == 0 ? 0 : 55 + 40 * index;
}

static int square(int value) {
    return value * value;
}

// Returns the index of the palette's colour that is nearest to the given one. The palette has the
// cube at the indices 16 to 231 and the greys 8, 18, ..., 238 at the indices 232 to 255.
static uint32_t palette_index(int red, int green, int blue) {
    const int r = cube_index(red), g = cube_index(green), b = cube_index(blue);
    const int sum = red + green + blue;
    const int grey = sum < 9 ? 0 : sum >= 699 ? 23 : (sum - 9) / 30;
    const int grey_value = 8 + 10 * grey;
    const int cube_error =
        square(red - cube_value(r)) + square(green - cube_value(g)) + square(blue - cube_value(b));
    const int grey_error =
        square(red - grey_value) + square(green - grey_value) + square(blue - grey_value);
    return (uint32_t)(grey_error < cube_error ? 232 + grey : 16 + 36 * r + 6 * g + b);
}

static uint32_t colour_of(const DipTerminalWriter *writer, int red, int green, int blue) {
    if (writer->colours == DIP_TERMINAL_TRUE) {
        return true_channel(red) << 16 | true_channel(green) << 8 | true_channel(blue);
    }
    return palette_index(red, green, blue);
}

// Returns the brightness (luma by BT.709) of a colour, 0 to 255.
static int luma(int red, int green, int blue) {
    return (2126 * red + 7152 * green + 722 * blue + 5000) / 10000;
}

// --- cells -------------------------------------------------------------------------------------

// Returns a pixel of the picture. Pixels outside the picture are black.
static const uint8_t *pixel_at(const DipPixels *picture, int x, int y) {
    static const uint8_t black[4] = {0, 0, 0, 255};
    if (x >= picture->width || y >= picture->height) {
        return black;
    }
    return picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * (size_t)x;
}

// Returns the cell that shows two pixels.
static DipTerminalCell picture_cell(const DipTerminalWriter *writer, const uint8_t *upper,
                                    const uint8_t *lower) {
    static const char greys[PLAIN_GREYS + 1] = " .,:;-+=*o%#@";
    if (writer->colours == DIP_TERMINAL_NONE) {
        const int sum = luma(upper[0], upper[1], upper[2]) + luma(lower[0], lower[1], lower[2]);
        return (DipTerminalCell){(uint32_t)greys[sum * PLAIN_GREYS / 511], 0, 0};
    }
    if (!writer->utf8) {
        return (DipTerminalCell){' ', 0,
                                 colour_of(writer, (upper[0] + lower[0]) / 2,
                                           (upper[1] + lower[1]) / 2, (upper[2] + lower[2]) / 2)};
    }
    const uint32_t top = colour_of(writer, upper[0], upper[1], upper[2]);
    const uint32_t bottom = colour_of(writer, lower[0], lower[1], lower[2]);
    return top == bottom ? (DipTerminalCell){' ', 0, top}
                         : (DipTerminalCell){UPPER_HALF, top, bottom};
}

// Returns the ASCII character that comes nearest to a character of the preview's texts.
static uint32_t ascii_of(uint32_t code) {
    static const struct {
        uint32_t code;
        char ascii;
    } pairs[] = {
        {0x2212, '-'}, {0x2500, '-'}, {0x2013, '-'},                // minus, horizontal line, dash
        {0x2190, '<'}, {0x2191, '^'}, {0x2192, '>'}, {0x2193, 'v'}, // arrows
        {0x25b6, '>'}, {0x25cf, 'o'},                // triangle to the right, filled circle
        {0x2588, '#'}, {0x2592, '#'}, {0x2502, '|'}, // full block, medium shade, vertical line
        {0x2026, '.'}, {0xb7, '.'},                  // ellipsis, middle dot
        {0x2248, '~'}, {0xd7, 'x'},                  // almost equal, times
    };
    for (size_t i = 0; i < DIP_ARRAY_COUNT(pairs); ++i) {
        if (pairs[i].code == code) {
            return (uint32_t)pairs[i].ascii;
        }
    }
    return code < 0x80 ? code : '?';
}

static DipTerminalCell text_cell(const DipTerminalWriter *writer, const DipTextCell *text) {
    const bool plain = writer->colours == DIP_TERMINAL_NONE;
    const DipColour ink = text->ink, paper = text->paper;
    DipTerminalCell cell = {.code = plain || !writer->utf8 ? ascii_of(text->code) : text->code};
    if (plain) {
        cell.paper = luma(ink.red, ink.green, ink.blue) < luma(paper.red, paper.green, paper.blue);
        return cell;
    }
    cell.ink = cell.code == ' ' ? 0 : colour_of(writer, ink.red, ink.green, ink.blue);
    cell.paper = colour_of(writer, paper.red, paper.green, paper.blue);
    return cell;
}

// --- bytes -------------------------------------------------------------------------------------

static inline void put_text(DipTerminalWriter *writer, const char *text) {
    const size_t length = strlen(text);
    memcpy(writer->bytes + writer->count, text, length);
    writer->count += length;
}

// Appends a number in decimal digits.
static inline void put_number(DipTerminalWriter *writer, uint32_t number) {
    char digits[10];
    int count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    while (count > 0) {
        writer->bytes[writer->count++] = digits[--count];
    }
}

static void put_code(DipTerminalWriter *writer, uint32_t code) {
    writer->count += dip_utf8_write(code, writer->bytes + writer->count);
}

// Moves the terminal's cursor.
static void put_place(DipTerminalWriter *writer, int column, int row) {
    if (row == writer->row && column == writer->column) {
        return;
    }
    put_text(writer, "\x1b[");
    if (row == writer->row && column > writer->column) {
        put_number(writer, (uint32_t)(column - writer->column));
        put_text(writer, "C");
    } else {
        put_number(writer, (uint32_t)row + 1);
        put_text(writer, ";");
        put_number(writer, (uint32_t)column + 1);
        put_text(writer, "H");
    }
    writer->row = row;
    writer->column = column;
}

// Appends the parameters that set a colour. `layer` is 38 for the ink and 48 for the paper.
static void put_colour(DipTerminalWriter *writer, uint32_t layer, uint32_t colour) {
    put_number(writer, layer);
    if (writer->colours == DIP_TERMINAL_256) {
        put_text(writer, ";5;");
        put_number(writer, colour);
        return;
    }
    put_text(writer, ";2;");
    put_number(writer, colour >> 16 & 0xff);
    put_text(writer, ";");
    put_number(writer, colour >> 8 & 0xff);
    put_text(writer, ";");
    put_number(writer, colour & 0xff);
}

// Sets the colours of the next character. The caller passes no_colour for a colour that the
// character does not show.
static void put_pen(DipTerminalWriter *writer, uint32_t ink, uint32_t paper) {
    const bool new_ink = ink != no_colour && ink != writer->pen.ink;
    const bool new_paper = paper != no_colour && paper != writer->pen.paper;
    if (!new_ink && !new_paper) {
        return;
    }
    put_text(writer, "\x1b[");
    if (new_ink) {
        put_colour(writer, 38, ink);
        writer->pen.ink = ink;
    }
    if (new_paper) {
        put_text(writer, new_ink ? ";" : "");
        put_colour(writer, 48, paper);
        writer->pen.paper = paper;
    }
    put_text(writer, "m");
}

// Shows two colours in one cell. Of two characters, writes the one that needs fewer new colours:
// the upper half block, or the lower half block with ink and paper exchanged.
static void put_halves(DipTerminalWriter *writer, uint32_t upper, uint32_t lower) {
    const DipTerminalCell pen = writer->pen;
    const int changes = (pen.ink != upper) + (pen.paper != lower);
    const int exchanged_changes = (pen.ink != lower) + (pen.paper != upper);
    if (exchanged_changes < changes) {
        put_pen(writer, lower, upper);
        put_code(writer, LOWER_HALF);
    } else {
        put_pen(writer, upper, lower);
        put_code(writer, UPPER_HALF);
    }
}

static void put_cell(DipTerminalWriter *writer, DipTerminalCell cell) {
    if (writer->colours == DIP_TERMINAL_NONE) {
        if (cell.paper != writer->pen.paper) {
            put_text(writer, cell.paper ? "\x1b[7m" : "\x1b[0m");
            writer->pen.paper = cell.paper;
        }
        put_code(writer, cell.code);
    } else if (cell.code == UPPER_HALF) {
        put_halves(writer, cell.ink, cell.paper);
    } else {
        put_pen(writer, cell.code == ' ' ? no_colour : cell.ink, cell.paper);
        put_code(writer, cell.code);
    }
    ++writer->column;
}

// --- frames ------------------------------------------------------------------------------------

static void begin_frame(DipTerminalWriter *writer) {
    writer->count = 0;
    put_text(writer, begin_update);
    put_text(writer, "\x1b[0m");
    writer->pen = (DipTerminalCell){0, no_colour, no_colour};
    if (writer->colours == DIP_TERMINAL_NONE) {
        writer->pen.paper = 0;
    }
    writer->row = writer->column = -1;
}

static DipTerminalCell wanted_cell(const DipTerminalWriter *writer, const DipPixels *picture,
                                   const DipTextCell *text, int column, int row) {
    if (text && text->code != 0) {
        return text_cell(writer, text);
    }
    return picture_cell(writer, pixel_at(picture, column, 2 * row),
                        pixel_at(picture, column, 2 * row + 1));
}

size_t dip_terminal_writer_encode(DipTerminalWriter *writer, const DipPixels *picture,
                                  const DipTextCell *text, int text_columns, int text_rows) {
    bool changed = false;
    begin_frame(writer);
    for (int row = 0; row < writer->rows; ++row) {
        const DipTextCell *text_row =
            text && row < text_rows ? text + (size_t)row * (size_t)text_columns : NULL;
        DipTerminalCell *shown = writer->shown + (size_t)row * (size_t)writer->columns;
        for (int column = 0; column < writer->columns; ++column) {
            const DipTextCell *over = text_row && column < text_columns ? text_row + column : NULL;
            const DipTerminalCell cell = wanted_cell(writer, picture, over, column, row);
            if (memcmp(&cell, &shown[column], sizeof cell) != 0) {
                put_place(writer, column, row);
                put_cell(writer, cell);
                shown[column] = cell;
                changed = true;
            }
        }
    }
    put_text(writer, end_update);
    writer->count = changed ? writer->count : 0;
    return writer->count;
}
