// Chooses a screenshot's name, joins the panes, and writes the file.
#include "app/preview/loop/screenshot.h"

#include "app/session/picture_texts.h"
#include "app/ui/style.h"
#include "app/preview/loop/view.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_SCREENSHOTS = 9999 };

static bool free_name(char *file, size_t size_bytes, DipError *err) {
    for (int i = 1; i <= MAX_SCREENSHOTS; ++i) {
        snprintf(file, size_bytes, "diptych-%04d.png", i);
        if (access(file, F_OK) != 0) {
            return true;
        }
    }
    return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "screenshot",
                         "no name from diptych-0001.png to diptych-%04d.png is free",
                         MAX_SCREENSHOTS);
}

// Copies a pane to the column x of a picture whose rows have row_bytes bytes.
static void copy_pane(uint8_t *rgba8, size_t row_bytes, const DipFrame *pane, int x) {
    for (int y = 0; y < pane->height; ++y) {
        memcpy(rgba8 + (size_t)y * row_bytes + 4 * (size_t)x,
               pane->rgba8 + (size_t)y * pane->stride_bytes, 4 * (size_t)pane->width);
    }
}

// Joins both panes. The caller frees *rgba8. Returns false when memory runs out.
static bool join_panes(const DipFrame panes[DIP_PANE_COUNT], uint8_t **rgba8, DipFrame *joined) {
    const int right = panes[DIP_PANE_CURRENT].width + DIP_PANE_GAP_PX;
    const int width = right + panes[DIP_PANE_REQUESTED].width;
    const int height = panes[DIP_PANE_CURRENT].height;
    const size_t row_bytes = 4 * (size_t)width;
    *rgba8 = malloc(row_bytes * (size_t)height);
    if (!*rgba8) {
        return false;
    }
    for (int y = 0; y < height; ++y) {
        uint8_t *gap = *rgba8 + (size_t)y * row_bytes + 4 * (size_t)panes[DIP_PANE_CURRENT].width;
        for (int i = 0; i < DIP_PANE_GAP_PX; ++i) {
            memcpy(gap + 4 * i, &dip_style_background, 4);
        }
    }
    copy_pane(*rgba8, row_bytes, &panes[DIP_PANE_CURRENT], 0);
    copy_pane(*rgba8, row_bytes, &panes[DIP_PANE_REQUESTED], right);
    *joined =
        (DipFrame){.rgba8 = *rgba8, .stride_bytes = row_bytes, .width = width, .height = height};
    return true;
}

bool dip_screenshot_save(const DipScreenshot *shot, char *file, size_t size_bytes, DipError *err) {
    uint8_t *rgba8 = NULL;
    DipFrame picture;
    DipPictureTexts texts;
    if (!free_name(file, size_bytes, err)) {
        return false;
    }
    if (shot->picture) {
        picture = (DipFrame){.rgba8 = shot->picture->rgba8,
                             .stride_bytes = shot->picture->stride_bytes,
                             .width = shot->picture->width,
                             .height = shot->picture->height};
    } else if (!join_panes(shot->frame->panes, &rgba8, &picture)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "screenshot", "out of memory");
    }
    dip_picture_texts_make(&texts, shot->session, shot->pose, shot->time_ns, shot->free_camera);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_picture_texts_add_pane(&texts, p, &shot->quality[p], &shot->frame->panes[p]);
    }
    const bool written = dip_png_write_with_texts(file, &picture, texts.items, texts.count, err);
    free(rgba8);
    return written;
}
