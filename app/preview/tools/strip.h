// Draws thumbnails of the camera path: small pictures with the current pane's settings at evenly
// spaced times. The user clicks a thumbnail to move to its time. The thumbnails are drawn one after
// the other while camera and scene stand still.
#ifndef DIP_APP_PREVIEW_TOOLS_STRIP_H
#define DIP_APP_PREVIEW_TOOLS_STRIP_H

#include "app/preview/tools/tools_input.h"
#include "app/ui/canvas.h"

enum { DIP_STRIP_COUNT = 10 };

// One thumbnail.
typedef struct DipThumbnail {
    DipPixels picture; // The width is 0 until the thumbnail is drawn.
    uint64_t version;
    int64_t time_ns; // Time on the path.
} DipThumbnail;

// What all thumbnails of a strip have in common.
typedef struct DipStripSubject {
    const DipCamPath *path;
    double fov_y_deg;
    const DipScene *scene;
    DipQuality quality;
    int width;
    int height;
} DipStripSubject;

typedef struct DipStrip {
    DipStripSubject subject;
    // Draws the thumbnails. NULL after an update that drew no thumbnail or the last one.
    DipPainter *painter;
    DipCanvas pictures[DIP_STRIP_COUNT];
    uint64_t versions[DIP_STRIP_COUNT];
    uint64_t version; // Version of the thumbnail that was drawn last.
    int drawn;        // Number of thumbnails, from the first on, that show the subject.
    bool failed;      // The subject cannot be drawn.
    bool wanted;
    int wanted_width;
    int wanted_height;
    int64_t duration_ns; // Duration of the path; 0 if the strip has no path.
} DipStrip;

void dip_strip_free(DipStrip *strip);

// Asks for thumbnails of a size in pixels. The tab that shows the strip calls this function while
// the window is drawn. An update draws nothing if there was no call since the update before.
void dip_strip_want(DipStrip *strip, int width, int height);

// Draws the next thumbnail if the strip is wanted and incomplete, and camera and scene stand still.
// Returns whether it drew a thumbnail. Scenes of the gallery have no strip.
bool dip_strip_update(DipStrip *strip, const DipToolsInput *input);

// Returns one of the DIP_STRIP_COUNT thumbnails. The thumbnail's picture is valid until the next
// update.
DipThumbnail dip_strip_thumbnail(const DipStrip *strip, int index);

#endif
