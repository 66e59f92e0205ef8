// Shows on standard error how much of its work a long command has done. Lets Ctrl-C end the command
// once the current frame or measurement is done. Does both while a driver times frames (dip_drive).
#ifndef DIP_APP_CLI_PROGRESS_H
#define DIP_APP_CLI_PROGRESS_H

#include "app/measure/timing/driver.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipProgress {
    const char *things; // What is counted, such as "frames". Borrowed.
    int64_t total;      // Number of things in all.
    int64_t begin_ns;   // When the work began, by dip_clock_ns.
    int64_t shown_ns;   // When the progress was last shown, by dip_clock_ns; begin_ns until it is
                        // first shown.
    double expected_s;  // Time that the work is expected to take; 0 if not known.
    bool terminal;      // True if standard error is a terminal.
} DipProgress;

DipProgress dip_progress_begin(const char *things, int64_t total);

// Sets how long the work that begins next is expected to take, and how long all later parts of the
// command together are expected to take; a time is 0 if it is not known. From now on, the time left
// that is shown includes the later parts. At first the time left follows from the expected time of
// the work, later from the time that the work has taken so far.
void dip_progress_expect(double own_s, double later_s);

// Shows "7 of 12 frames, 3 s left" or, if later parts are expected to take time, "7 of 12 frames,
// about 4 min left in all". On a terminal, one line is overwritten up to ten times a second. If
// standard error is not a terminal, a new line is printed every ten seconds, so a short command
// prints nothing.
void dip_progress_show(DipProgress *progress, int64_t done);

// Shows that `done` of the things are done and ends the line. Prints nothing if standard error is
// not a terminal.
void dip_progress_end(DipProgress *progress, int64_t done);

// Returns the seconds since the work began.
double dip_progress_elapsed_s(const DipProgress *progress);

// Clears the line that shows the progress, so that another text can be printed there. Does
// nothing if standard error is not a terminal.
void dip_progress_clear(void);

// From now on, the first SIGINT (Ctrl-C) or SIGTERM only sets a flag. The second signal, of either
// kind, ends the program at once.
void dip_interrupt_watch(void);

// Returns whether one of these signals has come.
bool dip_interrupted(void);

// Steps the driver until it is done. Shows on standard error how many frames have been drawn. If
// the driver then looks for disturbed frames to draw again, also shows in how many rounds it has
// looked. `things` is the word for the frames in the line that shows the progress, such as
// "frames". If the driver fails, fails with the driver's error. After Ctrl-C or SIGTERM, fails with
// DIP_ERROR_RUNTIME, the key `command` and the message `interrupted`.
bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err);

#endif
