// Times frames in another process: another build of this program, or this one started anew. The
// process runs as a child, `PROGRAM ... --serve`, and is controlled through two pipes.
//
// The protocol consists of lines of text. The child first sends the greeting "diptych-WHAT 1
// COMBINATIONS FRAMES". It answers each request for a frame with "total_ms=1.5 geometry_ms=...
// hash=...", or writes an error to standard error and ends. Unknown names are ignored, so that
// builds with different stages can be compared.
#ifndef DIP_APP_MEASURE_TIMING_CHILD_H
#define DIP_APP_MEASURE_TIMING_CHILD_H

#include "renderer/base/api.h"
#include "app/measure/timing/sample.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipChild DipChild;

// Texts are borrowed while the child lives.
typedef struct DipChildDef {
    const char *program; // File to run.
    char *const *argv;   // Its command line; argv[0] is replaced, and --serve is added.
    int argc;
    const char *what; // The command: "bench".
    int count;        // Combinations that the greeting must state.
    int frames;       // Frames that the greeting must state.
    const char *key;  // The key of errors.
} DipChildDef;

// Starts a program and its watch. Fails if the program cannot be started or does not send the
// expected greeting.
DIP_API DipChild *dip_child_start(const DipChildDef *def, DipError *err);

// Returns the number of the child's threads; 0 if the machine does not tell.
DIP_API int dip_child_thread_count(const DipChild *child);

// Closes the child's standard input and waits until the child has ended. at_once: sends the child a
// signal to end first. Its answer is then no longer read, so it must not complain that it cannot
// write one.
DIP_API void dip_child_stop(DipChild **child, bool at_once);

// Asks for a frame. Writes the frame's time, the parts of this time, and how long the child's
// threads waited (NAN if the machine does not tell).
DIP_API bool dip_child_draw(DipChild *child, const char *request, DipBenchSample *sample,
                            DipTimed *timed, DipError *err);

// Runs in the child: answers requests on standard input until standard input is closed. `draw` gets
// the line of a request.
DIP_API bool dip_child_serve(const char *what, int count, int frames,
                             bool (*draw)(void *context, const char *request,
                                          DipBenchSample *sample, DipError *err),
                             void *context, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
