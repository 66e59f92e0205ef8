// What the filters share: the state of a DipPost, its memory, and planes of values.
#ifndef DIP_RENDERER_POST_FILTERS_FILTER_H
#define DIP_RENDERER_POST_FILTERS_FILTER_H

#include "renderer/post/filters/post_kernels.h"
#include "renderer/post/filters/smaa_areas.h"
#include "renderer/post/post.h"

// A task filters a band of this many rows of the result.
enum { DIP_POST_BAND = 16 };

// A plane of values with DIP_POST_BORDER values on each side and as many rows above and below.
typedef struct DipPostPlane {
    float *at;  // value of pixel (0, 0)
    int stride; // values from one row to the next
} DipPostPlane;

// A bit for each pixel of a picture, with a border of zeros: DIP_POST_MARGIN rows above and below,
// and a word before each row and two after it.
enum { DIP_POST_MARGIN = 4 };
typedef struct DipPostBits {
    uint64_t *at; // word of pixel (0, 0)
    int stride;   // words from one row to the next
} DipPostBits;

// Memory from which a filter takes its parts. The first time, without memory, it only counts them.
typedef struct DipPostArena {
    uint8_t *memory;
    size_t used;
} DipPostArena;

// Returns the next part, aligned to a cache line; NULL while the arena only counts. If size_t
// cannot hold the sum, which happens with 32 bits, `used` becomes SIZE_MAX and stays so.
void *dip_post_take(DipPostArena *arena, size_t count, size_t item_bytes);
DipPostPlane dip_post_take_plane(DipPostArena *arena, int width, int height);

// Rows of values in the memory of one worker.
typedef struct DipPostWindow {
    float *at; // first value of the first row, after its border
    int stride;
    int row_count;
} DipPostWindow;

DipPostWindow dip_post_take_window(DipPostArena *arena, int width, int row_count);

struct DipPost {
    DipPostDef def;
    const DipPostKernels *kernels;
    void *memory;
    size_t bytes;
    int worker_count;

    // The pictures of the current run.
    const uint8_t *from;
    size_t from_stride_bytes;
    uint8_t *to;
    size_t to_stride_bytes;

    // Memory of the filters that are antialiasing.
    DipPostPlane luma;
    uint32_t **edge_lists;  // of each worker
    uint64_t *edges_found;  // of each worker, in the current run
    DipPostBits edges_left; // pixels with an edge at their left side
    DipPostBits edges_top;
    DipPostBits edges_left_by_y; // the same, transposed
    DipPostBits edges_top_by_y;
    uint32_t *weights; // of SMAA, (height + 1) * (width + 1)
    DipSmaaAreas *areas;

    // Memory of the filters that enlarge or sharpen.
    DipPostWindow *channels[3]; // of each worker: rows of the source
    DipPostWindow *spread[3];   // the same rows with the width of the result
    DipPostWindow *lumas;
    DipPostWindow *shapes[3];
    DipPostPlaces places_x;
    DipPostPlaces places_y;
    float *weights_x[4];
    float *weights_y[4];
    float *light; // linear light of the 256 codes
    DipSrgbEncodeTable *srgb;
};

// A filter: how it takes its memory, how it fills what never changes, and how it runs.
typedef struct DipPostKind {
    void (*take)(DipPost *post, DipPostArena *arena);
    void (*prepare)(DipPost *post);
    void (*run)(DipPost *post);
} DipPostKind;

extern const DipPostKind dip_post_fxaa;
extern const DipPostKind dip_post_smaa;
extern const DipPostKind dip_post_sharpen;
extern const DipPostKind dip_post_separable; // bilinear and bicubic
extern const DipPostKind dip_post_easu;

// Runs a task for each band of `rows` rows: task(post, band, worker).
void dip_post_run_bands(DipPost *post, int rows, DipTask task);

// Returns the pixels of a row of the source; rows beyond its borders are the nearest rows.
const uint8_t *dip_post_row(const DipPost *post, int y);

// Repeats the first and the last value of a row into its borders.
void dip_post_extend_row(float *row, int width);

// Fills the plane of luma: the sum of the codes 0..1 with these weights.
void dip_post_fill_luma(DipPost *post, const float weights[3]);

// Takes the memory for the rows of the source that a band needs: `more` rows more than the band.
void dip_post_take_channels(DipPost *post, DipPostArena *arena, int row_count);

// Unpacks row y of the source into row `slot` of a worker's windows, in linear light or as codes.
void dip_post_unpack(DipPost *post, int worker, int slot, int y, bool linear);

static inline float *dip_post_window_row(const DipPostWindow *window, int row) {
    return window->at + (ptrdiff_t)row * window->stride;
}

#endif
