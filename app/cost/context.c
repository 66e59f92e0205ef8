// Opens the renderers and the reference renderer, and draws the frames of the report's rows. A row
// is one combination of settings on a camera path.
#include "app/cost/context.h"

#include "app/cost/gallery_truth.h"
#include "app/cli/interrupt.h"

// Rounds that draw a frame of the baseline, so that slow frames and slow moments can be told apart.
enum { BASE_COPIES = 3 };

// Compresses the textures if the settings of any row of the report need it. This is done before any
// frame is drawn or timed.
static bool prepare_textures(const DipCostContext *cost, DipError *err) {
    bool compresses = false;
    for (int row = 0; row < cost->report->row_count; row++) {
        compresses |= dip_quality_compresses(&cost->report->rows[row].quality);
    }
    for (int i = 0; i < cost->report->predicted.count; i++) {
        compresses |= dip_quality_compresses(&cost->report->predicted.list[i].quality);
    }
    return !compresses || !cost->session->scene ||
           dip_scene_compress_textures(cost->session->scene, cost->session->pool, err);
}

// Opens what the pictures are drawn from: the gallery, or the reference renderer, which draws the
// truths of models.
static bool open_source(DipCostContext *cost, bool judges, DipError *err) {
    const DipSession *session = cost->session;
    if (session->shows_gallery) {
        cost->gallery = dip_session_open_gallery(session, session->pool, session->isa, err);
        return cost->gallery != NULL;
    }
    if (!judges) {
        return true;
    }
    cost->reference = dip_reference_create(&session->scene_def, err);
    if (cost->reference) {
        dip_reference_set_reflection(cost->reference, &session->reflection);
    }
    return cost->reference != NULL;
}

bool dip_cost_context_open(DipCostContext *cost, const DipSession *session, DipCostReport *report,
                           DipCostJournal *journal, const char *cache, bool judges, DipError *err) {
    *cost =
        (DipCostContext){.session = session, .report = report, .journal = journal, .cache = cache};
    const DipRendererDef def = {
        .pool = session->pool,
        .isa = session->isa,
        .width = report->width,
        .height = report->height,
        .quality = report->options.baseline,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    bool opened = open_source(cost, judges, err);
    for (int gi = 0; opened && gi < 2; gi++) {
        cost->renderers[gi] = dip_painter_create(&def, cost->gallery, err);
        opened = cost->renderers[gi] != NULL;
    }
    opened = opened && prepare_textures(cost, err);
    if (!opened) {
        dip_cost_context_close(cost);
    }
    return opened;
}

void dip_cost_context_close(DipCostContext *cost) {
    dip_reference_destroy(&cost->reference);
    dip_painter_destroy(&cost->renderers[0]);
    dip_painter_destroy(&cost->renderers[1]);
    dip_gallery_destroy(&cost->gallery);
}

static bool draw(DipCostContext *cost, const DipQuality *quality, int path, int64_t time_ns,
                 int frame_index, DipFrame *frame, DipError *err) {
    const DipPose pose = dip_cost_pose(cost->report, cost->session, path, time_ns);
    DipPainter *renderer = cost->renderers[quality->step[DIP_SETTING_GI] != 0];
    dip_painter_set_frame_index(renderer, (uint64_t)frame_index);
    return dip_painter_set_quality(renderer, quality, err) &&
           dip_painter_draw(renderer, cost->session->scene, &pose, time_ns, frame, err);
}

bool dip_cost_draw(DipCostContext *cost, int row, int64_t time_ns, int frame_index, DipFrame *frame,
                   DipError *err) {
    const DipCostRow *drawn = &cost->report->rows[row];
    return draw(cost, &drawn->quality, drawn->path, time_ns, frame_index, frame, err);
}

static int64_t timed_ns(const DipCostContext *cost, int path, int index) {
    return dip_cost_path_duration_ns(cost->report, cost->session, path) /
           dip_cost_frame_count(cost->report) * index;
}

bool dip_cost_draw_settings(DipCostContext *cost, const DipQuality *quality, int path, int index,
                            DipFrame *frame, DipError *err) {
    return draw(cost, quality, path, timed_ns(cost, path, index), index, frame, err);
}

bool dip_cost_draw_timed(DipCostContext *cost, int row, int index, DipFrame *frame, DipError *err) {
    const int path = cost->report->rows[row].path;
    return dip_cost_draw(cost, row, timed_ns(cost, path, index), index, frame, err);
}

bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err) {
    const DipCostReport *report = cost->report;
    const int64_t time_ns =
        dip_cost_viewpoint_time_ns(report, cost->session, path, viewpoint, frame);
    DipGalleryTruth gallery = {.gallery = cost->gallery, .isa = cost->session->isa};
    const DipTruthDef def = {
        .reference = cost->reference,
        .draw = cost->gallery ? dip_gallery_truth_draw : NULL,
        .context = &gallery,
        .scene_hash = report->scene_hash,
        .pose = dip_cost_pose(report, cost->session, path, time_ns),
        .time_ns = time_ns,
        .width = report->width,
        .height = report->height,
        .samples = report->options.samples,
        .pixels_per_degree = report->options.pixels_per_degree,
    };
    return dip_truth_get(truth, &def, cost->cache, cost->session->pool, progress, context, err);
}

DipDriverDef dip_cost_driver_def(const DipCostReport *report, int subjects, int block_subjects) {
    const int rounds = report->options.rounds;
    return (DipDriverDef){
        .subjects = subjects,
        .block_subjects = block_subjects,
        .starts = 1,
        .rounds = rounds,
        .frames = dip_cost_frame_count(report),
        .base_copies = rounds < BASE_COPIES ? rounds : BASE_COPIES,
        .warm_frames = 1,
        .seed = (uint64_t)report->options.seed,
        .most_wait = DIP_TIMED_MOST_WAIT,
    };
}

void dip_cost_stage_parts(const DipFrame *frame, double parts_ms[DIP_TIMED_PARTS]) {
    _Static_assert((int)DIP_COST_STAGE_rest == (int)DIP_TIMED_PARTS, "each stage is a part");
#define WRITE_STAGE(name, text) *parts_ms++ = frame->stages.name##_ms;
    DIP_STAGE_LIST(WRITE_STAGE)
#undef WRITE_STAGE
}

bool dip_cost_interrupted(const DipCostContext *cost, DipError *err) {
    (void)cost;
    return dip_interrupted() &&
           !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost", DIP_COST_INTERRUPTED);
}
