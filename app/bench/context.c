// Makes the pools, scenes and renderers that a plan needs.
#include "app/bench/context.h"

#include "app/bench/enlarge.h"
#include "app/bench/synthetic.h"
#include "renderer/base/clock.h"

#include <stdlib.h>
#include <string.h>

// A scene with the camera path through it.
typedef struct View {
    const DipScene *scene;
    DipScene *own; // `scene` if the view owns it; NULL if the session owns it
    const DipCamPath *path;
    DipCamPath *own_path;
    DipCamPathEnd end; // what the path does at its end
    double fov_y_deg;
    int triangles; // number of triangles given to --grid; 0 for the session's scene
    double aspect; // width / height of the picture that a grid fills; 0 for the session's scene
} View;

struct DipBenchContext {
    const DipBenchPlan *plan;
    DipPool **pools; // one per number of threads
    View *views;
    int view_count;
    DipPainter **renderers;  // one per combination
    DipGallery **galleries;  // one per combination; all NULL unless the session shows the gallery
    DipEnlarger **enlargers; // one per combination; NULL for those with render scale 1
    int *view_of;            // index of each combination's view
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
}

// --- views -------------------------------------------------------------------------------------

static View session_view(const DipSession *session) {
    const DipCamTrack *track = &session->track;
    const DipCamCategory *slot =
        &track->categories[track->categories[track->active].path ? track->active : 0];
    return (View){.scene = session->scene,
                  .path = slot->path,
                  .end = track->end,
                  .fov_y_deg = slot->fov_y_deg};
}

static bool make_grid_view(View *view, const DipBenchPlan *plan, const DipSession *session,
                           DipError *err) {
    view->fov_y_deg =
        dip_session_fov(session, session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg);
    const double turn_deg = plan->options.grid_out_of_view ? 180.0 : 0.0;
    DipSynthetic *relief =
        dip_synthetic_relief(view->triangles, true, view->fov_y_deg, view->aspect, turn_deg, err);
    if (!relief) {
        return false;
    }
    view->own = dip_scene_create(dip_synthetic_scene_def(relief), session->pool, err);
    view->own_path = dip_synthetic_take_path(relief);
    dip_synthetic_destroy(&relief);
    view->scene = view->own;
    view->path = view->own_path;
    return view->own != NULL;
}

// Finds the view of a grid by its number of triangles and its aspect ratio. Returns -1 if there is
// no such view yet. A grid is a relief, that is, a wavy surface (synthetic.h). It is made to fill a
// picture of one aspect ratio, so each aspect ratio needs its own view.
static int find_view(const DipBenchContext *bench, int triangles, double aspect) {
    for (int i = 0; i < bench->view_count; i++) {
        if (bench->views[i].triangles == triangles && bench->views[i].aspect == aspect) {
            return i;
        }
    }
    return -1;
}

static bool choose_view(DipBenchContext *bench, int index, const DipSession *session,
                        DipError *err) {
    const DipBenchOptions *options = &bench->plan->options;
    const int *at = bench->plan->combinations[index].at;
    if (!options->grid_count) {
        bench->views[0] = session_view(session);
        bench->view_count = 1;
        return true;
    }
    const DipOptionSize size = options->sizes[at[DIP_BENCH_AXIS_SIZE]];
    const int triangles = options->grids[at[DIP_BENCH_AXIS_GRID]];
    const double aspect = (double)size.width / size.height;
    bench->view_of[index] = find_view(bench, triangles, aspect);
    if (bench->view_of[index] >= 0) {
        return true;
    }
    bench->view_of[index] = bench->view_count;
    View *view = &bench->views[bench->view_count++];
    *view = (View){.triangles = triangles, .aspect = aspect};
    return make_grid_view(view, bench->plan, session, err);
}

// --- the context -------------------------------------------------------------------------------

static DipPool *pool_of(DipBenchContext *bench, int threads_index, DipError *err) {
    if (!bench->pools[threads_index]) {
        bench->pools[threads_index] =
            dip_pool_create(bench->plan->options.threads[threads_index], err);
    }
    return bench->pools[threads_index];
}

static bool make_renderer(DipBenchContext *bench, int index, const DipSession *session,
                          DipError *err) {
    const DipBenchOptions *options = &bench->plan->options;
    const int *at = bench->plan->combinations[index].at;
    const DipOptionSize size = options->sizes[at[DIP_BENCH_AXIS_SIZE]];
    int width, height;
    dip_bench_drawn_size(bench->plan, &bench->plan->combinations[index], &width, &height);
    const DipRendererDef def = {
        .pool = pool_of(bench, at[DIP_BENCH_AXIS_THREADS], err),
        .isa = options->isas[at[DIP_BENCH_AXIS_ISA]],
        .width = width,
        .height = height,
        .quality = options->sets[at[DIP_BENCH_AXIS_SET]].quality,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    if (def.pool && session->shows_gallery && !options->grid_count) {
        bench->galleries[index] = dip_session_open_gallery(session, def.pool, def.isa, err);
        if (!bench->galleries[index]) {
            return false;
        }
    }
    bench->renderers[index] =
        def.pool ? dip_painter_create(&def, bench->galleries[index], err) : NULL;
    if (bench->renderers[index] && options->scales[at[DIP_BENCH_AXIS_SCALE]] < 1.0) {
        const DipEnlargerDef enlarger = {width, height, size.width, size.height, def.pool};
        bench->enlargers[index] = dip_enlarger_create(&enlarger, err);
        return bench->enlargers[index] != NULL;
    }
    return bench->renderers[index] != NULL;
}

DipBenchContext *dip_bench_context_create(const DipBenchPlan *plan, const DipSession *session,
                                          DipError *err) {
    DipBenchContext *bench = calloc(1, sizeof *bench);
    if (!bench) {
        out_of_memory(err);
        return NULL;
    }
    const size_t count = (size_t)plan->count;
    bench->plan = plan;
    bench->pools = calloc((size_t)plan->options.threads_count, sizeof(DipPool *));
    bench->views = calloc(count, sizeof(View));
    bench->renderers = calloc(count, sizeof(DipPainter *));
    bench->galleries = calloc(count, sizeof(DipGallery *));
    bench->enlargers = calloc(count, sizeof(DipEnlarger *));
    bench->view_of = calloc(count, sizeof(int));
    bool made = (bench->pools && bench->views && bench->renderers && bench->galleries &&
                 bench->enlargers && bench->view_of) ||
                out_of_memory(err);
    for (int i = 0; made && i < plan->count; i++) {
        made = choose_view(bench, i, session, err) && make_renderer(bench, i, session, err);
    }
    if (!made) {
        dip_bench_context_destroy(&bench);
    }
    return bench;
}

void dip_bench_context_destroy(DipBenchContext **context_pointer) {
    DipBenchContext *bench = *context_pointer;
    if (!bench) {
        return;
    }
    for (int i = 0; bench->renderers && i < bench->plan->count; i++) {
        dip_painter_destroy(&bench->renderers[i]);
    }
    for (int i = 0; bench->galleries && i < bench->plan->count; i++) {
        dip_gallery_destroy(&bench->galleries[i]);
    }
    for (int i = 0; bench->enlargers && i < bench->plan->count; i++) {
        dip_enlarger_destroy(&bench->enlargers[i]);
    }
    for (int i = 0; i < bench->view_count; i++) {
        dip_scene_destroy(&bench->views[i].own);
        dip_campath_destroy(&bench->views[i].own_path);
    }
    for (int i = 0; bench->pools && i < bench->plan->options.threads_count; i++) {
        dip_pool_destroy(&bench->pools[i]);
    }
    free(bench->pools);
    free(bench->views);
    free(bench->renderers);
    free(bench->galleries);
    free(bench->enlargers);
    free(bench->view_of);
    free(bench);
    *context_pointer = NULL;
}

// The enlarging is part of the frame's total time, and of none of its stages.
static void enlarge(DipEnlarger *enlarger, DipOptionSize size, DipFrame *picture) {
    const int64_t begin_ns = dip_clock_ns();
    picture->rgba8 = dip_enlarger_run(enlarger, picture->rgba8, picture->stride_bytes);
    picture->width = size.width;
    picture->height = size.height;
    picture->stride_bytes = (size_t)size.width * 4;
    picture->stages.total_ms += 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

bool dip_bench_context_draw(DipBenchContext *bench, int combination, int frame, DipFrame *picture,
                            DipError *err) {
    const View *view = &bench->views[bench->view_of[combination]];
    const int64_t time_ns =
        dip_campath_span_ns(view->path, view->end) / bench->plan->options.frames * frame;
    DipPose pose = {.fov_y_deg = view->fov_y_deg};
    dip_campath_sample(view->path, dip_campath_time_at_end(view->path, view->end, time_ns), &pose);
    dip_painter_set_frame_index(bench->renderers[combination], (uint64_t)frame);
    if (!dip_painter_draw(bench->renderers[combination], view->scene, &pose, time_ns, picture,
                          err)) {
        return false;
    }
    if (bench->enlargers[combination]) {
        const int size = bench->plan->combinations[combination].at[DIP_BENCH_AXIS_SIZE];
        enlarge(bench->enlargers[combination], bench->plan->options.sizes[size], picture);
    }
    return true;
}

uint64_t dip_bench_context_triangles(const DipBenchContext *bench, int combination) {
    const DipScene *scene = bench->views[bench->view_of[combination]].scene;
    return scene ? dip_scene_triangle_count(scene) : 0;
}
