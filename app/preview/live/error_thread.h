// Measures the errors of both panes' pictures on a thread of its own while the camera rests.
//
// The thread has a slightly lower priority than the threads that draw frames. It gets a share of
// the processors even if other programs keep all of them busy. It runs a DipErrorJob in steps of a
// few milliseconds. When the thread gets new pictures, it first ends the current step. If the new
// pictures have the same truth (converged picture), the thread keeps what it has drawn of the
// truth.
#ifndef DIP_APP_PREVIEW_LIVE_ERROR_THREAD_H
#define DIP_APP_PREVIEW_LIVE_ERROR_THREAD_H

#include "app/measure/metrics/flip_tail.h"
#include "app/preview/live/error_job.h"

typedef struct DipErrorThread DipErrorThread;

// Borrows the scene and `cache`, the folder of cached truths (converged pictures). If `cache` is
// NULL, there is no cache. The thread starts with the first measurement, and only then allocates
// its memory.
DipErrorThread *dip_error_thread_create(const DipSceneDef *scene,
                                        const DipReflectionDef *reflection, const char *cache,
                                        DipError *err);

// Ends the thread. Waits until the thread has finished its current step.
void dip_error_thread_destroy(DipErrorThread **thread);

// Begins to measure a still (both panes' pictures of one pose and time) and forgets the previous
// still. The still's pictures are copied. The caller must change the picture number whenever the
// pictures change: a call with the same number as the previous call does nothing, unless
// dip_error_thread_pause was called between them.
void dip_error_thread_measure(DipErrorThread *thread, const DipStill *still,
                              unsigned picture_number);

// Lets the thread draw truths of at most this many samples per pixel. The limit does not delay the
// measuring of errors against a truth that is drawn already. At first there is no limit.
void dip_error_thread_limit(DipErrorThread *thread, int samples);

// Stops measuring and forgets the errors. What is drawn of a truth is used again if the next still
// has the same truth. Call it while the camera moves.
void dip_error_thread_pause(DipErrorThread *thread);

typedef enum DipErrorStatus {
    DIP_ERROR_STATUS_PAUSED,
    DIP_ERROR_STATUS_WORKING, // The result is still being refined.
    DIP_ERROR_STATUS_DONE,    // The result is final.
    DIP_ERROR_STATUS_FAILED   // Memory ran out, or no thread could start.
} DipErrorStatus;

typedef struct DipErrorReading {
    DipErrorStatus status;
    DipErrorJobResult result;
    int next_samples; // Samples per pixel of the truth that is being drawn; 0 if there is none.
    double drawn;     // How much of the truth that is being drawn is done, from 0 to 1.
    bool waits;       // The thread waits for a processor most of the time.
} DipErrorReading;

// Reads the status and the result for the last still. Returns whether the status or the result has
// changed since the previous call. The members after `result` may change at any call, whatever the
// function returns.
bool dip_error_thread_read(DipErrorThread *thread, DipErrorReading *reading);

// Number of bins, from FLIP 0 to FLIP 1, in which pixels are counted.
enum { DIP_ERROR_BINS = 100 };

// How FLIP is distributed over the pixels of a pane.
typedef struct DipErrorSpread {
    DipFlipTail tail;
    uint32_t bins[DIP_ERROR_BINS]; // Number of pixels in each bin.
} DipErrorSpread;

// The pictures from which a result was measured: the truth, and the FLIP map of each pane. Rows are
// packed.
typedef struct DipErrorPictures {
    uint64_t version; // Grows with each result. While it stays the same, only `flip` may change, to
                      // NULL.
    int width;
    int height;
    DipErrorJobResult result;
    const uint8_t *truth_rgba8; // sRGB, four bytes per pixel.
    // FLIP of each pixel. NULL if the pane is not judged, or if only the truth still holds because
    // the panes' pictures have changed.
    const float *flip[DIP_PANE_COUNT];
    DipErrorSpread spread[DIP_PANE_COUNT];
} DipErrorPictures;

// Returns the newest pictures that were made with the truth of the last still. Returns NULL if
// there are none (yet) or measuring is paused. They are valid until the next call of a function
// that this file declares, except dip_error_thread_read. Only the thread that calls
// dip_error_thread_measure may call this function.
const DipErrorPictures *dip_error_thread_pictures(DipErrorThread *thread);

#endif
