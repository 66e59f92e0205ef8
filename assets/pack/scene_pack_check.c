// Reads the bytes of scene packs, and checks all that is read.
#include "assets/pack/scene_pack_check.h"

#include <math.h>
#include <string.h>

// --- reporting faults ----------------------------------------------------------------------------

bool dip_pack_refuse(const DipPackReader *reader, const char *what, uint64_t index) {
    return dip_error_set(reader->err, DIP_ERROR_FORMAT, NULL, 0, NULL,
                         "the importer's result is malformed: %s (item %llu)", what,
                         (unsigned long long)index);
}

bool dip_pack_out_of_memory(const DipPackReader *reader) {
    return dip_error_set(reader->err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
}

// --- values --------------------------------------------------------------------------------------

// Tests the exponents as integers, which compilers vectorise.
bool dip_pack_all_finite(const void *floats, uint64_t count) {
    const uint32_t exponent = 0x7f800000;
    const uint8_t *bytes = floats;
    uint32_t found = 0;
    for (uint64_t i = 0; i < count; ++i) {
        uint32_t bits;
        memcpy(&bits, bytes + sizeof bits * i, sizeof bits);
        found |= (bits & exponent) == exponent;
    }
    return !found;
}

void dip_pack_read_record(const DipPackReader *reader, const PackSection *section, uint64_t index,
                          void *record, size_t record_bytes) {
    memcpy(record, reader->bytes + section->offset + index * record_bytes, record_bytes);
}

// The section of text ends with a zero byte (check_sections), so every text ends.
bool dip_pack_read_text(const DipPackReader *reader, uint64_t offset, const char **text) {
    const bool inside = offset < reader->header.text.count;
    *text = inside ? (const char *)reader->bytes + reader->header.text.offset + offset : NULL;
    return inside;
}

// Counts and item sizes are below 2^33, so that their product does not overflow.
bool dip_pack_read_array(DipPackReader *reader, uint64_t offset, uint64_t count,
                         uint64_t item_bytes, const void **array) {
    *array = NULL;
    if (offset == 0) {
        return true;
    }
    const uint64_t size = reader->size_bytes;
    if (offset % PACK_ALIGNMENT != 0 || offset < reader->arrays_end || offset > size ||
        count * item_bytes > size - offset) {
        return false;
    }
    *array = reader->bytes + offset;
    reader->arrays_end = offset + count * item_bytes;
    return true;
}

bool dip_pack_read_floats(DipPackReader *reader, uint64_t offset, uint64_t count,
                          const float **floats) {
    const void *array;
    const bool ok = dip_pack_read_array(reader, offset, count, sizeof **floats, &array) &&
                    dip_pack_all_finite(array, array ? count : 0);
    *floats = array;
    return ok;
}

// --- the header ----------------------------------------------------------------------------------

static bool check_section(const DipPackReader *reader, const PackSection *section,
                          size_t record_bytes, uint64_t most) {
    const uint64_t size = reader->size_bytes;
    return section->offset >= sizeof(PackHeader) && section->offset <= size &&
           section->count <= most && section->count <= (size - section->offset) / record_bytes;
}

static bool check_sections(const DipPackReader *reader) {
    const PackHeader *header = &reader->header;
#define CHECK_SECTION(name, type)                                                                  \
    if (!check_section(reader, &header->name, sizeof(type),                                        \
                       sizeof(type) > 1 ? PACK_MAX_RECORDS : UINT64_MAX)) {                        \
        return dip_pack_refuse(reader, "section " #name, header->name.count);                      \
    }
    PACK_SECTION_LIST(CHECK_SECTION)
#undef CHECK_SECTION
    const PackSection *text = &header->text;
    return (text->count > 0 && reader->bytes[text->offset + text->count - 1] == '\0') ||
           dip_pack_refuse(reader, "the text has no end", text->count);
}

bool dip_pack_has_layout(const PackHeader *header) {
    return memcmp(header->magic, pack_magic, sizeof header->magic) == 0 &&
           header->version == PACK_VERSION && header->header_bytes == sizeof *header;
}

bool dip_pack_read_header(DipPackReader *reader) {
    PackHeader *header = &reader->header;
    if (reader->size_bytes < sizeof *header) {
        return dip_pack_refuse(reader, "it ends too early", reader->size_bytes);
    }
    memcpy(header, reader->bytes, sizeof *header);
    if (!dip_pack_has_layout(header)) {
        return dip_pack_refuse(reader, "it is not of this version", header->version);
    }
    if (header->stage != DIP_IMPORT_DONE || header->total_bytes != reader->size_bytes) {
        return dip_pack_refuse(reader, "it is incomplete", header->stage);
    }
    if (!isfinite(header->import_ms) || !isfinite(header->pictures_ms)) {
        return dip_pack_refuse(reader, "times", 0);
    }
    return check_sections(reader);
}
