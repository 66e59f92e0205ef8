// The inside of the loupe's memory, shared by the code that reads samples (loupe.c) and the code
// that draws its pictures (loupe_picture.c).
#ifndef DIP_APP_PREVIEW_TOOLS_LOUPE_MEMORY_H
#define DIP_APP_PREVIEW_TOOLS_LOUPE_MEMORY_H

#include "app/preview/tools/loupe.h"
#include "renderer/base/srgb.h"

// A picture that is kept until what it shows changes.
typedef struct DipKeptPicture {
    DipCanvas canvas;
    bool valid;
    uint64_t version;
} DipKeptPicture;

typedef struct DipPaneSamples {
    DipSampleValue *samples; // Owned.
    size_t capacity;         // In entries.
    bool tried;              // The three members below say what was read last.
    bool known;              // False if reading failed.
    uint64_t version;
    DipTargetRegion region;
    const DipSamplePattern *pattern;
    DipKeptPicture crop;
    DipLoupeCrop crop_shown; // What the crop picture shows.
    uint64_t crop_frame_version;
    unsigned crop_generation;
    DipKeptPicture box;
    DipColour box_pixel; // What the box picture shows.
    const DipSamplePattern *box_pattern;
    DipSampleValue box_samples[DIP_MAX_SAMPLES];
    bool box_has_samples;
    int box_side;
} DipPaneSamples;

struct DipLoupe {
    DipSrgbDecodeTable decode;
    DipSrgbEncodeTable encode;
    DipTargetRegion wanted;
    bool is_wanted;
    uint64_t frame_index; // Of the frame that was drawn last.
    unsigned generation;  // Grows whenever samples are read.
    uint64_t version;     // Version of the picture that was drawn last.
    DipPaneSamples panes[DIP_PANE_COUNT];
};

#endif
