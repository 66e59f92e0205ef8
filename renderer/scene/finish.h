// Finishing a frame: what the settings do to a picture after it is drawn. These are blending it
// with the frames before it (taa=history), antialiasing of the finished picture (post), enlarging
// it (upscale, with a scale below 1), and sharpening. renderer/post/ has the filters.
#ifndef DIP_RENDERER_SCENE_FINISH_H
#define DIP_RENDERER_SCENE_FINISH_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/post/history.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The filters of one pane. Use it on one thread at a time.
typedef struct DipFinish DipFinish;

// The pool is borrowed and must outlive the DipFinish; NULL: the caller's thread works alone. isa:
// an instruction set that this machine has (dip_isa_available). Fails with MEMORY.
DIP_API DipFinish *dip_finish_create(DipPool *pool, DipIsa isa, DipError *err);
// *finish may be NULL and becomes NULL.
DIP_API void dip_finish_destroy(DipFinish **finish);

// The sizes of the picture that is drawn and of the frame that is made of it, in pixels. They
// differ only with a scale below 1; a larger picture is averaged before.
typedef struct DipFinishSize {
    int drawn_width;
    int drawn_height;
    int width;
    int height;
    // The size of the picture that has depths: with a scale above 1, that of the larger picture.
    int depths_width;
    int depths_height;
} DipFinishSize;

// Returns the sizes for frames of width x height pixels. quality: settings that dip_quality_check
// accepts, as for dip_finish_follow.
DIP_API DipFinishSize dip_finish_size(const DipQuality *quality, int width, int height);

// Makes the filters that these settings need for frames of this size, and frees all others, so that
// settings without filters take no memory. Does nothing if neither settings nor size have changed.
// Fails with RANGE (a size outside 1..DIP_MAX_POST_SIZE), UNSUPPORTED (the instruction set) or
// MEMORY; then no filter is left.
DIP_API bool dip_finish_follow(DipFinish *finish, const DipQuality *quality,
                               const DipFinishSize *size, DipError *err);

// Returns where the next frame stores its depths for the history, or NULL without a history. They
// belong to the picture whose depths' size dip_finish_follow was given, row by row without gaps.
DIP_API float *dip_finish_depths(DipFinish *finish);

// How a frame follows the frame before it; only a history uses it. See DipHistoryPicture.
typedef struct DipFinishMotion {
    DipHistoryStep step;
    float to_before[12];
} DipFinishMotion;

// Applies the filters to a frame whose pixels are the picture that was drawn, of the size that
// dip_finish_follow was given. Points the frame to the filtered picture, which the DipFinish owns
// until it is called again; adds to the counters of the filters, and adds the time to the frame's
// total. motion may be NULL, which means DIP_HISTORY_BEGIN. Allocates nothing.
DIP_API void dip_finish_frame(DipFinish *finish, const DipFinishMotion *motion, DipFrame *frame);

#ifdef __cplusplus
}
#endif

#endif
