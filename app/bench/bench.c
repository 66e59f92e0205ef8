// `diptych bench`: measuring one program, or two in turn.
#include "app/commands.h"

#include "app/bench/child.h"
#include "app/bench/context.h"
#include "app/bench/measure.h"
#include "app/bench/plots.h"
#include "app/bench/table.h"
#include "app/files/folder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static bool draw_here(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                      DipError *err) {
    DipFrame picture;
    if (!dip_bench_context_draw(context, combination, frame, &picture, err)) {
        return false;
    }
    dip_bench_sample_set(sample, &picture, hash);
    return true;
}

static bool open_here(DipBenchContext **bench, const DipBenchPlan *plan, const DipSession *session,
                      DipBenchSource *source, DipError *err) {
    *bench = dip_bench_context_create(plan, session, err);
    *source = (DipBenchSource){draw_here, *bench};
    return *bench != NULL;
}

static bool measure_here(const DipBenchPlan *plan, const DipSession *session,
                         const DipOptions *options, DipError *err) {
    DipBenchContext *bench;
    DipBenchResult result = {0};
    DipBenchSource source;
    bool done = open_here(&bench, plan, session, &source, err) &&
                dip_bench_result_init(&result, plan, err) &&
                dip_bench_measure(plan, &source, 1, &result, err);
    if (done) {
        dip_bench_print_heading(plan, session, options, stdout);
        done = dip_bench_print_times(&result, stdout, err);
        dip_bench_print_work(&result, stdout);
    }
    done = done &&
           (!options->bench.csv || dip_bench_write_csv(options->bench.csv, &result, 1, err)) &&
           (!options->bench.svg || dip_bench_write_plots(options->bench.svg, &result, err));
    dip_bench_result_free(&result);
    dip_bench_context_destroy(&bench);
    return done;
}

static bool serve(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    DipBenchContext *bench;
    DipBenchSource source;
    const bool done =
        open_here(&bench, plan, session, &source, err) && dip_bench_serve(plan, &source, err);
    dip_bench_context_destroy(&bench);
    return done;
}

// Both programs run apart from this one, so that neither has an advantage.
static bool measure_both(const DipBenchPlan *plan, const DipSession *session,
                         const DipOptions *options, DipError *err) {
    const char *const programs[2] = {"/proc/self/exe", options->bench.vs};
    DipBenchChild *children[2] = {NULL, NULL};
    DipBenchResult results[2] = {{0}, {0}};
    DipBenchSource sources[2];
    bool done = true;
    for (int p = 0; done && p < 2; p++) {
        children[p] = dip_bench_child_start(programs[p], plan, err);
        sources[p] = (DipBenchSource){dip_bench_child_draw, children[p]};
        done = children[p] && dip_bench_result_init(&results[p], plan, err);
    }
    done = done && dip_bench_measure(plan, sources, 2, results, err);
    if (done) {
        dip_bench_print_heading(plan, session, options, stdout);
        done = dip_bench_print_ratios(&results[0], &results[1], stdout, err);
    }
    done =
        done && (!options->bench.csv || dip_bench_write_csv(options->bench.csv, results, 2, err));
    for (int p = 0; p < 2; p++) {
        dip_bench_child_stop(&children[p]);
        dip_bench_result_free(&results[p]);
    }
    return done;
}

bool dip_bench_run(DipSession *session, const DipOptions *options, DipError *err) {
    const DipBenchOptions *bench = &options->bench;
    DipBenchPlan *plan = malloc(sizeof *plan);
    if (!plan) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    if (bench->svg && !bench->serve && !dip_folder_make(bench->svg, "--svg", err)) {
        free(plan);
        return false;
    }
    dip_bench_plan_make(plan, session, bench);
    bool done = bench->serve ? serve(plan, session, err)
                : bench->vs  ? measure_both(plan, session, options, err)
                             : measure_here(plan, session, options, err);
    free(plan);
    if (done && fflush(stdout) != 0) {
        done = dip_error_set(err, DIP_ERROR_IO, NULL, 0, "bench", "standard output: %s",
                             strerror(errno));
    }
    return done;
}
