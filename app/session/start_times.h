// Measures how long each part of the program's start takes.
#ifndef DIP_APP_SESSION_START_TIMES_H
#define DIP_APP_SESSION_START_TIMES_H

#include <stddef.h>
#include <stdint.h>

// X(name, "what it covers"), in the order of a run.
#define DIP_START_TIME_LIST(X)                                                                     \
    X(ini, "reading the ini and starting the threads")                                             \
    X(import, "turning model files into meshes and materials")                                     \
    X(pictures, "reading and decoding pictures")                                                   \
    X(textures, "making mip chains, and compressed ones if a pane uses them")                      \
    X(meshes, "splitting meshes into chunks")                                                      \
    X(paths, "reading camera paths")                                                               \
    X(renderers, "making the renderers of both panes")                                             \
    X(first_frame, "from the loaded session to the first complete frame")                          \
    X(total, "from the start of the program to the first frame")

// Durations are in milliseconds; the duration of a part that did not run is 0. The last three
// fields are times by dip_clock_ns.
typedef struct DipStartTimes {
#define DIP_START_TIME_FIELD(name, text) double name##_ms;
    DIP_START_TIME_LIST(DIP_START_TIME_FIELD)
#undef DIP_START_TIME_FIELD
    int64_t begin_ns;  // When the program started.
    int64_t opened_ns; // When everything was loaded.
    int64_t ended_ns;  // When the command had done its work and began to free its memory.
} DipStartTimes;

// Returns the milliseconds that have passed since begin_ns, a time by dip_clock_ns.
double dip_start_times_since_ms(int64_t begin_ns);

// Call this function after every frame. Its first call fills in first_frame and total.
void dip_start_times_frame(DipStartTimes *times);

// Formats the parts as "start, ms: ini 0.4 import 21.3 ...", for --timing.
void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes);

#endif
