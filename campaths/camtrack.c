// Decides which camera path plays.
#include "campaths/camtrack.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/assert.h"

DipCamTrack dip_camtrack_make(bool reset_on_switch) {
    return (DipCamTrack){.reset_on_switch = reset_on_switch};
}

void dip_camtrack_set(DipCamTrack *track, int category, const DipCamPath *path, double fov_y_deg) {
    dip_camtrack_set_named(track, category, path, fov_y_deg, NULL);
}

void dip_camtrack_set_named(DipCamTrack *track, int category, const DipCamPath *path,
                            double fov_y_deg, const char *name) {
    DIP_ASSERT(category >= 0 && category < DIP_CAMTRACK_CATEGORIES);
    track->categories[category] = (DipCamCategory){path, fov_y_deg, name};
}

void dip_camtrack_set_end(DipCamTrack *track, DipCamPathEnd end) {
    DIP_ASSERT(end >= 0 && end < DIP_CAMPATH_END_COUNT);
    track->end = end;
}

const DipCamCategory *dip_camtrack_playing(const DipCamTrack *track) {
    return &track->categories[track->categories[track->active].path ? track->active : 0];
}

void dip_camtrack_switch(DipCamTrack *track, int category, int64_t play_ns) {
    DIP_ASSERT(category >= 0 && category < DIP_CAMTRACK_CATEGORIES);
    const DipCamPath *before = dip_camtrack_playing(track)->path;
    track->active = category;
    if (track->reset_on_switch && dip_camtrack_playing(track)->path != before) {
        dip_camtrack_restart(track, play_ns);
    }
}

void dip_camtrack_restart(DipCamTrack *track, int64_t play_ns) {
    track->start_ns = play_ns;
}

int64_t dip_camtrack_time(const DipCamTrack *track, int64_t play_ns) {
    return (
        int64_t)((uint64_t)play_ns -
                 (uint64_t)track->start_ns); // Unsigned, so that it wraps instead of overflowing.
}

int64_t dip_camtrack_path_time(const DipCamTrack *track, int64_t play_ns) {
    const DipCamPath *path = dip_camtrack_playing(track)->path;
    return path ? dip_campath_time_at_end(path, track->end, dip_camtrack_time(track, play_ns)) : 0;
}

bool dip_camtrack_pose(const DipCamTrack *track, int64_t play_ns, DipPose *pose) {
    DIP_FP_MODE_SCOPE();
    const DipCamCategory *category = dip_camtrack_playing(track);
    if (!category->path) {
        return false;
    }
    dip_campath_sample(category->path, dip_camtrack_path_time(track, play_ns), pose);
    pose->fov_y_deg = category->fov_y_deg;
    return true;
}
