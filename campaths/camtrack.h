// Decides which camera path plays. Each category of settings has a path and a field of view; the
// track knows the active category and keeps the time on the path when the category changes. Play
// time is the caller's clock, in nanoseconds; a change of path does not affect this clock.
//
// Threads: a track is plain data without locks. Functions that change it need exclusive access; any
// number of threads may read it otherwise.
#ifndef DIP_CAMPATHS_CAMTRACK_H
#define DIP_CAMPATHS_CAMTRACK_H

#include "renderer/base/api.h"
#include "campaths/campath.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIP_CAMTRACK_CATEGORIES = 64 };

typedef struct DipCamCategory {
    const DipCamPath *path; // borrowed; NULL: the path of category 0 plays, with its field of view
    double fov_y_deg;       // vertical field of view, 1..170
    const char *name;       // borrowed; name of the path, or NULL if it has none
} DipCamCategory;

// Plain data that may be copied. The paths must live as long as the track. Both panes read one
// track, so they have one pose. Read the fields freely, but change them only with the functions
// below.
typedef struct DipCamTrack {
    DipCamCategory categories[DIP_CAMTRACK_CATEGORIES];
    int active;           // index of the active category
    bool reset_on_switch; // CAMPATH_RESET_ON_SWITCH of the ini
    int64_t start_ns;     // play time at which the active path is at its beginning
    DipCamPathEnd end;    // what every path does at its end
} DipCamTrack;

// Returns a track without paths. Category 0 is active, the time on the path is the play time, and
// paths are loops.
DIP_API DipCamTrack dip_camtrack_make(bool reset_on_switch);

// Sets the path and field of view of a category, 0..DIP_CAMTRACK_CATEGORIES - 1. Categories that
// play the same path must share the pointer, so that a change between them counts as no change of
// path.
DIP_API void dip_camtrack_set(DipCamTrack *track, int category, const DipCamPath *path,
                              double fov_y_deg);

// Does the same for a path that has a name of its own, such as a camera of a model. The name must
// live as long as the track.
DIP_API void dip_camtrack_set_named(DipCamTrack *track, int category, const DipCamPath *path,
                                    double fov_y_deg, const char *name);

// Sets what paths do at their end.
DIP_API void dip_camtrack_set_end(DipCamTrack *track, DipCamPathEnd end);

// Makes a category, 0..DIP_CAMTRACK_CATEGORIES - 1, active at a play time. If this changes the path
// and reset_on_switch is set, the new path starts at its beginning. Otherwise it continues at the
// time that the old path had reached, so that a change to another path and back does not affect the
// time.
DIP_API void dip_camtrack_switch(DipCamTrack *track, int category, int64_t play_ns);

// Returns the category whose path plays: the active one or, if that has no path, category 0. If
// this has no path either, none plays.
DIP_API const DipCamCategory *dip_camtrack_playing(const DipCamTrack *track);

// Returns the active path to its beginning.
DIP_API void dip_camtrack_restart(DipCamTrack *track, int64_t play_ns);

// Returns the time on the active path at a play time. It may be negative or beyond the path's
// duration.
DIP_API int64_t dip_camtrack_time(const DipCamTrack *track, int64_t play_ns);

// Returns the same time as a time from 0 to the path's end (dip_campath_time_at_end), which is what
// to show to a user. Without a path, returns 0.
DIP_API int64_t dip_camtrack_path_time(const DipCamTrack *track, int64_t play_ns);

// Fills the whole pose, its field of view included. Returns false and leaves the pose unchanged if
// neither the active category nor category 0 has a path.
DIP_API bool dip_camtrack_pose(const DipCamTrack *track, int64_t play_ns, DipPose *pose);

#ifdef __cplusplus
}
#endif

#endif
