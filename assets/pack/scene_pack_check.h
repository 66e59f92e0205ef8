// Reads the bytes of a scene pack, of which nothing is trusted, and checks all that is read.
// Private to scene_pack.h's reader.
#ifndef DIP_ASSETS_PACK_SCENE_PACK_CHECK_H
#define DIP_ASSETS_PACK_SCENE_PACK_CHECK_H

#include "assets/pack/scene_pack.h"
#include "assets/pack/scene_pack_layout.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct DipPackReader {
    const uint8_t *bytes;
    uint64_t size_bytes;
    PackHeader header;
    uint64_t arrays_end; // End of the last array, in bytes. The next array begins here or later.
    DipError *err;
    DipPbrDef *pbrs; // One for each material.
} DipPackReader;

// Both fill in the reader's error and return false. what: the part that is out of place; index: its
// number.
bool dip_pack_refuse(const DipPackReader *reader, const char *what, uint64_t index);
bool dip_pack_out_of_memory(const DipPackReader *reader);

// Whether the header has the layout of this version.
bool dip_pack_has_layout(const PackHeader *header);

// Reads the header and checks the places of all sections.
bool dip_pack_read_header(DipPackReader *reader);

// Reads record `index` of a section.
void dip_pack_read_record(const DipPackReader *reader, const PackSection *section, uint64_t index,
                          void *record, size_t record_bytes);

// Finds a text. Returns false if it lies outside the section of text.
bool dip_pack_read_text(const DipPackReader *reader, uint64_t offset, const char **text);

// Finds an array. The offset 0 gives NULL. Returns false if the array lies outside the pack or
// within an earlier array.
bool dip_pack_read_array(DipPackReader *reader, uint64_t offset, uint64_t count,
                         uint64_t item_bytes, const void **array);

// The same for floats. Returns false also if one of them is not finite.
bool dip_pack_read_floats(DipPackReader *reader, uint64_t offset, uint64_t count,
                          const float **floats);

// Whether no float is infinite or NaN.
bool dip_pack_all_finite(const void *floats, uint64_t count);

static inline bool dip_pack_is_boolean(uint32_t value) {
    return value <= 1;
}

// scene_pack_motion.c: reads the motion if the pack has one. The caller frees pack->motion, even if
// the call fails.
bool dip_pack_read_motion(DipPackReader *reader, DipScenePack *pack);
void dip_pack_free_motion(struct DipPackedMotion *motion);

#endif
