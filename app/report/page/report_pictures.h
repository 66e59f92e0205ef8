// Pictures for the HTML page: a set for each sweep (all steps of one setting), and a set for the
// combinations in the Pareto front of time and error. A set shows several rows of a report at one
// viewpoint, beside the truth (the converged picture). A row is one combination of settings on a
// camera path.
#ifndef DIP_APP_REPORT_PAGE_REPORT_PICTURES_H
#define DIP_APP_REPORT_PAGE_REPORT_PICTURES_H

#include "app/report/report.h"

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

typedef struct DipCostPictures {
    DipCostPictureSet sweeps[DIP_COST_MAX_SWEEPS]; // In the order of the report's sweeps.
    DipCostPictureSet front;
    int crops_left_out;  // Number of rows whose crops did not fit in the page.
    int frames_left_out; // Number of rows whose whole frames did not fit, if they were asked for.
} DipCostPictures;

// The greatest size of a page, in bytes.
#define DIP_COST_PAGE_BYTES 10000000.0

// Gets a frame of every row of the sweeps and of the front, at the run's middle viewpoint, and cuts
// out the crops, or with --pictures full whole frames. Leaves out what does not fit in a page. With
// --pictures none, there are no pictures.
bool dip_cost_pictures_make(DipCostPictures *pictures, const DipCostReport *report,
                            const DipCostFrameSource *source, DipError *err);
void dip_cost_pictures_free(DipCostPictures *pictures);

// Frees the pictures that do not fit in `room` bytes and counts the rows concerned. Each row has
// its crop first, the sweeps before the front. Then whole frames take the place of crops, the front
// before the sweeps.
void dip_cost_pictures_fit(DipCostPictures *pictures, double room);

// Returns "data:TYPE;base64,..." for a file's bytes (RFC 4648). The caller frees it. Returns NULL
// when memory runs out.
char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes);

#endif
