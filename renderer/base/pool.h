// A pool of worker threads that runs a function for every index of a range.
#ifndef DIP_RENDERER_BASE_POOL_H
#define DIP_RENDERER_BASE_POOL_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipPool DipPool;

// A task runs once for each index 0..count-1, in no fixed order. worker: 0..thread_count-1, the
// thread that runs the task, so that a task can use working memory of that thread.
typedef void (*DipTask)(void *context, int index, int worker);

enum { DIP_MAX_THREADS = 256 };

// thread_count: 1..DIP_MAX_THREADS, or 0 for one thread per processor. The caller of dip_pool_run
// is one of these threads, so a pool of 1 starts none. Fails with RANGE, MEMORY or RUNTIME (a
// thread could not be started).
DIP_API DipPool *dip_pool_create(int thread_count, DipError *err);
// Stops the threads and frees the pool, in which nothing may be running. *pool may be NULL and
// becomes NULL.
DIP_API void dip_pool_destroy(DipPool **pool);
// Returns the number of threads, the caller of dip_pool_run included.
DIP_API int dip_pool_thread_count(const DipPool *pool);

// Runs the task for each index 0..count-1 and returns when all are done. A pool runs one range at a
// time: do not call this from a task of the same pool, nor from two threads at once. Without a pool
// (NULL), the caller's thread runs all indices as worker 0. Tasks run in the floating-point mode of
// fp_mode.h; afterwards the caller's own mode is restored.
DIP_API void dip_pool_run(DipPool *pool, int count, DipTask task, void *context);

#ifdef __cplusplus
}
#endif

#endif
