// Declares the painter, which draws one pane of a session. If the session shows models, the painter
// uses a scene renderer (renderer.h). If the session shows a scene of the gallery, whose scenes are
// written in code, the painter uses a DipGalleryPane (app/gallery). Both take the same settings and
// give the same kind of frame.
#ifndef DIP_APP_SESSION_PAINTER_H
#define DIP_APP_SESSION_PAINTER_H

#include "app/gallery/gallery.h"
#include "renderer/scene/renderer.h"

typedef struct DipPainter DipPainter;

// Makes a painter that draws `gallery`, or models if `gallery` is NULL. The gallery is borrowed and
// must outlive the painter. Fails as dip_renderer_create or dip_gallery_pane_create does.
DipPainter *dip_painter_create(const DipRendererDef *def, DipGallery *gallery, DipError *err);
// *painter may be NULL and becomes NULL.
void dip_painter_destroy(DipPainter **painter);

// The functions below do what the renderer's functions of the same name do (renderer.h).
bool dip_painter_set_quality(DipPainter *painter, const DipQuality *quality, DipError *err);
bool dip_painter_resize(DipPainter *painter, int width, int height, DipError *err);
DipQuality dip_painter_quality(const DipPainter *painter);
void dip_painter_set_frame_index(DipPainter *painter, uint64_t frame_index);
// Does nothing in a pane of the gallery, which has no history.
void dip_painter_cut(DipPainter *painter);
// Does nothing in a pane of the gallery, which never copies pixels from another pane.
void dip_painter_copy_shading(DipPainter *painter, bool on);

// Fails with UNSUPPORTED if the painter draws a scene of the gallery.
bool dip_painter_record_tiles(DipPainter *painter, bool on, DipError *err);

// A pane of the gallery has flat mip colours only and ignores the pictures.
bool dip_painter_set_mip_pictures(DipPainter *painter,
                                  const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                  DipError *err);

// Draws a frame. `scene` is the scene of the models; a painter of the gallery ignores it.
bool dip_painter_draw(DipPainter *painter, const DipScene *scene, const DipPose *pose,
                      int64_t time_ns, DipFrame *frame, DipError *err);

// Reads samples of the frame that was drawn last (renderer.h). Fails with UNSUPPORTED if the
// painter draws a scene of the gallery.
bool dip_painter_read_samples(DipPainter *painter, const DipScene *scene, const DipPose *pose,
                              int64_t time_ns, const DipSampleReadback *readback, DipError *err);

// Draws one frame with each of `count` painters, 1..DIP_MAX_FRAMES_AT_ONCE. Either all of them draw
// models, or all draw the gallery.
bool dip_painter_draw_frames(DipPainter *const *painters, int count, const DipScene *scene,
                             const DipPose *pose, int64_t time_ns, DipFrame *const *frames,
                             DipError *err);

#endif
