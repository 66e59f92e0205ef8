// The bench's options: lists of settings, threads, instruction sets, sizes and triangle counts.
#include "app/options_private.h"

#include "app/bench/synthetic.h"
#include "renderer/base/number.h"
#include "renderer/base/pool.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char default_sets[] = "aa=none;aa=4;aa=8;af=16;aa=4,af=16;aa=8,af=16";

// Reads one element of a list into place `index` of an axis.
typedef bool ReadItem(DipBenchOptions *bench, int index, const char *key, const char *item,
                      DipError *err);

static bool read_list(DipBenchOptions *bench, int *count, char separator, ReadItem *read,
                      const char *key, const char *value, DipError *err) {
    *count = 0;
    for (const char *from = value; from;) {
        const char *end = strchr(from, separator);
        const size_t length = end ? (size_t)(end - from) : strlen(from);
        char item[80];
        if (length == 0) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, key,
                                 "'%.200s' has an empty place, accepted values between '%c'", value,
                                 separator);
        }
        if (*count == DIP_BENCH_MAX_VALUES || length >= sizeof item) {
            return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, key,
                                 "'%.200s' is too long, accepted %d values of up to %zu letters",
                                 value, DIP_BENCH_MAX_VALUES, sizeof item - 1);
        }
        memcpy(item, from, length);
        item[length] = '\0';
        if (!read(bench, (*count)++, key, item, err)) {
            return false;
        }
        from = end ? end + 1 : NULL;
    }
    return true;
}

static bool read_count(const char *key, const char *text, int least, int most, int *value,
                       DipError *err) {
    return (dip_integer_parse(text, strlen(text), value) && *value >= least && *value <= most) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "'%s', accepted %d..%d", text, least,
                         most);
}

static bool read_set(DipBenchOptions *bench, int index, const char *key, const char *item,
                     DipError *err) {
    (void)key;
    DipBenchSet *set = &bench->sets[index];
    snprintf(set->text, sizeof set->text, "%s", item);
    return dip_quality_parse(item, &set->quality, err);
}

static bool read_threads(DipBenchOptions *bench, int index, const char *key, const char *item,
                         DipError *err) {
    return read_count(key, item, 0, DIP_MAX_THREADS, &bench->threads[index], err);
}

static bool read_isa(DipBenchOptions *bench, int index, const char *key, const char *item,
                     DipError *err) {
    return dip_option_isa(key, item, &bench->isas[index], err);
}

static bool read_size(DipBenchOptions *bench, int index, const char *key, const char *item,
                      DipError *err) {
    return dip_option_size(key, item, &bench->sizes[index].width, &bench->sizes[index].height, err);
}

static bool read_grid(DipBenchOptions *bench, int index, const char *key, const char *item,
                      DipError *err) {
    return read_count(key, item, 2, DIP_SYNTHETIC_MAX_TRIANGLES, &bench->grids[index], err);
}

bool dip_bench_set_sets(DipOptions *options, const char *key, const char *value, DipError *err) {
    DipBenchOptions *bench = &options->bench;
    return read_list(bench, &bench->set_count, ';', read_set, key, value, err);
}

bool dip_bench_set_threads(DipOptions *options, const char *key, const char *value, DipError *err) {
    DipBenchOptions *bench = &options->bench;
    return read_list(bench, &bench->threads_count, ',', read_threads, key, value, err);
}

bool dip_bench_set_isa(DipOptions *options, const char *key, const char *value, DipError *err) {
    DipBenchOptions *bench = &options->bench;
    return read_list(bench, &bench->isa_count, ',', read_isa, key, value, err);
}

bool dip_bench_set_size(DipOptions *options, const char *key, const char *value, DipError *err) {
    DipBenchOptions *bench = &options->bench;
    return read_list(bench, &bench->size_count, ',', read_size, key, value, err);
}

bool dip_bench_set_grid(DipOptions *options, const char *key, const char *value, DipError *err) {
    DipBenchOptions *bench = &options->bench;
    return read_list(bench, &bench->grid_count, ',', read_grid, key, value, err);
}

bool dip_bench_set_grid_out_of_view(DipOptions *options, const char *key, const char *value,
                                    DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->bench.grid_out_of_view = true;
    return true;
}

bool dip_bench_set_frames(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 1, DIP_BENCH_MAX_FRAMES, &options->bench.frames, err);
}

bool dip_bench_set_rounds(DipOptions *options, const char *key, const char *value, DipError *err) {
    return read_count(key, value, 1, DIP_BENCH_MAX_ROUNDS, &options->bench.rounds, err);
}

bool dip_bench_set_seed(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->bench.has_seed = true;
    return read_count(key, value, 0, INT32_MAX, &options->bench.seed, err);
}

bool dip_bench_set_csv(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->bench.csv = value;
    return true;
}

bool dip_bench_set_svg(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->bench.svg = value;
    return true;
}

bool dip_bench_set_vs(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->bench.vs = value;
    return true;
}

bool dip_bench_set_serve(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->bench.serve = true;
    return true;
}

void dip_bench_options_default(DipBenchOptions *bench) {
    *bench = (DipBenchOptions){.frames = 12, .rounds = 10};
    read_list(bench, &bench->set_count, ';', read_set, "--sets", default_sets, NULL);
}

static int at_least_one(int count) {
    return count ? count : 1;
}

static bool varies_in_samples(const DipBenchOptions *bench) {
    for (int i = 1; i < bench->set_count; i++) {
        if (dip_quality_sample_count(&bench->sets[i].quality) !=
            dip_quality_sample_count(&bench->sets[0].quality)) {
            return true;
        }
    }
    return false;
}

bool dip_bench_options_check(const DipBenchOptions *bench, DipError *err) {
    const int count = bench->set_count * at_least_one(bench->threads_count) *
                      at_least_one(bench->isa_count) * at_least_one(bench->size_count) *
                      at_least_one(bench->grid_count);
    if (count > DIP_BENCH_MAX_COMBINATIONS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "bench",
                             "%d combinations of the lists' values, accepted up to %d", count,
                             DIP_BENCH_MAX_COMBINATIONS);
    }
    if (bench->grid_out_of_view && !bench->grid_count) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--grid-out-of-view",
                             "there is no grid, accepted with --grid N,N,...");
    }
    if (bench->svg && bench->size_count < 2 && bench->grid_count < 2 && bench->threads_count < 2 &&
        !varies_in_samples(bench)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--svg",
                             "nothing to plot, accepted with more than one value of --size, "
                             "--grid, --threads or of aa in --sets");
    }
    if (bench->vs && !bench->serve && access(bench->vs, X_OK) != 0) {
        return dip_error_set(err, DIP_ERROR_IO, bench->vs, 0, "--vs", "cannot be run: %s",
                             strerror(errno));
    }
    if (bench->svg && bench->vs) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--svg",
                             "plots show one program, accepted without --vs");
    }
    return true;
}
