// Keeps a picture that a tool makes, so that the tool makes it again only if it would differ.
#ifndef DIP_APP_PREVIEW_TOOLS_KEPT_H
#define DIP_APP_PREVIEW_TOOLS_KEPT_H

#include "app/ui/canvas.h"
#include "renderer/base/hash.h"

// Zero-initialise. dip_canvas_free frees the canvas.
typedef struct DipKeptPicture {
    DipCanvas canvas;
    bool known;       // The canvas shows the picture with this version.
    uint64_t version; // Hash of everything that decides what the picture shows, so that equal
                      // versions mean equal pixels (draw_list.h). No frame has the same number.
} DipKeptPicture;

// Returns whether the picture has to be made, because it was made from other content or is not
// known. The caller then draws it into the canvas and sets `known`.
static inline bool dip_kept_begin(DipKeptPicture *kept, const DipHash *content) {
    const bool same = kept->known && kept->version == content->lanes[0];
    kept->version = content->lanes[0];
    return !same;
}

// Sets *picture and *version, which are valid until the picture is made again. Returns whether the
// picture is known.
static inline bool dip_kept_show(const DipKeptPicture *kept, DipPixels *picture,
                                 uint64_t *version) {
    *picture = dip_canvas_pixels(&kept->canvas);
    *version = kept->version;
    return kept->known;
}

#endif
