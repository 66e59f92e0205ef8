// The cost report's options.
#include "app/options_private.h"

#include "app/measure/flip.h"
#include "renderer/base/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool read_count(const char *key, const char *text, int least, int most, int *value,
                       DipError *err) {
    return (dip_integer_parse(text, strlen(text), value) && *value >= least && *value <= most) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "'%s', accepted %d..%d", text, least,
                         most);
}

bool dip_cost_set_baseline(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    return dip_quality_parse(value, &options->cost.baseline, err);
}

bool dip_cost_set_places(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 1, DIP_COST_MAX_PLACES, &options->cost.places, err);
}

bool dip_cost_set_burst(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 1, DIP_COST_MAX_BURST, &options->cost.burst, err);
}

bool dip_cost_set_part(DipOptions *options, const char *key, const char *value, DipError *err) {
    int range[2];
    if (dip_option_integers(value, ':', 2, range) != 2 || range[0] < 0 || range[1] <= range[0]) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, key, value,
                                 "A:B with 0 <= A < B <= the number of --places");
    }
    options->cost.first_place = range[0];
    options->cost.end_place = range[1];
    return true;
}

bool dip_cost_set_samples(DipOptions *options, const char *key, const char *value, DipError *err) {
    int count;
    if (!dip_integer_parse(value, strlen(value), &count) || count < 1 || count > 4096 ||
        lround(sqrt(count)) * lround(sqrt(count)) != count) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, key, value,
                                 "squares of 1..64: 64, 100, ...");
    }
    options->cost.samples = count;
    return true;
}

bool dip_cost_set_pixels_per_degree(DipOptions *options, const char *key, const char *value,
                                    DipError *err) {
    double *ppd = &options->cost.pixels_per_degree;
    return (dip_number_parse(value, strlen(value), ppd) && *ppd >= DIP_FLIP_MIN_PIXELS_PER_DEGREE &&
            *ppd <= DIP_FLIP_MAX_PIXELS_PER_DEGREE) ||
           dip_option_refuse(err, DIP_ERROR_RANGE, key, value, "5..500");
}

bool dip_cost_set_rounds(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 2, 10000, &options->cost.rounds, err);
}

bool dip_cost_set_timed(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 1, 100, &options->cost.timed_frames, err);
}

bool dip_cost_set_errors_only(DipOptions *options, const char *key, const char *value,
                              DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->cost.errors_only = true;
    return true;
}

bool dip_cost_set_seed(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->cost.has_seed = true;
    return read_count(key, value, 0, 0x7fffffff, &options->cost.seed, err);
}

bool dip_cost_set_cache(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->cost.cache = value;
    return true;
}

// Calls for each element between commas; none may be empty.
static bool for_each(const char *key, const char *value, DipOptions *options,
                     bool (*take)(DipOptions *, const char *key, const char *item, DipError *),
                     DipError *err) {
    for (const char *from = value; from;) {
        const char *end = strchr(from, ',');
        const size_t length = end ? (size_t)(end - from) : strlen(from);
        char item[64];
        if (length == 0 || length >= sizeof item) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, key,
                                 "'%.200s' has an empty or too long place, accepted values "
                                 "between ','",
                                 value);
        }
        memcpy(item, from, length);
        item[length] = '\0';
        if (!take(options, key, item, err)) {
            return false;
        }
        from = end ? end + 1 : NULL;
    }
    return true;
}

static bool add_combined(DipOptions *options, const char *key, const char *item, DipError *err) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (strcmp(dip_setting_info((DipSetting)s)->key, item) == 0) {
            options->cost.combined |= 1u << s;
            return true;
        }
    }
    return dip_option_refuse(err, DIP_ERROR_UNKNOWN, key, item,
                             "none, or settings: aa,aaa,asd,af,aaf,opt,miplod,...");
}

bool dip_cost_set_combine(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->cost.has_combined = true;
    options->cost.combined = 0;
    return strcmp(value, "none") == 0 || for_each(key, value, options, add_combined, err);
}

static bool add_budget(DipOptions *options, const char *key, const char *item, DipError *err) {
    DipCostOptions *cost = &options->cost;
    double ms;
    if (!dip_number_parse(item, strlen(item), &ms) || ms < 0.01 || ms > 100000.0) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, key, item, "milliseconds, 0.01..100000");
    }
    if (cost->budget_count == DIP_COST_MAX_BUDGETS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "more than %d, accepted %d",
                             DIP_COST_MAX_BUDGETS, DIP_COST_MAX_BUDGETS);
    }
    cost->budgets_ms[cost->budget_count++] = ms;
    return true;
}

bool dip_cost_set_budget(DipOptions *options, const char *key, const char *value, DipError *err) {
    return for_each(key, value, options, add_budget, err);
}

void dip_cost_options_default(DipCostOptions *cost) {
    *cost = (DipCostOptions){
        .baseline = dip_quality_default(),
        .places = 3,
        .burst = 2,
        .samples = 64,
        .pixels_per_degree = DIP_FLIP_PIXELS_PER_DEGREE,
        .rounds = 16,
        .timed_frames = 4,
    };
}

bool dip_cost_options_check(const DipOptions *options, DipError *err) {
    const DipCostOptions *cost = &options->cost;
    if (!options->out) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--out",
                             "no folder for the report, accepted --out DIR");
    }
    if (options->command == DIP_COMMAND_COST_MERGE) {
        return cost->part_count > 0 ||
               dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost merge",
                             "no parts, accepted cost merge --out DIR PART/cost.json...");
    }
    if (cost->end_place > cost->places) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--part",
                             "ends at %d of %d places, accepted up to --places", cost->end_place,
                             cost->places);
    }
    if (cost->errors_only && cost->budget_count) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--budget-ms",
                             "advice needs times, accepted without --errors-only");
    }
    return true;
}
