// `diptych bench`: measuring this program, or two programs in turn.
#include "app/bench/bench.h"

#include "app/bench/context.h"
#include "app/bench/measure.h"
#include "app/bench/options.h"
#include "app/bench/plots.h"
#include "app/bench/table.h"
#include "app/cli/interrupt.h"
#include "app/files/folder.h"
#include "app/measure/timing/child.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

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
                         const DipBenchArguments *arguments, DipError *err) {
    DipBenchContext *bench;
    DipBenchResult result = {0};
    DipBenchSource source;
    bool done = open_here(&bench, plan, session, &source, err) &&
                dip_bench_result_init(&result, plan, err) &&
                dip_bench_measure(plan, &source, 1, &result, err);
    if (done) {
        dip_bench_print_heading(plan, session, stdout);
        done = dip_bench_print_times(&result, stdout, err);
        dip_bench_print_work(&result, stdout);
    }
    done = done &&
           (!arguments->bench.csv || dip_bench_write_csv(arguments->bench.csv, &result, 1, err)) &&
           (!arguments->bench.svg || dip_bench_write_plots(arguments->bench.svg, &result, err));
    dip_bench_result_free(&result);
    dip_bench_context_destroy(&bench);
    return done;
}

typedef struct Server {
    const DipBenchPlan *plan;
    DipBenchSource source;
} Server;

static bool answer(void *context, const char *request, DipBenchSample *sample, DipError *err) {
    const Server *server = context;
    int combination, frame, hash;
    if (sscanf(request, "draw %d %d %d", &combination, &frame, &hash) != 3 || combination < 0 ||
        combination >= server->plan->count || frame < 0 || frame >= server->plan->options.frames) {
        return dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                                     "'%.60s' is not a request; give draw COMBINATION FRAME 0|1",
                                     request);
    }
    return server->source.draw(server->source.context, combination, frame, hash != 0, sample, err);
}

static bool serve(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    DipBenchContext *bench;
    Server server = {.plan = plan};
    const bool done =
        open_here(&bench, plan, session, &server.source, err) &&
        dip_child_serve("bench", plan->count, plan->options.frames, answer, &server, err);
    dip_bench_context_destroy(&bench);
    return done;
}

static bool draw_there(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                       DipError *err) {
    char request[64];
    DipTimed timed;
    snprintf(request, sizeof request, "draw %d %d %d", combination, frame, hash);
    return dip_child_draw(context, request, sample, &timed, err);
}

// Runs both programs as processes of their own, so that neither has an advantage.
static bool measure_both(const DipBenchPlan *plan, const DipSession *session,
                         const DipBenchArguments *arguments, DipError *err) {
    const char *const programs[2] = {"/proc/self/exe", arguments->bench.vs};
    DipChild *children[2] = {NULL, NULL};
    DipBenchResult results[2] = {{0}, {0}};
    DipBenchSource sources[2];
    bool done = true;
    for (int p = 0; done && p < 2; p++) {
        const DipChildDef def = {programs[p],
                                 plan->options.serve.argv,
                                 plan->options.serve.argc,
                                 "bench",
                                 plan->count,
                                 plan->options.frames,
                                 "--vs"};
        children[p] = dip_child_start(&def, err);
        sources[p] = (DipBenchSource){draw_there, children[p]};
        done = children[p] && dip_bench_result_init(&results[p], plan, err);
    }
    done = done && dip_bench_measure(plan, sources, 2, results, err);
    if (done) {
        dip_bench_print_heading(plan, session, stdout);
        done = dip_bench_print_ratios(&results[0], &results[1], stdout, err);
    }
    done = done &&
           (!arguments->bench.csv || dip_bench_write_csv(arguments->bench.csv, results, 2, err));
    for (int p = 0; p < 2; p++) {
        dip_child_stop(&children[p], dip_interrupted());
        dip_bench_result_free(&results[p]);
    }
    return done;
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    const DipBenchArguments *arguments = all_arguments;
    const DipBenchOptions *bench = &arguments->bench;
    DipBenchPlan *plan = malloc(sizeof *plan);
    if (!plan) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    if (bench->svg && !bench->serve.serve && !dip_folder_make(bench->svg, "--svg", err)) {
        free(plan);
        return false;
    }
    dip_bench_plan_make(plan, session, bench);
    if (!bench->serve.serve) {
        dip_interrupt_watch();
    }
    const bool done = bench->serve.serve ? serve(plan, session, err)
                      : bench->vs        ? measure_both(plan, session, arguments, err)
                                         : measure_here(plan, session, arguments, err);
    free(plan);
    return done;
}

// Tells the session to make no renderers, because the bench makes its own, and to load the scene
// only if this process draws it: --grid replaces the scene, and with --vs each started program
// loads the scene itself.
static void describe_session(const void *all_arguments, DipSessionDef *def) {
    const DipBenchArguments *arguments = all_arguments;
    const DipBenchOptions *bench = &arguments->bench;
    def->options = &arguments->session;
    def->scene = !bench->grid_count && (!bench->vs || bench->serve.serve);
}

static const DipExample examples[] = {
    {"diptych bench", "measures six sets of settings in the ini's scene"},
    {"diptych bench --sets \"aa=none;aa=4;aa=4,af=16\" --threads 1,2 --isa avx2,avx512",
     "measures twelve combinations"},
    {"diptych bench --size 320x240,640x480,1280x960 --svg plots --csv frames.csv",
     "plots the time against the number of pixels, and writes the time of every frame to a file"},
    {"diptych bench --scale 0.5,0.7071,1 --sets \"aa=none;aa=4\"",
     "measures what drawing smaller pictures and enlarging them saves"},
    {"diptych bench --grid 1000,10000,100000 --sets aa=none --grid-out-of-view",
     "measures the time that triangles outside the view take"},
    {"diptych bench --vs ../before/build/release/diptych --threads 1 --rounds 40",
     "compares this program with the build of another branch"},
};

const DipCommand dip_bench_command = {
    .name = "bench",
    .summary = "measure how long frames take: settings, threads, sizes, ...",
    .usage = "[OPTION]...",
    .text =
        "Bench measures how long frames take and counts their work (triangles, fragments, "
        "texels, ...). It measures every combination of the values in the lists. Each round "
        "measures all combinations in a new random order, so that a slow moment of the machine "
        "favours no combination. Each row's ratio compares it with the base: the first value of "
        "each list, but the greatest render scale. The pictures of all instruction sets and "
        "numbers of threads must be the same; if one differs, the bench fails.\n\n"
        "Times are wall-clock milliseconds per frame. docs/bench.md explains how to read them.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &dip_bench_option_parts,
    .options_size = sizeof(DipBenchArguments),
    .set_defaults = dip_bench_options_default,
    .check = dip_bench_options_check,
    .describe_session = describe_session,
    .run = run,
};
