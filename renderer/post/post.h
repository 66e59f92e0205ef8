// Filters of finished pictures: antialiasing, enlarging and sharpening, as panels and games offer
// them.
//
// A DipPost applies one filter to pictures of one size. A chain of filters is several of them, each
// with a picture between it and the next. A filter reads and writes 8-bit sRGB; the result is the
// same to the bit on every machine, with every instruction set and any number of threads.
// docs/post.md defines the filters and names their sources.
#ifndef DIP_RENDERER_POST_POST_H
#define DIP_RENDERER_POST_POST_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The filters. X(name, NAME, "what it does")
//
// fxaa, smaa: Antialiasing of a picture that is drawn already. Both look for edges in the picture's
//     codes. fxaa is FXAA 3.11 with the quality preset 12; smaa is SMAA 1x with the preset "high".
// sharpen: RCAS, the sharpening of FSR 1: five pixels each, limited so that nothing overshoots.
// bilinear, bicubic: Enlarging in linear light by two or four pixels along each axis. bicubic is
//     Catmull-Rom, clamped to the range of the four nearest pixels.
// easu: Enlarging along edges, the upscaling of FSR 1: twelve pixels of codes each.
#define DIP_POST_LIST(X)                                                                           \
    X(fxaa, FXAA, "fast approximate antialiasing")                                                 \
    X(smaa, SMAA, "subpixel morphological antialiasing")                                           \
    X(sharpen, SHARPEN, "sharpening that follows the contrast")                                    \
    X(bilinear, BILINEAR, "enlarging by the four nearest pixels")                                  \
    X(bicubic, BICUBIC, "enlarging by sixteen pixels")                                             \
    X(easu, EASU, "enlarging along edges")

typedef enum DipPostFilter {
#define DIP_POST_ENUM(name, NAME, text) DIP_POST_##NAME,
    DIP_POST_LIST(DIP_POST_ENUM)
#undef DIP_POST_ENUM
        DIP_POST_COUNT
} DipPostFilter;

// Returns the name of a filter: "fxaa", or "?" for any other number. Static storage.
DIP_API const char *dip_post_name(DipPostFilter filter);
// Sets *filter to the filter with exactly this name. Returns false if there is none.
DIP_API bool dip_post_parse(const char *name, DipPostFilter *filter);
// Returns whether the filter may give a picture of another size than that of its source.
DIP_API bool dip_post_enlarges(DipPostFilter filter);

enum { DIP_MAX_POST_SIZE = 16384 }; // largest width and height, in pixels

typedef struct DipPostDef {
    DipPostFilter filter;
    int from_width; // size of the source, 1..DIP_MAX_POST_SIZE pixels
    int from_height;
    int to_width;    // size of the result; only a filter that enlarges may have another one,
    int to_height;   // which is then at least as wide and as high as the source
    float sharpness; // 0..1, for sharpen: 0 changes nothing, 1 is the strongest
    DipIsa isa;      // an instruction set that this machine has (dip_isa_available)
    DipPool *pool;   // borrowed, must outlive the DipPost; NULL: the caller's thread works alone
} DipPostDef;

// A filter with its working memory. Use it on one thread at a time.
typedef struct DipPost DipPost;

// Makes a filter. Fails with UNKNOWN (the filter), RANGE (a size, or sharpness), UNSUPPORTED (the
// instruction set) or MEMORY; err may be NULL.
DIP_API DipPost *dip_post_create(const DipPostDef *def, DipError *err);
// *post may be NULL and becomes NULL.
DIP_API void dip_post_destroy(DipPost **post);
// Bytes of working memory that the filter holds.
DIP_API size_t dip_post_bytes(const DipPost *post);

// What a run did.
typedef struct DipPostWork {
    uint64_t pixels_filtered; // pixels of the result
    uint64_t edges_found;     // pixels at which fxaa or smaa found an edge; 0 for other filters
} DipPostWork;

// Filters a picture of 8-bit sRGB pixels with alpha, the top row first. The stride of a picture is
// the number of bytes from one row to the next, at least 4 * width. The pictures may not overlap.
// Filters that enlarge write the alpha 255, the others keep each pixel's alpha. Allocates nothing
// and cannot fail.
DIP_API DipPostWork dip_post_run(DipPost *post, const uint8_t *from_rgba8, size_t from_stride_bytes,
                                 uint8_t *to_rgba8, size_t to_stride_bytes);

#ifdef __cplusplus
}
#endif

#endif
