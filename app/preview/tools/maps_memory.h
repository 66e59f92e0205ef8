// The inside of the maps' memory, shared by the code that measures (maps.c) and the code that draws
// the maps' pictures (map_pictures.c).
#ifndef DIP_APP_PREVIEW_TOOLS_MAPS_MEMORY_H
#define DIP_APP_PREVIEW_TOOLS_MAPS_MEMORY_H

#include "app/preview/tools/map_colours.h"
#include "app/preview/tools/maps.h"

// Versions of pictures in the draw list. Frames count from 0, so no frame has these numbers.
#define DIP_MAP_TRUTH_VERSION   (UINT64_C(0x4d) << 56)
#define DIP_MAP_PICTURE_VERSION (UINT64_C(0x4e) << 56)

#define DIP_MAP_MAX_BRIGHTNESS 16.0

// What was measured of a pane's frame. The arrays are NULL until the frame has been drawn.
typedef struct DipPaneWork {
    DipMapWork work; // Points to the arrays below.
    DipTileRecord *records;
    double *draws_ms; // DIP_MAP_DRAWS times for each tile.
    double *ms;
    uint8_t *mixed;
    uint8_t *mips; // The frame in mip colours, rows packed.
    int mips_width;
    int mips_height;
} DipPaneWork;

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
    bool copied; // Both panes show one frame, which is measured once.
} DipMapKey;

// A map's picture, and what it was made from.
typedef struct DipMapPicture {
    uint8_t *rgba8; // Owned.
    size_t pixels;
    DipMap map;
    double end;
    uint64_t source; // Version of the values.
    uint64_t frame_version;
    int width;
    int height;
    bool made;
    uint64_t version;
} DipMapPicture;

struct DipMaps {
    DipMap wanted;       // The map that the window showed last.
    DipPainter *painter; // Draws what the panes show, with records; NULL until a map needs it.
    DipMapKey key;
    bool failed;         // The frames of the key could not be drawn.
    uint64_t generation; // Grows whenever something new is known about work.
    DipPaneWork panes[DIP_PANE_COUNT];
    DipErrorReading reading;
    const DipErrorPictures *errors; // Borrowed; NULL if there are none.
    DipPixels truth;
    DipMapPicture pictures[DIP_PANE_COUNT];
    uint64_t picture_count;
    DipMapView view;
};

// Returns what was measured of the frame that a pane shows.
const DipPaneWork *dip_maps_pane(const DipMaps *maps, int pane);

#endif
