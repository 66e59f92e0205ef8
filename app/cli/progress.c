// Prints the progress of a command with an estimate of the time left, and catches SIGINT and
// SIGTERM.
#include "app/cli/progress.h"

#include "renderer/base/clock.h"

#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static const int64_t terminal_period_ns = 100000000;
static const int64_t other_period_ns = INT64_C(10000000000);

// next_s is the expected time of the work that begins next, and later_s is that of all parts of the
// command that come after this work. A time is 0 if it is not known.
static double next_s, later_s;
// The time left is a weighted mean of two estimates: one from the expected time, and one from the
// time that the work has taken so far. Both weigh the same when this share of the work is done.
// Later, the second estimate weighs more. If the expected time is not known, the time left follows
// from the second estimate alone.
static const double early = 0.05;

void dip_progress_expect(double own_s, double all_later_s) {
    next_s = own_s;
    later_s = all_later_s;
}

double dip_progress_elapsed_s(const DipProgress *progress) {
    return 1e-9 * (double)(dip_clock_ns() - progress->begin_ns);
}

void dip_progress_clear(void) {
    if (isatty(STDERR_FILENO) != 0) {
        fputs("\r\033[K", stderr);
    }
}

DipProgress dip_progress_begin(const char *things, int64_t total) {
    const int64_t now_ns = dip_clock_ns();
    const double expected_s = next_s;
    next_s = 0.0;
    return (DipProgress){things, total, now_ns, now_ns, expected_s, isatty(STDERR_FILENO) != 0};
}

static void print_left(double left_s) {
    const double all_s = left_s + later_s;
    if (later_s <= 0.0) {
        fprintf(stderr, ", %.0f s left", left_s);
    } else if (all_s < 100.0) {
        fprintf(stderr, ", about %.0f s left in all", all_s);
    } else {
        fprintf(stderr, ", about %.0f min left in all", all_s / 60.0);
    }
}

static void print(const DipProgress *progress, int64_t done, int64_t now_ns) {
    fprintf(stderr, "%s%" PRId64 " of %" PRId64 " %s", progress->terminal ? "\r" : "", done,
            progress->total, progress->things);
    if (done > 0 && done < progress->total) {
        const double share = (double)done / (double)progress->total;
        const double all_s = 1e-9 * (double)(now_ns - progress->begin_ns) / share;
        const double weight = progress->expected_s > 0.0 ? share / (share + early) : 1.0;
        print_left((1.0 - share) * (weight * all_s + (1.0 - weight) * progress->expected_s));
    }
    fputs(progress->terminal ? "\033[K" : "\n", stderr);
}

void dip_progress_show(DipProgress *progress, int64_t done) {
    const int64_t now_ns = dip_clock_ns();
    if (now_ns - progress->shown_ns >=
        (progress->terminal ? terminal_period_ns : other_period_ns)) {
        print(progress, done, now_ns);
        progress->shown_ns = now_ns;
    }
}

void dip_progress_end(DipProgress *progress, int64_t done) {
    if (progress->terminal) {
        print(progress, done, dip_clock_ns());
        fputc('\n', stderr);
    }
}

// --- Ctrl-C --------------------------------------------------------------------------------------

static volatile sig_atomic_t was_interrupted;

static void interrupt(int signal_number) {
    if (was_interrupted) {
        signal(signal_number, SIG_DFL);
        raise(signal_number);
    }
    was_interrupted = 1;
}

void dip_interrupt_watch(void) {
    const struct sigaction on_interrupt = {.sa_handler = interrupt};
    sigaction(SIGINT, &on_interrupt, NULL);
    sigaction(SIGTERM, &on_interrupt, NULL);
}

bool dip_interrupted(void) {
    return was_interrupted != 0;
}

bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err) {
    DipDriverProgress now = dip_driver_progress(driver);
    DipProgress progress = dip_progress_begin(things, now.total);
    DipDriverStep step = DIP_DRIVER_WORKING;
    bool searches = false; // True once the driver looks for disturbed frames, which a second line
                           // of progress shows.
    while (step < DIP_DRIVER_DONE && !dip_interrupted()) {
        step = dip_driver_step(driver, err);
        now = dip_driver_progress(driver);
        if (now.searched > 0 && !searches) {
            searches = true;
            dip_progress_end(&progress, now.drawn);
            progress = dip_progress_begin("rounds searched for disturbed frames to time again",
                                          now.all_rounds);
        }
        progress.total = searches ? now.all_rounds : now.total;
        dip_progress_show(&progress, searches ? now.searched : now.drawn);
    }
    dip_progress_end(&progress, searches ? now.searched : now.drawn);
    // Ctrl-C also ends child processes, so a frame may fail after Ctrl-C. The message then still
    // says only that the command was interrupted.
    return dip_interrupted()
               ? dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, command, "%s", interrupted)
               : step == DIP_DRIVER_DONE;
}
