// Opens the renderers and the reference renderer, and draws the frames of the report's rows. A row
// is one combination of settings on a camera path.
#include "app/cost/context.h"

#include "app/cli/progress.h"
#include "renderer/base/srgb.h"

#include <string.h>

enum { SAMPLES = 8 }; // Samples of each pixel that draw_gallery_truth draws.

// Compresses the textures if the settings of any row or predicted combination of the report need
// it. This is done before any frame is drawn or timed.
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

// Opens the gallery if the session shows it. Otherwise, if `judges` is true, opens the reference
// renderer, which draws the truths (converged pictures) of models.
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
                           bool judges, DipError *err) {
    *cost = (DipCostContext){.session = session, .report = report};
    bool opened = open_source(cost, judges, err);
    for (int gi = 0; opened && gi < 2; gi++) {
        cost->renderers[gi] = dip_session_make_painter(
            session, cost->gallery, &report->options.baseline, report->width, report->height, err);
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

// --- drawing -------------------------------------------------------------------------------------

static bool draw(DipCostContext *cost, const DipQuality *quality, int path, int64_t time_ns,
                 int frame_index, DipFrame *frame, DipError *err) {
    const DipPose pose = dip_cost_pose(cost->report, cost->session, path, time_ns);
    DipPainter *renderer = cost->renderers[quality->step[DIP_SETTING_GI] != 0];
    dip_painter_set_frame_index(renderer, (uint64_t)frame_index);
    return dip_painter_set_quality(renderer, quality, err) &&
           dip_painter_draw(renderer, cost->session->scene, &pose, time_ns, frame, err);
}

// Lets the history of the renderer that draws these settings begin anew. Returns whether frames
// with these settings have a history. Scenes of the gallery never have one.
static bool cut_history(const DipCostContext *cost, const DipQuality *quality) {
    dip_painter_cut(cost->renderers[quality->step[DIP_SETTING_GI] != 0]);
    return dip_quality_has_history(quality) && !cost->gallery;
}

// The time from one timed frame of a path to the next.
static int64_t timed_step_ns(const DipCostContext *cost, int path) {
    return dip_cost_path_duration_ns(cost->report, cost->session, path) /
           dip_cost_frame_count(cost->report);
}

bool dip_cost_prepare_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                            DipError *err) {
    static const int64_t most_ns = INT64_C(1000000000) / 30;
    const int64_t step_ns = timed_step_ns(cost, path);
    const int64_t before_ns = step_ns < most_ns ? step_ns : most_ns;
    DipFrame before;
    return !cut_history(cost, quality) || index == 0 ||
           draw(cost, quality, path, step_ns * index - before_ns, index - 1, &before, err);
}

bool dip_cost_draw_timed(DipCostContext *cost, const DipQuality *quality, int path, int index,
                         DipFrame *frame, DipError *err) {
    return draw(cost, quality, path, timed_step_ns(cost, path) * index, index, frame, err);
}

// Draws frame `index` of a burst. If the settings have a history, draws before frame 0 the
// DIP_FRAMES_BEFORE frames that precede the burst, as far as the path has them.
static bool draw_burst_frame(DipCostContext *cost, const DipCostRow *row, int viewpoint, int index,
                             DipFrame *frame, DipError *err) {
    int first = index;
    if (index == 0 && cut_history(cost, &row->quality)) {
        first = -DIP_FRAMES_BEFORE;
    }
    for (int i = first; i <= index; i++) {
        const int64_t time_ns =
            dip_cost_viewpoint_time_ns(cost->report, cost->session, row->path, viewpoint, i);
        if (time_ns >= 0 &&
            !draw(cost, &row->quality, row->path, time_ns, i + DIP_FRAMES_BEFORE, frame, err)) {
            return false;
        }
    }
    return true;
}

bool dip_cost_draw_viewpoint(DipCostContext *cost, int row, int viewpoint, int index,
                             uint8_t *rgba8, char hash[33], DipError *err) {
    const DipCostRow *drawn = &cost->report->rows[row];
    const size_t row_bytes = (size_t)cost->report->width * 4;
    DipFrame frame;
    if (!draw_burst_frame(cost, drawn, viewpoint, index, &frame, err)) {
        return false;
    }
    for (int y = 0; y < frame.height; y++) {
        memcpy(rgba8 + (size_t)y * row_bytes, frame.rgba8 + (size_t)y * frame.stride_bytes,
               row_bytes);
    }
    dip_frame_hash(&frame, hash);
    return true;
}

static bool read_drawn(void *context, const DipCostPictureSet *set, int row, uint8_t *rgba8,
                       DipError *err) {
    DipCostContext *cost = context;
    DipTruth truth;
    char hash[33];
    if (dip_cost_interrupted(cost, err)) {
        return false;
    }
    if (row >= 0) {
        return dip_cost_draw_viewpoint(cost, row, set->viewpoint, 0, rgba8, hash, err);
    }
    if (!dip_cost_context_truth(cost, set->path, set->viewpoint, 0, NULL, NULL, &truth, err)) {
        return false;
    }
    memcpy(rgba8, truth.rgba8, (size_t)truth.width * (size_t)truth.height * 4);
    dip_truth_free(&truth);
    return true;
}

DipCostFrameSource dip_cost_drawn_frames(DipCostContext *cost) {
    return (DipCostFrameSource){cost, read_drawn};
}

// --- truths --------------------------------------------------------------------------------------

// Returns k: a gallery scene is drawn k times as wide and high as its truth, and its pixels are
// averaged in blocks of k x k.
static int scale_of(const DipTruthDef *def) {
    const int longer = def->width > def->height ? def->width : def->height;
    int scale = 2;
    while (scale * scale * SAMPLES < def->samples && (scale + 1) * longer <= DIP_MAX_FRAME_SIZE) {
        scale++;
    }
    return scale * longer <= DIP_MAX_FRAME_SIZE ? scale : 1;
}

// Averages blocks of scale x scale pixels in linear light, and adds the results to rgb_lin.
static void average(const DipFrame *frame, int scale, int width, int height, double *rgb_lin) {
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    const double share = 1.0 / (scale * scale);
    for (int y = 0; y < height * scale; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        double *out = rgb_lin + (size_t)(y / scale) * (size_t)width * 3;
        for (int x = 0; x < width * scale; x++) {
            for (int c = 0; c < 3; c++) {
                out[3 * (x / scale) + c] += share * table.linear[row[4 * x + c]];
            }
        }
    }
}

// Draws one half of the truth of a gallery scene. (A truth is the mean of two halves.) The
// reference renderer cannot draw such a scene. Instead, the pipeline draws it larger (scale_of),
// with 8 samples per pixel and advanced AF, and the pixels are averaged in linear light. Each half
// has at least def->samples samples for each pixel, unless the frame would then be wider or higher
// than DIP_MAX_FRAME_SIZE. If twice the truth's width or height is already above
// DIP_MAX_FRAME_SIZE, the scene is drawn at the truth's own size. The truth cannot show a fault
// that the pipeline has at every size. The two halves have different sample patterns.
static bool draw_gallery_truth(const DipTruthDef *def, int half, double *rgb_lin, DipError *err) {
    const DipCostContext *cost = def->context;
    const int scale = scale_of(def);
    DipGalleryPaneDef pane_def = {.gallery = cost->gallery,
                                  .isa = cost->session->isa,
                                  .width = def->width * scale,
                                  .height = def->height * scale};
    DipFrame frame;
    if (!dip_quality_parse("aa=8,taa=on,af=16,aaf=on", &pane_def.quality, err)) {
        return false;
    }
    DipGalleryPane *pane = dip_gallery_pane_create(&pane_def, err);
    if (!pane) {
        return false;
    }
    dip_gallery_pane_set_frame_index(pane, (uint64_t)half);
    const bool drawn = dip_gallery_pane_draw(pane, &def->pose, def->time_ns, &frame, err);
    if (drawn) {
        average(&frame, scale, def->width, def->height, rgb_lin);
    }
    dip_gallery_pane_destroy(&pane);
    return drawn;
}

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return !dip_interrupted();
}

bool dip_cost_context_truth(DipCostContext *cost, int path, int viewpoint, int frame,
                            DipTruthProgress *progress, void *context, DipTruth *truth,
                            DipError *err) {
    const DipCostReport *report = cost->report;
    const int64_t time_ns =
        dip_cost_viewpoint_time_ns(report, cost->session, path, viewpoint, frame);
    const DipTruthDef def = {
        .reference = cost->reference,
        .draw = cost->gallery ? draw_gallery_truth : NULL,
        .context = cost,
        .scene_hash = report->scene_hash,
        .pose = dip_cost_pose(report, cost->session, path, time_ns),
        .time_ns = time_ns,
        .width = report->width,
        .height = report->height,
        .samples = report->options.samples,
        .pixels_per_degree = report->options.pixels_per_degree,
    };
    const char *cache = cost->cache && cost->cache[0] ? cost->cache : NULL;
    const bool got = dip_truth_get(truth, &def, cache, cost->session->pool,
                                   progress ? progress : go_on, context, err);
    if (!got) {
        dip_cost_interrupted(cost, err); // After Ctrl-C, the error says how to continue.
    }
    return got;
}

const char *dip_cost_interrupted_text(const DipCostContext *cost) {
    return cost->journal ? "interrupted; run the same command again to continue" : "interrupted";
}

bool dip_cost_interrupted(const DipCostContext *cost, DipError *err) {
    return dip_interrupted() && !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost", "%s",
                                               dip_cost_interrupted_text(cost));
}
