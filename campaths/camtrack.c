// Which camera path plays.
#include "campaths/camtrack.h"

#include "renderer/base/assert.h"

DipCamTrack dip_camtrack_make(bool reset_on_switch) {
    return (DipCamTrack){.reset_on_switch = reset_on_switch};
}

void dip_camtrack_set(DipCamTrack *track, int slot, const DipCamPath *path, double fov_y_deg) {
    DIP_ASSERT(slot >= 0 && slot < DIP_CAMTRACK_SLOTS);
    track->slots[slot] = (DipCamSlot){path, fov_y_deg};
}

static const DipCamSlot *playing(const DipCamTrack *track, int slot) {
    return &track->slots[track->slots[slot].path ? slot : 0];
}

void dip_camtrack_switch(DipCamTrack *track, int slot, int64_t play_ns) {
    DIP_ASSERT(slot >= 0 && slot < DIP_CAMTRACK_SLOTS);
    const DipCamPath *before = playing(track, track->active)->path;
    track->active = slot;
    if (track->reset_on_switch && playing(track, slot)->path != before) {
        dip_camtrack_restart(track, play_ns);
    }
}

void dip_camtrack_restart(DipCamTrack *track, int64_t play_ns) {
    track->start_ns = play_ns;
}

int64_t dip_camtrack_time(const DipCamTrack *track, int64_t play_ns) {
    return (int64_t)((uint64_t)play_ns - (uint64_t)track->start_ns); // wraps, never overflows
}

bool dip_camtrack_pose(const DipCamTrack *track, int64_t play_ns, DipPose *pose) {
    const DipCamSlot *slot = playing(track, track->active);
    if (!slot->path) {
        return false;
    }
    dip_campath_sample(slot->path, dip_camtrack_time(track, play_ns), pose);
    pose->fov_y_deg = slot->fov_y_deg;
    return true;
}
