// Which rows a report has: every step of every setting on the path made for it, and combinations.
#ifndef DIP_APP_COST_PLAN_H
#define DIP_APP_COST_PLAN_H

#include "app/cost/report.h"
#include "app/options.h"
#include "app/session.h"

// Fills in what is measured and makes room for it. Steps that the renderer refuses are left out,
// with the reason in the report.
bool dip_cost_plan(DipCostReport *report, const DipSession *session, const DipOptions *options,
                   DipError *err);

// The first model's file, without folders.
void dip_cost_scene_name(const DipSession *session, const DipOptions *options,
                         char name[DIP_COST_TEXT]);

// The pose at a time on one of the report's paths.
int64_t dip_cost_path_duration_ns(const DipCostReport *report, const DipSession *session, int path);
DipPose dip_cost_pose(const DipCostReport *report, const DipSession *session, int path,
                      int64_t time_ns);

// When a burst's frame at a place is; 30 frames a second.
int64_t dip_cost_place_time_ns(const DipCostReport *report, const DipSession *session, int path,
                               int place, int frame);

// A name for all that decides what times and errors mean: rows, size, scene, machine.
void dip_cost_plan_hash(const DipCostReport *report, char hex[33]);

#endif
