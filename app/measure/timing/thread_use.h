// Tells what the threads of a process got from the processor: how long they ran on a core, how long
// they waited for one, and how often another process took their core away.
//
// A frame whose threads waited was disturbed by another process, whatever its time says. On Linux
// the figures come from /proc/self/task/*/schedstat (the first number is the time on a core, the
// second the time on the run queue, both in nanoseconds) and from getrusage. Where the machine does
// not tell the waiting time, has_wait is false.
#ifndef DIP_APP_MEASURE_TIMING_THREAD_USE_H
#define DIP_APP_MEASURE_TIMING_THREAD_USE_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Sums over all threads since the process began.
typedef struct DipThreadUse {
    int64_t cpu_ns;   // Time on a core.
    int64_t wait_ns;  // Time on the run queue, ready to run; 0 if has_wait is false.
    int64_t switches; // Involuntary context switches.
    bool has_wait;
} DipThreadUse;

// Watches the threads that exist when it is opened, of this process or of another one. Not
// thread-safe.
typedef struct DipThreadWatch DipThreadWatch;

// Opens a watch. Threads that are started later are not seen, so open it after the thread pool.
// Threads with less priority than the calling one are not watched: they work in the background.
// Returns NULL if the machine does not tell the threads' times, or if memory runs out.
// dip_thread_watch_read accepts NULL.
DIP_API DipThreadWatch *dip_thread_watch_open(void);
DIP_API void dip_thread_watch_close(DipThreadWatch **watch);

// Opens a watch of another process of the same user.
DIP_API DipThreadWatch *dip_thread_watch_open_process(long pid);

// Returns the number of threads that are watched; 0 without a watch.
DIP_API int dip_thread_watch_count(const DipThreadWatch *watch);

// Reads the sums. Takes a few microseconds per thread. `switches` always counts those of this
// process. Without a watch, only this number and this process' time on a core are known.
DIP_API DipThreadUse dip_thread_watch_read(const DipThreadWatch *watch);

#ifdef __cplusplus
}
#endif

#endif
