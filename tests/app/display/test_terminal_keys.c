// Tests of the terminal's keys: what bytes mean, and that no bytes confuse the reader.
#include "app/display/terminal/terminal_private.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

typedef struct Row {
    const char *bytes;
    int key;
    unsigned modifiers;
} Row;

enum { SHIFT = DIP_MODIFIER_SHIFT, CTRL = DIP_MODIFIER_CTRL, ALT = DIP_MODIFIER_ALT };

// As xterm's documentation (ctlseqs), terminfo's entries of linux and rxvt, and kitty's protocol
// document give them.
static const Row rows[] = {
    {"x", 'x', 0},
    {"X", 'x', SHIFT},
    {"1", '1', 0},
    {".", '.', 0},
    {" ", DIP_KEYCODE_SPACE, 0},
    {"\r", DIP_KEYCODE_ENTER, 0},
    {"\n", DIP_KEYCODE_ENTER, CTRL},
    {"\t", DIP_KEYCODE_TAB, 0},
    {"\x1b[Z", DIP_KEYCODE_TAB, SHIFT},
    {"\x7f", DIP_KEYCODE_BACKSPACE, 0},
    {"\x11", 'q', CTRL},
    {"\x1bz", 'z', CTRL}, // Alt stands for Ctrl with C and Z.
    {"\x1b"
     "c",
     'c', CTRL},
    {"\x1bx", 'x', ALT},
    {"\xc3\xa4", 0xe4, 0},
    {"\xe2\x82\xac", 0x20ac, 0},
    {"\x1b[A", DIP_KEYCODE_UP, 0},
    {"\x1bOA", DIP_KEYCODE_UP, 0},
    {"\x1b[B", DIP_KEYCODE_DOWN, 0},
    {"\x1b[C", DIP_KEYCODE_RIGHT, 0},
    {"\x1b[D", DIP_KEYCODE_LEFT, 0},
    {"\x1b[1;2D", DIP_KEYCODE_LEFT, SHIFT},
    {"\x1b[1;5C", DIP_KEYCODE_RIGHT, CTRL},
    {"\x1b[1;3A", DIP_KEYCODE_UP, ALT},
    {"\x1b[H", DIP_KEYCODE_HOME, 0},
    {"\x1b[1~", DIP_KEYCODE_HOME, 0},
    {"\x1b[F", DIP_KEYCODE_END, 0},
    {"\x1b[2~", DIP_KEYCODE_INSERT, 0},
    {"\x1b[3~", DIP_KEYCODE_DELETE, 0},
    {"\x1b[5~", DIP_KEYCODE_PAGE_UP, 0},
    {"\x1b[6;2~", DIP_KEYCODE_PAGE_DOWN, SHIFT},
    {"\x1bOP", DIP_KEYCODE_F1, 0},
    {"\x1b[[A", DIP_KEYCODE_F1, 0},
    {"\x1b[11~", DIP_KEYCODE_F1, 0},
    {"\x1b[1;2Q", DIP_KEYCODE_F2, SHIFT},
    {"\x1b[15~", DIP_KEYCODE_F5, 0},
    {"\x1b[17~", DIP_KEYCODE_F6, 0},
    {"\x1b[21~", DIP_KEYCODE_F10, 0},
    {"\x1b[23~", DIP_KEYCODE_F11, 0},
    {"\x1b[24;2~", DIP_KEYCODE_F12, SHIFT},
    {"\x1b[13;5u", DIP_KEYCODE_ENTER, CTRL},
    {"\x1b[27;5;13~", DIP_KEYCODE_ENTER, CTRL},
};
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

static int read_text(const char *text, int count, bool ended, DipEvent *event) {
    return dip_terminal_keys_read((const uint8_t *)text, count, ended, event);
}

static void sequences_are_keys(void **state) {
    (void)state;
    for (int i = 0; i < ROW_COUNT; ++i) {
        const int length = (int)strlen(rows[i].bytes);
        char followed[32];
        DipEvent event;
        strcpy(followed, rows[i].bytes);
        strcat(followed, "\x1b[A");
        assert_int_equal(read_text(followed, length + 3, false, &event), length);
        assert_int_equal(event.kind, DIP_EVENT_KEY_DOWN);
        assert_int_equal(event.key, rows[i].key);
        assert_int_equal(event.position, rows[i].key);
        assert_int_equal(event.modifiers, rows[i].modifiers);
    }
}

// The terminal may deliver a sequence byte by byte.
static void sequences_may_arrive_in_parts(void **state) {
    (void)state;
    for (int i = 0; i < ROW_COUNT; ++i) {
        const int length = (int)strlen(rows[i].bytes);
        DipEvent event;
        for (int part = 1; part < length; ++part) {
            assert_int_equal(read_text(rows[i].bytes, part, false, &event), 0);
            assert_int_equal(read_text(rows[i].bytes, part, true, &event), part);
        }
    }
}

static void a_lone_escape_character_is_the_key(void **state) {
    (void)state;
    DipEvent event;
    assert_int_equal(read_text("\x1b", 1, false, &event), 0);
    assert_int_equal(read_text("\x1b", 1, true, &event), 1);
    assert_int_equal(event.kind, DIP_EVENT_KEY_DOWN);
    assert_int_equal(event.key, DIP_KEYCODE_ESCAPE);
    assert_int_equal(read_text("\x1b\x1b[A", 4, false, &event), 1);
    assert_int_equal(event.key, DIP_KEYCODE_ESCAPE);
}

static DipEvent read_mouse(const char *bytes) {
    DipEvent event;
    assert_int_equal(read_text(bytes, (int)strlen(bytes), false, &event), strlen(bytes));
    return event;
}

static void reports_are_mouse_events(void **state) {
    (void)state;
    DipEvent event = read_mouse("\x1b[<0;31;12M");
    assert_int_equal(event.kind, DIP_EVENT_MOUSE_DOWN);
    assert_int_equal(event.button, DIP_MOUSE_LEFT);
    assert_int_equal(event.x, 30);
    assert_int_equal(event.y, 22);
    assert_int_equal(read_mouse("\x1b[<0;31;12m").kind, DIP_EVENT_MOUSE_UP);
    assert_int_equal(read_mouse("\x1b[<2;1;1M").button, DIP_MOUSE_RIGHT);
    event = read_mouse("\x1b[<36;5;6M");
    assert_int_equal(event.kind, DIP_EVENT_MOUSE_MOVE);
    assert_int_equal(event.modifiers, SHIFT);
    event = read_mouse("\x1b[<65;5;6M");
    assert_int_equal(event.kind, DIP_EVENT_MOUSE_WHEEL);
    assert_true(event.wheel_y < 0.0 && event.wheel_x == 0.0);
    assert_int_equal(read_mouse("\x1b[M !!").kind, DIP_EVENT_NONE);
}

// Whatever comes, the reader takes at least one byte and at most all bytes.
static void no_bytes_confuse_the_reader(void **state) {
    (void)state;
    static const uint8_t often[] = {0x1b, '[', 'O', '<', ';', '9', 'M', '~', 0xe2, 0x80};
    uint32_t random = 1;
    for (int i = 0; i < 200000; ++i) {
        uint8_t bytes[48];
        int count = 0;
        do {
            random = random * 1664525u + 1013904223u;
            bytes[count++] = random & 0x80000000u ? often[(random >> 8) % sizeof often]
                                                  : (uint8_t)(random >> 16);
        } while (count < 48 && (random >> 4) % 16 != 0);
        DipEvent event;
        assert_in_range(dip_terminal_keys_read(bytes, count, false, &event), 0, count);
        assert_in_range(dip_terminal_keys_read(bytes, count, true, &event), 1, count);
        assert_true(count < 40 || dip_terminal_keys_read(bytes, count, false, &event) > 0);
    }
}

static DipTerminalColours colours(const char *term, const char *colorterm, const char *no_color) {
    const DipTerminalEnvironment environment = {term, colorterm, no_color, NULL};
    return dip_terminal_best_colours(&environment);
}

static bool utf8(const char *locale) {
    const DipTerminalEnvironment environment = {"xterm", NULL, NULL, locale};
    return dip_terminal_has_utf8(&environment);
}

static void environment_tells_colours(void **state) {
    (void)state;
    assert_int_equal(colours("xterm-256color", "truecolor", NULL), DIP_TERMINAL_TRUE);
    assert_int_equal(colours("xterm-256color", "24bit", ""), DIP_TERMINAL_TRUE);
    assert_int_equal(colours("xterm-direct", NULL, NULL), DIP_TERMINAL_TRUE);
    assert_int_equal(colours("xterm-256color", NULL, NULL), DIP_TERMINAL_256);
    assert_int_equal(colours("tmux-256color", "", NULL), DIP_TERMINAL_256);
    assert_int_equal(colours("linux", NULL, NULL), DIP_TERMINAL_256);
    assert_int_equal(colours("vt100", NULL, NULL), DIP_TERMINAL_NONE);
    assert_int_equal(colours(NULL, NULL, NULL), DIP_TERMINAL_NONE);
    assert_int_equal(colours("xterm-256color", "truecolor", "1"), DIP_TERMINAL_NONE);
    assert_true(utf8("C.UTF-8") && utf8("de_DE.utf8") && utf8("sr_RS.UTF-8@latin") && utf8(NULL));
    assert_false(utf8("C") || utf8("de_DE.ISO-8859-1") || utf8("ja_JP.eucJP") || utf8("de_DE"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sequences_are_keys),
        cmocka_unit_test(sequences_may_arrive_in_parts),
        cmocka_unit_test(a_lone_escape_character_is_the_key),
        cmocka_unit_test(reports_are_mouse_events),
        cmocka_unit_test(no_bytes_confuse_the_reader),
        cmocka_unit_test(environment_tells_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
