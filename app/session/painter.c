// Passes the calls of a painter on to its scene renderer or to its pane of the gallery. Functions
// that a pane of the gallery lacks do nothing or fail.
#include "app/session/painter.h"

#include <stdlib.h>

struct DipPainter {
    DipRenderer *renderer; // Draws models; NULL if the painter draws the gallery.
    DipGalleryPane *pane;  // Draws the gallery; NULL if the painter draws models.
};

DipPainter *dip_painter_create(const DipRendererDef *def, DipGallery *gallery, DipError *err) {
    DipPainter *painter = calloc(1, sizeof *painter);
    if (!painter) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "renderer", "out of memory");
        return NULL;
    }
    if (gallery) {
        const DipGalleryPaneDef pane = {gallery, def->isa, def->width, def->height, def->quality};
        painter->pane = dip_gallery_pane_create(&pane, err);
    } else {
        painter->renderer = dip_renderer_create(def, err);
    }
    if (!painter->pane && !painter->renderer) {
        dip_painter_destroy(&painter);
    }
    return painter;
}

void dip_painter_destroy(DipPainter **painter_pointer) {
    DipPainter *painter = *painter_pointer;
    if (painter) {
        dip_renderer_destroy(&painter->renderer);
        dip_gallery_pane_destroy(&painter->pane);
        free(painter);
        *painter_pointer = NULL;
    }
}

bool dip_painter_set_quality(DipPainter *painter, const DipQuality *quality, DipError *err) {
    return painter->pane ? dip_gallery_pane_set_quality(painter->pane, quality, err)
                         : dip_renderer_set_quality(painter->renderer, quality, err);
}

bool dip_painter_resize(DipPainter *painter, int width, int height, DipError *err) {
    return painter->pane ? dip_gallery_pane_resize(painter->pane, width, height, err)
                         : dip_renderer_resize(painter->renderer, width, height, err);
}

DipQuality dip_painter_quality(const DipPainter *painter) {
    return painter->pane ? dip_gallery_pane_quality(painter->pane)
                         : dip_renderer_quality(painter->renderer);
}

void dip_painter_set_frame_index(DipPainter *painter, uint64_t frame_index) {
    if (painter->pane) {
        dip_gallery_pane_set_frame_index(painter->pane, frame_index);
    } else {
        dip_renderer_set_frame_index(painter->renderer, frame_index);
    }
}

void dip_painter_cut(DipPainter *painter) {
    if (painter->renderer) {
        dip_renderer_cut(painter->renderer);
    }
}

void dip_painter_copy_shading(DipPainter *painter, bool on) {
    if (painter->renderer) {
        dip_renderer_copy_shading(painter->renderer, on);
    }
}

bool dip_painter_record_tiles(DipPainter *painter, bool on, DipError *err) {
    if (painter->pane) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "tiles",
                             "scenes of the gallery do not record the work of their tiles");
    }
    return dip_renderer_record_tiles(painter->renderer, on, err);
}

bool dip_painter_set_mip_pictures(DipPainter *painter,
                                  const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                  DipError *err) {
    return painter->pane || dip_renderer_set_mip_pictures(painter->renderer, pictures, err);
}

bool dip_painter_draw(DipPainter *painter, const DipScene *scene, const DipPose *pose,
                      int64_t time_ns, DipFrame *frame, DipError *err) {
    return painter->pane ? dip_gallery_pane_draw(painter->pane, pose, time_ns, frame, err)
                         : dip_renderer_draw(painter->renderer, scene, pose, time_ns, frame, err);
}

bool dip_painter_read_samples(DipPainter *painter, const DipScene *scene, const DipPose *pose,
                              int64_t time_ns, const DipSampleReadback *readback, DipError *err) {
    if (painter->pane) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "samples",
                             "scenes of the gallery do not give their samples");
    }
    return dip_renderer_read_samples(painter->renderer, scene, pose, time_ns, readback, err);
}

bool dip_painter_draw_frames(DipPainter *const *painters, int count, const DipScene *scene,
                             const DipPose *pose, int64_t time_ns, DipFrame *const *frames,
                             DipError *err) {
    DipRenderer *renderers[DIP_MAX_FRAMES_AT_ONCE];
    if (painters[0]->pane) {
        bool drawn = true;
        for (int i = 0; drawn && i < count; i++) {
            drawn = dip_gallery_pane_draw(painters[i]->pane, pose, time_ns, frames[i], err);
        }
        return drawn;
    }
    for (int i = 0; i < count && i < DIP_MAX_FRAMES_AT_ONCE; i++) {
        renderers[i] = painters[i]->renderer;
    }
    return dip_renderer_draw_frames(renderers, count, scene, pose, time_ns, frames, err);
}
