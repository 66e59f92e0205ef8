// Measures the errors of both panes' pictures on a thread of its own while the camera rests.
//
// The thread runs when nothing else wants the processor. Its work is a DipErrorJob, which it drops
// between two steps of a few milliseconds when the pictures change.
#ifndef DIP_APP_PREVIEW_ERROR_THREAD_H
#define DIP_APP_PREVIEW_ERROR_THREAD_H

#include "app/preview/error_job.h"

typedef struct DipErrorThread DipErrorThread;

// The scene is borrowed. The thread starts, and takes memory, with the first measurement.
DipErrorThread *dip_error_thread_create(const DipSceneDef *scene,
                                        const DipReflectionDef *reflection, DipError *err);

// Ends the thread; waits for no more than the step that it is in.
void dip_error_thread_destroy(DipErrorThread **thread);

// Measures a still from now on and forgets the one before. The still's pictures are copied. A call
// with the picture number of the call before does nothing: the caller changes the number whenever
// the pictures change.
void dip_error_thread_measure(DipErrorThread *thread, const DipStill *still,
                              unsigned picture_number);

// Stops measuring and forgets all results: the camera moves.
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
} DipErrorReading;

// Reads the result for the last still. Returns whether it differs from the reading before.
bool dip_error_thread_read(DipErrorThread *thread, DipErrorReading *reading);

#endif
