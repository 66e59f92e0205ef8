// The thread, what is asked of it, and what it answers.
#define _GNU_SOURCE // SCHED_IDLE

#include "app/preview/live.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// A shot with pictures of its own.
typedef struct Shot {
    DipJudgeShot def; // rgba8 points into memory
    uint8_t *memory;
    size_t size_bytes;
} Shot;

struct DipLive {
    const DipSceneDef *scene;
    DipReflectionDef reflection;
    Shot staged; // the caller's, filled without the lock
    unsigned picture_number;
    bool shown;
    pthread_t thread;
    bool running;
    atomic_bool stop;

    // Under the lock, which is held for copies of a few bytes only: the thread may be set aside for
    // long while it has it.
    pthread_mutex_t lock;
    pthread_cond_t changed;
    Shot asked;
    unsigned asked_number; // of what is asked; the thread's answers carry it
    bool resting;
    DipLiveReading reading;
    bool news;
};

// --- the thread --------------------------------------------------------------------------------

typedef struct Worker {
    DipLive *live;
    DipReference *reference;
    DipJudge *judge;
    Shot shot;
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

static void answer(Worker *worker, DipLiveStatus status) {
    DipLive *live = worker->live;
    pthread_mutex_lock(&live->lock);
    if (live->asked_number == worker->number && !live->resting) {
        live->reading.status = status;
        if (worker->judge) {
            live->reading.result = *dip_judge_result(worker->judge);
        }
        live->news = true;
    }
    pthread_mutex_unlock(&live->lock);
    worker->idle = status != DIP_LIVE_WORKING;
}

// Waits while there is nothing to do. Returns false when it is to end; *fresh: there is a new shot.
static bool take_shot(Worker *worker, bool *fresh) {
    DipLive *live = worker->live;
    pthread_mutex_lock(&live->lock);
    while (!atomic_load(&live->stop) &&
           (live->resting || (worker->idle && live->asked_number == worker->number))) {
        pthread_cond_wait(&live->changed, &live->lock);
    }
    *fresh = live->asked_number != worker->number;
    if (*fresh) {
        const Shot swap = worker->shot;
        worker->shot = live->asked;
        live->asked = swap;
        worker->number = live->asked_number;
    }
    pthread_mutex_unlock(&live->lock);
    return !atomic_load(&live->stop);
}

static bool prepare(Worker *worker, DipError *err) {
    const DipLive *live = worker->live;
    if (!worker->reference) {
        worker->reference = dip_reference_create_for_truth(live->scene, &live->stop, err);
        if (worker->reference) {
            dip_reference_set_reflection(worker->reference, &live->reflection);
        }
    }
    if (worker->reference && !worker->judge) {
        worker->judge = dip_judge_create(worker->reference, err);
    }
    return worker->judge != NULL;
}

static void work(Worker *worker, bool fresh) {
    DipError err;
    if (fresh) {
        worker->idle = false;
        if (!prepare(worker, &err) || !dip_judge_begin(worker->judge, &worker->shot.def, &err)) {
            answer(worker, DIP_LIVE_FAILED);
            return;
        }
    }
    switch (dip_judge_step(worker->judge, &err)) {
    case DIP_JUDGE_WORKING:
        break;
    case DIP_JUDGE_NEWS:
        answer(worker, DIP_LIVE_WORKING);
        break;
    case DIP_JUDGE_IDLE:
        answer(worker, DIP_LIVE_DONE);
        break;
    case DIP_JUDGE_FAILED:
        answer(worker, DIP_LIVE_FAILED);
        break;
    }
}

static void *run(void *context) {
    Worker worker = {.live = context, .idle = true};
    bool fresh = false;
    yield_to_all(pthread_self(), true);
    while (take_shot(&worker, &fresh)) {
        work(&worker, fresh);
    }
    dip_judge_destroy(&worker.judge);
    dip_reference_destroy(&worker.reference);
    free(worker.shot.memory);
    return NULL;
}

// --- the caller --------------------------------------------------------------------------------

DipLive *dip_live_create(const DipSceneDef *scene, const DipReflectionDef *reflection,
                         DipError *err) {
    DipLive *live = calloc(1, sizeof *live);
    if (!live) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
        return NULL;
    }
    live->scene = scene;
    live->reflection = *reflection;
    live->resting = true;
    pthread_mutex_init(&live->lock, NULL);
    pthread_cond_init(&live->changed, NULL);
    return live;
}

void dip_live_destroy(DipLive **live_pointer) {
    DipLive *live = *live_pointer;
    if (!live) {
        return;
    }
    *live_pointer = NULL;
    if (live->running) {
        pthread_mutex_lock(&live->lock);
        atomic_store(&live->stop, true);
        pthread_cond_signal(&live->changed);
        pthread_mutex_unlock(&live->lock);
        yield_to_all(live->thread, false); // its end is waited for
        pthread_join(live->thread, NULL);
    }
    pthread_cond_destroy(&live->changed);
    pthread_mutex_destroy(&live->lock);
    free(live->staged.memory);
    free(live->asked.memory);
    free(live);
}

// Copies a shot's pictures.
static bool stage(Shot *staged, const DipJudgeShot *shot) {
    const size_t row_bytes = 4 * (size_t)shot->width;
    const size_t picture_bytes = row_bytes * (size_t)shot->height;
    if (staged->size_bytes != DIP_PANE_COUNT * picture_bytes) {
        free(staged->memory);
        staged->memory = malloc(DIP_PANE_COUNT * picture_bytes);
        staged->size_bytes = staged->memory ? DIP_PANE_COUNT * picture_bytes : 0;
    }
    if (!staged->memory) {
        return false;
    }
    staged->def = *shot;
    staged->def.stride_bytes = row_bytes;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        uint8_t *const copy = staged->memory + (size_t)p * picture_bytes;
        for (size_t y = 0; shot->rgba8[p] && y < (size_t)shot->height; y++) {
            memcpy(copy + y * row_bytes, shot->rgba8[p] + y * shot->stride_bytes, row_bytes);
        }
        staged->def.rgba8[p] = shot->rgba8[p] ? copy : NULL;
    }
    return true;
}

static bool start(DipLive *live) {
    if (!live->running) {
        live->running = pthread_create(&live->thread, NULL, run, live) == 0;
    }
    return live->running;
}

void dip_live_show(DipLive *live, const DipJudgeShot *shot, unsigned picture_number) {
    if (live->shown && live->picture_number == picture_number) {
        return;
    }
    const bool staged = start(live) && stage(&live->staged, shot);
    live->shown = true;
    live->picture_number = picture_number;
    pthread_mutex_lock(&live->lock);
    if (staged) {
        const Shot swap = live->asked;
        live->asked = live->staged;
        live->staged = swap;
        live->asked_number++;
    }
    live->resting = !staged;
    live->reading = (DipLiveReading){.status = staged ? DIP_LIVE_WORKING : DIP_LIVE_FAILED};
    live->news = true;
    pthread_cond_signal(&live->changed);
    pthread_mutex_unlock(&live->lock);
}

void dip_live_rest(DipLive *live) {
    if (!live->shown) {
        return;
    }
    live->shown = false;
    pthread_mutex_lock(&live->lock);
    live->resting = true;
    live->reading = (DipLiveReading){.status = DIP_LIVE_RESTING};
    live->news = true;
    pthread_mutex_unlock(&live->lock);
}

bool dip_live_read(DipLive *live, DipLiveReading *reading) {
    pthread_mutex_lock(&live->lock);
    const bool news = live->news;
    *reading = live->reading;
    live->news = false;
    pthread_mutex_unlock(&live->lock);
    return news;
}
