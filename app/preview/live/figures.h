// Collects the panes' frame times, turns them into figures that change slowly enough to be read,
// and formats the figures as the panel's lines of text.
#ifndef DIP_APP_PREVIEW_LIVE_FIGURES_H
#define DIP_APP_PREVIEW_LIVE_FIGURES_H

#include "app/measure/timing/sample.h"
#include "app/preview/live/error_thread.h"

#include <stdbool.h>
#include <stdint.h>

// --- times ---------------------------------------------------------------------------------------

enum { DIP_TIMING_SAMPLES = 512 };

// The newest values of a series, mostly frame times, in a ring with the moments when they were
// added. Zero-initialise.
typedef struct DipTiming {
    int64_t at_ns[DIP_TIMING_SAMPLES];
    double ms[DIP_TIMING_SAMPLES];
    unsigned count; // How many values were added so far.
} DipTiming;

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms);
void dip_timing_clear(DipTiming *timing);

// Returns the median of the values added in the last second. If there are none, returns the value
// added last, or 0 if none was added since dip_timing_clear.
double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns);

// Returns how many values were added in the last second, but at most DIP_TIMING_SAMPLES.
int dip_timing_per_second(const DipTiming *timing, int64_t now_ns);

// Copies the values added in the last `span_ns`, the newest first. Unless age_ns is NULL, also
// writes how long ago each value was added. Returns how many values were copied.
int dip_timing_recent(const DipTiming *timing, int64_t now_ns, int64_t span_ns,
                      double ms[DIP_TIMING_SAMPLES], int64_t age_ns[DIP_TIMING_SAMPLES]);

// --- the pace of temporal antialiasing -----------------------------------------------------------

// Temporal antialiasing by two alternating sample patterns (taa=alternate) relies on the eye, which
// averages the frames. The eye can do so only if the frames follow each other at the display's
// refresh rate: at least this share of the refreshes of the last second must show a new frame.
static const double dip_taa_pace_share = 0.9;

// Zero-initialise.
typedef struct DipTaaPace {
    bool on;          // A pane's sample patterns alternated in the last turn.
    int64_t since_ns; // If `on`, when a pane's patterns began to alternate.
} DipTaaPace;

// Says whether frames come fast enough for alternating patterns. All members are 0 while no pane's
// patterns alternate.
typedef struct DipTaaSpeed {
    bool too_slow;
    int shown;  // Frames presented in the last second.
    int wanted; // Refreshes of the display in a second.
} DipTaaSpeed;

// Notes in each turn of the loop whether a pane's patterns alternate (`on`), and returns the speed
// of the frames. `presented` holds the moments at which frames were presented. No speed counts as
// too slow in the first second after the patterns began to alternate.
DipTaaSpeed dip_taa_pace_update(DipTaaPace *pace, bool on, const DipTiming *presented,
                                int64_t refresh_ns, int64_t now_ns);

// Returns when the next frame is due. `due_ns` is when the previous frame was due, and `turn_ns` is
// when this turn began. The next frame is due one refresh after `due_ns`, so that the mean rate is
// exactly the display's. If that moment has passed already, or lies further ahead than one refresh,
// the frame is due one refresh after `turn_ns`.
int64_t dip_taa_pace_next_ns(int64_t due_ns, int64_t turn_ns, int64_t refresh_ns, int64_t now_ns);

// --- figures -------------------------------------------------------------------------------------

// The figures of a pane as the window shows them.
typedef struct DipPaneFigures {
    double ms;  // Median frame time of the last second in which frames were drawn.
    int frames; // Number of these frames; 1 if `ms` is the time of a single frame.
    double stage_ms[DIP_TIMED_PARTS]; // Times of the stages in DIP_STAGE_LIST.
    int fps; // Pictures presented in the last second; 0 if no rate is shown.
    DipEffects effects;
    DipCounters counters;
    bool copied; // The pane shows the other pane's picture, since the settings are the same.
    DipErrorReading errors;
    const DipTiming *times; // The newest frames' times; NULL if there are none. Borrowed.
    int dropped; // Refreshes of the last 5 seconds that showed no new picture although the picture
                 // moved.
    DipTaaSpeed taa_speed; // `too_slow` is true only if the pane's patterns alternate.
    bool mip_colours;      // The pane shows mip colours, which have no error.
    bool no_errors;        // Errors cannot be measured in this scene, so the panel leaves them out.
} DipPaneFigures;

// Zero-initialise.
typedef struct DipFigures {
    DipTiming total[DIP_PANE_COUNT];
    DipTiming stages[DIP_PANE_COUNT][DIP_TIMED_PARTS];
    DipTiming presented;  // When pictures were presented; `ms` is 0.
    DipTiming dropped;    // When refreshes had no new picture; `ms` holds their number.
    int64_t presented_ns; // When the last picture was presented; 0 if nothing moved then.
    int64_t updated_ns;   // When the shown times were updated.
    bool outdated;        // The shown times must be updated at once, as at the start and after new
                          // settings.
    DipPaneFigures shown[DIP_PANE_COUNT]; // What the window shows.
} DipFigures;

// Forgets a pane's times. Call it when the pane's settings change.
void dip_figures_forget(DipFigures *figures, int pane);

// Returns whether each pane has at least one time since its settings changed.
bool dip_figures_have_times(const DipFigures *figures);

// Adds a frame. The frame's effects and counters show at once, and its times after
// dip_figures_update. A pane that copied pixels from the other pane in this frame is left out,
// since its time and its counters are not those of its settings.
void dip_figures_add(DipFigures *figures, const DipSessionFrame *frame, int64_t now_ns);

// Counts a presented picture, and the refreshes of the display that passed without a new picture
// while the picture moved.
void dip_figures_count_presented(DipFigures *figures, bool moving, int64_t refresh_ns,
                                 int64_t now_ns);

// Updates the shown times if they are outdated or a quarter of a second old. `moving` is true if
// frames follow each other without pauses. Only then is a frame rate shown.
void dip_figures_update(DipFigures *figures, bool moving, int64_t now_ns);

// --- the panel's lines ---------------------------------------------------------------------------

typedef struct DipPanelLine {
    bool head; // The line begins a group of lines.
    char name[32];
    char value[40];
} DipPanelLine;

enum { DIP_PANEL_MAX_LINES = 24 };

// Fills in the panel's lines of times, errors, work and effects, the most important first, so that
// a caller with little room can leave out the last lines. Returns the number of lines.
int dip_panel_lines(const DipPaneFigures *figures, int pane,
                    DipPanelLine lines[DIP_PANEL_MAX_LINES]);

enum { DIP_EFFECTS_TEXT_BYTES = 900 };

// Writes which effects ran, and below, in a line for each reason, why others did not. Leaves out
// effects of which the scene has none.
void dip_effects_text(const DipEffects *effects, char text[DIP_EFFECTS_TEXT_BYTES]);

#endif
