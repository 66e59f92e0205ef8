// The pace of frames with temporal antialiasing.
#include "app/preview/live/taa_pace.h"

static const int64_t window_ns = 1000000000;

DipTaaSpeed dip_taa_pace_update(DipTaaPace *pace, bool on, const DipTiming *presented,
                                int64_t refresh_ns, int64_t now_ns) {
    DipTaaSpeed speed = {.too_slow = false};
    if (!on || refresh_ns <= 0) {
        pace->on = false;
        return speed;
    }
    if (!pace->on) {
        *pace = (DipTaaPace){.on = true, .since_ns = now_ns};
    }
    speed.shown = dip_timing_per_second(presented, now_ns);
    speed.wanted = (int)((window_ns + refresh_ns / 2) / refresh_ns);
    speed.too_slow =
        now_ns - pace->since_ns >= window_ns && speed.shown < dip_taa_pace_share * speed.wanted;
    return speed;
}

int64_t dip_taa_pace_next_ns(int64_t due_ns, int64_t turn_ns, int64_t refresh_ns, int64_t now_ns) {
    const int64_t next_ns = due_ns + refresh_ns;
    return next_ns > now_ns && next_ns <= now_ns + refresh_ns ? next_ns : turn_ns + refresh_ns;
}
