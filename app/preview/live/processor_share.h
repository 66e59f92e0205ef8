// Notices that a thread waits for a processor, because other threads keep all processors busy.
#ifndef DIP_APP_PREVIEW_LIVE_PROCESSOR_SHARE_H
#define DIP_APP_PREVIEW_LIVE_PROCESSOR_SHARE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

// Zero-initialise.
typedef struct DipProcessorShare {
    int64_t from_ns;      // Time when the thread's present piece of work began.
    int64_t from_used_ns; // The thread's processor time at that moment.
    int64_t worked_ns;    // Time that pieces of work took since `low` was set last.
    int64_t used_ns;      // Processor time of these pieces of work.
    bool low; // In the last half second of work, the thread had a processor for less than half the
              // time.
} DipProcessorShare;

// Notes that the thread begins to work.
void dip_processor_share_begin(DipProcessorShare *share, pthread_t thread);

// Notes that the thread has worked, or waited for a processor, since dip_processor_share_begin.
void dip_processor_share_end(DipProcessorShare *share, pthread_t thread);

#endif
