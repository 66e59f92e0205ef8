// Shows on standard error how much of its work a long command has done.
#ifndef DIP_APP_CLI_PROGRESS_H
#define DIP_APP_CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct DipProgress {
    const char *things; // What is counted: "frames". Borrowed.
    int64_t total;
    int64_t begin_ns;
    int64_t shown_ns; // When the progress was last shown.
    bool terminal;    // Standard error is a terminal.
} DipProgress;

DipProgress dip_progress_begin(const char *things, int64_t total);

// Shows "7 of 12 frames, 3 s left". On a terminal, one line is overwritten up to ten times a
// second. If standard error is not a terminal, a new line is printed every ten seconds, so a short
// command prints nothing.
void dip_progress_show(DipProgress *progress, int64_t done);

// Shows the last state and ends the line. Prints nothing if standard error is not a terminal.
void dip_progress_end(DipProgress *progress, int64_t done);

#endif
