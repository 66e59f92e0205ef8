// A scene pack: a scene description as one block of bytes without pointers, which the importer
// process hands over to the program (importer.h).
//
// The reader trusts nothing. It checks every offset, count, index, enumerator, text and float
// before the scene points to it. Packs are made and read by builds of the same version on one
// machine, so numbers are stored as the machine stores them; the format is not meant for files that
// last.
#ifndef DIP_ASSETS_PACK_SCENE_PACK_H
#define DIP_ASSETS_PACK_SCENE_PACK_H

#include "assets/model.h"
#include "renderer/base/error.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// What the importer is doing. It notes this in the pack before each step, so that the program can
// tell what it was doing when it crashed.
typedef enum DipImportStage {
    DIP_IMPORT_STARTS,   // No file has been opened yet.
    DIP_IMPORT_READS,    // A model file is read.
    DIP_IMPORT_PICTURES, // The pictures are decoded.
    DIP_IMPORT_PACKS,    // The pack is written.
    DIP_IMPORT_DONE      // The pack is complete.
} DipImportStage;

// The content of a pack: either a scene or the reason why there is none.
typedef struct DipScenePack {
    DipSceneDef scene;              // Its sky is the default sky, which is not part of the pack.
    DipPbrDef *pbrs;                // What the materials of a pack that was read point to.
    struct DipPackedMotion *motion; // What the motion of a pack that was read points to.
    const char *const *clips; // The names of the files' animations; owned by a pack that was read.
    int clip_count;
    DipModelTimes times;
    DipErrorList warnings;
    DipError failure; // Why the import failed; the code is NONE if there is a scene.
} DipScenePack;

// Notes in the pack file what the importer is doing. file_index: index of the model file.
// Returns false if the file cannot be written; errno says why.
bool dip_scene_pack_note(int pack_file, DipImportStage stage, int file_index);

// Reads the last note. Returns false if the file holds no valid note.
bool dip_scene_pack_read_note(int pack_file, DipImportStage *stage, int *file_index);

// Writes a whole pack to an empty file, or to a file that holds notes only. Returns false if the
// file cannot be written or memory runs out; errno says why.
bool dip_scene_pack_write(int pack_file, const DipScenePack *pack);

// Reads a pack. bytes: aligned to 8 bytes. On success the caller frees *pack with
// dip_scene_pack_free; the scene's texts, texels, vertices and indices point into `bytes`, which
// must stay unchanged as long as the scene is used. If anything in the pack is out of place,
// returns false, leaves *pack empty and fills *err with FORMAT or MEMORY. Takes time and memory in
// proportion to size_bytes, whatever the bytes say. Thread-safe.
bool dip_scene_pack_read(const void *bytes, size_t size_bytes, DipScenePack *pack, DipError *err);

// Frees what dip_scene_pack_read allocated and zeroes the pack. Accepts a zeroed pack.
void dip_scene_pack_free(DipScenePack *pack);

#ifdef __cplusplus
}
#endif

#endif
