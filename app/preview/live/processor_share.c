// Compares a thread's processor time with the time that passes while the thread works.
#include "app/preview/live/processor_share.h"

#include "renderer/base/clock.h"

#include <time.h>

static const int64_t period_ns = 500000000;

static int64_t used_ns(pthread_t thread) {
    clockid_t clock;
    struct timespec used = {0};
    if (pthread_getcpuclockid(thread, &clock) == 0) {
        clock_gettime(clock, &used);
    }
    return (int64_t)used.tv_sec * 1000000000 + used.tv_nsec;
}

void dip_processor_share_begin(DipProcessorShare *share, pthread_t thread) {
    share->from_ns = dip_clock_ns();
    share->from_used_ns = used_ns(thread);
}

void dip_processor_share_end(DipProcessorShare *share, pthread_t thread) {
    share->worked_ns += dip_clock_ns() - share->from_ns;
    share->used_ns += used_ns(thread) - share->from_used_ns;
    if (share->worked_ns >= period_ns) {
        share->low = 2 * share->used_ns < share->worked_ns;
        share->worked_ns = share->used_ns = 0;
    }
}
