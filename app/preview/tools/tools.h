// The tools for looking closer: the loupe, comparisons, maps and the strip.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOLS_H
#define DIP_APP_PREVIEW_TOOLS_TOOLS_H

#include "app/preview/tools/compare.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/tools/maps.h"
#include "app/preview/tools/strip.h"

// Memory of the tools: pictures that they compute from the panes' frames. Owned by the preview's
// loop.
struct DipTools {
    DipLoupe loupe;
    DipComparer compare;
    DipStrip strip;
    DipMaps maps;
};

DipTools *dip_tools_create(DipError *err);
void dip_tools_destroy(DipTools **tools);

// Does work of the tools that needs the renderers: reads the samples that the loupe shows, and
// draws one thumbnail of the path. The loop calls it after each window that it draws, on the thread
// that draws frames. It does nothing unless a tool shows what it would draw and the pictures are
// still. Returns whether the window must be drawn again.
bool dip_tools_update(DipTools *tools, const DipToolsInput *input);

#endif
