// The rows of a report: every step of every setting, on the camera path made for that setting, and
// the combinations.
#ifndef DIP_APP_COST_PLAN_H
#define DIP_APP_COST_PLAN_H

#include "app/cost/options.h"
#include "app/cost/report.h"
#include "app/session.h"

// Fills in the rows and sweeps of an empty report and allocates its memory. Steps that the renderer
// refuses are left out and listed with the reason. Free the report even after a failure.
bool dip_cost_plan(DipCostReport *report, const DipSession *session, const DipCostOptions *options,
                   DipError *err);

// Writes the file name of the first model, without its folder.
void dip_cost_scene_name(const DipSession *session, char name[DIP_COST_TEXT]);

// The duration of a camera path of the report, and the pose at a time on that path.
int64_t dip_cost_path_duration_ns(const DipCostReport *report, const DipSession *session, int path);
DipPose dip_cost_pose(const DipCostReport *report, const DipSession *session, int path,
                      int64_t time_ns);

// Returns the time of a frame of the burst at a viewpoint. The path is divided into equal parts,
// and each viewpoint is the middle of a part. The frames of a burst are 1/30 s apart.
int64_t dip_cost_viewpoint_time_ns(const DipCostReport *report, const DipSession *session, int path,
                                   int viewpoint, int frame);

// Writes the hash of everything that times depend on: rows, size, scene, machine, version.
void dip_cost_plan_hash(const DipCostReport *report, char hex[33]);

#endif
