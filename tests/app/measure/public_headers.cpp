// Every public header of app/measure/ in one C++ file; it only has to compile.
#include "app/measure/difference.h"
#include "app/measure/flicker.h"
#include "app/measure/flip.h"
#include "app/measure/magma.h"
#include "app/measure/meter.h"
#include "app/measure/metrics.h"
#include "app/measure/picture.h"
#include "app/measure/ssim.h"
#include "app/measure/statistics.h"
#include "app/measure/timing.h"
#include "app/measure/truth.h"

// Functions are found under their C names.
double measured(const double *ms) {
    return dip_stats_time(ms, 1, 1);
}
