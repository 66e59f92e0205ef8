// A pool of worker threads that runs a function for every index of a range.
#ifndef DIP_RENDERER_BASE_POOL_H
#define DIP_RENDERER_BASE_POOL_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipPool DipPool;

// A task is called once for each index 0..count-1, in no fixed order. worker: 0..thread_count-1,
// the number of the thread that runs the task, so that the task can use memory of its own thread.
typedef void (*DipTask)(void *context, int index, int worker);

enum { DIP_MAX_THREADS = 256 };

// Creates a pool. thread_count: 1..DIP_MAX_THREADS, or 0 for one thread per processor. The caller
// of dip_pool_run counts as one of these threads, so a pool of 1 starts no thread. Threads have a
// stack of at least 1 MB. The caller's thread should have at least 256 KB if it draws. Fails with
// RANGE, MEMORY or RUNTIME (a thread could not be started).
DIP_API DipPool *dip_pool_create(int thread_count, DipError *err);
// Stops the threads and frees the pool. No dip_pool_run may be in progress. *pool may be NULL and
// becomes NULL.
DIP_API void dip_pool_destroy(DipPool **pool);
// Returns the number of threads, including the caller of dip_pool_run: 1 for NULL.
DIP_API int dip_pool_thread_count(const DipPool *pool);

// Runs the task for each index 0..count-1 and returns when the task is done for all of them. count
// is at most INT_MAX - DIP_MAX_THREADS; if it is 0 or less, no task is run. A pool does one such
// run at a time: if several threads call this function, they take turns. Do not call it from a task
// of the same pool, which would wait for itself. If pool is NULL, the caller's thread runs the task
// for all indices as worker 0. Tasks run in the floating-point mode of fp_mode.h; afterwards the
// caller's own mode is restored.
DIP_API void dip_pool_run(DipPool *pool, int count, DipTask task, void *context);

#ifdef __cplusplus
}
#endif

#endif
