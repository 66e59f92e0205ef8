// Holds the tools with which the user examines the pictures: the loupe, comparisons, maps and the
// strip of thumbnails.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOLS_H
#define DIP_APP_PREVIEW_TOOLS_TOOLS_H

#include "app/preview/tools/compare.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/tools/maps.h"
#include "app/preview/tools/strip.h"

// Memory of the tools: among others, the pictures that they compute from the panes' frames. Owned
// by the preview's loop.
struct DipTools {
    DipLoupe loupe;
    DipComparer compare;
    DipStrip strip;
    DipMaps maps;
};

DipTools *dip_tools_create(DipError *err);
void dip_tools_destroy(DipTools **tools);

// Does the tools' work that needs renderers: reads the samples that the loupe shows, draws one
// thumbnail of the path, and draws one frame for a map. Each of these happens only while the
// pictures are still and the tool is in use: the loupe is on, the strip shows, or a map shows. The
// loop calls this function after each window that it draws, on the thread that draws frames.
// Returns whether the window must be drawn again.
bool dip_tools_update(DipTools *tools, const DipToolsInput *input);

#endif
