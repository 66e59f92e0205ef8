// Creates and destroys the memory of all tools, and lets each tool do its work.
#include "app/preview/tools/tools.h"

#include <stdlib.h>

DipTools *dip_tools_create(DipError *err) {
    DipTools *tools = calloc(1, sizeof *tools);
    if (!tools) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    dip_srgb_decode_table(&tools->loupe.decode);
    dip_srgb_encode_table(&tools->loupe.encode);
    tools->strip.version = DIP_STRIP_VERSION;
    return tools;
}

void dip_tools_destroy(DipTools **tools) {
    if (*tools) {
        dip_loupe_free(&(*tools)->loupe);
        dip_canvas_free(&(*tools)->compare.difference.canvas);
        dip_strip_free(&(*tools)->strip);
        dip_maps_free(&(*tools)->maps);
        free(*tools);
        *tools = NULL;
    }
}

bool dip_tools_update(DipTools *tools, const DipToolsInput *input) {
    const bool samples = dip_loupe_update(&tools->loupe, input);
    const bool thumbnail = dip_strip_update(&tools->strip, input);
    const bool map = dip_maps_update(&tools->maps, input);
    return samples || thumbnail || map;
}
