// The worker pool: an atomic index hands out tasks; idle workers spin briefly, then sleep.
#include "renderer/base/pool.h"

#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

// Time in nanoseconds that an idle worker looks for work before it sleeps. This is about as long as
// the pause between two panes or between the stages of a frame. Waking a sleeping thread would take
// about as long as a large part of a frame's geometry stage.
#define SPIN_NS 300000

enum { CHECKS_PER_CLOCK_READ = 64 }; // number of checks for work between two reads of the clock

// One word holds the state of a run: the run's number, whether workers may still enter the run, and
// how many workers are inside. A run does not wait for workers that wake too late to enter it.
#define STATE_RUN_SHIFT 32
#define STATE_OPEN      0x80000000u
#define STATE_INSIDE    0x7fffffffu

typedef struct Worker {
    DipPool *pool;
    int index;
    pthread_t thread;
} Worker;

struct DipPool {
    int thread_count;
    Worker *workers; // thread_count - 1 workers; the caller of dip_pool_run is worker 0
    int started;     // number of workers whose threads have been started
    bool spins;      // whether waiting threads spin: only if there is a processor for each thread

    // The current run. The caller writes these while no run is open and no worker is inside.
    DipTask task;
    void *context;
    int count;
    atomic_int next; // the next index to hand out
    atomic_bool stop;
    _Atomic uint64_t state;

    pthread_mutex_t turn;  // held by the thread whose run this is
    pthread_mutex_t mutex; // for sleeping and waking only
    pthread_cond_t wake;
    int sleeping; // number of workers that sleep
};

static void pause_briefly(void) {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

static void work(DipPool *pool, int worker) {
    for (;;) {
        const int index = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
        if (index >= pool->count) {
            return;
        }
        pool->task(pool->context, index, worker);
    }
}

static uint32_t current_run(DipPool *pool) {
    return (uint32_t)(atomic_load_explicit(&pool->state, memory_order_acquire) >> STATE_RUN_SHIFT);
}

// Waits until a run other than `seen` has begun.
static void await_run(DipPool *pool, uint32_t seen) {
    const int64_t end_ns = pool->spins ? dip_clock_ns() + SPIN_NS : 0;
    while (pool->spins && dip_clock_ns() < end_ns) {
        for (int i = 0; i < CHECKS_PER_CLOCK_READ; i++) {
            if (current_run(pool) != seen) {
                return;
            }
            pause_briefly();
        }
    }
    pthread_mutex_lock(&pool->mutex);
    pool->sleeping++;
    while (current_run(pool) == seen) {
        pthread_cond_wait(&pool->wake, &pool->mutex);
    }
    pool->sleeping--;
    pthread_mutex_unlock(&pool->mutex);
}

// Enters the current run and sets *run to its number. Returns false if the run is over.
static bool enter(DipPool *pool, uint32_t *run) {
    uint64_t state = atomic_load_explicit(&pool->state, memory_order_acquire);
    while (state & STATE_OPEN &&
           !atomic_compare_exchange_weak_explicit(&pool->state, &state, state + 1,
                                                  memory_order_acquire, memory_order_acquire)) {
    }
    *run = (uint32_t)(state >> STATE_RUN_SHIFT);
    return state & STATE_OPEN;
}

static void *worker_main(void *argument) {
    Worker *self = argument;
    DipPool *pool = self->pool;
    dip_fp_mode_set();
    uint32_t run = 0;
    for (;;) {
        await_run(pool, run);
        if (enter(pool, &run)) {
            work(pool, self->index);
            atomic_fetch_sub_explicit(&pool->state, 1, memory_order_release);
        } else if (atomic_load_explicit(&pool->stop, memory_order_acquire)) {
            return NULL; // the pool is being stopped, and this worker woke too late for a run
        }
    }
}

// Starts a new run. The mutex makes sure that no worker misses the run between its last check for
// work and falling asleep.
static void begin_run(DipPool *pool, uint32_t flags) {
    pthread_mutex_lock(&pool->mutex);
    const uint64_t run = (uint64_t)(uint32_t)(current_run(pool) + 1) << STATE_RUN_SHIFT;
    atomic_store_explicit(&pool->state, run | flags, memory_order_release);
    if (pool->sleeping) {
        pthread_cond_broadcast(&pool->wake);
    }
    pthread_mutex_unlock(&pool->mutex);
}

// Closes the run to workers that have not entered it, and waits until all workers inside have left.
static void end_run(DipPool *pool) {
    uint64_t state =
        atomic_fetch_and_explicit(&pool->state, ~(uint64_t)STATE_OPEN, memory_order_acquire);
    while (state & STATE_INSIDE) {
        if (pool->spins) {
            pause_briefly();
        } else {
            sched_yield();
        }
        state = atomic_load_explicit(&pool->state, memory_order_acquire);
    }
}

static int processor_count(void) {
#ifdef _WIN32
    const long online = pthread_num_processors_np();
#else
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return online < 1 ? 1 : online > DIP_MAX_THREADS ? DIP_MAX_THREADS : (int)online;
}

// Starts a thread with the system's usual stack, but with at least LEAST_STACK_BYTES: tasks that
// shade take up to 128 KB, which is all that some C libraries give to a thread.
static bool start_thread(Worker *worker) {
    enum { LEAST_STACK_BYTES = 1 << 20 };
    pthread_attr_t attributes;
    size_t stack_bytes = 0;
    if (pthread_attr_init(&attributes) != 0) {
        return false;
    }
    pthread_attr_getstacksize(&attributes, &stack_bytes);
    if (stack_bytes < LEAST_STACK_BYTES) {
        pthread_attr_setstacksize(&attributes, LEAST_STACK_BYTES);
    }
    const bool started = pthread_create(&worker->thread, &attributes, worker_main, worker) == 0;
    pthread_attr_destroy(&attributes);
    return started;
}

DipPool *dip_pool_create(int thread_count, DipError *err) {
    if (thread_count < 0 || thread_count > DIP_MAX_THREADS) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "threads",
                      "%d is out of range, accepted 1..%d, or 0 for all processors", thread_count,
                      DIP_MAX_THREADS);
        return NULL;
    }
    DipPool *pool = calloc(1, sizeof *pool);
    if (!pool) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "threads", "out of memory");
        return NULL;
    }
    pool->thread_count = thread_count ? thread_count : processor_count();
    pool->spins = pool->thread_count <= processor_count();
    pthread_mutex_init(&pool->turn, NULL);
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pool->workers = calloc((size_t)pool->thread_count, sizeof *pool->workers);
    for (int i = 0; pool->workers && i < pool->thread_count - 1; i++) {
        pool->workers[i] = (Worker){.pool = pool, .index = i + 1};
        if (!start_thread(&pool->workers[i])) {
            break;
        }
        pool->started++;
    }
    if (pool->started != pool->thread_count - 1) {
        dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "threads",
                      "only %d of %d threads could be started", pool->started + 1,
                      pool->thread_count);
        dip_pool_destroy(&pool);
    }
    return pool;
}

void dip_pool_destroy(DipPool **pool_pointer) {
    DipPool *pool = *pool_pointer;
    if (!pool) {
        return;
    }
    atomic_store_explicit(&pool->stop, true, memory_order_release);
    begin_run(pool, 0);
    for (int i = 0; i < pool->started; i++) {
        pthread_join(pool->workers[i].thread, NULL);
    }
    pthread_cond_destroy(&pool->wake);
    pthread_mutex_destroy(&pool->mutex);
    pthread_mutex_destroy(&pool->turn);
    free(pool->workers);
    free(pool);
    *pool_pointer = NULL;
}

int dip_pool_thread_count(const DipPool *pool) {
    return pool ? pool->thread_count : 1;
}

static void run_on_all(DipPool *pool, int count, DipTask task, void *context) {
    pthread_mutex_lock(&pool->turn);
    pool->task = task;
    pool->context = context;
    pool->count = count;
    atomic_store_explicit(&pool->next, 0, memory_order_relaxed);
    if (pool->started) {
        begin_run(pool, STATE_OPEN);
    }
    work(pool, 0);
    if (pool->started) {
        end_run(pool);
    }
    pthread_mutex_unlock(&pool->turn);
}

void dip_pool_run(DipPool *pool, int count, DipTask task, void *context) {
    const DipFpMode saved = dip_fp_mode_set();
    if (pool) {
        run_on_all(pool, count, task, context);
    }
    for (int i = 0; !pool && i < count; i++) {
        task(context, i, 0);
    }
    dip_fp_mode_restore(saved);
}
