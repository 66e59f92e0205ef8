// Pictures of several rows of a report at one viewpoint, beside the truth (the converged picture).
// A row is one combination of settings on a camera path.
#ifndef DIP_APP_REPORT_PAGE_PICTURE_SET_H
#define DIP_APP_REPORT_PAGE_PICTURE_SET_H

#include "app/report/report.h"
#include "app/measure/metrics/flip.h"

#include <stdint.h>

enum {
    DIP_COST_CROP_WIDTH = 200,  // Pixels, at most.
    DIP_COST_CROP_HEIGHT = 150, // Pixels, at most.
    DIP_COST_SET_ROWS = 24,     // Rows in a set of pictures.
    DIP_COST_FRAME_QUALITY = 95 // Of the JPEG files of whole frames, 1..100.
};

// The pictures of one row as data URIs; NULL for a picture that the page lacks. All are owned.
typedef struct DipCostPicture {
    int row;     // Row of the report; -1: the truth.
    char *crop;  // Part of the picture, PNG.
    char *map;   // FLIP map of the same part against the truth, PNG; the truth has none.
    char *frame; // Whole frame, JPEG.
} DipCostPicture;

// The crops of a set show the same rectangle: the part in which the rows differ most.
typedef struct DipCostPictureSet {
    DipCostPicture truth;
    DipCostPicture pictures[DIP_COST_SET_ROWS];
    int count; // Number of rows; 0 if the set has no pictures at all.
    int path;
    int viewpoint;
    int x; // Upper left corner of the crops, pixels.
    int y;
    int crop_width; // Pixels.
    int crop_height;
} DipCostPictureSet;

// Where the frames of the sets come from: code that draws them.
typedef struct DipCostFrameSource {
    void *context;
    // Writes the packed rgba8 pixels of a row's frame, or those of the truth if `row` is -1.
    bool (*read)(void *context, const DipCostPictureSet *set, int row, uint8_t *rgba8,
                 DipError *err);
} DipCostFrameSource;

// Scratch memory for making sets, and the source of their frames.
typedef struct DipCostCutter {
    const DipCostReport *report;      // Borrowed.
    const DipCostFrameSource *source; // Borrowed.
    DipFlip flip;
    DipFlipAnalysis truth_side;
    uint8_t *truth;  // The truth's pixels, rgba8.
    uint8_t *frames; // Frames, [picture of the set][pixel], rgba8.
    uint8_t *maps;   // FLIP maps in 1/255, [picture of the set][pixel].
    float *map;      // FLIP map of one frame.
    uint8_t *crop;   // Crop of a FLIP map.
} DipCostCutter;

// `most_rows` is the greatest number of rows in a set. Fails with DIP_ERROR_MEMORY; the cutter is
// then closed.
bool dip_cost_cutter_open(DipCostCutter *cutter, const DipCostReport *report,
                          const DipCostFrameSource *source, int most_rows, DipError *err);
void dip_cost_cutter_close(DipCostCutter *cutter);

// Gets the rows' frames from the source and cuts their pictures out. The caller fills in set->path,
// set->viewpoint, set->count and the rows of set->pictures. `whole` asks for whole frames, too. On
// success the caller frees the set; on failure the set is empty.
bool dip_cost_picture_set_make(DipCostPictureSet *set, DipCostCutter *cutter, bool whole,
                               DipError *err);
void dip_cost_picture_set_free(DipCostPictureSet *set);

// Returns "data:TYPE;base64,..." for a file's bytes (RFC 4648). The caller frees it. Returns NULL
// when memory runs out.
char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes);

#endif
