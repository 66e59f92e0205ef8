// Decides when the next frame is due, and whether the machine keeps pace with temporal
// antialiasing.
//
// Temporal antialiasing draws each frame with another sample pattern, and the eye averages the
// frames. It can do so only if the frames follow each other at the display's refresh rate.
#ifndef DIP_APP_PREVIEW_LIVE_TAA_PACE_H
#define DIP_APP_PREVIEW_LIVE_TAA_PACE_H

#include "app/preview/live/timing.h"

#include <stdbool.h>

// At least this share of the refreshes of the last second must show a new frame.
static const double dip_taa_pace_share = 0.9;

// Zero-initialise.
typedef struct DipTaaPace {
    bool on;          // A pane used temporal antialiasing in the last frame.
    int64_t since_ns; // Since when a pane uses it, if `on`.
} DipTaaPace;

// What a pane with temporal antialiasing says about its speed.
typedef struct DipTaaSpeed {
    bool too_slow;
    int shown;  // Frames presented in the last second.
    int wanted; // Refreshes of the display in a second.
} DipTaaSpeed;

// Notes at each turn whether a pane uses temporal antialiasing, and returns its speed.
// `presented` holds the moments at which frames were presented. In the first second after temporal
// antialiasing was turned on, no speed is too slow.
DipTaaSpeed dip_taa_pace_update(DipTaaPace *pace, bool on, const DipTiming *presented,
                                int64_t refresh_ns, int64_t now_ns);

// Returns when the frame after the one that was due at `due_ns` is due: one refresh later, so that
// the mean rate is exactly the display's. If that moment has passed already, or lies further ahead
// than one refresh, the frame is due one refresh after this turn's begin, `turn_ns`.
int64_t dip_taa_pace_next_ns(int64_t due_ns, int64_t turn_ns, int64_t refresh_ns, int64_t now_ns);

#endif
