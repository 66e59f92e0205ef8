// Memory of the tools.
#include "app/preview/tools.h"

#include <stdlib.h>

struct DipTools {
    int unused;
};

DipTools *dip_tools_create(DipError *err) {
    DipTools *tools = calloc(1, sizeof *tools);
    if (!tools) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
    }
    return tools;
}

void dip_tools_destroy(DipTools **tools) {
    free(*tools);
    *tools = NULL;
}
