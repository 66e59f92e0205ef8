// Translates the characters and escape sequences of a terminal into events. The sequences are those
// of xterm. For keys without modifiers, the Linux console, rxvt, tmux and screen send the same
// sequences or other sequences that this file reads, too.
#include "app/display/terminal/terminal_private.h"

#include "renderer/base/assert.h"
#include "renderer/base/utf8.h"

#include <stddef.h>

enum {
    ESCAPE = 0x1b,
    MAX_PARAMETERS = 4,
    LONGEST_SEQUENCE = 32, // A longer sequence is taken for garbage.
    // Bits of xterm's first mouse parameter.
    MOUSE_BUTTON = 3,
    MOUSE_SHIFT = 4,
    MOUSE_ALT = 8,
    MOUSE_CTRL = 16,
    MOUSE_MOVES = 32,
    MOUSE_WHEEL = 64
};

// A control sequence: ESC [, perhaps a private marker, numbers, and a final character.
typedef struct Sequence {
    int length; // Number of bytes.
    uint8_t marker;
    uint8_t final;
    int parameters[MAX_PARAMETERS]; // 0 if not given.
} Sequence;

typedef struct KeyOfNumber {
    int number;
    int key;
} KeyOfNumber;

// --- keys --------------------------------------------------------------------------------------

// Alt+C and Alt+Z stand for Ctrl+C and Ctrl+Z.
static unsigned usual_modifiers(int key, unsigned modifiers) {
    const bool stands_for_ctrl = modifiers == DIP_MODIFIER_ALT && (key == 'c' || key == 'z');
    return stands_for_ctrl ? DIP_MODIFIER_CTRL : modifiers;
}

static DipEvent key_event(int key, unsigned modifiers) {
    if (key >= 'A' && key <= 'Z') {
        key += 'a' - 'A';
        modifiers |= DIP_MODIFIER_SHIFT;
    }
    return (DipEvent){
        .kind = key == DIP_KEYCODE_NONE ? DIP_EVENT_NONE : DIP_EVENT_KEY_DOWN,
        .modifiers = usual_modifiers(key, modifiers),
        .key = (DipKeycode)key,
        .position = (DipKeycode)key,
    };
}

// Reads a character below 128, with the modifiers that an escape sequence gave it.
static DipEvent character_event(int character, unsigned modifiers) {
    switch (character) {
    case '\t':
        return key_event(DIP_KEYCODE_TAB, modifiers);
    case '\r':
        return key_event(DIP_KEYCODE_ENTER, modifiers);
    case '\n': // Ctrl+Enter on many terminals, Ctrl+J on all.
        return key_event(DIP_KEYCODE_ENTER, modifiers | DIP_MODIFIER_CTRL);
    case '\b':
    case 0x7f:
        return key_event(DIP_KEYCODE_BACKSPACE, modifiers);
    case ESCAPE:
        return key_event(DIP_KEYCODE_ESCAPE, modifiers);
    case 0:
        return key_event(DIP_KEYCODE_SPACE, modifiers | DIP_MODIFIER_CTRL);
    default:
        break;
    }
    if (character <= 26) {
        return key_event('a' + character - 1, modifiers | DIP_MODIFIER_CTRL);
    }
    if (character < ' ') {
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
    return key_event(character, modifiers);
}

// Reads the modifiers of a sequence. Terminals send 1 plus a sum of bits: 1 Shift, 2 Alt, 4
// Ctrl, 8 Super (in xterm Meta).
static unsigned modifiers_of(int parameter) {
    const unsigned bits = parameter > 1 ? (unsigned)parameter - 1 : 0;
    return (bits & 1 ? DIP_MODIFIER_SHIFT : 0u) | (bits & 2 ? DIP_MODIFIER_ALT : 0u) |
           (bits & 4 ? DIP_MODIFIER_CTRL : 0u) | (bits & 8 ? DIP_MODIFIER_SUPER : 0u);
}

static int find_key(const KeyOfNumber *keys, size_t count, int number) {
    for (size_t i = 0; i < count; ++i) {
        if (keys[i].number == number) {
            return keys[i].key;
        }
    }
    return DIP_KEYCODE_NONE;
}

// Returns the key whose sequence ends in a letter, such as ESC [ A or ESC O A.
static int key_of_letter(uint8_t letter) {
    static const KeyOfNumber keys[] = {
        {'A', DIP_KEYCODE_UP},   {'B', DIP_KEYCODE_DOWN},  {'C', DIP_KEYCODE_RIGHT},
        {'D', DIP_KEYCODE_LEFT}, {'F', DIP_KEYCODE_END},   {'H', DIP_KEYCODE_HOME},
        {'P', DIP_KEYCODE_F1},   {'Q', DIP_KEYCODE_F2},    {'R', DIP_KEYCODE_F3},
        {'S', DIP_KEYCODE_F4},   {'M', DIP_KEYCODE_ENTER}, // ESC O M: Enter of the keypad.
    };
    return find_key(keys, DIP_ARRAY_COUNT(keys), letter);
}

// Returns the key whose sequence is ESC [ number ~.
static int key_of_number(int number) {
    static const KeyOfNumber keys[] = {
        {1, DIP_KEYCODE_HOME}, {2, DIP_KEYCODE_INSERT},  {3, DIP_KEYCODE_DELETE},
        {4, DIP_KEYCODE_END},  {5, DIP_KEYCODE_PAGE_UP}, {6, DIP_KEYCODE_PAGE_DOWN},
        {7, DIP_KEYCODE_HOME}, {8, DIP_KEYCODE_END},     {11, DIP_KEYCODE_F1},
        {12, DIP_KEYCODE_F2},  {13, DIP_KEYCODE_F3},     {14, DIP_KEYCODE_F4},
        {15, DIP_KEYCODE_F5},  {17, DIP_KEYCODE_F6},     {18, DIP_KEYCODE_F7},
        {19, DIP_KEYCODE_F8},  {20, DIP_KEYCODE_F9},     {21, DIP_KEYCODE_F10},
        {23, DIP_KEYCODE_F11}, {24, DIP_KEYCODE_F12},
    };
    return find_key(keys, DIP_ARRAY_COUNT(keys), number);
}

// --- the mouse ---------------------------------------------------------------------------------

// Reads ESC [ < button ; column ; row M (pressed or moved) or m (released).
static DipEvent mouse_event(const Sequence *sequence) {
    const int bits = sequence->parameters[0];
    const bool wheel = (bits & MOUSE_WHEEL) != 0;
    const int button = bits & MOUSE_BUTTON;
    DipEvent event = {
        .modifiers = (bits & MOUSE_SHIFT ? DIP_MODIFIER_SHIFT : 0u) |
                     (bits & MOUSE_ALT ? DIP_MODIFIER_ALT : 0u) |
                     (bits & MOUSE_CTRL ? DIP_MODIFIER_CTRL : 0u),
        .x = sequence->parameters[1] > 0 ? sequence->parameters[1] - 1 : 0,
        .y = sequence->parameters[2] > 0 ? 2 * (sequence->parameters[2] - 1) : 0,
    };
    if (wheel) {
        event.kind = sequence->final == 'M' ? DIP_EVENT_MOUSE_WHEEL : DIP_EVENT_NONE;
        event.wheel_y = button == 0 ? 1.0 : button == 1 ? -1.0 : 0.0;
        event.wheel_x = button == 2 ? -1.0 : button == 3 ? 1.0 : 0.0;
    } else if (bits & MOUSE_MOVES) {
        event.kind = DIP_EVENT_MOUSE_MOVE;
    } else {
        event.kind = sequence->final == 'M' ? DIP_EVENT_MOUSE_DOWN : DIP_EVENT_MOUSE_UP;
        event.button = button == 3 ? DIP_MOUSE_OTHER : (DipMouseButton)button;
        event.clicks = sequence->final == 'M' ? 1 : 0;
    }
    return event;
}

// --- sequences ---------------------------------------------------------------------------------

// Reads a control sequence from the byte after ESC [ on. Returns false if more bytes must follow.
static bool read_sequence(const uint8_t *bytes, int count, Sequence *sequence) {
    int index = 0;
    bool detail = false; // True from a colon to the next semicolon; the digits between are skipped.
    *sequence = (Sequence){0};
    for (int i = 2; i < count && i < LONGEST_SEQUENCE; ++i) {
        const uint8_t byte = bytes[i];
        if (byte >= '0' && byte <= '9') {
            int *parameter = &sequence->parameters[index];
            *parameter = detail || *parameter > 9999 ? *parameter : 10 * *parameter + byte - '0';
        } else if (byte == ';' || byte == ':') {
            detail = byte == ':';
            index += !detail && index + 1 < MAX_PARAMETERS;
        } else if (byte >= '<' && byte <= '?') {
            sequence->marker = byte;
        } else if (byte >= '@' && byte <= '~') {
            sequence->final = byte;
            sequence->length = i + 1;
            return true;
        } else if (byte < ' ' || byte > '~') { // Such a byte shows that the sequence broke off.
            sequence->length = i;
            return true;
        }
    }
    sequence->length = LONGEST_SEQUENCE;
    return count >= LONGEST_SEQUENCE;
}

static DipEvent sequence_event(const Sequence *sequence) {
    const int number = sequence->parameters[0];
    const unsigned modifiers = modifiers_of(sequence->parameters[1]);
    if (sequence->marker == '<' && (sequence->final == 'M' || sequence->final == 'm')) {
        return mouse_event(sequence);
    }
    if (sequence->marker) {
        return (DipEvent){.kind = DIP_EVENT_NONE};
    }
    switch (sequence->final) {
    case 'Z':
        return key_event(DIP_KEYCODE_TAB, DIP_MODIFIER_SHIFT);
    case '~': // 27 ; modifiers ; character: a character with modifiers.
        return number == 27 && sequence->parameters[2] > 0 && sequence->parameters[2] < 0x80
                   ? character_event(sequence->parameters[2], modifiers)
                   : key_event(key_of_number(number), modifiers);
    case 'u': // character ; modifiers: a character with modifiers, too.
        return number > 0 && number < 0x80 ? character_event(number, modifiers)
                                           : (DipEvent){.kind = DIP_EVENT_NONE};
    default:
        return key_event(key_of_letter(sequence->final), modifiers);
    }
}

// Reads what follows ESC [.
static int read_control(const uint8_t *bytes, int count, DipEvent *event) {
    enum { OLD_MOUSE_BYTES = 6, CONSOLE_KEY_BYTES = 4 };
    Sequence sequence;
    *event = (DipEvent){.kind = DIP_EVENT_NONE};
    if (count > 2 && bytes[2] == 'M') { // The old mouse report, which is skipped.
        return count >= OLD_MOUSE_BYTES ? OLD_MOUSE_BYTES : 0;
    }
    if (count > 2 && bytes[2] == '[') { // F1 to F5 of the Linux console: ESC [ [ A to ESC [ [ E.
        if (count >= CONSOLE_KEY_BYTES && bytes[3] >= 'A' && bytes[3] <= 'E') {
            *event = key_event(DIP_KEYCODE_F1 + (bytes[3] - 'A'), 0);
        }
        return count >= CONSOLE_KEY_BYTES ? CONSOLE_KEY_BYTES : 0;
    }
    if (!read_sequence(bytes, count, &sequence)) {
        return 0;
    }
    if (sequence.final) {
        *event = sequence_event(&sequence);
    }
    return sequence.length;
}

// Reads a character beyond ASCII. A byte that is not valid UTF-8 is skipped, and so is an overlong
// encoding.
static int read_utf8(const uint8_t *bytes, int count, DipEvent *event) {
    const int length = bytes[0] >= 0xf0 ? 4 : bytes[0] >= 0xe0 ? 3 : bytes[0] >= 0xc2 ? 2 : 1;
    uint32_t code = 0;
    for (int i = 1; i < length; ++i) {
        if (i >= count) {
            return 0;
        }
        if ((bytes[i] & 0xc0) != 0x80) {
            return 1;
        }
    }
    if (dip_utf8_read((const char *)bytes, (size_t)length, &code) > 0) {
        *event = key_event((int)code, 0);
    }
    return length;
}

static int read_escape(const uint8_t *bytes, int count, DipEvent *event) {
    if (count == 1) {
        return 0;
    }
    if (bytes[1] == '[') {
        return read_control(bytes, count, event);
    }
    if (bytes[1] == 'O') {
        *event = count > 2 ? key_event(key_of_letter(bytes[2]), 0) : *event;
        return count > 2 ? 3 : 0;
    }
    if (bytes[1] == ESCAPE) { // The first escape character is the Escape key.
        *event = key_event(DIP_KEYCODE_ESCAPE, 0);
        return 1;
    }
    *event = bytes[1] < 0x80 ? character_event(bytes[1], DIP_MODIFIER_ALT) : *event;
    return 2;
}

int dip_terminal_keys_read(const uint8_t *bytes, int count, bool ended, DipEvent *event) {
    int length;
    *event = (DipEvent){.kind = DIP_EVENT_NONE};
    if (bytes[0] == ESCAPE) {
        length = read_escape(bytes, count, event);
    } else if (bytes[0] >= 0x80) {
        length = read_utf8(bytes, count, event);
    } else {
        *event = character_event(bytes[0], 0);
        length = 1;
    }
    if (length > 0 || !ended) {
        return length;
    }
    *event = count == 1 && bytes[0] == ESCAPE ? key_event(DIP_KEYCODE_ESCAPE, 0)
                                              : (DipEvent){.kind = DIP_EVENT_NONE};
    return count;
}
