// Plans the rows of a report. A row is one combination of settings on a camera path. There is a row
// for every step of every setting but mip colours, on the camera path made for this setting, and a
// row for every combination of the combined settings (--combine). Steps and combinations that the
// renderer refuses have no rows.
//
// A run predicts if the user gives --predict or --quick, or gives budgets but neither --combine nor
// --part. Then only the steps of the combined settings have rows, all on path 0, and rows for other
// combinations are added later (steps.h).
#ifndef DIP_APP_COST_PLAN_H
#define DIP_APP_COST_PLAN_H

#include "app/cost/options.h"
#include "app/report/report.h"
#include "app/session/session.h"

// Fills in the rows and sweeps of a report and allocates its memory. (A sweep is all steps of one
// setting.) Steps that the renderer refuses are left out. report->refused lists them with the
// reason, except those of adaptive AA. Free the report even after a failure.
bool dip_cost_plan(DipCostReport *report, const DipSession *session, const DipCostOptions *options,
                   DipError *err);

// Fills in the report's scene and its hash, machine, program, threads and size.
void dip_cost_describe(DipCostReport *report, const DipSession *session);

// Writes a hash of a scene's content as 32 hexadecimal digits. The hash depends on everything that
// affects how the scene looks. The cache of truths (converged pictures) uses it to identify a
// scene.
void dip_cost_scene_hash(const DipSceneDef *def, const DipReflectionDef *reflection, char hex[33]);

// Writes the scene's name: the file name of the first model without its folder, or the name of the
// gallery's scene with its look.
void dip_cost_scene_name(const DipSession *session, char name[DIP_COST_TEXT]);

// These functions return the duration of a camera path of the report, and the pose at a time on
// that path.
int64_t dip_cost_path_duration_ns(const DipCostReport *report, const DipSession *session, int path);
DipPose dip_cost_pose(const DipCostReport *report, const DipSession *session, int path,
                      int64_t time_ns);

// Fills in the hash of the poses at all viewpoints of a path.
void dip_cost_hash_path(DipCostReport *report, const DipSession *session, int path);

// Returns the time of a frame at a viewpoint. The path is divided into equal parts, and each
// viewpoint is the middle of a part. At each viewpoint, a burst of successive frames is drawn.
// These frames are 1/30 s apart, and `frame` is the index in the burst. A negative index stands for
// a frame before the burst.
int64_t dip_cost_viewpoint_time_ns(const DipCostReport *report, const DipSession *session, int path,
                                   int viewpoint, int frame);

// Writes the plan hash, which covers everything that times depend on, for example rows, poses along
// the paths, size, scene, processor, threads and the program's build.
void dip_cost_plan_hash(const DipCostReport *report, const DipSession *session, char hex[33]);

#endif
