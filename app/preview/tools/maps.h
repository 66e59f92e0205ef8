// Makes the maps: pictures over each pane that show where the pane's error lies and where its work
// goes.
//
// The FLIP map comes from the thread that measures errors (error_thread.h). The other maps come
// from a separate painter (DipMaps.painter), which draws each pane's frame again while camera and
// scene rest. This painter records the tiles, or draws in mip colours. The panes' own frames are
// drawn as always and take no more time.
#ifndef DIP_APP_PREVIEW_TOOLS_MAPS_H
#define DIP_APP_PREVIEW_TOOLS_MAPS_H

#include "app/preview/live/error_thread.h"
#include "app/preview/state/tool_state.h"
#include "app/preview/tools/kept.h"
#include "app/preview/tools/map_colours.h"
#include "app/preview/tools/tools_input.h"
#include "app/ui/pixels.h"

// How often a frame is drawn for DIP_MAP_TIME, which shows the median time of each tile. Any other
// map needs at most one draw.
enum { DIP_MAP_DRAWS = 15 };

// What was measured of a pane's frame. The maps own the arrays, which are NULL until they are
// filled and valid until the next dip_maps_update.
typedef struct DipMapWork {
    // Number of draws with records so far, 0..DIP_MAP_DRAWS. The draw for `mips` does not count.
    int draws;
    int width;              // Width of the frame, in pixels.
    int height;             // Height of the frame, in pixels.
    int across;             // Number of tiles from left to right.
    int down;               // Number of tiles from top to bottom.
    DipTileRecord *records; // Counters and times of each tile in the last draw.
    double *draws_ms;       // Times of the draws: DIP_MAP_DRAWS values for each tile.
    double *ms;             // Median time of each tile, on the worker that drew it.
    uint8_t *mixed;         // Copy of DipFrameTiles.mixed: the pixels whose samples differ.
    uint8_t *mips;          // The frame in mip colours, rows packed.
    double geometry_ms;     // Time that the last draw took for the geometry of the main pass.
    double mirrored_ms;     // Time that the last draw took for the passes before the main pass: the
                            // shadow map, and the mirrored scene in a reflection.
} DipMapWork;

typedef enum DipMapOver {
    DIP_MAP_OVER_BOTH,
    DIP_MAP_OVER_CURRENT,
    DIP_MAP_OVER_REQUESTED
} DipMapOver;

typedef struct DipMapView {
    DipMapOver over;
    bool pointed; // The pointer is over a pane.
    int x;        // Column of the pixel under the pointer.
    int y;        // Row of that pixel.
} DipMapView;

// Everything that decides what the panes' frames show and how they are drawn.
typedef struct DipMapKey {
    DipPose pose;
    int64_t play_ns;
    const void *scene;
    const void *gallery;
    DipQuality quality[DIP_PANE_COUNT];
    uint64_t versions[DIP_PANE_COUNT];
    int width;
    int height;
    bool copied; // Both panes show one frame, which is measured only once.
} DipMapKey;

// The memory of the maps; zero-initialise. While the window is drawn, the maps' tab sets `wanted`.
// The tab reads `errors`, and keeps its choices in `view`.
typedef struct DipMaps {
    DipMap wanted;       // The map that the window showed last, over the panes or in tables.
    DipPainter *painter; // Draws the panes' frames again; NULL until a map needs it.
    DipMapKey key;
    bool failed;         // A frame that `key` describes could not be drawn or measured.
    uint64_t generation; // Grows whenever a measurement of work is added or dropped.
    DipMapWork panes[DIP_PANE_COUNT];
    DipErrorReading reading;
    const DipErrorPictures *errors; // Borrowed; NULL if there are none.
    DipPixels truth;
    DipKeptPicture pictures[DIP_PANE_COUNT];
    DipMapView view;
} DipMaps;

void dip_maps_free(DipMaps *maps);

// --- what the preview's loop calls ---------------------------------------------------------------

// Returns whether a tool shows errors or the truth (the converged picture), so that the loop must
// measure errors at rest.
bool dip_maps_need_errors(const DipToolState *tools);

// Gives the maps the newest errors. pictures: borrowed until the next call; NULL if no error was
// measured yet. The loop calls this function before it draws the window.
void dip_maps_set_errors(DipMaps *maps, const DipErrorReading *reading,
                         const DipErrorPictures *pictures);

// Returns the truth as a picture, or NULL if the truth is not known. The picture is valid until the
// next call of dip_maps_set_errors. Sets *version to the picture's version (dip_draw_list_picture),
// which differs from the versions of all frames.
const DipPixels *dip_maps_truth(DipMaps *maps, uint64_t *version);

// Draws at most one frame for the map that the window showed last (DipMaps.wanted), if nothing
// moves. Returns whether the window must be drawn again. Runs on the thread that draws frames.
bool dip_maps_update(DipMaps *maps, const DipToolsInput *input);

// --- what is known about the panes ---------------------------------------------------------------

// Returns what was measured of the frame that a pane showed when camera and scene rested last.
const DipMapWork *dip_maps_work(const DipMaps *maps, int pane);

// Returns the index of the tile that holds a pixel.
int dip_map_tile(const DipMapWork *work, int x, int y);

// Returns the number of a tile's pixels that lie inside the frame.
int dip_map_tile_pixels(const DipMapWork *work, int tile);

// Returns the value of a tile in a map: milliseconds for TIME, a mean per pixel for FRAGMENTS and
// PROBES, the share of mixed pixels for SAMPLES.
double dip_map_value(const DipMapWork *work, DipMap map, int tile);

// Returns the value at the end of the chosen map's colour scale, which is the same for both panes.
double dip_maps_end(const DipMaps *maps, const DipToolState *tools);

// --- pictures ------------------------------------------------------------------------------------

// Makes the picture of the chosen map for a pane, in the size of `frame`. Returns false if the
// map's values are not known (yet). frame: the pane's picture, which shows dimly through maps of
// work. *picture is valid until the next call for the pane.
bool dip_maps_picture(DipMaps *maps, const DipToolState *tools, int pane, const DipPixels *frame,
                      uint64_t frame_version, DipPixels *picture, uint64_t *version);

// Returns a line that says why a pane has no map or what the map still waits for; "" if the map is
// final. The line is a constant or lies in `text`. gallery: the panes show a scene of the gallery.
// still: camera and scene rest.
const char *dip_maps_status(const DipMaps *maps, DipMap map, int pane, bool gallery, bool still,
                            char *text, size_t size_bytes);

// Returns whether the values of a pane's map are known or will be known once camera and scene rest.
// The parameters are those of dip_maps_status, which says why not.
bool dip_maps_can_measure(const DipMaps *maps, DipMap map, int pane, bool gallery, bool still);

// Returns the index of the colour (dip_map_mip_colour) that is most like a pixel of the map
// DIP_MAP_MIPS, or -1 if no colour is similar or the map is not known. Light may dim the pixel's
// colour, and colours of two levels mix where levels are blended.
int dip_maps_mip_index(const DipMaps *maps, int pane, int x, int y);

// Returns one of the colours that stand for sizes of mip levels. The colour `index` (0..7) stands
// for levels whose side has at least 1024 >> index texels, but less than twice as many. Colour 0
// also stands for all larger levels, colour 7 for all smaller ones.
DipColour dip_map_mip_colour(int index);

// Writes the size for which a colour stands: "≥1024", "512", ..., "≤8".
enum { DIP_MIP_TEXT_BYTES = 16 };
void dip_map_mip_text(int index, char text[DIP_MIP_TEXT_BYTES]);

#endif
