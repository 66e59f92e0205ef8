// The program's configuration: an ini file to one plain struct.
//
// Syntax: a `KEY: value` or `KEY = value` per line, keys in upper case, no sections; `;` begins a
// comment at a line's start or after white space, `#` at a line's start. Indentation, CRLF and a
// UTF-8 byte order mark do not matter. Keys stand in config_list.h and docs/config.md.
#ifndef DIP_CONFIG_CONFIG_H
#define DIP_CONFIG_CONFIG_H

#include "config/config_list.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DIP_CONFIG_MAX_LINE = 190,           // bytes of a line without its indentation and comment
    DIP_CONFIG_MAX_FILE_BYTES = 1 << 20, // of an ini
    DIP_CONFIG_MAX_FAULTS = 100,         // reading stops there
    DIP_CONFIG_MAX_MODELS = 64,          // XFILE keys
    DIP_CONFIG_ISA_AUTO = -1             // the best that the processor has
};

// clang-format off
#define DIP_CONFIG_NONE(...)

// Setting categories, each with a camera path: DIP_CATEGORY_DEFAULT (0), _AA, _AF, ...
typedef enum DipCategory {
#define DIP_CONFIG_CATEGORY(NAME, fallback, text) DIP_CATEGORY_##NAME,
    DIP_CONFIG_LIST(DIP_CONFIG_NONE, DIP_CONFIG_CATEGORY, DIP_CONFIG_NONE)
#undef DIP_CONFIG_CATEGORY
    DIP_CATEGORY_COUNT
} DipCategory;

// Levels of the mip-debug pictures: DIP_MIP_LEVEL_1024 (0), _512, ... _8, the order of
// dip_renderer_set_mip_pictures.
typedef enum DipMipLevel {
#define DIP_CONFIG_LEVEL(NAME, size, text) DIP_MIP_LEVEL_##size,
    DIP_CONFIG_LIST(DIP_CONFIG_NONE, DIP_CONFIG_NONE, DIP_CONFIG_LEVEL)
#undef DIP_CONFIG_LEVEL
    DIP_MIP_LEVEL_COUNT
} DipMipLevel;

// Every key: DIP_KEY_RES, ..., DIP_KEY_CAMPATH_AA, DIP_KEY_CAMPATH_AA_FOV, ...
typedef enum DipConfigKey {
#define DIP_CONFIG_KEY(NAME, field, TYPE, fallback, low, high, text) DIP_KEY_##NAME,
#define DIP_CONFIG_CAMERA(NAME, fallback, text) DIP_KEY_CAMPATH_##NAME, DIP_KEY_CAMPATH_##NAME##_FOV,
#define DIP_CONFIG_PICTURE(NAME, size, text) DIP_KEY_##NAME,
    DIP_CONFIG_LIST(DIP_CONFIG_KEY, DIP_CONFIG_CAMERA, DIP_CONFIG_PICTURE)
#undef DIP_CONFIG_KEY
#undef DIP_CONFIG_CAMERA
#undef DIP_CONFIG_PICTURE
    DIP_KEY_COUNT
} DipConfigKey;
// clang-format on

typedef struct DipConfigSize {
    int width;
    int height;
} DipConfigSize;

typedef struct DipConfigColor {
    uint8_t rgb[3]; // sRGB
} DipConfigColor;

// A file that the ini names. Strings belong to the config.
typedef struct DipConfigFile {
    char *path; // to open: a relative name is taken from the ini's folder; NULL: none
    char *text; // as it stands in the ini
    DipConfigKey key;
    int line; // 1-based
} DipConfigFile;

typedef struct DipConfigFiles {
    DipConfigFile *items;
    size_t count;
} DipConfigFiles;

typedef struct DipConfigCamera {
    DipConfigFile file; // path NULL (WATER only): plays DEFAULT's
    double fov_y_deg;   // vertical, 1..170; 0 without a path
} DipConfigCamera;

typedef DipConfigSize DipConfigFieldSIZE;
typedef double DipConfigFieldNUMBER;
typedef int DipConfigFieldINTEGER;
typedef bool DipConfigFieldFLAG;
typedef DipConfigFile DipConfigFieldFILE;
typedef DipConfigFiles DipConfigFieldFILES;
typedef DipQuality DipConfigFieldSETTINGS;
typedef DipConfigColor DipConfigFieldCOLOR;
typedef int DipConfigFieldISA; // a DipIsa or DIP_CONFIG_ISA_AUTO

typedef struct DipConfig {
#define DIP_CONFIG_FIELD(NAME, field, TYPE, fallback, low, high, text) DipConfigField##TYPE field;
    DIP_CONFIG_LIST(DIP_CONFIG_FIELD, DIP_CONFIG_NONE, DIP_CONFIG_NONE)
#undef DIP_CONFIG_FIELD
    DipConfigCamera camera[DIP_CATEGORY_COUNT];
    DipConfigFile mip_picture[DIP_MIP_LEVEL_COUNT];
    char *file;              // the ini itself, as it was given
    int line[DIP_KEY_COUNT]; // where each key was (last) set, 1-based; 0: it has its default
} DipConfig;

// Reads the whole file and adds every fault to *faults: unknown keys with the nearest known one,
// bad values with what is accepted, lines that are none, missing keys. True when there was no
// error; *config then belongs to the caller. On failure *config is zeroed. Warnings (a key given
// again: the later value counts) do not fail.
//
// As the ini of the seed has it, a missing CAMPATH_*_FOV takes the field of view of another
// category with the same path file. Categories with the same path file must have the same field of
// view.
//
// Codes: IO, FORMAT (a line without a value, a section, a NUL byte), OVERSIZED, UNKNOWN, TYPE,
// RANGE, MISSING, CONFLICT (two fields of view; as a warning: a repeated key), MEMORY. Reads no
// other file: whether the named ones exist is for who opens them, see dip_config_file_fault.
bool dip_config_load(const char *file, DipConfig *config, DipErrorList *faults);

// Accepts a zeroed config; zeroes it.
void dip_config_free(DipConfig *config);

// Fills *err with the place in the ini where a file is named, and returns false: for a file that
// cannot be used after all. "ini:12: [XFILE] message".
bool dip_config_file_fault(const DipConfig *config, const DipConfigFile *file, DipErrorCode code,
                           DipError *err, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

const char *dip_config_key_name(DipConfigKey key);

// Two names of one file ("a.pth", "./a.pth"), by their text alone.
bool dip_config_same_file(const DipConfigFile *a, const DipConfigFile *b);

// A key's row of the table in docs/config.md: "| `RES` | type and range | default | text |".
// Returns the length as snprintf does.
size_t dip_config_document_key(DipConfigKey key, char *buffer, size_t size_bytes);

#endif
