// One pool of worker threads: runs a function for every index of a range.
#ifndef DIP_RENDERER_BASE_POOL_H
#define DIP_RENDERER_BASE_POOL_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipPool DipPool;

// index: 0..count-1, each exactly once, in no fixed order. worker: 0..thread_count-1, the thread
// that runs it, so that a task may use scratch of its own.
typedef void (*DipTask)(void *context, int index, int worker);

enum { DIP_MAX_THREADS = 256 };

// thread_count 0: one per processor; else 1..DIP_MAX_THREADS. The caller of dip_pool_run is one
// of them, so a pool of 1 starts no thread.
DIP_API DipPool *dip_pool_create(int thread_count, DipError *err);
DIP_API void dip_pool_destroy(DipPool **pool);
DIP_API int dip_pool_thread_count(const DipPool *pool);

// Returns when all are done. One run at a time: not to be called from a task or by two threads.
// Without a pool (NULL) the caller runs them all, as worker 0.
DIP_API void dip_pool_run(DipPool *pool, int count, DipTask task, void *context);

#ifdef __cplusplus
}
#endif

#endif
