// Runs the command `diptych bench`: makes the pools, scenes and renderers that the plan (plan.h)
// needs, and measures this program, or two programs in turn.
#include "app/bench/gap.h"
#include "app/bench/measure.h"
#include "app/bench/plots.h"
#include "app/bench/synthetic.h"
#include "app/bench/table.h"
#include "app/cli/machine.h"
#include "app/cli/program_file.h"
#include "app/cli/progress.h"
#include "app/files/whole_file.h"
#include "app/measure/timing/child.h"
#include "app/measure/timing/processors.h"
#include "renderer/base/assert.h"
#include "renderer/base/clock.h"
#include "renderer/post/post.h"

#include <stdlib.h>
#include <unistd.h>

// A view is a scene with the camera path through it.
typedef struct View {
    const DipScene *scene;
    const DipCamPath *path;
    DipScene *own_scene;  // equal to `scene` if the view owns it; NULL if the session owns it
    DipCamPath *own_path; // equal to `path` if the view owns it; NULL if the session owns it
    DipCamPathEnd end;    // what the path does at its end
    double fov_y_deg;
    int triangles; // number of triangles given to --grid; 0 for the session's scene
    double aspect; // width / height of the picture if --grid replaces the scene; otherwise 0
} View;

// A drawer draws with one combination of values on the plan's axes (settings, size, threads, ...).
typedef struct Drawer {
    DipGallery *gallery; // NULL unless the view shows a scene of the gallery
    DipPainter *painter;
    DipPost *enlarger; // NULL if the render scale is 1
    uint8_t *enlarged; // the enlarged picture, rgba8
    const View *view;
} Drawer;

typedef struct Context {
    const DipBenchPlan *plan;
    DipPool **pools; // one per number of threads in the plan
    View *views;
    int view_count;
    Drawer *drawers; // one per combination
    int processors;  // how many this process may use, as draw_here has set it; 0: all
} Context;

// --- views -------------------------------------------------------------------------------------

static View session_view(const DipSession *session) {
    const DipCamCategory *slot = dip_camtrack_playing(&session->track);
    return (View){.scene = session->scene,
                  .path = slot->path,
                  .end = session->track.end,
                  .fov_y_deg = slot->fov_y_deg};
}

static bool make_grid_view(View *view, const DipBenchPlan *plan, const DipSession *session,
                           DipError *err) {
    view->fov_y_deg =
        dip_session_fov(session, session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg);
    const double turn_deg = plan->options.grid_out_of_view ? 180.0 : 0.0;
    DipSynthetic *relief =
        dip_synthetic_relief(view->triangles, view->fov_y_deg, view->aspect, turn_deg, err);
    if (!relief) {
        return false;
    }
    view->scene = view->own_scene = dip_scene_create(&relief->def, session->pool, err);
    view->path = view->own_path = relief->path;
    relief->path = NULL;
    dip_synthetic_destroy(&relief);
    return view->scene != NULL;
}

// Finds the view of a combination in bench->views, or adds it. A grid is a relief, that is, a wavy
// surface (synthetic.h). A relief fills a picture of one aspect ratio, so each aspect ratio needs a
// view of its own.
static bool choose_view(Context *bench, int index, const DipSession *session, DipError *err) {
    const DipBenchValues v = dip_bench_values(bench->plan, index);
    const double aspect = v.triangles ? (double)v.size.width / v.size.height : 0.0;
    View *view = bench->views;
    while (view < bench->views + bench->view_count &&
           (view->triangles != v.triangles || view->aspect != aspect)) {
        view++;
    }
    bench->drawers[index].view = view;
    if (view < bench->views + bench->view_count) {
        return true;
    }
    bench->view_count++;
    *view =
        v.triangles ? (View){.triangles = v.triangles, .aspect = aspect} : session_view(session);
    return !v.triangles || make_grid_view(view, bench->plan, session, err);
}

// --- the context -------------------------------------------------------------------------------

static DipPool *pool_of(Context *bench, int threads_index, DipError *err) {
    if (!bench->pools[threads_index]) {
        bench->pools[threads_index] =
            dip_pool_create(bench->plan->options.threads[threads_index], err);
    }
    return bench->pools[threads_index];
}

// Makes the filter that enlarges the picture that the painter draws.
static bool make_enlarger(Drawer *drawer, const DipBenchValues *v, const DipRendererDef *def,
                          DipError *err) {
    const DipPostDef post = {
        .filter = DIP_POST_BILINEAR,
        .from_width = v->drawn.width,
        .from_height = v->drawn.height,
        .to_width = v->size.width,
        .to_height = v->size.height,
        .isa = def->isa,
        .pool = def->pool,
    };
    drawer->enlarger = dip_post_create(&post, err);
    drawer->enlarged = malloc((size_t)v->size.width * (size_t)v->size.height * 4);
    if (drawer->enlarger && !drawer->enlarged) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    return drawer->enlarger != NULL;
}

static bool make_renderer(Context *bench, int index, const DipSession *session, DipError *err) {
    const DipBenchValues v = dip_bench_values(bench->plan, index);
    const DipRendererDef def = {
        .pool = pool_of(bench, bench->plan->at[index][DIP_BENCH_AXIS_THREADS], err),
        .isa = v.isa,
        .width = v.drawn.width,
        .height = v.drawn.height,
        .quality = v.set->quality,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    Drawer *drawer = &bench->drawers[index];
    if (def.pool && session->shows_gallery && !v.triangles) {
        drawer->gallery = dip_session_open_gallery(session, def.pool, def.isa, err);
        if (!drawer->gallery) {
            return false;
        }
    }
    drawer->painter = def.pool ? dip_painter_create(&def, drawer->gallery, err) : NULL;
    if (drawer->painter && v.scale < 1.0) {
        return make_enlarger(drawer, &v, &def, err);
    }
    return drawer->painter != NULL;
}

static void destroy_context(Context **context_pointer) {
    Context *bench = *context_pointer;
    if (!bench) {
        return;
    }
    for (int i = 0; bench->drawers && i < bench->plan->count; i++) {
        dip_painter_destroy(&bench->drawers[i].painter);
        dip_gallery_destroy(&bench->drawers[i].gallery);
        dip_post_destroy(&bench->drawers[i].enlarger);
        free(bench->drawers[i].enlarged);
    }
    for (int i = 0; i < bench->view_count; i++) {
        dip_scene_destroy(&bench->views[i].own_scene);
        dip_campath_destroy(&bench->views[i].own_path);
    }
    for (int i = 0; bench->pools && i < bench->plan->options.counts[DIP_BENCH_AXIS_THREADS]; i++) {
        dip_pool_destroy(&bench->pools[i]);
    }
    free(bench->pools);
    free(bench->views);
    free(bench->drawers);
    free(bench);
    *context_pointer = NULL;
}

// Makes everything that the plan draws with. Borrows the plan and the session.
static Context *create_context(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    Context *bench = calloc(1, sizeof *bench);
    if (!bench) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
        return NULL;
    }
    const size_t count = (size_t)plan->count;
    bench->plan = plan;
    bench->pools = calloc((size_t)plan->options.counts[DIP_BENCH_AXIS_THREADS], sizeof(DipPool *));
    bench->views = calloc(count, sizeof(View));
    bench->drawers = calloc(count, sizeof(Drawer));
    bool made = (bench->pools && bench->views && bench->drawers) ||
                dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    for (int i = 0; made && i < plan->count; i++) {
        made = choose_view(bench, i, session, err) && make_renderer(bench, i, session, err);
    }
    if (!made) {
        destroy_context(&bench);
    }
    return bench;
}

// Enlarges the picture to its full size (--scale). Adds the time to the frame's total time, but to
// no stage.
static void enlarge(const Drawer *drawer, DipOptionSize size, DipFrame *picture) {
    const int64_t begin_ns = dip_clock_ns();
    const size_t stride_bytes = (size_t)size.width * 4;
    dip_post_run(drawer->enlarger, picture->rgba8, picture->stride_bytes, drawer->enlarged,
                 stride_bytes);
    picture->rgba8 = drawer->enlarged;
    picture->width = size.width;
    picture->height = size.height;
    picture->stride_bytes = stride_bytes;
    picture->stages.total_ms += 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

// Draws a frame of a combination. The frames divide the camera path evenly.
static bool draw_sample(Context *bench, int combination, int frame, bool hash,
                        DipBenchSample *sample, DipError *err) {
    const Drawer *drawer = &bench->drawers[combination];
    const View *view = drawer->view;
    const int64_t time_ns =
        dip_campath_span_ns(view->path, view->end) / bench->plan->options.frames * frame;
    DipPose pose = {.fov_y_deg = view->fov_y_deg};
    DipFrame picture;
    dip_campath_sample(view->path, dip_campath_time_at_end(view->path, view->end, time_ns), &pose);
    dip_painter_set_frame_index(drawer->painter, (uint64_t)frame);
    if (!dip_painter_draw(drawer->painter, view->scene, &pose, time_ns, &picture, err)) {
        return false;
    }
    if (drawer->enlarger) {
        enlarge(drawer, dip_bench_values(bench->plan, combination).size, &picture);
    }
    dip_bench_sample_set(sample, &picture, hash);
    return true;
}

// --- programs ------------------------------------------------------------------------------------

// Draws in this process, which is the only one that is measured.
static bool draw_here(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                      DipError *err) {
    Context *bench = context;
    const int threads = dip_bench_values(bench->plan, combination).threads;
    if (threads != bench->processors) {
        dip_processors_confine((long)getpid(), threads);
        bench->processors = threads;
    }
    return draw_sample(bench, combination, frame, hash, sample, err);
}

static bool answer(void *context, const char *request, DipBenchSample *sample, DipError *err) {
    Context *bench = context;
    int combination, frame, hash;
    if (sscanf(request, "draw %d %d %d", &combination, &frame, &hash) != 3 || combination < 0 ||
        combination >= bench->plan->count || frame < 0 || frame >= bench->plan->options.frames) {
        return dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                                     "'%.60s' is not a request; give draw COMBINATION FRAME 0|1",
                                     request);
    }
    return draw_sample(bench, combination, frame, hash != 0, sample, err);
}

static bool serve(const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    Context *bench = create_context(plan, session, err);
    const bool done = bench && dip_child_serve("bench", plan->count, plan->options.frames, NULL,
                                               answer, bench, err);
    destroy_context(&bench);
    return done;
}

// A program that draws in another process.
typedef struct Rival {
    const DipBenchPlan *plan;
    DipChild *child;
} Rival;

static bool draw_there(void *context, int combination, int frame, bool hash, DipBenchSample *sample,
                       DipError *err) {
    const Rival *rival = context;
    char request[64];
    DipTimed timed;
    dip_child_confine(rival->child, dip_bench_values(rival->plan, combination).threads);
    snprintf(request, sizeof request, "draw %d %d %d", combination, frame, hash);
    return dip_child_draw(rival->child, request, sample, &timed, err);
}

// The programs that are measured. Without --vs, this process is the only one. With --vs, both
// programs run as child processes, so that neither has an advantage.
typedef struct Programs {
    Context *here;
    Rival rivals[2];
    DipBenchSource sources[2];
    DipBenchResult results[2];
    int count;
} Programs;

static bool open_programs(Programs *programs, const DipProgramOptions *program,
                          const DipBenchPlan *plan, const DipSession *session, DipError *err) {
    const DipBenchOptions *options = &plan->options;
    const char *const files[2] = {dip_program_file(), options->vs};
    *programs = (Programs){.count = options->vs ? 2 : 1};
    if (!options->vs) {
        programs->here = create_context(plan, session, err);
        programs->sources[0] = (DipBenchSource){draw_here, programs->here};
        return programs->here && dip_bench_result_init(&programs->results[0], plan, err);
    }
    for (int p = 0; p < 2; p++) {
        const DipChildDef def = {files[p],    program->argv,   program->argc, "bench",
                                 plan->count, options->frames, "--vs"};
        programs->rivals[p] = (Rival){plan, dip_child_start(&def, err)};
        programs->sources[p] = (DipBenchSource){draw_there, &programs->rivals[p]};
        if (!programs->rivals[p].child ||
            !dip_bench_result_init(&programs->results[p], plan, err)) {
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
        dip_bench_print_gap(&results[0], dip_machine_ns_per_cycle(), stdout);
    }
    return (!options->csv || dip_bench_write_csv(options->csv, results, programs->count, err)) &&
           (!options->svg || dip_bench_write_plots(options->svg, &results[0], err));
}

static bool measure(const DipProgramOptions *program, const DipBenchPlan *plan,
                    const DipSession *session, DipError *err) {
    Programs programs;
    const bool done =
        open_programs(&programs, program, plan, session, err) &&
        dip_bench_measure(plan, programs.sources, programs.count, programs.results, err) &&
        print_and_write(&programs, plan, session, err);
    for (int p = 0; p < 2; p++) {
        dip_child_stop(&programs.rivals[p].child, dip_interrupted());
        dip_bench_result_free(&programs.results[p]);
    }
    destroy_context(&programs.here);
    return done;
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    const DipBenchArguments *arguments = all_arguments;
    const DipBenchOptions *bench = &arguments->bench;
    DipBenchPlan *plan = malloc(sizeof *plan);
    if (!plan) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
    }
    if (bench->svg && !bench->serve && !dip_folder_make(bench->svg, "--svg", err)) {
        free(plan);
        return false;
    }
    dip_bench_plan_make(plan, session, bench);
    if (!bench->serve) {
        dip_interrupt_watch();
    }
    const bool done =
        bench->serve ? serve(plan, session, err) : measure(&arguments->program, plan, session, err);
    free(plan);
    return done;
}

// Tells the session to make no renderers, because the bench makes its own. Tells it to load the
// scene only if this process draws it: --grid replaces the scene, and with --vs each started
// program loads the scene itself.
static void describe_session(const void *all_arguments, DipSessionDef *def) {
    const DipBenchArguments *arguments = all_arguments;
    const DipBenchOptions *bench = &arguments->bench;
    def->options = &arguments->session;
    def->scene = !bench->counts[DIP_BENCH_AXIS_GRID] && (!bench->vs || bench->serve);
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
        "The last table has the cycles that each stage takes per triangle, tile triangle, "
        "sub-block, fragment and probe, beside a floor: what the machine can do. app/bench/gap.h "
        "has the floors and their sources.\n\n"
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
