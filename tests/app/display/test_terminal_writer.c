// Tests of the terminal's writer against a small terminal emulator. The emulator knows nothing of
// the writer: it carries out the bytes, and the tests compare its screen with the picture. The
// colours that the screen must show are found by searching all colours of the terminal.
#include "app/display/terminal/terminal_private.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 37, ROWS = 11, UNTOUCHED = 0xfffe };

typedef struct Colour {
    int channels[3];
} Colour;

typedef struct Cell {
    uint32_t code;
    Colour ink;
    Colour paper;
    bool reversed;
} Cell;

static struct {
    Cell cells[ROWS][COLUMNS];
    Cell pen;
    int row;
    int column;
    bool updating; // Between the sequences that begin and end a synchronised update.
    int updates;
} screen;

static uint32_t random_state = 1;

static int random_below(int limit) {
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (uint32_t)limit);
}

// --- the emulator ------------------------------------------------------------------------------

static Colour palette_colour(int index) {
    static const int levels[6] = {0, 95, 135, 175, 215, 255};
    assert_in_range(index, 16, 255);
    if (index >= 232) {
        const int grey = 8 + 10 * (index - 232);
        return (Colour){{grey, grey, grey}};
    }
    index -= 16;
    return (Colour){{levels[index / 36], levels[index / 6 % 6], levels[index % 6]}};
}

static void reset_screen(void) {
    memset(&screen, 0, sizeof screen);
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        screen.cells[i / COLUMNS][i % COLUMNS].code = UNTOUCHED;
    }
}

// Sets colours from the numbers of a sequence ESC [ ... m.
static void set_pen(const int *numbers, int count) {
    for (int i = 0; i < count;) {
        if (numbers[i] == 0) {
            screen.pen = (Cell){0};
            ++i;
        } else if (numbers[i] == 7) {
            screen.pen.reversed = true;
            ++i;
        } else {
            assert_true(numbers[i] == 38 || numbers[i] == 48);
            Colour *colour = numbers[i] == 38 ? &screen.pen.ink : &screen.pen.paper;
            if (numbers[i + 1] == 5) {
                *colour = palette_colour(numbers[i + 2]);
                i += 3;
            } else {
                assert_int_equal(numbers[i + 1], 2);
                for (int c = 0; c < 3; ++c) {
                    assert_in_range(numbers[i + 2 + c], 0, 255);
                    colour->channels[c] = numbers[i + 2 + c];
                }
                i += 5;
            }
            assert_true(i <= count);
        }
    }
}

// Carries out the sequence after ESC [. Returns the number of its bytes.
static size_t carry_out(const char *bytes) {
    int numbers[16] = {0};
    int count = 0;
    size_t i = 0;
    const bool private = bytes[0] == '?';
    i += private;
    for (; (bytes[i] >= '0' && bytes[i] <= '9') || bytes[i] == ';'; ++i) {
        count += bytes[i] == ';';
        assert_in_range(count, 0, 14);
        numbers[count] = bytes[i] == ';' ? 0 : 10 * numbers[count] + bytes[i] - '0';
    }
    if (private) {
        assert_int_equal(numbers[0], 2026);
        assert_int_equal(screen.updating, bytes[i] == 'l');
        screen.updating = bytes[i] == 'h';
        screen.updates += bytes[i] == 'h';
    } else if (bytes[i] == 'm') {
        set_pen(numbers, count + 1);
    } else if (bytes[i] == 'H') {
        screen.row = numbers[0] - 1;
        screen.column = numbers[1] - 1;
    } else {
        assert_int_equal(bytes[i], 'C');
        screen.column += numbers[0];
    }
    return i + 1;
}

static size_t show_character(const char *bytes) {
    const unsigned char *utf8 = (const unsigned char *)bytes;
    const size_t length = utf8[0] < 0x80 ? 1 : utf8[0] < 0xe0 ? 2 : utf8[0] < 0xf0 ? 3 : 4;
    uint32_t code = length == 1 ? utf8[0] : utf8[0] & (0xffu >> (length + 1));
    for (size_t i = 1; i < length; ++i) {
        assert_int_equal(utf8[i] & 0xc0, 0x80);
        code = code << 6 | (utf8[i] & 0x3fu);
    }
    assert_true(code >= ' ');
    assert_in_range(screen.row, 0, ROWS - 1);
    assert_in_range(screen.column, 0, COLUMNS - 1);
    Cell *cell = &screen.cells[screen.row][screen.column++];
    *cell = screen.pen;
    cell->code = code;
    return length;
}

static void show_bytes(const DipTerminalWriter *writer) {
    for (size_t i = 0; i < writer->count;) {
        assert_true(i == 0 || screen.updating); // Everything lies within one update.
        if (writer->bytes[i] == 0x1b) {
            assert_int_equal(writer->bytes[i + 1], '[');
            i += 2 + carry_out(writer->bytes + i + 2);
        } else {
            i += show_character(writer->bytes + i);
        }
    }
    assert_false(screen.updating);
}

// --- what the screen must show -----------------------------------------------------------------

static int distance(Colour a, Colour b) {
    int sum = 0;
    for (int c = 0; c < 3; ++c) {
        sum += (a.channels[c] - b.channels[c]) * (a.channels[c] - b.channels[c]);
    }
    return sum;
}

// Returns the smallest distance between a colour and the colours of the terminal: all colours whose
// channels are one of 64 evenly spaced values, or the palette.
static int least_distance(DipTerminalColours colours, Colour colour) {
    int least = 0;
    if (colours == DIP_TERMINAL_256) {
        least = distance(colour, palette_colour(16));
        for (int i = 17; i < 256; ++i) {
            const int candidate = distance(colour, palette_colour(i));
            least = candidate < least ? candidate : least;
        }
        return least;
    }
    for (int c = 0; c < 3; ++c) {
        int best = 255 * 255;
        for (int i = 0; i < 64; ++i) {
            const int off = (int)floor(i * 255.0 / 63.0 + 0.5) - colour.channels[c];
            best = off * off < best ? off * off : best;
        }
        least += best;
    }
    return least;
}

static void assert_shows(DipTerminalColours colours, Colour shown, Colour wanted) {
    assert_int_equal(distance(shown, wanted), least_distance(colours, wanted));
}

static Colour pixel(const DipPixels *picture, int x, int y) {
    if (x >= picture->width || y >= picture->height) {
        return (Colour){{0, 0, 0}};
    }
    const uint8_t *bytes = picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * (size_t)x;
    return (Colour){{bytes[0], bytes[1], bytes[2]}};
}

static double brightness(Colour colour) {
    return 0.2126 * colour.channels[0] + 0.7152 * colour.channels[1] + 0.0722 * colour.channels[2];
}

// A cell without colours must hold the character of its mean brightness. At the border between two
// characters, rounding may give either one.
static void assert_plain(const Cell *cell, Colour upper, Colour lower) {
    const double position = 0.5 * (brightness(upper) + brightness(lower)) * 13.0 / 255.5;
    static const char ramp[] = " .,:;-+=*o%#@";
    const char *found = strchr(ramp, (int)cell->code);
    assert_non_null(found);
    assert_false(cell->reversed);
    const double off = position - (double)(found - ramp);
    assert_true(off > -0.06 && off < 1.06);
}

static void assert_cell_shows_pixels(const DipTerminalWriter *writer, const Cell *cell,
                                     Colour upper, Colour lower) {
    if (writer->colours == DIP_TERMINAL_NONE) {
        assert_plain(cell, upper, lower);
        return;
    }
    if (!writer->utf8) {
        Colour mean;
        for (int c = 0; c < 3; ++c) {
            mean.channels[c] = (upper.channels[c] + lower.channels[c]) / 2;
        }
        assert_int_equal(cell->code, ' ');
        assert_shows(writer->colours, cell->paper, mean);
        return;
    }
    assert_true(cell->code == ' ' || cell->code == 0x2580 || cell->code == 0x2584);
    assert_shows(writer->colours, cell->code == 0x2580 ? cell->ink : cell->paper, upper);
    assert_shows(writer->colours, cell->code == 0x2584 ? cell->ink : cell->paper, lower);
}

static Colour colour_of(DipColour colour) {
    return (Colour){{colour.red, colour.green, colour.blue}};
}

static void assert_cell_shows_text(const DipTerminalWriter *writer, const Cell *cell,
                                   const DipTextCell *text) {
    if (writer->colours == DIP_TERMINAL_NONE || !writer->utf8) {
        assert_int_equal(cell->code, text->code == 0x2192 ? '>' : text->code);
    } else {
        assert_int_equal(cell->code, text->code);
    }
    if (writer->colours == DIP_TERMINAL_NONE) {
        const double difference =
            brightness(colour_of(text->paper)) - brightness(colour_of(text->ink));
        assert_true(fabs(difference) <= 1.0 || cell->reversed == (difference > 0.0));
        return;
    }
    assert_shows(writer->colours, cell->paper, colour_of(text->paper));
    if (text->code != ' ') {
        assert_shows(writer->colours, cell->ink, colour_of(text->ink));
    }
}

static void assert_screen_shows(const DipTerminalWriter *writer, const DipPixels *picture,
                                const DipTextCell *text) {
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            const DipTextCell *over = text ? &text[row * COLUMNS + column] : NULL;
            const Cell *cell = &screen.cells[row][column];
            if (over && over->code) {
                assert_cell_shows_text(writer, cell, over);
            } else {
                assert_cell_shows_pixels(writer, cell, pixel(picture, column, 2 * row),
                                         pixel(picture, column, 2 * row + 1));
            }
        }
    }
}

// --- the tests ---------------------------------------------------------------------------------

static uint8_t pixels[2 * ROWS][COLUMNS + 3][4];
static DipTextCell text[ROWS * COLUMNS];
static const DipPixels picture = {&pixels[0][0][0], sizeof pixels[0], COLUMNS, 2 * ROWS};

static void change_pixels(int count) {
    for (int i = 0; i < count; ++i) {
        uint8_t *bytes = pixels[random_below(2 * ROWS)][random_below(COLUMNS)];
        const int grey = random_below(256); // Every fourth pixel is grey.
        for (int c = 0; c < 3; ++c) {
            bytes[c] = (uint8_t)(i % 4 == 0 ? grey : random_below(256));
        }
    }
}

static void change_text(int count) {
    static const uint32_t codes[] = {0, 0, 'a', ' ', '~', 0x2192};
    for (int i = 0; i < count; ++i) {
        DipTextCell *cell = &text[random_below(ROWS * COLUMNS)];
        cell->code = codes[random_below(6)];
        cell->ink = (DipColour){(uint8_t)random_below(256), (uint8_t)random_below(256), 90, 255};
        cell->paper = (DipColour){(uint8_t)random_below(256), 10, (uint8_t)random_below(256), 255};
    }
}

static DipTerminalWriter make_writer(DipTerminalColours colours, bool utf8) {
    DipTerminalWriter writer = {.colours = colours, .utf8 = utf8};
    assert_true(dip_terminal_writer_resize(&writer, COLUMNS, ROWS, NULL));
    reset_screen();
    return writer;
}

static void show(DipTerminalWriter *writer) {
    dip_terminal_writer_encode(writer, &picture, text, COLUMNS, ROWS);
    show_bytes(writer);
    assert_screen_shows(writer, &picture, text);
}

static void screen_shows_what_the_picture_holds(void **state) {
    static const DipTerminalColours depths[] = {DIP_TERMINAL_TRUE, DIP_TERMINAL_256,
                                                DIP_TERMINAL_NONE};
    (void)state;
    for (int i = 0; i < 6; ++i) {
        DipTerminalWriter writer = make_writer(depths[i / 2], i % 2 == 0);
        for (int frame = 0; frame < 60; ++frame) {
            change_pixels(frame % 10 == 0 ? 2000 : random_below(30));
            change_text(frame % 7 == 0 ? 60 : random_below(5));
            show(&writer);
        }
        dip_terminal_writer_free(&writer);
    }
}

static void still_pictures_send_nothing(void **state) {
    (void)state;
    DipTerminalWriter writer = make_writer(DIP_TERMINAL_TRUE, true);
    change_pixels(2000);
    show(&writer);
    const int updates = screen.updates;
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(dip_terminal_writer_encode(&writer, &picture, text, COLUMNS, ROWS), 0);
    }
    assert_int_equal(updates, 1);
    // One pixel costs no more than one cell.
    pixels[5][7][1] ^= 0x80;
    text[2 * COLUMNS + 7].code = 0;
    assert_in_range(dip_terminal_writer_encode(&writer, &picture, text, COLUMNS, ROWS), 1, 80);
    show_bytes(&writer);
    assert_screen_shows(&writer, &picture, text);
    // A terminal that has lost its contents gets all cells anew.
    dip_terminal_writer_forget(&writer);
    reset_screen();
    show(&writer);
    dip_terminal_writer_free(&writer);
}

// A change that rounding hides must not be sent.
static void invisible_changes_send_nothing(void **state) {
    (void)state;
    DipTerminalWriter writer = make_writer(DIP_TERMINAL_256, true);
    memset(pixels, 120, sizeof pixels);
    memset(text, 0, sizeof text);
    show(&writer);
    memset(pixels, 121, sizeof pixels);
    assert_int_equal(dip_terminal_writer_encode(&writer, &picture, text, COLUMNS, ROWS), 0);
    dip_terminal_writer_free(&writer);
}

static void cells_outside_the_picture_are_black(void **state) {
    (void)state;
    DipTerminalWriter writer = make_writer(DIP_TERMINAL_TRUE, true);
    change_pixels(2000);
    const DipPixels small = {picture.rgba8, picture.stride_bytes, 20, 9};
    dip_terminal_writer_encode(&writer, &small, NULL, 0, 0);
    show_bytes(&writer);
    assert_screen_shows(&writer, &small, NULL);
    dip_terminal_writer_free(&writer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(screen_shows_what_the_picture_holds),
        cmocka_unit_test(still_pictures_send_nothing),
        cmocka_unit_test(invisible_changes_send_nothing),
        cmocka_unit_test(cells_outside_the_picture_are_black),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
