// Implements the loupe: finds the pixels that it shows enlarged and where the panes mark these
// pixels, reads the pixels' samples, and draws the loupe's pictures.
//
// The loupe looks at one pixel of both panes. Below each pane, the dock shows two pictures. The
// crop has the pixels around the looked-at pixel, each as a square of `zoom` x `zoom` pixels of the
// window. The box is a larger square for the looked-at pixel alone, with the pixel's samples.
#ifndef DIP_APP_PREVIEW_TOOLS_LOUPE_H
#define DIP_APP_PREVIEW_TOOLS_LOUPE_H

#include "app/preview/state/tool_state.h"
#include "app/preview/tools/kept.h"
#include "app/preview/tools/tools_input.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/readback.h"

// --- arithmetic --------------------------------------------------------------------------------

// The crop: the part of a picture that the loupe shows. The looked-at pixel lies in the middle.
// Beyond the picture's edges, the crop shows no pixels.
typedef struct DipLoupeCrop {
    DipRect source; // Pixels of the picture that show; empty if the area has no room for one
                    // enlarged pixel.
    DipRect shown;  // Where `source` shows, in pixels of the window.
    DipRect pixel;  // Where the looked-at pixel shows, in pixels of the window.
    DipRect frame;  // Where the whole crop lies, with its part beyond the picture's edges.
    int zoom;
} DipLoupeCrop;

// Returns what a loupe at pixel x, y of a picture shows in an area of the window. The number of
// columns and of rows is odd, and the largest that fits the area.
DipLoupeCrop dip_loupe_crop(int width, int height, int x, int y, int zoom, DipRect area);

// Finds the pixel of a picture of width x height pixels that the window shows at window_x,
// window_y, if the picture is scaled to the rectangle `shown` as dip_canvas_copy does. Returns
// false if the rectangle does not hold the position.
bool dip_loupe_pixel_at(DipRect shown, int width, int height, int window_x, int window_y, int *x,
                        int *y);

// Returns the rectangle of the window that shows the pixels `source` of a picture, if the picture
// is scaled to the rectangle `shown`. If the picture is scaled down, the rectangle may be empty.
DipRect dip_loupe_mark(DipRect shown, int width, int height, DipRect source);

// Pins the loupe, and moves it by whole pixels within a picture of width x height pixels.
void dip_loupe_move(DipToolState *tools, int dx, int dy, int width, int height);

// Keeps the looked-at pixel within pictures of width x height pixels. A pixel below 0 becomes the
// picture's middle.
void dip_loupe_keep_inside(DipToolState *tools, int width, int height);

// Returns whether the loupe is in use: the user has switched it on, or its tab is open.
bool dip_loupe_is_on(const DipToolState *tools);

// How the samples of a pixel are divided among surface patches (readback.h).
typedef struct DipSampleCount {
    int front;   // Number of samples that show the patch nearest to the eye.
    int patches; // Number of distinct patches. The background counts as a patch.
    int colours; // Number of distinct colours. Samples that were shaded together have one colour.
} DipSampleCount;

// Counts the samples of a pixel. samples: the pixel's `count` samples from a readback (readback.h).
DipSampleCount dip_loupe_count(const DipSampleValue *samples, int count);

// Returns whether a sample shows the patch that is nearest to the eye.
bool dip_loupe_is_front(const DipSampleValue *samples, int count, int sample);

// --- memory ------------------------------------------------------------------------------------

typedef struct DipPaneSamples {
    DipSampleValue *samples; // Owned.
    size_t capacity;         // Number of entries for which `samples` has room.
    bool tried;              // Reading the samples has been tried for `version` and `region`.
    bool known;              // Reading succeeded.
    uint64_t version;        // Version of the pane's picture.
    DipTargetRegion region;
    const DipSamplePattern *pattern;
    DipKeptPicture crop;
    DipKeptPicture box;
} DipPaneSamples;

typedef struct DipLoupe {
    DipSrgbDecodeTable decode;
    DipSrgbEncodeTable encode;
    DipTargetRegion wanted;
    uint64_t frame_index; // Index of the panes' newest frame, as in DipToolsInput.
    unsigned generation;  // Grows whenever reading samples is tried.
    DipPaneSamples panes[DIP_PANE_COUNT];
} DipLoupe;

void dip_loupe_free(DipLoupe *loupe);

// Tells the loupe that the crops and boxes need the samples of the pixels in a region. The loupe's
// tab calls this function while the window is drawn.
void dip_loupe_want(DipLoupe *loupe, DipTargetRegion region);

// Reads the wanted samples of both panes if the loupe is on, the pictures are still, and reading
// was not tried for these pictures yet. Returns whether new samples are known. After a failure, the
// samples stay unknown.
bool dip_loupe_update(DipLoupe *loupe, const DipToolsInput *input);

// Returns the samples of a pane's pixel, and sets *pattern to their sample pattern. Returns NULL if
// they are not known for the picture with this version.
const DipSampleValue *dip_loupe_samples(const DipLoupe *loupe, int pane, uint64_t version, int x,
                                        int y, const DipSamplePattern **pattern);

// Returns the sample pattern with which a pane with these settings draws the newest frame.
const DipSamplePattern *dip_loupe_pattern(const DipLoupe *loupe, const DipQuality *quality);

// Return a sample's colour, and the linear light (0 to 1) of a code of 8-bit sRGB.
DipColour dip_loupe_colour(const DipLoupe *loupe, const DipSampleValue *sample);
double dip_loupe_linear(const DipLoupe *loupe, uint8_t code);

// --- pictures ----------------------------------------------------------------------------------

// What the crop of a pane shows.
typedef struct DipCropContent {
    DipPixels frame;
    uint64_t version;
    DipLoupeCrop crop;
} DipCropContent;

// Least zoom at which the crop marks samples. At smaller zooms, the marks would hide the pixels.
enum { DIP_LOUPE_MARKS_ZOOM = 16 };

// Draws the enlarged pixels of a pane. From DIP_LOUPE_MARKS_ZOOM on, marks the known samples of
// pixels that show several patches. *picture has the size of crop.frame and is valid until the next
// call for the pane. Returns false if memory runs out.
bool dip_loupe_crop_picture(DipLoupe *loupe, int pane, const DipCropContent *content,
                            DipPixels *picture, uint64_t *version);

// What the box shows: one pixel as a square with its samples.
typedef struct DipBoxContent {
    DipColour pixel;
    const DipSamplePattern *pattern;
    const DipSampleValue *samples; // pattern->count entries, or NULL if they are not known.
    int side;                      // Width and height of the box, in pixels of the window.
} DipBoxContent;

// Draws the box: the pixel's colour, a grid, and a disc with the sample's colour at each sample's
// position. Samples of the nearest patch have a solid ring, other samples a dashed ring. If the
// samples are not known, all discs have the pixel's colour and a solid ring. Returns false if
// memory runs out. *picture is valid until the next call for the pane.
bool dip_loupe_box_picture(DipLoupe *loupe, int pane, const DipBoxContent *content,
                           DipPixels *picture, uint64_t *version);

// Returns where the box shows the middle of a sample, in pixels from the box's top left corner.
void dip_loupe_box_position(const DipSamplePattern *pattern, int side, int sample, int *x, int *y);

#endif
