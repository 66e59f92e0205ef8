// How long the program takes to start, by part.
#ifndef DIP_APP_START_TIMES_H
#define DIP_APP_START_TIMES_H

#include <stddef.h>
#include <stdint.h>

// X(name, "what it covers"), in the order of a run.
#define DIP_START_TIME_LIST(X)                                                                     \
    X(ini, "reading the ini, starting the threads")                                                \
    X(import, "model files to meshes and materials")                                               \
    X(pictures, "reading and decoding pictures")                                                   \
    X(textures, "mip chains, and compressed ones where a pane shows them")                         \
    X(meshes, "meshes to chunks")                                                                  \
    X(paths, "camera paths")                                                                       \
    X(renderers, "both panes' renderers")                                                          \
    X(first_frame, "from then until the first frame is there")                                     \
    X(total, "from the command line to the first frame")

// Milliseconds.
typedef struct DipStartTimes {
#define DIP_START_TIME_FIELD(name, text) double name##_ms;
    DIP_START_TIME_LIST(DIP_START_TIME_FIELD)
#undef DIP_START_TIME_FIELD
    int64_t begin_ns;  // of the program
    int64_t opened_ns; // everything is loaded
    int64_t ended_ns;  // the command has done its work and gives back what it holds
} DipStartTimes;

// Milliseconds since a time of dip_clock_ns.
double dip_start_times_since_ms(int64_t begin_ns);

// To be called after every frame: the first call fills in first_frame and total.
void dip_start_times_frame(DipStartTimes *times);

// "load: ini 0.4, import 21.3, ... ms", for --timing.
void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes);

#endif
