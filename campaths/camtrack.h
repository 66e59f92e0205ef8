// Which camera path plays: one path and field of view per slot (a setting category), and the time
// on the path across switches.
#ifndef DIP_CAMPATHS_CAMTRACK_H
#define DIP_CAMPATHS_CAMTRACK_H

#include "campaths/campath.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stdint.h>

enum { DIP_CAMTRACK_SLOTS = 16 };

typedef struct DipCamSlot {
    const DipCamPath *path; // borrowed; NULL: the slot plays slot 0's path
    double fov_y_deg;
} DipCamSlot;

// Plain data: may be copied and kept anywhere. Both panes read one track, hence one pose. The
// fields are read freely and changed through the functions.
typedef struct DipCamTrack {
    DipCamSlot slots[DIP_CAMTRACK_SLOTS];
    int active;
    bool reset_on_switch; // CAMPATH_RESET_ON_SWITCH
    int64_t start_ns;     // play time at which the active path is at its beginning
} DipCamTrack;

// All slots empty, slot 0 active, the path's time equal to the play time.
DipCamTrack dip_camtrack_make(bool reset_on_switch);

// Slots of one path share the pointer: to go from one to the other is then no switch of path.
void dip_camtrack_set(DipCamTrack *track, int slot, const DipCamPath *path, double fov_y_deg);

// Makes a slot active at a play time. When that changes the path and reset_on_switch is set, the
// new path begins at its beginning; else it goes on at the time the old one had reached, so that
// going there and back leaves no trace. An empty slot counts as slot 0.
void dip_camtrack_switch(DipCamTrack *track, int slot, int64_t play_ns);

// Back to the beginning of the active path.
void dip_camtrack_restart(DipCamTrack *track, int64_t play_ns);

// Time on the active path at a play time: not reduced to its duration, any sign.
int64_t dip_camtrack_time(const DipCamTrack *track, int64_t play_ns);

// The whole pose with its field of view. False (and nothing filled in) when no path is there.
bool dip_camtrack_pose(const DipCamTrack *track, int64_t play_ns, DipPose *pose);

#endif
