// Measures how long the parts of the start take, and formats these times (session.h).
#include "app/session/session.h"

#include "renderer/base/clock.h"

#include <stdio.h>
#include <string.h>

double dip_start_times_since_ms(int64_t begin_ns) {
    return 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

void dip_start_times_frame(DipStartTimes *times) {
    if (times->total_ms == 0.0) {
        times->first_frame_ms = dip_start_times_since_ms(times->opened_ns);
        times->total_ms = dip_start_times_since_ms(times->begin_ns);
    }
}

void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes) {
    snprintf(text, size_bytes, "start, ms:");
#define ADD_PART(name, what)                                                                       \
    snprintf(text + strlen(text), size_bytes - strlen(text), " %s %.1f", #name, times->name##_ms);
    DIP_START_TIME_LIST(ADD_PART)
#undef ADD_PART
}
