// Times frames in another process, which runs another build of this program or this program again.
// The process is a child, started as `PROGRAM ... --serve` and controlled through two pipes.
//
// The protocol consists of lines of text. The child first sends the greeting "diptych-WHAT 1
// COMBINATIONS FRAMES": the command that it runs, the version of the protocol, the number of
// combinations of settings and the number of frames. It answers each request for a frame with
// "geometry_ms=0.3 ... total_ms=1.5 ... hash=...", or writes an error to standard error and ends.
// Unknown names are ignored, so that builds with different stages can be compared.
#ifndef DIP_APP_MEASURE_TIMING_CHILD_H
#define DIP_APP_MEASURE_TIMING_CHILD_H

#include "renderer/base/api.h"
#include "app/measure/timing/sample.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipChild DipChild;

// Describes a child. Texts are borrowed until dip_child_stop.
typedef struct DipChildDef {
    const char *program; // File to run.
    char *const *argv;   // Arguments of the file. argv[0] is replaced, and --serve is added.
    int argc;
    const char *what; // The command that the greeting must name, such as "bench".
    int count;        // Number of combinations that the greeting must state.
    int frames;       // Number of frames that the greeting must state.
    const char *key;  // Key of the errors (DipError).
} DipChildDef;

// Starts a program and a watch of its threads (thread_use.h). Fails if the program cannot be
// started or does not send the expected greeting. From then on, this process ignores the signal
// SIGPIPE.
DIP_API DipChild *dip_child_start(const DipChildDef *def, DipError *err);

// Returns the number of the child's threads that are watched (thread_use.h); 0 if the system does
// not tell their times.
DIP_API int dip_child_thread_count(const DipChild *child);

// Lets all threads of the child draw on as many processors as `threads` says, the same ones for all
// children of this process (processors.h). If `threads` is 0, they may use all that this process
// may use. Does nothing if the last call had the same number, or if the system cannot do this.
DIP_API void dip_child_confine(DipChild *child, int threads);

// Closes the child's standard input and waits until the child has ended. If at_once is true, first
// sends the child SIGTERM, so that the child ends silently instead of reporting that nobody reads
// its answer.
DIP_API void dip_child_stop(DipChild **child, bool at_once);

// Asks the child for a frame with a line of text and reads the answer. Fills in *sample, and in
// *timed the frame's time, the times of its stages, and how long the child's threads waited,
// divided by the frame's time (NAN if the system does not tell). Fails if the child has ended or
// answers without a time.
DIP_API bool dip_child_draw(DipChild *child, const char *request, DipBenchSample *sample,
                            DipTimed *timed, DipError *err);

// Runs in the child. Sends the greeting, then answers the requests on standard input until it is
// closed. `draw` gets the line of a request and draws the frame. Before it, `prepare` gets the same
// line and does what is not timed. `prepare` may be NULL. Fails with the error of `prepare` or
// `draw`.
DIP_API bool dip_child_serve(const char *what, int count, int frames,
                             bool (*prepare)(void *context, const char *request, DipError *err),
                             bool (*draw)(void *context, const char *request,
                                          DipBenchSample *sample, DipError *err),
                             void *context, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
