// What the option tables of the commands share. Private to app/.
#ifndef DIP_APP_OPTIONS_PRIVATE_H
#define DIP_APP_OPTIONS_PRIVATE_H

#include "app/options.h"

// Takes over an option's value (NULL for options without one) or says what is accepted.
typedef bool DipOptionSetter(DipOptions *options, const char *key, const char *value,
                             DipError *err);

// "'value', accepted ..."; returns false.
bool dip_option_refuse(DipError *err, DipErrorCode code, const char *key, const char *value,
                       const char *accepted);

// Reads numbers separated by one character; as many as there are, up to count. Returns how many,
// or 0 when something is not a number.
int dip_option_integers(const char *text, char separator, int count, int *values);

// One value each; the bench's lists consist of these.
bool dip_option_size(const char *key, const char *value, int *width, int *height, DipError *err);
bool dip_option_isa(const char *key, const char *value, DipIsa *isa, DipError *err);

// bench/options.c
void dip_bench_options_default(DipBenchOptions *bench);
bool dip_bench_options_check(const DipBenchOptions *bench, DipError *err);
DipOptionSetter dip_bench_set_sets;
DipOptionSetter dip_bench_set_threads;
DipOptionSetter dip_bench_set_isa;
DipOptionSetter dip_bench_set_size;
DipOptionSetter dip_bench_set_grid;
DipOptionSetter dip_bench_set_grid_out_of_view;
DipOptionSetter dip_bench_set_frames;
DipOptionSetter dip_bench_set_rounds;
DipOptionSetter dip_bench_set_seed;
DipOptionSetter dip_bench_set_csv;
DipOptionSetter dip_bench_set_svg;
DipOptionSetter dip_bench_set_vs;
DipOptionSetter dip_bench_set_serve;

// cost/options.c
void dip_cost_options_default(DipCostOptions *cost);
bool dip_cost_options_check(const DipOptions *options, DipError *err);
DipOptionSetter dip_cost_set_baseline;
DipOptionSetter dip_cost_set_places;
DipOptionSetter dip_cost_set_burst;
DipOptionSetter dip_cost_set_part;
DipOptionSetter dip_cost_set_samples;
DipOptionSetter dip_cost_set_pixels_per_degree;
DipOptionSetter dip_cost_set_rounds;
DipOptionSetter dip_cost_set_timed;
DipOptionSetter dip_cost_set_errors_only;
DipOptionSetter dip_cost_set_seed;
DipOptionSetter dip_cost_set_combine;
DipOptionSetter dip_cost_set_budget;
DipOptionSetter dip_cost_set_cache;

#endif
