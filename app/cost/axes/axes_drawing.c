// Making the renderers of the rows, and drawing with them.
#include "app/cost/axes/axes_drawing.h"

#include "app/cost/plan.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

// Returns the bytes that the program holds, as the C library's allocator counts them, or NAN.
static double allocated_bytes(void) {
#ifdef __GLIBC__
    const struct mallinfo2 info = mallinfo2();
    return (double)info.uordblks + (double)info.hblkhd;
#else
    return NAN;
#endif
}

bool dip_cost_axes_interrupted(DipError *err) {
    return dip_interrupted() &&
           !dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "cost axes", "interrupted");
}

// --- drawing -------------------------------------------------------------------------------------

bool dip_cost_axes_draw(DipCostAxesDrawing *drawing, int row, int64_t time_ns, int frame_index,
                        DipFrame *frame, DipError *err) {
    const DipCostAxisRow *r = &drawing->axes->rows[row];
    // The A/A row is the base again.
    const DipCostAxisDrawer *drawer = &drawing->drawers[r->axis == DIP_COST_AXIS_BASE ? 0 : row];
    const DipPose pose = dip_cost_pose(&drawing->axes->report, drawing->session, 0, time_ns);
    const int64_t begin_ns = dip_clock_ns();
    dip_painter_set_frame_index(drawer->painter, (uint64_t)frame_index);
    if (!dip_painter_draw(drawer->painter, drawing->session->scene, &pose, time_ns, frame, err)) {
        return false;
    }
    const int64_t drawn_ns = dip_clock_ns();
    drawing->draw_ms = 1e-6 * (double)(drawn_ns - begin_ns);
    drawing->enlarge_ms = 0.0;
    if (drawer->enlarger) {
        frame->rgba8 = dip_enlarger_run(drawer->enlarger, frame->rgba8, frame->stride_bytes);
        frame->width = r->shown_width;
        frame->height = r->shown_height;
        frame->stride_bytes = (size_t)r->shown_width * 4;
        drawing->enlarge_ms = 1e-6 * (double)(dip_clock_ns() - drawn_ns);
    }
    return true;
}

bool dip_cost_axes_draw_timed(DipCostAxesDrawing *drawing, int row, int index, DipFrame *frame,
                              DipError *err) {
    const DipCostReport *report = &drawing->axes->report;
    const int64_t time_ns = dip_cost_path_duration_ns(report, drawing->session, 0) /
                            dip_cost_frame_count(report) * index;
    return dip_cost_axes_draw(drawing, row, time_ns, index, frame, err);
}

// --- making the renderers ------------------------------------------------------------------------

static bool make_drawer(DipCostAxesDrawing *drawing, int row, DipError *err) {
    const DipSession *session = drawing->session;
    const DipCostAxisRow *r = &drawing->axes->rows[row];
    DipCostAxisDrawer *drawer = &drawing->drawers[row];
    DipPool *pool = drawer->pool ? drawer->pool : session->pool;
    const DipRendererDef def = {
        .pool = pool,
        .isa = r->isa,
        .width = r->width,
        .height = r->height,
        .quality = drawing->axes->report.options.baseline,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    if (session->shows_gallery) {
        drawer->gallery = dip_session_open_gallery(session, pool, r->isa, err);
        if (!drawer->gallery) {
            return false;
        }
    }
    drawer->painter = dip_painter_create(&def, drawer->gallery, err);
    if (drawer->painter && r->axis == DIP_COST_AXIS_SCALE) {
        const DipEnlargerDef enlarger = {r->width, r->height, r->shown_width, r->shown_height,
                                         pool};
        drawer->enlarger = dip_enlarger_create(&enlarger, err);
        return drawer->enlarger != NULL;
    }
    return drawer->painter != NULL;
}

// --- the first drawing ---------------------------------------------------------------------------

// The hashes of the base's pictures: [frame].
typedef char Hash[33];

typedef struct FirstDrawing {
    DipCostAxesDrawing *drawing;
    Hash *base_hashes;
    DipProgress progress;
    int64_t drawn;
} FirstDrawing;

static void count_work(DipCostReport *report, int row, const DipFrame *frame) {
    double *value = report->rows[row].counters;
#define ADD_COUNTER(name, text) *value++ += (double)frame->counters.name;
    DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
}

// Keeps the base's hash of a frame, or compares the row's with it.
static bool check_frame(FirstDrawing *first, int row, int index, const DipFrame *frame,
                        DipError *err) {
    DipCostAxes *axes = first->drawing->axes;
    Hash hash;
    if (!dip_cost_axes_has_base_picture(axes, row)) {
        return true;
    }
    dip_frame_hash(frame, hash);
    if (row == 0) {
        memcpy(first->base_hashes[index], hash, sizeof hash);
        return true;
    }
    axes->checked_pictures++;
    return dip_cost_axes_check_picture(axes, row, index, hash, first->base_hashes[index], err);
}

static bool draw_all(FirstDrawing *first, int row, DipError *err) {
    DipCostReport *report = &first->drawing->axes->report;
    const int frames = dip_cost_frame_count(report);
    for (int f = 0; f < frames; f++) {
        DipFrame frame;
        if (dip_cost_axes_interrupted(err) ||
            !dip_cost_axes_draw_timed(first->drawing, row, f, &frame, err) ||
            !check_frame(first, row, f, &frame, err)) {
            return false;
        }
        count_work(report, row, &frame);
        dip_progress_show(&first->progress, ++first->drawn);
    }
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        report->rows[row].counters[c] /= frames;
    }
    return true;
}

// Makes a row's renderer, and measures what the allocator hands out for it. The threads of a row
// are started before, because they are no part of a renderer.
static bool open_row(FirstDrawing *first, int row, DipError *err) {
    DipCostAxes *axes = first->drawing->axes;
    DipCostAxisRow *r = &axes->rows[row];
    if (row == axes->report.same_rows[0]) {
        r->memory_bytes = axes->rows[0].memory_bytes;
        return draw_all(first, row, err);
    }
    if (r->axis == DIP_COST_AXIS_THREADS) {
        first->drawing->drawers[row].pool = dip_pool_create(r->threads, err);
        if (!first->drawing->drawers[row].pool) {
            return false;
        }
    }
    const double before = allocated_bytes();
    if (!make_drawer(first->drawing, row, err) || !draw_all(first, row, err)) {
        return false;
    }
    const double grown = allocated_bytes() - before;
    r->memory_bytes = grown > 0.0 ? grown : NAN; // A sanitizer's allocator does not tell.
    return true;
}

bool dip_cost_axes_open_drawing(DipCostAxesDrawing *drawing, const DipSession *session,
                                DipCostAxes *axes, DipError *err) {
    const DipCostReport *report = &axes->report;
    const int64_t frames = dip_cost_frame_count(report);
    *drawing = (DipCostAxesDrawing){.session = session, .axes = axes};
    FirstDrawing first = {.drawing = drawing, .base_hashes = calloc((size_t)frames, sizeof(Hash))};
    bool opened = first.base_hashes ||
                  dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes", "out of memory");
    if (opened && session->scene && dip_quality_compresses(&report->options.baseline)) {
        opened = dip_scene_compress_textures(session->scene, session->pool, err);
        axes->scene_texture_bytes = (int64_t)dip_scene_texture_bytes(session->scene);
    }
    first.progress =
        dip_progress_begin("frames drawn for the first time", report->row_count * frames);
    for (int row = 0; opened && row < report->row_count; row++) {
        opened = open_row(&first, row, err);
    }
    dip_progress_end(&first.progress, first.drawn);
    free(first.base_hashes);
    if (!opened) {
        dip_cost_axes_close_drawing(drawing);
    }
    return opened;
}

void dip_cost_axes_close_drawing(DipCostAxesDrawing *drawing) {
    for (int row = 0; row < DIP_COST_AXES_MAX_ROWS; row++) {
        DipCostAxisDrawer *drawer = &drawing->drawers[row];
        dip_enlarger_destroy(&drawer->enlarger);
        dip_painter_destroy(&drawer->painter);
        dip_gallery_destroy(&drawer->gallery);
        dip_pool_destroy(&drawer->pool);
    }
}
