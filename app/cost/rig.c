// Renderer, reference and poses.
#include "app/cost/rig.h"

#include "app/interrupt.h"

// Compressed textures are made before any frame that shows them.
static bool prepare_textures(const DipCostRig *rig, DipError *err) {
    bool compresses = false;
    for (int row = 0; row < rig->report->row_count; row++) {
        compresses |= dip_quality_compresses(&rig->report->rows[row].quality);
    }
    return !compresses || dip_scene_compress_textures(rig->session->scene, rig->session->pool, err);
}

bool dip_cost_rig_open(DipCostRig *rig, const DipSession *session, DipCostReport *report,
                       DipCostState *state, const char *cache, DipError *err) {
    *rig = (DipCostRig){.session = session, .report = report, .state = state, .cache = cache};
    const DipRendererDef def = {
        .pool = session->pool,
        .isa = session->isa,
        .width = report->width,
        .height = report->height,
        .quality = report->options.baseline,
        .reflection = session->reflection,
    };
    rig->reference = dip_reference_create(&session->scene_def, err);
    bool opened = rig->reference != NULL;
    if (opened) {
        dip_reference_set_reflection(rig->reference, &session->reflection);
    }
    for (int gi = 0; opened && gi < 2; gi++) {
        rig->renderers[gi] = dip_renderer_create(&def, err);
        opened = rig->renderers[gi] != NULL;
    }
    opened = opened && prepare_textures(rig, err);
    if (!opened) {
        dip_cost_rig_close(rig);
    }
    return opened;
}

void dip_cost_rig_close(DipCostRig *rig) {
    dip_reference_destroy(&rig->reference);
    dip_renderer_destroy(&rig->renderers[0]);
    dip_renderer_destroy(&rig->renderers[1]);
}

bool dip_cost_draw(DipCostRig *rig, int row, int64_t time_ns, int frame_index, DipFrame *frame,
                   DipError *err) {
    const DipCostRow *drawn = &rig->report->rows[row];
    const DipPose pose = dip_cost_pose(rig->report, rig->session, drawn->path, time_ns);
    DipRenderer *renderer = rig->renderers[drawn->quality.step[DIP_SETTING_GI] != 0];
    dip_renderer_set_frame_index(renderer, (uint64_t)frame_index);
    return dip_renderer_set_quality(renderer, &drawn->quality, err) &&
           dip_renderer_draw(renderer, rig->session->scene, &pose, time_ns, frame, err);
}

bool dip_cost_draw_timed(DipCostRig *rig, int row, int index, DipFrame *frame, DipError *err) {
    const DipCostReport *report = rig->report;
    const int64_t duration_ns =
        dip_cost_path_duration_ns(report, rig->session, report->rows[row].path);
    return dip_cost_draw(rig, row, duration_ns / report->options.timed_frames * index, index, frame,
                         err);
}

bool dip_cost_rig_truth(DipCostRig *rig, int path, int place, int frame, DipTruthProgress *progress,
                        void *context, DipTruth *truth, DipError *err) {
    const DipCostReport *report = rig->report;
    const int64_t time_ns = dip_cost_place_time_ns(report, rig->session, path, place, frame);
    const DipTruthDef def = {
        .reference = rig->reference,
        .scene_hash = report->scene_hash,
        .pose = dip_cost_pose(report, rig->session, path, time_ns),
        .time_ns = time_ns,
        .width = report->width,
        .height = report->height,
        .samples = report->options.samples,
        .pixels_per_degree = report->options.pixels_per_degree,
    };
    return dip_truth_get(truth, &def, rig->cache, rig->session->pool, progress, context, err);
}

bool dip_cost_interrupted(const DipCostRig *rig, DipError *err) {
    (void)rig;
    return dip_interrupted() && !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost",
                                               "interrupted; the same command goes on from here");
}
