// Measures rows and keeps their greatest error.
#include "renderer/catalogue/stability.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool stability_measure(const StabilityRow *row, StabilityRun *run) {
    run->worst = 0.0;
    run->worst_at[0] = '\0';
    run->case_count = 0;
    run->failed_count = 0;
    run->hash = dip_hash_begin(0);
    run->broken = false;
    run->broken_why[0] = '\0';
    row->measure(run);
    if (!run->broken && run->case_count == 0) {
        stability_break(run, "the row compared no case");
    }
    return !run->broken && run->worst <= row->bound;
}

static void keep_worst(StabilityRun *run, double error, const char *format, va_list arguments) {
    run->case_count++;
    run->failed_count += error != 0.0;
    char name[sizeof run->worst_at];
    vsnprintf(name, sizeof name, format, arguments);
    dip_hash_text(&run->hash, name);
    const double size = isnan(error) ? INFINITY : fabs(error);
    if (size > run->worst) {
        run->worst = size;
        memcpy(run->worst_at, name, sizeof name);
    }
}

void stability_error(StabilityRun *run, double error, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    keep_worst(run, error, format, arguments);
    va_end(arguments);
}

void stability_expect(StabilityRun *run, bool holds, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    keep_worst(run, holds ? 0.0 : 1.0, format, arguments);
    va_end(arguments);
}

void stability_break(StabilityRun *run, const char *format, ...) {
    if (run->broken) {
        return;
    }
    run->broken = true;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(run->broken_why, sizeof run->broken_why, format, arguments);
    va_end(arguments);
}

void stability_keep(StabilityRun *run, const double *results, size_t count) {
    for (size_t i = 0; i < count; i++) {
        dip_hash_number(&run->hash, results[i]);
    }
}

int stability_count(const StabilityRun *run, int count_short, int count_full, int count_long) {
    return run->depth == STABILITY_SHORT  ? count_short
           : run->depth == STABILITY_FULL ? count_full
                                          : count_long;
}
