// Reads the pictures that the ini gives for mip colours, and hands them to the panes.
#include "app/session/session_private.h"

#include "assets/importer.h"

typedef struct MipPictures {
    DipPicture pictures[DIP_MIP_LEVEL_COUNT];
    DipTextureDef defs[DIP_MIP_LEVEL_COUNT];
    const DipTextureDef *given[DIP_MIP_LEVEL_COUNT]; // NULL: this level keeps its debug colour.
    bool any;
} MipPictures;

static bool read_pictures(const DipSession *session, MipPictures *all, DipErrorList *faults) {
    bool read = true;
    for (int level = 0; level < DIP_MIP_LEVEL_COUNT; level++) {
        const DipConfigFile *file = &session->config.mip_picture[level];
        DipError err;
        if (!file->path) {
            continue;
        }
        if (!dip_picture_import(file->path, session->importer, &all->pictures[level], &err)) {
            read = dip_session_place_fault(session, file, faults, &err);
            continue;
        }
        all->defs[level] = (DipTextureDef){.name = file->path,
                                           .width = all->pictures[level].width,
                                           .height = all->pictures[level].height,
                                           .rgba8 = all->pictures[level].rgba8,
                                           .encoding = DIP_ENCODING_SRGB};
        all->given[level] = &all->defs[level];
        all->any = true;
    }
    return read;
}

bool dip_session_load_mip_pictures(DipSession *session, DipErrorList *faults) {
    MipPictures all = {.any = false};
    bool loaded = read_pictures(session, &all, faults);
    for (int p = 0; loaded && all.any && p < DIP_PANE_COUNT; p++) {
        DipError err;
        if (!dip_painter_set_mip_pictures(session->renderers[p], all.given, &err)) {
            loaded = dip_session_add_fault(faults, &err);
        }
    }
    for (int level = 0; level < DIP_MIP_LEVEL_COUNT; level++) {
        dip_picture_free(&all.pictures[level]);
    }
    return loaded;
}
