// Making pools, scenes and renderers for a plan.
#include "app/bench/rig.h"

#include "app/bench/synthetic.h"

#include <stdlib.h>
#include <string.h>

// A scene with the camera that flies through it.
typedef struct View {
    const DipScene *scene;
    DipScene *own; // the scene, where it is not the session's
    const DipCamPath *path;
    DipCamPath *own_path;
    double fov_y_deg;
    int triangles; // of a grid, as asked for
    double aspect;
} View;

struct DipBenchRig {
    const DipBenchPlan *plan;
    DipPool **pools; // per thread count
    View *views;
    int view_count;
    DipRenderer **renderers; // per combination
    int *view_of;            // likewise
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
}

// --- views -------------------------------------------------------------------------------------

static View session_view(const DipSession *session) {
    const DipCamTrack *track = &session->track;
    const DipCamCategory *slot =
        &track->categories[track->categories[track->active].path ? track->active : 0];
    return (View){.scene = session->scene, .path = slot->path, .fov_y_deg = slot->fov_y_deg};
}

static bool make_grid_view(View *view, const DipBenchPlan *plan, const DipSession *session,
                           DipError *err) {
    view->fov_y_deg = session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg;
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

// Grids fill the picture: one for each count and shape of picture.
static int find_view(const DipBenchRig *rig, int triangles, double aspect) {
    for (int i = 0; i < rig->view_count; i++) {
        if (rig->views[i].triangles == triangles && rig->views[i].aspect == aspect) {
            return i;
        }
    }
    return -1;
}

static bool choose_view(DipBenchRig *rig, int index, const DipSession *session, DipError *err) {
    const DipBenchOptions *options = &rig->plan->options;
    const int *at = rig->plan->combinations[index].at;
    if (!options->grid_count) {
        rig->views[0] = session_view(session);
        rig->view_count = 1;
        return true;
    }
    const DipBenchSize size = options->sizes[at[DIP_BENCH_AXIS_SIZE]];
    const int triangles = options->grids[at[DIP_BENCH_AXIS_GRID]];
    const double aspect = (double)size.width / size.height;
    rig->view_of[index] = find_view(rig, triangles, aspect);
    if (rig->view_of[index] >= 0) {
        return true;
    }
    rig->view_of[index] = rig->view_count;
    View *view = &rig->views[rig->view_count++];
    *view = (View){.triangles = triangles, .aspect = aspect};
    return make_grid_view(view, rig->plan, session, err);
}

// --- the rig -----------------------------------------------------------------------------------

static DipPool *pool_of(DipBenchRig *rig, int threads_index, DipError *err) {
    if (!rig->pools[threads_index]) {
        rig->pools[threads_index] = dip_pool_create(rig->plan->options.threads[threads_index], err);
    }
    return rig->pools[threads_index];
}

static bool make_renderer(DipBenchRig *rig, int index, const DipSession *session, DipError *err) {
    const DipBenchOptions *options = &rig->plan->options;
    const int *at = rig->plan->combinations[index].at;
    const DipBenchSize size = options->sizes[at[DIP_BENCH_AXIS_SIZE]];
    const DipRendererDef def = {
        .pool = pool_of(rig, at[DIP_BENCH_AXIS_THREADS], err),
        .isa = options->isas[at[DIP_BENCH_AXIS_ISA]],
        .width = size.width,
        .height = size.height,
        .quality = options->sets[at[DIP_BENCH_AXIS_SET]].quality,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    rig->renderers[index] = def.pool ? dip_renderer_create(&def, err) : NULL;
    return rig->renderers[index] != NULL;
}

DipBenchRig *dip_bench_rig_create(const DipBenchPlan *plan, const DipSession *session,
                                  DipError *err) {
    DipBenchRig *rig = calloc(1, sizeof *rig);
    if (!rig) {
        out_of_memory(err);
        return NULL;
    }
    const size_t count = (size_t)plan->count;
    rig->plan = plan;
    rig->pools = calloc((size_t)plan->options.threads_count, sizeof(DipPool *));
    rig->views = calloc(count, sizeof(View));
    rig->renderers = calloc(count, sizeof(DipRenderer *));
    rig->view_of = calloc(count, sizeof(int));
    bool made = (rig->pools && rig->views && rig->renderers && rig->view_of) || out_of_memory(err);
    for (int i = 0; made && i < plan->count; i++) {
        made = choose_view(rig, i, session, err) && make_renderer(rig, i, session, err);
    }
    if (!made) {
        dip_bench_rig_destroy(&rig);
    }
    return rig;
}

void dip_bench_rig_destroy(DipBenchRig **rig_pointer) {
    DipBenchRig *rig = *rig_pointer;
    if (!rig) {
        return;
    }
    for (int i = 0; rig->renderers && i < rig->plan->count; i++) {
        dip_renderer_destroy(&rig->renderers[i]);
    }
    for (int i = 0; i < rig->view_count; i++) {
        dip_scene_destroy(&rig->views[i].own);
        dip_campath_destroy(&rig->views[i].own_path);
    }
    for (int i = 0; rig->pools && i < rig->plan->options.threads_count; i++) {
        dip_pool_destroy(&rig->pools[i]);
    }
    free(rig->pools);
    free(rig->views);
    free(rig->renderers);
    free(rig->view_of);
    free(rig);
    *rig_pointer = NULL;
}

bool dip_bench_rig_draw(DipBenchRig *rig, int combination, int frame, DipFrame *picture,
                        DipError *err) {
    const View *view = &rig->views[rig->view_of[combination]];
    const int64_t time_ns =
        dip_campath_info(view->path).duration_ns / rig->plan->options.frames * frame;
    DipPose pose = {.fov_y_deg = view->fov_y_deg};
    dip_campath_sample(view->path, time_ns, &pose);
    dip_renderer_set_frame_index(rig->renderers[combination], (uint64_t)frame);
    return dip_renderer_draw(rig->renderers[combination], view->scene, &pose, time_ns, picture,
                             err);
}

uint64_t dip_bench_rig_triangles(const DipBenchRig *rig, int combination) {
    return dip_scene_triangle_count(rig->views[rig->view_of[combination]].scene);
}
