// Notices that a thread waits for a processor, because other threads keep all of them busy.
#ifndef DIP_APP_PREVIEW_LIVE_PROCESSOR_SHARE_H
#define DIP_APP_PREVIEW_LIVE_PROCESSOR_SHARE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

// Zero-initialise.
typedef struct DipProcessorShare {
    int64_t from_ns; // Time when the thread's work began, and its processor time then.
    int64_t from_used_ns;
    int64_t worked_ns; // Sums of both over the last pieces of work.
    int64_t used_ns;
    bool low; // In the last half second of work, the thread had a processor for less than half.
} DipProcessorShare;

// Notes that the thread begins to work.
void dip_processor_share_begin(DipProcessorShare *share, pthread_t thread);

// Notes that the thread has worked since the call of dip_processor_share_begin, or wanted to.
void dip_processor_share_end(DipProcessorShare *share, pthread_t thread);

#endif
