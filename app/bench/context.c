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

// What draws a combination.
typedef struct Drawer {
    DipGallery *gallery; // NULL unless the session shows the gallery
    DipPainter *painter;
    DipEnlarger *enlarger; // NULL if the render scale is 1
    const View *view;
} Drawer;

struct DipBenchContext {
    const DipBenchPlan *plan;
    DipPool **pools; // one per number of threads
    View *views;
    int view_count;
    Drawer *drawers; // one per combination
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
        dip_synthetic_relief(view->triangles, view->fov_y_deg, view->aspect, turn_deg, err);
    if (!relief) {
        return false;
    }
    view->own = dip_scene_create(&relief->def, session->pool, err);
    view->own_path = relief->path;
    relief->path = NULL;
    dip_synthetic_destroy(&relief);
    view->scene = view->own;
    view->path = view->own_path;
    return view->own != NULL;
}

// Finds or makes the view of a combination, the next one of bench->views. A grid is a relief, that
// is, a wavy surface (synthetic.h). It is made to fill a picture of one aspect ratio, so each
// aspect ratio needs its own view.
static bool choose_view(DipBenchContext *bench, int index, const DipSession *session,
                        DipError *err) {
    const DipBenchOptions *options = &bench->plan->options;
    const int *at = bench->plan->combinations[index].at;
    const DipOptionSize size = options->sizes[at[DIP_BENCH_AXIS_SIZE]];
    const int triangles = options->grid_count ? options->grids[at[DIP_BENCH_AXIS_GRID]] : 0;
    const double aspect = options->grid_count ? (double)size.width / size.height : 0.0;
    View *view = bench->views;
    while (view < bench->views + bench->view_count &&
           (view->triangles != triangles || view->aspect != aspect)) {
        view++;
    }
    bench->drawers[index].view = view;
    if (view < bench->views + bench->view_count) {
        return true;
    }
    bench->view_count++;
    *view = options->grid_count ? (View){.triangles = triangles, .aspect = aspect}
                                : session_view(session);
    return !options->grid_count || make_grid_view(view, bench->plan, session, err);
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
    Drawer *drawer = &bench->drawers[index];
    if (def.pool && session->shows_gallery && !options->grid_count) {
        drawer->gallery = dip_session_open_gallery(session, def.pool, def.isa, err);
        if (!drawer->gallery) {
            return false;
        }
    }
    drawer->painter = def.pool ? dip_painter_create(&def, drawer->gallery, err) : NULL;
    if (drawer->painter && options->scales[at[DIP_BENCH_AXIS_SCALE]] < 1.0) {
        const DipEnlargerDef enlarger = {width, height, size.width, size.height, def.pool};
        drawer->enlarger = dip_enlarger_create(&enlarger, err);
        return drawer->enlarger != NULL;
    }
    return drawer->painter != NULL;
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
    bench->drawers = calloc(count, sizeof(Drawer));
    bool made = (bench->pools && bench->views && bench->drawers) || out_of_memory(err);
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
    for (int i = 0; bench->drawers && i < bench->plan->count; i++) {
        dip_painter_destroy(&bench->drawers[i].painter);
        dip_gallery_destroy(&bench->drawers[i].gallery);
        dip_enlarger_destroy(&bench->drawers[i].enlarger);
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
    free(bench->drawers);
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
    const Drawer *drawer = &bench->drawers[combination];
    const View *view = drawer->view;
    const int64_t time_ns =
        dip_campath_span_ns(view->path, view->end) / bench->plan->options.frames * frame;
    DipPose pose = {.fov_y_deg = view->fov_y_deg};
    dip_campath_sample(view->path, dip_campath_time_at_end(view->path, view->end, time_ns), &pose);
    dip_painter_set_frame_index(drawer->painter, (uint64_t)frame);
    if (!dip_painter_draw(drawer->painter, view->scene, &pose, time_ns, picture, err)) {
        return false;
    }
    if (drawer->enlarger) {
        const int size = bench->plan->combinations[combination].at[DIP_BENCH_AXIS_SIZE];
        enlarge(drawer->enlarger, bench->plan->options.sizes[size], picture);
    }
    return true;
}
