// How far a long command is, on standard error.
#ifndef DIP_APP_PROGRESS_H
#define DIP_APP_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct DipProgress {
    const char *things; // borrowed: "frames"
    int64_t total;
    int64_t begin_ns;
    int64_t shown_ns; // when it was shown last
    bool terminal;
} DipProgress;

DipProgress dip_progress_begin(const char *things, int64_t total);

// "7 of 12 frames, 3 s left". On a terminal one line that is written over, ten times a second;
// elsewhere a line every ten seconds, so that a short command prints none.
void dip_progress_show(DipProgress *progress, int64_t done);

// Shows the last state and ends the terminal's line.
void dip_progress_end(DipProgress *progress, int64_t done);

#endif
