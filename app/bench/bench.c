// `diptych bench`: measuring this program, or two programs in turn.
#include "app/bench/context.h"
#include "app/bench/measure.h"
#include "app/bench/options.h"
#include "app/bench/plots.h"
#include "app/bench/table.h"
#include "app/cli/progress.h"
#include "app/files/whole_file.h"
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

typedef struct Server {
    const DipBenchPlan *plan;
    DipBenchContext *bench;
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
    return draw_here(server->bench, combination, frame, hash != 0, sample, err);
}

static bool serve(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    Server server = {plan, dip_bench_context_create(plan, session, err)};
    const bool done = server.bench && dip_child_serve("bench", plan->count, plan->options.frames,
                                                      answer, &server, err);
    dip_bench_context_destroy(&server.bench);
    return done;
}

static bool draw_there(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                       DipError *err) {
    char request[64];
    DipTimed timed;
    snprintf(request, sizeof request, "draw %d %d %d", combination, frame, hash);
    return dip_child_draw(context, request, sample, &timed, err);
}

// The programs that are measured: this process, or with --vs two child processes, so that neither
// program has an advantage.
typedef struct Programs {
    DipBenchContext *here;
    DipChild *children[2];
    DipBenchSource sources[2];
    DipBenchResult results[2];
    int count;
} Programs;

static bool open_programs(Programs *programs, const DipBenchPlan *plan, const DipSession *session,
                          DipError *err) {
    const DipBenchOptions *options = &plan->options;
    const char *const files[2] = {"/proc/self/exe", options->vs};
    *programs = (Programs){.count = options->vs ? 2 : 1};
    if (!options->vs) {
        programs->here = dip_bench_context_create(plan, session, err);
        programs->sources[0] = (DipBenchSource){draw_here, programs->here};
        return programs->here && dip_bench_result_init(&programs->results[0], plan, err);
    }
    for (int p = 0; p < 2; p++) {
        const DipChildDef def = {files[p], options->serve.argv, options->serve.argc,
                                 "bench",  plan->count,         options->frames,
                                 "--vs"};
        programs->children[p] = dip_child_start(&def, err);
        programs->sources[p] = (DipBenchSource){draw_there, programs->children[p]};
        if (!programs->children[p] || !dip_bench_result_init(&programs->results[p], plan, err)) {
            return false;
        }
    }
    return true;
}

static bool print_and_write(const Programs *programs, const DipBenchPlan *plan,
                            const DipSession *session, DipError *err) {
    const DipBenchOptions *options = &plan->options;
    const DipBenchResult *results = programs->results;
    dip_bench_print_heading(plan, session, stdout);
    if (options->vs) {
        dip_bench_print_ratios(&results[0], &results[1], stdout);
    } else {
        dip_bench_print_times(&results[0], stdout);
        dip_bench_print_work(&results[0], stdout);
    }
    return (!options->csv || dip_bench_write_csv(options->csv, results, programs->count, err)) &&
           (!options->svg || dip_bench_write_plots(options->svg, &results[0], err));
}

static bool measure(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    Programs programs;
    const bool done =
        open_programs(&programs, plan, session, err) &&
        dip_bench_measure(plan, programs.sources, programs.count, programs.results, err) &&
        print_and_write(&programs, plan, session, err);
    for (int p = 0; p < 2; p++) {
        dip_child_stop(&programs.children[p], dip_interrupted());
        dip_bench_result_free(&programs.results[p]);
    }
    dip_bench_context_destroy(&programs.here);
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
    const bool done = bench->serve.serve ? serve(plan, session, err) : measure(plan, session, err);
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
