// Frames that a part of a report (--part) keeps beside its cost.json, so that `cost merge` can make
// the pictures of the joined page from them. The files are FOLDER/frames/HASH.png, where HASH is
// the hash of the file's bytes. PNG is lossless, so the merged pictures are those of an undivided
// report, to the bit.
#ifndef DIP_APP_REPORT_KEPT_FRAMES_H
#define DIP_APP_REPORT_KEPT_FRAMES_H

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/scene/quality.h"

#include <limits.h>
#include <stdint.h>

// A frame drawn with some settings on a camera path, or the truth (converged picture) of the path.
typedef struct DipCostKeptFrame {
    int path; // Index of the camera path in the report.
    bool is_truth;
    DipQuality quality; // The frame's settings. A truth has none.
    char hash[DIP_HASH_HEX_SIZE];
} DipCostKeptFrame;

// The frames of a part. All are the first ones of the burst at one viewpoint. Zero-initialised, it
// has none.
typedef struct DipCostKeptFrames {
    DipCostKeptFrame *list; // Owned.
    int count;
    int viewpoint;
} DipCostKeptFrames;

void dip_cost_kept_frames_free(DipCostKeptFrames *kept);

// Writes the name of a frame's file. Returns false if the name is too long.
bool dip_cost_kept_frame_file(const char *folder, const char *hash, char file[PATH_MAX]);

// Writes the file of a frame, whole or not at all, and fills in frame->hash. The pixels are packed
// rgba8; alpha is left out. FOLDER/frames must be there. Fails with DIP_ERROR_OVERSIZED,
// DIP_ERROR_IO or DIP_ERROR_MEMORY.
bool dip_cost_kept_frame_write(DipCostKeptFrame *frame, const char *folder, const uint8_t *rgba8,
                               int width, int height, DipError *err);

// What the file of a kept frame is like.
typedef enum DipCostKeptState {
    DIP_COST_KEPT_WHOLE,
    DIP_COST_KEPT_MISSING, // The file is not there or cannot be opened.
    DIP_COST_KEPT_DAMAGED  // Its bytes do not have the hash.
} DipCostKeptState;

// Checks the file of a frame against its hash. Fails only with DIP_ERROR_MEMORY.
bool dip_cost_kept_frame_check(const DipCostKeptFrame *frame, const char *folder,
                               DipCostKeptState *state, DipError *err);

// Reads the packed pixels of a frame; alpha is 255. Fails if the file cannot be read or does not
// have this size.
bool dip_cost_kept_frame_read(const DipCostKeptFrame *frame, const char *folder, uint8_t *rgba8,
                              int width, int height, DipError *err);

#endif
