// Temporal antialiasing with a history: each picture of a sequence is blended with what the
// pictures before it have shown at the same places of the scene.
//
// The caller shifts its camera by a different part of a pixel in every picture. While the camera
// moves, a DipHistory finds the place of each pixel in its last result, from the pixel's depth and
// the two cameras, limits the colour there to the colours around the pixel in the new picture, and
// keeps four fifths of it. While the camera and the scene are at rest, the result is the mean of
// the shifted pictures, which is supersampling. docs/post.md defines every step. The result is the
// same to the bit on every machine, with every instruction set and any number of threads.
#ifndef DIP_RENDERER_POST_HISTORY_H
#define DIP_RENDERER_POST_HISTORY_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    // Pictures after which a mean at rest is complete and changes no more. The caller's shifts
    // should repeat after this many pictures, and their mean should be 0.
    DIP_HISTORY_PICTURES = 16,
    // Pictures at rest after which a mean takes the place of a blended picture.
    DIP_HISTORY_HELD = 8,
};

typedef struct DipHistoryDef {
    int width; // size of the pictures, 1..DIP_MAX_POST_SIZE of post.h
    int height;
    DipIsa isa;    // an instruction set that this machine has (dip_isa_available)
    DipPool *pool; // borrowed, must outlive the DipHistory; NULL: the caller's thread works alone
} DipHistoryDef;

// The history of one sequence of pictures. Use it on one thread at a time.
typedef struct DipHistory DipHistory;

// Makes an empty history. Fails with RANGE (a size), UNSUPPORTED (the instruction set) or MEMORY;
// err may be NULL.
DIP_API DipHistory *dip_history_create(const DipHistoryDef *def, DipError *err);
// *history may be NULL and becomes NULL.
DIP_API void dip_history_destroy(DipHistory **history);
// Bytes of memory that the history holds.
DIP_API size_t dip_history_bytes(const DipHistory *history);

// How a picture follows the one before it.
typedef enum DipHistoryStep {
    DIP_HISTORY_BEGIN, // not at all: the history begins anew with it, as with the first picture
    DIP_HISTORY_MOVE,  // the camera or the scene has moved
    DIP_HISTORY_REST,  // it shows the same from the same camera, but for the shift
} DipHistoryStep;

// A picture of the sequence: 8-bit sRGB with alpha, the top row first.
typedef struct DipHistoryPicture {
    const uint8_t *rgba8;
    size_t stride_bytes;
    // The depth of each pixel, near / w; 0 is infinitely far. Rows follow each other without gaps.
    // If the depths have another size than the pictures, each pixel has the depth at its centre.
    // They are not read if the step is DIP_HISTORY_REST, and may then be NULL.
    const float *depths;
    int depths_width; // 1 or more
    int depths_height;
    // A row-major matrix of three rows. It takes (x, y, 1, depth), with x and y from -1 to 1, left
    // to right and bottom to top, to the place (x w, y w, w) of the same point in the picture
    // before. Both places are without the shifts.
    float to_before[12];
    DipHistoryStep step;
} DipHistoryPicture;

// What a run did.
typedef struct DipHistoryWork {
    uint64_t pixels_filtered;    // pixels of the result that were written
    uint64_t pixels_reprojected; // those among them that were blended with their past
} DipHistoryWork;

// Adds a picture to the history and writes the result, whose pixels have the alpha of the picture.
// The result may not overlap the picture. If the step is not DIP_HISTORY_BEGIN, the result must
// still hold the last one: it is left as it is while a picture at rest adds nothing, because the
// mean is complete, or because it has fewer than DIP_HISTORY_HELD pictures and the blended picture
// before it looks better. Allocates nothing and cannot fail.
DIP_API DipHistoryWork dip_history_add(DipHistory *history, const DipHistoryPicture *picture,
                                       uint8_t *to_rgba8, size_t to_stride_bytes);

#ifdef __cplusplus
}
#endif

#endif
