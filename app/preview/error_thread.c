// Runs the thread that measures errors, passes stills (DipStill) to it, and reads its results.
#define _GNU_SOURCE // SCHED_IDLE

#include "app/preview/error_thread.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// A still that owns its pictures.
typedef struct Still {
    DipStill def; // Its pictures point into `memory`.
    uint8_t *memory;
    size_t size_bytes;
} Still;

struct DipErrorThread {
    const DipSceneDef *scene;
    DipReflectionDef reflection;
    Still staged; // The next still, which the caller fills without holding the lock.
    unsigned picture_number;
    bool shown;
    pthread_t thread;
    bool running;
    atomic_bool stop;

    // The lock guards everything below. The caller and the thread hold it only to copy a few bytes,
    // since the thread may lose the processor for a long time while it holds the lock.
    pthread_mutex_t lock;
    pthread_cond_t changed;
    Still asked;
    unsigned asked_number; // Number of the last still; results of older stills are dropped.
    bool resting;
    DipErrorReading reading;
    bool news;
};

// --- the thread --------------------------------------------------------------------------------

typedef struct Worker {
    DipErrorThread *owner;
    DipReference *reference;
    DipErrorJob *job;
    Still still;
    unsigned number;
    bool idle;
} Worker;

static void yield_to_all(pthread_t thread, bool yields) {
    const struct sched_param param = {0};
#ifdef SCHED_IDLE
    pthread_setschedparam(thread, yields ? SCHED_IDLE : SCHED_OTHER, &param);
#else
    (void)thread;
    (void)yields;
    (void)param;
#endif
}

static void answer(Worker *worker, DipErrorStatus status) {
    DipErrorThread *owner = worker->owner;
    pthread_mutex_lock(&owner->lock);
    if (owner->asked_number == worker->number && !owner->resting) {
        owner->reading.status = status;
        if (worker->job) {
            owner->reading.result = *dip_error_job_result(worker->job);
        }
        owner->news = true;
    }
    pthread_mutex_unlock(&owner->lock);
    worker->idle = status != DIP_ERROR_STATUS_WORKING;
}

// Waits while there is nothing to do. Sets *fresh if there is a new still. Returns false if the
// thread must end.
static bool wait_for_still(Worker *worker, bool *fresh) {
    DipErrorThread *owner = worker->owner;
    pthread_mutex_lock(&owner->lock);
    while (!atomic_load(&owner->stop) &&
           (owner->resting || (worker->idle && owner->asked_number == worker->number))) {
        pthread_cond_wait(&owner->changed, &owner->lock);
    }
    *fresh = owner->asked_number != worker->number;
    if (*fresh) {
        const Still swap = worker->still;
        worker->still = owner->asked;
        owner->asked = swap;
        worker->number = owner->asked_number;
    }
    pthread_mutex_unlock(&owner->lock);
    return !atomic_load(&owner->stop);
}

static bool prepare(Worker *worker, DipError *err) {
    const DipErrorThread *owner = worker->owner;
    if (!worker->reference) {
        worker->reference = dip_reference_create_for_truth(owner->scene, &owner->stop, err);
        if (worker->reference) {
            dip_reference_set_reflection(worker->reference, &owner->reflection);
        }
    }
    if (worker->reference && !worker->job) {
        worker->job = dip_error_job_create(worker->reference, err);
    }
    return worker->job != NULL;
}

static void work(Worker *worker, bool fresh) {
    DipError err;
    if (fresh) {
        worker->idle = false;
        if (!prepare(worker, &err) || !dip_error_job_begin(worker->job, &worker->still.def, &err)) {
            answer(worker, DIP_ERROR_STATUS_FAILED);
            return;
        }
    }
    switch (dip_error_job_step(worker->job, &err)) {
    case DIP_ERROR_JOB_WORKING:
        break;
    case DIP_ERROR_JOB_NEW_RESULT:
        answer(worker, DIP_ERROR_STATUS_WORKING);
        break;
    case DIP_ERROR_JOB_DONE:
        answer(worker, DIP_ERROR_STATUS_DONE);
        break;
    case DIP_ERROR_JOB_FAILED:
        answer(worker, DIP_ERROR_STATUS_FAILED);
        break;
    }
}

static void *run(void *context) {
    Worker worker = {.owner = context, .idle = true};
    bool fresh = false;
    yield_to_all(pthread_self(), true);
    while (wait_for_still(&worker, &fresh)) {
        work(&worker, fresh);
    }
    dip_error_job_destroy(&worker.job);
    dip_reference_destroy(&worker.reference);
    free(worker.still.memory);
    return NULL;
}

// --- the caller --------------------------------------------------------------------------------

DipErrorThread *dip_error_thread_create(const DipSceneDef *scene,
                                        const DipReflectionDef *reflection, DipError *err) {
    DipErrorThread *owner = calloc(1, sizeof *owner);
    if (!owner) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
        return NULL;
    }
    owner->scene = scene;
    owner->reflection = *reflection;
    owner->resting = true;
    pthread_mutex_init(&owner->lock, NULL);
    pthread_cond_init(&owner->changed, NULL);
    return owner;
}

void dip_error_thread_destroy(DipErrorThread **owner_pointer) {
    DipErrorThread *owner = *owner_pointer;
    if (!owner) {
        return;
    }
    *owner_pointer = NULL;
    if (owner->running) {
        pthread_mutex_lock(&owner->lock);
        atomic_store(&owner->stop, true);
        pthread_cond_signal(&owner->changed);
        pthread_mutex_unlock(&owner->lock);
        // The caller waits for the thread, so the thread should end soon.
        yield_to_all(owner->thread, false);
        pthread_join(owner->thread, NULL);
    }
    pthread_cond_destroy(&owner->changed);
    pthread_mutex_destroy(&owner->lock);
    free(owner->staged.memory);
    free(owner->asked.memory);
    free(owner);
}

// Copies a still with its pictures.
static bool stage(Still *staged, const DipStill *still) {
    const size_t row_bytes = 4 * (size_t)still->width;
    const size_t picture_bytes = row_bytes * (size_t)still->height;
    if (staged->size_bytes != DIP_PANE_COUNT * picture_bytes) {
        free(staged->memory);
        staged->memory = malloc(DIP_PANE_COUNT * picture_bytes);
        staged->size_bytes = staged->memory ? DIP_PANE_COUNT * picture_bytes : 0;
    }
    if (!staged->memory) {
        return false;
    }
    staged->def = *still;
    staged->def.stride_bytes = row_bytes;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        uint8_t *const copy = staged->memory + (size_t)p * picture_bytes;
        for (size_t y = 0; still->rgba8[p] && y < (size_t)still->height; y++) {
            memcpy(copy + y * row_bytes, still->rgba8[p] + y * still->stride_bytes, row_bytes);
        }
        staged->def.rgba8[p] = still->rgba8[p] ? copy : NULL;
    }
    return true;
}

static bool start(DipErrorThread *owner) {
    if (!owner->running) {
        owner->running = pthread_create(&owner->thread, NULL, run, owner) == 0;
    }
    return owner->running;
}

void dip_error_thread_measure(DipErrorThread *owner, const DipStill *still,
                              unsigned picture_number) {
    if (owner->shown && owner->picture_number == picture_number) {
        return;
    }
    const bool staged = start(owner) && stage(&owner->staged, still);
    owner->shown = true;
    owner->picture_number = picture_number;
    pthread_mutex_lock(&owner->lock);
    if (staged) {
        const Still swap = owner->asked;
        owner->asked = owner->staged;
        owner->staged = swap;
        owner->asked_number++;
    }
    owner->resting = !staged;
    owner->reading =
        (DipErrorReading){.status = staged ? DIP_ERROR_STATUS_WORKING : DIP_ERROR_STATUS_FAILED};
    owner->news = true;
    pthread_cond_signal(&owner->changed);
    pthread_mutex_unlock(&owner->lock);
}

void dip_error_thread_pause(DipErrorThread *owner) {
    if (!owner->shown) {
        return;
    }
    owner->shown = false;
    pthread_mutex_lock(&owner->lock);
    owner->resting = true;
    owner->reading = (DipErrorReading){.status = DIP_ERROR_STATUS_PAUSED};
    owner->news = true;
    pthread_mutex_unlock(&owner->lock);
}

bool dip_error_thread_read(DipErrorThread *owner, DipErrorReading *reading) {
    pthread_mutex_lock(&owner->lock);
    const bool news = owner->news;
    *reading = owner->reading;
    owner->news = false;
    pthread_mutex_unlock(&owner->lock);
    return news;
}
