// Holds the memory of all tools.
#include "app/preview/tools/tools.h"

#include "app/preview/tools/compare.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/tools/maps.h"
#include "app/preview/tools/strip.h"

#include <stdlib.h>

DipTools *dip_tools_create(DipError *err) {
    DipTools *tools = calloc(1, sizeof *tools);
    if (!tools) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    tools->loupe = dip_loupe_create(err);
    tools->compare = tools->loupe ? dip_compare_create(err) : NULL;
    tools->strip = tools->compare ? dip_strip_create(err) : NULL;
    tools->maps = tools->strip ? dip_maps_create(err) : NULL;
    if (!tools->maps) {
        dip_tools_destroy(&tools);
    }
    return tools;
}

void dip_tools_destroy(DipTools **tools_pointer) {
    DipTools *tools = *tools_pointer;
    if (!tools) {
        return;
    }
    *tools_pointer = NULL;
    dip_loupe_destroy(&tools->loupe);
    dip_compare_destroy(&tools->compare);
    dip_strip_destroy(&tools->strip);
    dip_maps_destroy(&tools->maps);
    free(tools);
}

bool dip_tools_update(DipTools *tools, const DipToolsInput *input) {
    const bool samples = dip_loupe_update(tools->loupe, input);
    const bool thumbnail = dip_strip_update(tools->strip, input);
    const bool map = dip_maps_update(tools->maps, input);
    return samples || thumbnail || map;
}
