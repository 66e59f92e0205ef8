// What a command that draws works with: the ini, the scene, the camera track, both renderers.
#ifndef DIP_APP_SESSION_H
#define DIP_APP_SESSION_H

#include "app/options.h"
#include "app/start_times.h"
#include "assets/model.h"
#include "campaths/camtrack.h"
#include "config/config.h"
#include "renderer/scene/renderer.h"

enum { DIP_PANE_CURRENT, DIP_PANE_REQUESTED, DIP_PANE_COUNT };

extern const char *const dip_pane_names[DIP_PANE_COUNT]; // "current", "requested"

typedef struct DipSession {
    DipConfig config;
    bool has_config;
    DipPool *pool;
    DipIsa isa;
    DipScene *scene;
    DipReflectionDef reflection; // the ini's, at the level of the user's own model if there is one
    bool force_all_effects;
    DipModel *model;       // kept for commands that need the reference, else NULL
    DipSceneDef scene_def; // of it, with the ini's surroundings
    DipCamTrack track;     // one path per category of the ini
    DipCamPath **paths;    // loaded once each, by file
    int path_count;
    DipRenderer *renderers[DIP_PANE_COUNT]; // not for bench and cost, which make their own
    DipStartTimes times;
    bool orbiting; // a model of the user's own, without a path
} DipSession;

// Loads everything the options and the ini name. Every fault goes to *faults with file and line;
// warnings too. Returns false when one of them is an error; then the session is empty.
bool dip_session_open(DipSession *session, const DipOptions *options, DipErrorList *faults);
void dip_session_close(DipSession *session);

// Loads what the reference reads, `model` and `scene_def`, if it is not kept already: its pictures
// take tens of megabytes, and the load a good part of what the start took.
bool dip_session_keep_model(DipSession *session, const DipOptions *options, DipError *err);

// "DEFAULT", "AA", ...: the ini's category that a slot of the track plays.
const char *dip_session_category(int slot);

// What the panes show of one frame.
typedef struct DipSessionFrame {
    DipFrame panes[DIP_PANE_COUNT];
    double ms; // both took, on the clock; less than their sum where they share work
    // The requested pane is a copy of the current one, whose settings are the same: it took neither
    // time nor work, and shares its pixels. Never when all effects are forced.
    bool copied;
} DipSessionFrame;

// Draws both panes from a pose, at once. frame_index: see dip_renderer_set_frame_index. Both
// renderers must have one size.
bool dip_session_draw_pose(DipSession *session, const DipPose *pose, int64_t play_ns,
                           uint64_t frame_index, DipSessionFrame *frame, DipError *err);

// Likewise from the pose at a time on the active path.
bool dip_session_draw(DipSession *session, int64_t play_ns, uint64_t frame_index, DipPose *pose,
                      DipSessionFrame *frame, DipError *err);

#endif
