// Runs the thread that measures errors, passes stills (DipStill) to it, and reads its results.
#define _GNU_SOURCE // Declares syscall().

#include "app/preview/live/error_thread.h"

#include "app/cost/plan.h"

#include "app/preview/live/processor_share.h"

#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

// The thread's nice value, which makes its priority lower than that of other threads. If all
// threads compete for a processor, this thread gets 0.8 of the time of another thread. With a nice
// value of 4, it got 0.4, and measuring errors took minutes beside many other programs; with an
// idle priority it would get none.
enum { NICE = 1 };

// A still that owns its pictures.
typedef struct Still {
    DipStill def; // The pictures of this DipStill point into `memory`.
    uint8_t *memory;
    size_t size_bytes;
} Still;

// The pictures from which a result was measured; they pass from the thread to the caller. There are
// three of these structs: the thread fills one, the caller reads another, and the third one holds
// the newest pictures that the caller has not asked for yet. The structs are swapped under the
// lock, so that no pixels are copied under it.
typedef struct Pictures {
    DipErrorPictures out; // The pointers of this struct point into the arrays below.
    DipStill still;       // The still that was measured. Its pointers to pictures are not valid.
    unsigned number;      // Number of this still (asked_number); 0 if there are no pictures.
    uint8_t *truth_rgba8; // Owned.
    float *flip;          // Owned; the FLIP maps of both panes.
    size_t pixels;        // Number of pixels of a picture, for which the arrays have room.
} Pictures;

struct DipErrorThread {
    const DipSceneDef *scene;
    DipReflectionDef reflection;
    const char *cache;
    Still staged; // The next still, which the caller fills without holding the lock.
    unsigned picture_number;
    bool shown;    // A still was given since the last pause.
    Pictures held; // The pictures that the caller reads.
    DipStill last; // The last still, whose number is last_number. Its pointers to pictures are not
                   // valid.
    unsigned last_number;
    pthread_t thread;
    bool running;
    DipProcessorShare share;
    bool working; // When the caller last read the result, the thread was drawing a truth.
    atomic_bool stop;

    // The lock guards everything below. The caller and the thread hold it only to copy a few bytes,
    // since the thread may lose the processor for a long time while it holds the lock.
    pthread_mutex_t lock;
    pthread_cond_t changed;
    Still asked;
    unsigned asked_number; // Number of the last still; results of older stills are dropped.
    bool resting;
    int limit; // Most samples per pixel of a truth that may be drawn.
    DipErrorReading reading;
    bool news;
    Pictures newest;
    bool has_newest; // `newest` has pictures that the caller has not taken yet.
};

// --- the thread --------------------------------------------------------------------------------

typedef struct Worker {
    DipErrorThread *owner;
    DipReference *reference;
    char scene_hash[33];
    DipErrorJob *job;
    Still still;
    unsigned number;
    bool idle;
    Pictures pictures; // The pictures that the thread fills.
    DipFlipTailMeter tail;
    uint64_t version;
} Worker;

// Gives the calling thread a lower priority. On Linux, each thread has a priority; elsewhere only
// processes have one, so this function does nothing there.
static void lower_priority(void) {
#ifdef __linux__
    setpriority(PRIO_PROCESS, (id_t)syscall(SYS_gettid), NICE);
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

static void free_pictures(Pictures *pictures) {
    free(pictures->truth_rgba8);
    free(pictures->flip);
    *pictures = (Pictures){.pixels = 0};
}

static bool make_room(Pictures *pictures, size_t pixels) {
    if (pictures->pixels == pixels) {
        return true;
    }
    free_pictures(pictures);
    pictures->truth_rgba8 = malloc(4 * pixels);
    pictures->flip = malloc(DIP_PANE_COUNT * pixels * sizeof(float));
    if (!pictures->truth_rgba8 || !pictures->flip) {
        free_pictures(pictures);
        return false;
    }
    pictures->pixels = pixels;
    return true;
}

static void measure_spread(DipFlipTailMeter *meter, const float *flip, int width, int height,
                           DipErrorSpread *spread) {
    const size_t pixels = (size_t)width * (size_t)height;
    *spread = (DipErrorSpread){.bins = {0}};
    for (size_t i = 0; i < pixels; i++) {
        const int bin = (int)(flip[i] * DIP_ERROR_BINS);
        spread->bins[bin < DIP_ERROR_BINS ? bin : DIP_ERROR_BINS - 1]++;
    }
    dip_flip_tail_restart(meter);
    dip_flip_tail_add(meter, flip, width, height);
    spread->tail = dip_flip_tail_result(meter);
}

// Copies the pictures of the job's result. Does not hold the lock.
static bool fill_pictures(Worker *worker) {
    const DipStill *still = &worker->still.def;
    const size_t pixels = (size_t)still->width * (size_t)still->height;
    Pictures *to = &worker->pictures;
    if (!make_room(to, pixels) || (!worker->tail.histogram && !dip_flip_tail_init(&worker->tail))) {
        return false;
    }
    to->still = *still;
    to->number = worker->number;
    to->out = (DipErrorPictures){
        .version = ++worker->version,
        .width = still->width,
        .height = still->height,
        .result = *dip_error_job_result(worker->job),
        .truth_rgba8 = to->truth_rgba8,
    };
    memcpy(to->truth_rgba8, dip_error_job_truth(worker->job), 4 * pixels);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const float *from = dip_error_job_flip(worker->job, p);
        if (from) {
            float *copy = to->flip + (size_t)p * pixels;
            memcpy(copy, from, pixels * sizeof *copy);
            to->out.flip[p] = copy;
            measure_spread(&worker->tail, copy, still->width, still->height, &to->out.spread[p]);
        }
    }
    return true;
}

// Makes the thread's pictures the newest ones of the owner.
static void pass_pictures(Worker *worker) {
    DipErrorThread *owner = worker->owner;
    pthread_mutex_lock(&owner->lock);
    const Pictures swap = owner->newest;
    owner->newest = worker->pictures;
    owner->has_newest = true;
    pthread_mutex_unlock(&owner->lock);
    worker->pictures = swap;
}

// Returns whether the worker must wait, because measuring is paused, nothing is left to do for the
// still, or the next truth has more samples than the limit allows.
static bool must_wait(const Worker *worker) {
    const DipErrorThread *owner = worker->owner;
    const bool fresh = owner->asked_number != worker->number;
    int next_samples = 0;
    if (worker->job) {
        dip_error_job_drawn(worker->job, &next_samples);
    }
    return owner->resting || (!fresh && (worker->idle || next_samples > owner->limit));
}

// Tells the owner how much of the truth is drawn. The caller holds the lock.
static void tell_progress(const Worker *worker) {
    DipErrorReading *reading = &worker->owner->reading;
    const bool works = worker->job && !worker->idle && !must_wait(worker);
    reading->next_samples = 0;
    reading->drawn = works ? dip_error_job_drawn(worker->job, &reading->next_samples) : 0.0;
}

// Waits while there is nothing to do. Sets *fresh if there is a new still. Returns false if the
// thread must end.
static bool wait_for_still(Worker *worker, bool *fresh) {
    DipErrorThread *owner = worker->owner;
    pthread_mutex_lock(&owner->lock);
    tell_progress(worker);
    while (!atomic_load(&owner->stop) && must_wait(worker)) {
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
        if (owner->cache) {
            dip_cost_scene_hash(owner->scene, &owner->reflection, worker->scene_hash);
        }
        worker->job =
            dip_error_job_create(worker->reference, worker->scene_hash, owner->cache, err);
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
    const DipStep step = dip_error_job_step(worker->job, &err);
    if (step == DIP_STEP_RESULT && fill_pictures(worker)) {
        pass_pictures(worker);
        answer(worker, DIP_ERROR_STATUS_WORKING);
    } else if (step != DIP_STEP_WORKING) {
        answer(worker, step == DIP_STEP_DONE ? DIP_ERROR_STATUS_DONE : DIP_ERROR_STATUS_FAILED);
    }
}

static void *run(void *context) {
    Worker worker = {.owner = context, .idle = true};
    bool fresh = false;
    lower_priority();
    while (wait_for_still(&worker, &fresh)) {
        work(&worker, fresh);
    }
    dip_error_job_destroy(&worker.job);
    dip_reference_destroy(&worker.reference);
    free(worker.still.memory);
    free_pictures(&worker.pictures);
    dip_flip_tail_free(&worker.tail);
    return NULL;
}

// --- the caller --------------------------------------------------------------------------------

DipErrorThread *dip_error_thread_create(const DipSceneDef *scene,
                                        const DipReflectionDef *reflection, const char *cache,
                                        DipError *err) {
    DipErrorThread *owner = calloc(1, sizeof *owner);
    if (!owner) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
        return NULL;
    }
    owner->scene = scene;
    owner->reflection = *reflection;
    owner->cache = cache;
    owner->resting = true;
    owner->limit = INT_MAX;
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
        pthread_join(owner->thread, NULL);
    }
    pthread_cond_destroy(&owner->changed);
    pthread_mutex_destroy(&owner->lock);
    free(owner->staged.memory);
    free(owner->asked.memory);
    free_pictures(&owner->held);
    free_pictures(&owner->newest);
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
        owner->last = *still;
        owner->last_number = ++owner->asked_number;
    }
    owner->resting = !staged;
    owner->reading =
        (DipErrorReading){.status = staged ? DIP_ERROR_STATUS_WORKING : DIP_ERROR_STATUS_FAILED};
    owner->news = true;
    pthread_cond_signal(&owner->changed);
    pthread_mutex_unlock(&owner->lock);
}

void dip_error_thread_limit(DipErrorThread *owner, int samples) {
    pthread_mutex_lock(&owner->lock);
    if (owner->limit != samples) {
        owner->limit = samples;
        pthread_cond_signal(&owner->changed);
    }
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
    if (owner->running && owner->working) {
        dip_processor_share_end(&owner->share, owner->thread);
    }
    owner->working = reading->next_samples > 0;
    if (owner->running && owner->working) {
        dip_processor_share_begin(&owner->share, owner->thread);
    }
    reading->waits = owner->working && owner->share.low;
    return news;
}

const DipErrorPictures *dip_error_thread_pictures(DipErrorThread *owner) {
    pthread_mutex_lock(&owner->lock);
    if (owner->has_newest) {
        const Pictures swap = owner->held;
        owner->held = owner->newest;
        owner->newest = swap;
        owner->has_newest = false;
    }
    pthread_mutex_unlock(&owner->lock);
    Pictures *held = &owner->held;
    if (!owner->shown || !held->number || !dip_still_has_same_truth(&held->still, &owner->last)) {
        return NULL;
    }
    if (held->number != owner->last_number) {
        held->out.flip[DIP_PANE_CURRENT] = held->out.flip[DIP_PANE_REQUESTED] = NULL;
    }
    return &held->out;
}
