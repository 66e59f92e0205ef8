// What `diptych cost` and `diptych cost merge` share.
#ifndef DIP_APP_COST_COST_H
#define DIP_APP_COST_COST_H

#include "app/cost/options.h"
#include "app/report/page/report_pictures.h"
#include "app/session/session.h"

#include <limits.h>

// Finds the folder of the cached truths (converged pictures): `given` (--cache) if it is not NULL,
// otherwise the user's cache folder. Makes the folder. Writes "" if there is no cache.
bool dip_cost_find_cache(const char *given, char folder[PATH_MAX], DipError *err);

// Writes cost.html, cost.csv and cost.json into a folder that exists. The source draws the pictures
// of the page; it is not used with --pictures none.
bool dip_cost_write_report(const DipCostReport *report, const DipCostFrameSource *source,
                           const char *folder, DipError *err);

#endif
