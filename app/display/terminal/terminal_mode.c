// Switches the terminal's mode, and restores it from signal handlers too.
#include "app/display/terminal/terminal_private.h"

#include "renderer/base/assert.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

enum { SIGNAL_STACK_BYTES = 65536, WRITE_WAIT_MS = 100 };

// Switches to the alternate screen, hides the cursor, turns off wrapping at the right margin,
// clears the screen, and asks for decimal reports of the mouse's buttons and drags.
static const char enter_sequence[] = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[0m\x1b[2J\x1b[H"
                                     "\x1b[?1000h\x1b[?1002h\x1b[?1006h";
// Undoes enter_sequence. The sequence begins by ending an update that was cut off in the middle.
static const char leave_sequence[] = "\x1b[?2026l\x1b[?1006l\x1b[?1002l\x1b[?1000l"
                                     "\x1b[0m\x1b[2J\x1b[H\x1b[?7h\x1b[?25h\x1b[?1049l";

// The signals that the mode takes over. `asks` is what a signal asks for (terminal_private.h).
static const struct {
    int number;
    unsigned asks; // 0 if the signal ends the process, as a crash does.
} signals[] = {
    {SIGINT, DIP_TERMINAL_QUIT},
    {SIGTERM, DIP_TERMINAL_QUIT},
    {SIGHUP, DIP_TERMINAL_QUIT},
    {SIGWINCH, DIP_TERMINAL_RESIZE},
    {SIGTSTP, DIP_TERMINAL_STOP},
    {SIGCONT, DIP_TERMINAL_RESUME},
    {SIGSEGV, 0},
    {SIGBUS, 0},
    {SIGFPE, 0},
    {SIGILL, 0},
    {SIGABRT, 0},
    {SIGQUIT, 0},
};
enum { SIGNAL_COUNT = (int)DIP_ARRAY_COUNT(signals) };

static struct {
    int input;
    int output;
    pid_t owner; // The process that entered the mode. Its child processes must not leave the mode.
    struct termios before;
    struct termios during;
    struct sigaction before_ours[SIGNAL_COUNT];
    int wake[2]; // A pipe to which the signal handlers write.
    bool exit_registered;
} mode;

static volatile sig_atomic_t active; // True while the terminal must be restored.
static volatile sig_atomic_t quits;  // Number of signals that asked the program to quit.
static volatile sig_atomic_t came[SIGNAL_COUNT]; // True for a signal that is not reported yet.
// Handlers of crashes run on this stack in the thread that entered the mode, unless that thread had
// such a stack already.
static char signal_stack[SIGNAL_STACK_BYTES];

// --- restoring ---------------------------------------------------------------------------------
// Signal handlers call the functions of this part, so they use async-signal-safe functions only.

// Returns whether another process group, such as the shell's, has the terminal now.
static bool is_in_background(void) {
    const pid_t group = tcgetpgrp(mode.output);
    return group >= 0 && group != getpgrp();
}

static void write_briefly(const char *bytes, size_t count) {
    while (count > 0) {
        const ssize_t written = write(mode.output, bytes, count);
        if (written < 0 && errno != EINTR) {
            return;
        }
        bytes += written > 0 ? written : 0;
        count -= written > 0 ? (size_t)written : 0;
    }
}

// `when` is the argument of tcsetattr that says when the change takes effect.
static void restore(int when) {
    if (!active || getpid() != mode.owner) {
        return;
    }
    active = 0;
    if (!is_in_background()) {
        write_briefly(leave_sequence, sizeof leave_sequence - 1);
        tcsetattr(mode.input, when, &mode.before);
    }
}

// Wakes the thread that waits for events. A full pipe wakes the thread as well.
static void wake_reader(void) {
    const int error = errno;
    const ssize_t written = write(mode.wake[1], "", 1);
    (void)written;
    errno = error;
}

// --- signals -----------------------------------------------------------------------------------

static void end_at_once(int signal_number) {
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    restore(TCSANOW);
    sigaction(signal_number, &usual, NULL);
    raise(signal_number);
}

static int index_of(int signal_number) {
    int i = 0;
    while (signals[i].number != signal_number) {
        ++i;
    }
    return i;
}

static void take_polite_signal(int signal_number) {
    const int i = index_of(signal_number);
    came[i] = 1;
    quits = quits + (signals[i].asks == DIP_TERMINAL_QUIT);
    if (signals[i].asks == DIP_TERMINAL_QUIT && quits > 1) {
        end_at_once(signal_number);
    }
    wake_reader();
}

// Restores the terminal and lets the signal do what it did before the mode was entered. If the
// kernel sent the signal because an instruction failed, the instruction fails again after this
// function returns.
static void take_crash_signal(int signal_number, siginfo_t *info, void *machine) {
    (void)machine;
    restore(TCSANOW);
    sigaction(signal_number, &mode.before_ours[index_of(signal_number)], NULL);
    if (info->si_code <= 0 || signal_number == SIGQUIT) {
        raise(signal_number);
    }
}

static void use_signal_stack(void) {
    stack_t now;
    const stack_t stack = {.ss_sp = signal_stack, .ss_size = sizeof signal_stack};
    if (sigaltstack(NULL, &now) == 0 && (now.ss_flags & SS_DISABLE)) {
        sigaltstack(&stack, NULL);
    }
}

// Takes over the signals. If the process ignores a signal that asks for something (as SIGHUP
// under nohup), or SIGQUIT, the signal stays ignored.
static void take_signals(void) {
    struct sigaction polite = {.sa_handler = take_polite_signal};
    struct sigaction crash = {.sa_sigaction = take_crash_signal,
                              .sa_flags = (int)(SA_SIGINFO | SA_ONSTACK)};
    sigemptyset(&polite.sa_mask);
    sigemptyset(&crash.sa_mask);
    use_signal_stack();
    for (int i = 0; i < SIGNAL_COUNT; ++i) {
        struct sigaction *before = &mode.before_ours[i];
        sigaction(signals[i].number, signals[i].asks ? &polite : &crash, before);
        const bool may_be_ignored = signals[i].asks || signals[i].number == SIGQUIT;
        if (may_be_ignored && before->sa_handler == SIG_IGN) {
            sigaction(signals[i].number, before, NULL);
        }
    }
}

static void give_signals_back(void) {
    for (int i = 0; i < SIGNAL_COUNT; ++i) {
        sigaction(signals[i].number, &mode.before_ours[i], NULL);
    }
}

unsigned dip_terminal_mode_take_signals(void) {
    char bytes[64];
    while (read(mode.wake[0], bytes, sizeof bytes) > 0) {
    }
    unsigned asked = quits ? DIP_TERMINAL_QUIT : 0;
    for (int i = 0; i < SIGNAL_COUNT; ++i) {
        if (came[i]) {
            // If the same signal comes again just before this line, it is not lost: the caller acts
            // once on both.
            came[i] = 0;
            asked |= signals[i].asks;
        }
    }
    return asked;
}

int dip_terminal_mode_signal_fd(void) {
    return mode.wake[0];
}

// --- the mode ----------------------------------------------------------------------------------

static void restore_at_exit(void) {
    restore(TCSANOW);
}

static bool failed(DipError *err, const char *what) {
    return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "terminal", "%s: %s", what,
                         strerror(errno));
}

static bool open_pipe(DipError *err) {
    if (pipe(mode.wake) != 0) {
        return failed(err, "a pipe cannot be opened");
    }
    for (int i = 0; i < 2; ++i) {
        fcntl(mode.wake[i], F_SETFL, O_NONBLOCK);
        fcntl(mode.wake[i], F_SETFD, FD_CLOEXEC);
    }
    return true;
}

// Keys arrive one by one, unchanged and without an echo. The terminal still turns Ctrl+C into
// SIGINT and Ctrl+Z into SIGTSTP.
static struct termios settings_for_keys(struct termios settings) {
    settings.c_iflag &= ~(tcflag_t)(IXON | ICRNL | INLCR | IGNCR | ISTRIP | BRKINT);
    settings.c_lflag &= ~(tcflag_t)(ICANON | ECHO | IEXTEN);
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    return settings;
}

void dip_terminal_mode_renew(void) {
    active = 1; // From here on, the terminal needs restoring.
    tcsetattr(mode.input, TCSANOW, &mode.during);
    write_briefly(enter_sequence, sizeof enter_sequence - 1);
}

bool dip_terminal_mode_enter(int input, int output, DipError *err) {
    DIP_ASSERT(!active);
    mode.input = input;
    mode.output = output;
    mode.owner = getpid();
    quits = 0;
    memset((void *)came, 0, sizeof came);
    if (tcgetattr(input, &mode.before) != 0) {
        return failed(err, "the terminal's settings cannot be read");
    }
    mode.during = settings_for_keys(mode.before);
    if (!open_pipe(err)) {
        return false;
    }
    if (!mode.exit_registered) {
        mode.exit_registered = atexit(restore_at_exit) == 0;
    }
    take_signals();
    dip_terminal_mode_renew();
    return true;
}

void dip_terminal_mode_leave(void) {
    restore(TCSAFLUSH); // Drops reports of the mouse that nobody has read.
    give_signals_back();
    close(mode.wake[0]);
    close(mode.wake[1]);
}

void dip_terminal_mode_suspend(void) {
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    struct sigaction ours;
    restore(TCSANOW);
    sigaction(SIGTSTP, &usual, &ours);
    raise(SIGTSTP); // Returns when the process goes on.
    sigaction(SIGTSTP, &ours, NULL);
    if (!quits) {
        dip_terminal_mode_renew();
    }
}

bool dip_terminal_mode_write(const char *bytes, size_t count) {
    while (count > 0) {
        const ssize_t written = write(mode.output, bytes, count);
        if (written > 0) {
            bytes += written;
            count -= (size_t)written;
        } else if (written < 0 && errno == EAGAIN) {
            struct pollfd wait = {.fd = mode.output, .events = POLLOUT};
            poll(&wait, 1, WRITE_WAIT_MS);
        } else if (written < 0 && errno != EINTR) {
            return false;
        }
        if (quits && count > 0) {
            return false;
        }
    }
    return true;
}
