// Measures how long the threads of a process ran on a core, how long they waited for one, and how
// often another thread took their core away.
//
// If the threads of a frame waited, other programs disturbed the frame, even if its time looks
// normal. On Linux, the numbers come from /proc/PID/task/*/schedstat (the first number is the time
// on a core, the second the time on the run queue, both in nanoseconds) and from getrusage. If the
// system does not tell the waiting time, has_wait is false.
#ifndef DIP_APP_MEASURE_TIMING_THREAD_USE_H
#define DIP_APP_MEASURE_TIMING_THREAD_USE_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Sums over the watched threads since they began, except `switches`.
typedef struct DipThreadUse {
    int64_t cpu_ns;   // Time on a core.
    int64_t wait_ns;  // Time on the run queue, ready to run; 0 if has_wait is false.
    int64_t switches; // Involuntary context switches of the whole process; 0 if it is not the
                      // calling one.
    bool has_wait;
} DipThreadUse;

// A watch reads the times of those threads of a process that existed when it was opened. Not
// thread-safe.
typedef struct DipThreadWatch DipThreadWatch;

// Opens a watch of this process. Threads that begin later are not watched, so the thread pool must
// exist before. Threads with a lower priority than the calling thread are not watched either,
// because they only work in the background. Returns NULL if the system does not tell the threads'
// times, or if memory runs out. All functions accept NULL as a watch.
DIP_API DipThreadWatch *dip_thread_watch_open(void);
DIP_API void dip_thread_watch_close(DipThreadWatch **watch);

// Opens a watch of another process of the same user. Returns NULL as dip_thread_watch_open does.
DIP_API DipThreadWatch *dip_thread_watch_open_process(long pid);

// Returns the number of threads that are watched; 0 if the watch is NULL.
DIP_API int dip_thread_watch_count(const DipThreadWatch *watch);

// Reads the sums. Takes a few microseconds per thread. If the watch is NULL, has_wait is false, and
// cpu_ns is the processor time of the calling process.
DIP_API DipThreadUse dip_thread_watch_read(const DipThreadWatch *watch);

#ifdef __cplusplus
}
#endif

#endif
