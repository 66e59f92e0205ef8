// Makes the pictures of the HTML page. There is a set for each sweep (all steps of one setting),
// and a set for the front: the advised combinations and those on the Pareto front of time and
// error, as many as a set has room for. A set shows several rows of a report at one viewpoint,
// beside the truth (the converged picture). A row is one combination of settings on a camera path.
#ifndef DIP_APP_REPORT_PAGE_REPORT_PICTURES_H
#define DIP_APP_REPORT_PAGE_REPORT_PICTURES_H

#include "app/report/report.h"

#include <stdint.h>

enum {
    DIP_COST_CROP_WIDTH = 200,  // Greatest width of a crop, in pixels.
    DIP_COST_CROP_HEIGHT = 150, // Greatest height of a crop, in pixels.
    DIP_COST_SET_ROWS = 24,     // Greatest number of rows in a set of pictures.
    DIP_COST_FRAME_QUALITY = 95 // Quality of the JPEG files of whole frames, 1..100.
};

// The pictures of one row as data URIs; NULL for a picture that the page lacks. All are owned.
typedef struct DipCostPicture {
    int row;     // Row of the report; -1 for the truth.
    char *crop;  // Part of the picture, PNG.
    char *map;   // FLIP map of the same part against the truth, PNG; the truth has none.
    char *frame; // Whole frame, JPEG.
} DipCostPicture;

// The crops of a set show the same rectangle: the part in which the rows differ most.
typedef struct DipCostPictureSet {
    DipCostPicture truth;
    DipCostPicture pictures[DIP_COST_SET_ROWS];
    int count;      // Number of rows; 0 if no pictures were made for the set.
    int path;       // Index of the camera path in the report.
    int viewpoint;  // Index of the viewpoint on the path.
    int x;          // Left edge of the crops, in pixels.
    int y;          // Top edge of the crops, in pixels.
    int crop_width; // Pixels.
    int crop_height;
} DipCostPictureSet;

// Provides the frames of the sets.
typedef struct DipCostFrameSource {
    void *context;
    // Writes the packed rgba8 pixels of a row's frame, or of the truth if `row` is -1, at the
    // viewpoint of the set. Fills *err if it returns false.
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

// Gets a frame of every row of the sets, at the run's middle viewpoint. Cuts out the crops and,
// with --pictures full, also keeps whole frames. Leaves out pictures that do not fit in a page.
// With --pictures none, makes no pictures.
bool dip_cost_pictures_make(DipCostPictures *pictures, const DipCostReport *report,
                            const DipCostFrameSource *source, DipError *err);
void dip_cost_pictures_free(DipCostPictures *pictures);

// Frees the pictures that do not fit in `room` bytes, and counts their rows. First keeps as many
// crops as fit, beginning with the sweeps. Then lets whole frames take the place of crops as far as
// they fit, beginning with the front.
void dip_cost_pictures_fit(DipCostPictures *pictures, double room);

// Returns "data:TYPE;base64,..." for a file's bytes (RFC 4648). The caller frees it. Returns NULL
// when memory runs out.
char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes);

#endif
