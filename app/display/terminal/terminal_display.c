// Implements the display on a terminal: turns bytes into events, follows the terminal's size, and
// writes each frame at once.
#include "app/display/terminal/terminal_display.h"

#include "app/display/terminal/terminal_private.h"
#include "renderer/base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum {
    INPUT_BYTES = 256,
    MAX_QUEUED = 16, // One key gives at most two events.
    MAX_HELD = 8,
    DEFAULT_COLUMNS = 80, // Size of a terminal that does not tell its size.
    DEFAULT_ROWS = 24,
    MAX_COLUMNS = 1000,
    MAX_ROWS = 500
};

// Some terminals need several milliseconds to show a picture, and a higher rate would keep them
// busy.
static const double frames_per_second = 20.0;

static const int64_t ns_per_ms = 1000000;
// After an escape character, the rest of the key's sequence arrives within this time.
static const int64_t escape_wait_ns = 40000000;
// A held key repeats itself every 25 to 50 ms. A key that comes again within repeat_ns is held; a
// key that does not come again within release_ns is released.
static const int64_t repeat_ns = 100000000;
static const int64_t release_ns = 150000000;
static const int64_t double_click_ns = 400000000;

typedef struct HeldKey {
    DipKeycode key; // NONE if the entry is free.
    int64_t seen_ns;
} HeldKey;

typedef struct Terminal {
    DipTerminalWriter writer;
    int input;
    bool owns_input; // True if the display opened `input` itself.
    bool gone;       // True if reading or writing has failed, as when the terminal has hung up.
    bool quit_sent;

    DipTextCell *text; // Owned: the cells of the last set_text, or NULL.
    int text_columns;
    int text_rows;

    uint8_t bytes[INPUT_BYTES]; // Bytes from the terminal that have not become events yet.
    int byte_count;
    int64_t byte_ns; // When the last bytes came.
    DipEvent queue[MAX_QUEUED];
    int queue_first;
    int queue_count;
    HeldKey held[MAX_HELD];
    DipEvent last_click;
    int64_t last_click_ns;
} Terminal;

// --- the size ----------------------------------------------------------------------------------

static bool follow_size(Terminal *terminal, DipError *err) {
    struct winsize size = {0};
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    const int columns = size.ws_col ? dip_min(size.ws_col, MAX_COLUMNS) : DEFAULT_COLUMNS;
    const int rows = size.ws_row ? dip_min(size.ws_row, MAX_ROWS) : DEFAULT_ROWS;
    return (columns == terminal->writer.columns && rows == terminal->writer.rows) ||
           dip_terminal_writer_resize(&terminal->writer, columns, rows, err);
}

static void size(void *context, int *width, int *height) {
    const Terminal *terminal = context;
    *width = terminal->writer.columns;
    *height = 2 * terminal->writer.rows;
}

// --- the queue of events -----------------------------------------------------------------------

static void queue_event(Terminal *terminal, const DipEvent *event) {
    if (terminal->queue_count < MAX_QUEUED) {
        terminal->queue[(terminal->queue_first + terminal->queue_count++) % MAX_QUEUED] = *event;
    }
}

static bool take_queued(Terminal *terminal, DipEvent *event) {
    if (terminal->queue_count == 0) {
        return false;
    }
    *event = terminal->queue[terminal->queue_first];
    terminal->queue_first = (terminal->queue_first + 1) % MAX_QUEUED;
    --terminal->queue_count;
    return true;
}

static void queue_release(Terminal *terminal, HeldKey *held) {
    const DipEvent event = {.kind = DIP_EVENT_KEY_UP, .key = held->key, .position = held->key};
    held->key = DIP_KEYCODE_NONE;
    queue_event(terminal, &event);
}

// Returns the entry of a key. If the key is not held, returns a free entry. If no entry is free,
// releases the key that was seen the longest time ago, and returns its entry.
static HeldKey *find_held(Terminal *terminal, DipKeycode key) {
    HeldKey *free_entry = NULL, *oldest = &terminal->held[0];
    for (int i = 0; i < MAX_HELD; ++i) {
        HeldKey *entry = &terminal->held[i];
        if (entry->key == key) {
            return entry;
        }
        free_entry = entry->key == DIP_KEYCODE_NONE ? entry : free_entry;
        oldest = entry->seen_ns < oldest->seen_ns ? entry : oldest;
    }
    if (!free_entry) {
        queue_release(terminal, oldest);
        free_entry = oldest;
    }
    return free_entry;
}

// Queues the press of a key.
static void queue_press(Terminal *terminal, DipEvent event, int64_t now_ns) {
    HeldKey *held = find_held(terminal, event.key);
    event.repeat = held->key == event.key && now_ns - held->seen_ns < repeat_ns;
    held->key = event.key;
    held->seen_ns = now_ns;
    queue_event(terminal, &event);
}

static void queue_click(Terminal *terminal, DipEvent event, int64_t now_ns) {
    const DipEvent *last = &terminal->last_click;
    const bool again = last->clicks == 1 && now_ns - terminal->last_click_ns < double_click_ns &&
                       last->button == event.button && last->x == event.x && last->y == event.y;
    event.clicks = again ? 2 : 1;
    terminal->last_click = event;
    terminal->last_click_ns = now_ns;
    queue_event(terminal, &event);
}

// --- input -------------------------------------------------------------------------------------

// Reads the bytes that have arrived.
static void read_input(Terminal *terminal) {
    const ssize_t count = read(terminal->input, terminal->bytes + terminal->byte_count,
                               (size_t)(INPUT_BYTES - terminal->byte_count));
    if (count > 0) {
        terminal->byte_count += (int)count;
        terminal->byte_ns = dip_clock_ns();
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        terminal->gone = true;
    }
}

// Turns the first bytes into events. Returns whether it has taken any bytes.
static bool translate_input(Terminal *terminal, int64_t now_ns) {
    DipEvent event;
    if (terminal->byte_count == 0) {
        return false;
    }
    const bool ended = now_ns - terminal->byte_ns >= escape_wait_ns;
    const int taken = dip_terminal_keys_read(terminal->bytes, terminal->byte_count, ended, &event);
    if (taken == 0) {
        return false;
    }
    if (event.kind == DIP_EVENT_KEY_DOWN) {
        queue_press(terminal, event, now_ns);
    } else if (event.kind == DIP_EVENT_MOUSE_DOWN) {
        queue_click(terminal, event, now_ns);
    } else if (event.kind != DIP_EVENT_NONE) {
        queue_event(terminal, &event);
    }
    terminal->byte_count -= taken;
    memmove(terminal->bytes, terminal->bytes + taken, (size_t)terminal->byte_count);
    return true;
}

static void release_keys(Terminal *terminal, int64_t now_ns) {
    for (int i = 0; i < MAX_HELD; ++i) {
        HeldKey *held = &terminal->held[i];
        if (held->key != DIP_KEYCODE_NONE && now_ns - held->seen_ns >= release_ns) {
            queue_release(terminal, held);
        }
    }
}

static bool ends(const Terminal *terminal, unsigned signals) {
    return ((signals & DIP_TERMINAL_QUIT) || terminal->gone) && !terminal->quit_sent;
}

static void queue_signals(Terminal *terminal) {
    unsigned signals = dip_terminal_mode_take_signals();
    if (signals & DIP_TERMINAL_STOP) {
        dip_terminal_mode_suspend();
        signals |= dip_terminal_mode_take_signals() | DIP_TERMINAL_RESUME;
    } else if (signals & DIP_TERMINAL_RESUME) {
        dip_terminal_mode_renew();
    }
    if (signals & DIP_TERMINAL_RESUME) {
        signals |= DIP_TERMINAL_RESIZE;
        dip_terminal_writer_forget(&terminal->writer);
        queue_event(terminal, &(DipEvent){.kind = DIP_EVENT_EXPOSE});
    }
    // If there is no memory for the new size, the picture keeps the old one.
    if ((signals & DIP_TERMINAL_RESIZE) && follow_size(terminal, NULL)) {
        dip_terminal_writer_forget(&terminal->writer);
        queue_event(terminal, &(DipEvent){.kind = DIP_EVENT_RESIZE});
    }
    if (ends(terminal, signals)) {
        terminal->quit_sent = true;
        queue_event(terminal, &(DipEvent){.kind = DIP_EVENT_QUIT});
    }
}

// Returns the earliest of these times:
// - until_ns,
// - the time at which a held key counts as released,
// - the time at which an unfinished escape sequence counts as broken off.
static int64_t next_deadline_ns(const Terminal *terminal, int64_t until_ns) {
    if (terminal->byte_count > 0 && terminal->byte_ns + escape_wait_ns < until_ns) {
        until_ns = terminal->byte_ns + escape_wait_ns;
    }
    for (int i = 0; i < MAX_HELD; ++i) {
        const HeldKey *held = &terminal->held[i];
        if (held->key != DIP_KEYCODE_NONE && held->seen_ns + release_ns < until_ns) {
            until_ns = held->seen_ns + release_ns;
        }
    }
    return until_ns;
}

// Waits until there is input, a signal comes, or wait_ns nanoseconds have passed. Reads the input.
static void wait_for_input(Terminal *terminal, int64_t wait_ns) {
    struct pollfd waits[2] = {
        {.fd = dip_terminal_mode_signal_fd(), .events = POLLIN},
        {.fd = terminal->gone || terminal->byte_count == INPUT_BYTES ? -1 : terminal->input,
         .events = POLLIN},
    };
    const int64_t wait_ms = wait_ns > 0 ? (wait_ns + ns_per_ms - 1) / ns_per_ms : 0;
    if (poll(waits, 2, (int)wait_ms) > 0 && waits[1].revents) {
        read_input(terminal);
    }
}

static bool next_event(void *context, int timeout_ms, DipEvent *event) {
    Terminal *terminal = context;
    const int64_t end_ns = dip_clock_ns() + ns_per_ms * timeout_ms;
    int64_t now_ns = dip_clock_ns();
    wait_for_input(terminal, 0);
    for (;;) {
        queue_signals(terminal);
        while (terminal->queue_count == 0 && translate_input(terminal, now_ns)) {
        }
        if (terminal->queue_count == 0) {
            release_keys(terminal, now_ns);
        }
        if (take_queued(terminal, event)) {
            return true;
        }
        if (now_ns >= end_ns) {
            return false;
        }
        wait_for_input(terminal, next_deadline_ns(terminal, end_ns) - now_ns);
        now_ns = dip_clock_ns();
    }
}

// --- output ------------------------------------------------------------------------------------

static void set_text(void *context, const DipTextCell *cells, int columns, int rows) {
    Terminal *terminal = context;
    const size_t count = (size_t)columns * (size_t)rows;
    if (columns != terminal->text_columns || rows != terminal->text_rows) {
        free(terminal->text);
        terminal->text = malloc(count * sizeof *terminal->text);
        terminal->text_columns = terminal->text ? columns : 0;
        terminal->text_rows = terminal->text ? rows : 0;
    }
    if (terminal->text) {
        memcpy(terminal->text, cells, count * sizeof *cells);
    }
}

// Ignores the damage: the writer compares every cell with what the terminal shows.
static bool present(void *context, const DipPixels *picture, const DipRect *damage, int count,
                    DipError *err) {
    Terminal *terminal = context;
    (void)damage;
    (void)count;
    (void)err;
    const size_t byte_count = dip_terminal_writer_encode(
        &terminal->writer, picture, terminal->text, terminal->text_columns, terminal->text_rows);
    if (byte_count > 0 && !dip_terminal_mode_write(terminal->writer.bytes, byte_count)) {
        terminal->gone = true; // next_event then queues QUIT.
    }
    return true;
}

static double scale(void *context) {
    (void)context;
    return 1.0;
}

static double refresh_hz(void *context) {
    (void)context;
    return frames_per_second;
}

// --- opening and closing -----------------------------------------------------------------------

static void free_terminal(Terminal *terminal) {
    if (terminal->owns_input) {
        close(terminal->input);
    }
    dip_terminal_writer_free(&terminal->writer);
    free(terminal->text);
    free(terminal);
}

static void close_display(void *context) {
    dip_terminal_mode_leave();
    free_terminal(context);
}

bool dip_terminal_is_there(void) {
    const DipTerminalEnvironment environment = dip_terminal_environment();
    return isatty(STDOUT_FILENO) && dip_terminal_can_place(&environment);
}

static bool check_terminal(DipError *err) {
    if (!isatty(STDOUT_FILENO)) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
                             "standard output is no terminal; `diptych dump` writes pictures");
    }
    return dip_terminal_is_there() ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
                         "the terminal cannot show pictures (TERM is not set, or is dumb); "
                         "`diptych dump` writes pictures");
}

static bool open_input(Terminal *terminal, DipError *err) {
    terminal->input = STDIN_FILENO;
    if (!isatty(STDIN_FILENO)) {
        terminal->input = open("/dev/tty", O_RDONLY | O_CLOEXEC);
        terminal->owns_input = terminal->input >= 0;
    }
    return terminal->input >= 0 ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
                         "there is no terminal to read keys from: standard input is none, and "
                         "/dev/tty cannot be opened (%s)",
                         strerror(errno));
}

bool dip_terminal_display_open(DipDisplay *display, DipTerminalColours colours, DipError *err) {
    const DipTerminalEnvironment environment = dip_terminal_environment();
    Terminal *terminal = calloc(1, sizeof *terminal);
    if (!terminal) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
    }
    terminal->writer.colours =
        colours == DIP_TERMINAL_AUTO ? dip_terminal_best_colours(&environment) : colours;
    terminal->writer.utf8 = dip_terminal_has_utf8(&environment);
    if (!check_terminal(err) || !follow_size(terminal, err) || !open_input(terminal, err) ||
        !dip_terminal_mode_enter(terminal->input, STDOUT_FILENO, err)) {
        free_terminal(terminal);
        return false;
    }
    *display = (DipDisplay){
        .context = terminal,
        .present = present,
        .next_event = next_event,
        .size = size,
        .scale = scale,
        .refresh_hz = refresh_hz,
        .set_text = set_text,
        .close = close_display,
    };
    return true;
}
