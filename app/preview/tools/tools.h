// The memory of the tools for looking closer: the loupe, comparisons, maps and the strip.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOLS_H
#define DIP_APP_PREVIEW_TOOLS_TOOLS_H

#include "app/ui/pixels.h"
#include "app/preview/state/tool_state.h"
#include "app/session/session.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipLoupe DipLoupe;       // loupe.h
typedef struct DipComparer DipComparer; // compare.h
typedef struct DipStrip DipStrip;       // strip.h
typedef struct DipMaps DipMaps;         // maps.h

// Memory of the tools: pictures that they compute from the panes' frames. Owned by the preview's
// loop.
typedef struct DipTools {
    DipLoupe *loupe;
    DipComparer *compare;
    DipStrip *strip;
    DipMaps *maps;
} DipTools;

DipTools *dip_tools_create(DipError *err);
void dip_tools_destroy(DipTools **tools);

// What the tools need besides the window, to draw parts of frames again. All of it is borrowed for
// the call.
typedef struct DipToolsInput {
    DipSession *session;
    const DipPose *pose; // Pose, time and number of the frame that was drawn last.
    int64_t play_ns;
    uint64_t frame_index;
    uint64_t versions[DIP_PANE_COUNT]; // Versions of the panes' pictures, as in DipWindow.
    int width;                         // Size of the panes' pictures.
    int height;
    bool copied; // See DipSessionFrame.
    bool still;  // Camera and scene stand still.
} DipToolsInput;

// Does work of the tools that needs the renderers: reads the samples that the loupe shows, and
// draws one thumbnail of the path. The loop calls it after each window that it draws, on the thread
// that draws frames. It does nothing unless a tool shows what it would draw and the pictures are
// still. Returns whether the window must be drawn again.
bool dip_tools_update(DipTools *tools, const DipToolsInput *input);

// Versions of the tools' pictures in the draw list. Frames count from 0, so no frame has these
// numbers, and each tool counts in a range of its own.
#define DIP_LOUPE_VERSION       (UINT64_C(1) << 62)
#define DIP_MAP_TRUTH_VERSION   (UINT64_C(0x4d) << 56)
#define DIP_MAP_PICTURE_VERSION (UINT64_C(0x4e) << 56)
#define DIP_DIFFERENCE_VERSION  (UINT64_C(5) << 60)
#define DIP_STRIP_VERSION       (UINT64_C(6) << 60)

#endif
