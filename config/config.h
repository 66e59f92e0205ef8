// The program's configuration: reads an ini file into one plain struct.
//
// Syntax: one `KEY: value` or `KEY = value` per line, keys in upper case, no sections. `;` begins a
// comment at the start of a line or after white space, `#` only at the start of a line.
// Indentation, CRLF and a UTF-8 byte order mark are ignored. config_list.h defines the keys and
// docs/config.md explains them.
//
// Threads: functions that work on different configurations may run at the same time.
#ifndef DIP_CONFIG_CONFIG_H
#define DIP_CONFIG_CONFIG_H

#include "config/config_list.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/scene/lights.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_CONFIG_MAX_LINE = 190,           // Bytes in a line without its indentation and comment.
    DIP_CONFIG_MAX_FILE_BYTES = 1 << 20, // Bytes in an ini.
    DIP_CONFIG_MAX_FAULTS = 100,         // Reading stops after this many faults.
    DIP_CONFIG_MAX_MODELS = 64,          // XFILE keys in an ini.
    DIP_CONFIG_MAX_MATERIALS = 32,       // Repetitions of each MATERIAL_ key in an ini.
    DIP_CONFIG_MAX_NAME = 64,            // Bytes in a NAME, with the final 0.
    DIP_CONFIG_ISA_AUTO = -1             // The best instruction set that the processor has.
};

// clang-format off
#define DIP_CONFIG_NONE(...) // Leaves out one kind of entry of DIP_CONFIG_LIST.

// Categories of settings. Each has a camera path: DIP_CATEGORY_DEFAULT (0), _AA, _AF, ...
typedef enum DipCategory {
#define DIP_CONFIG_CATEGORY(NAME, fov, text) DIP_CATEGORY_##NAME,
    DIP_CONFIG_LIST(DIP_CONFIG_NONE, DIP_CONFIG_CATEGORY, DIP_CONFIG_NONE)
#undef DIP_CONFIG_CATEGORY
    DIP_CATEGORY_COUNT
} DipCategory;

// Mip levels that a picture may stand for: DIP_MIP_LEVEL_1024 (0), _512, ... _8, in the order that
// dip_renderer_set_mip_pictures expects.
typedef enum DipConfigMipLevel {
#define DIP_CONFIG_LEVEL(NAME, size, text) DIP_MIP_LEVEL_##size,
    DIP_CONFIG_LIST(DIP_CONFIG_NONE, DIP_CONFIG_NONE, DIP_CONFIG_LEVEL)
#undef DIP_CONFIG_LEVEL
    DIP_MIP_LEVEL_COUNT
} DipConfigMipLevel;

// The keys of the ini: DIP_KEY_RES, ..., DIP_KEY_CAMPATH_AA, DIP_KEY_CAMPATH_AA_FOV, ...
typedef enum DipConfigKey {
#define DIP_CONFIG_KEY(NAME, field, TYPE, fallback, low, high, text) DIP_KEY_##NAME,
#define DIP_CONFIG_CAMERA(NAME, fov, text) DIP_KEY_CAMPATH_##NAME, DIP_KEY_CAMPATH_##NAME##_FOV,
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

// A file that the ini names. The DipConfig owns the strings.
typedef struct DipConfigFile {
    char *path;       // name to open, with the ini's folder; NULL if the ini names no file
    char *text;       // name as the ini gives it
    DipConfigKey key; // key that names the file
    int line;         // line of that key, 1-based
} DipConfigFile;

typedef struct DipConfigFiles {
    DipConfigFile *items;
    size_t count;
} DipConfigFiles;

// Materials of the models, by name. The DipConfig owns the text.
typedef struct DipConfigMaterial {
    char *pattern;           // name; `*` stands for any text, `?` for any character
    DipConfigFile light_map; // picture of MATERIAL_LIGHTMAP; its path is NULL if there is none
    DipConfigKey key;        // key that gives the pattern
    int line;                // line of that key, 1-based
} DipConfigMaterial;

typedef struct DipConfigMaterials {
    DipConfigMaterial *items;
    size_t count;
} DipConfigMaterials;

typedef struct DipConfigCamera {
    DipConfigFile file; // if its path is NULL, the path of DIP_CATEGORY_DEFAULT or an orbit plays
    double fov_y_deg;   // vertical field of view, 1..170; 0 without a path, except for DEFAULT
} DipConfigCamera;

// A word; "" if the ini does not give it.
typedef struct DipConfigName {
    char text[DIP_CONFIG_MAX_NAME];
} DipConfigName;

// Lights, ready for a scene; their names are NULL. The DipConfig owns them.
typedef struct DipConfigLights {
    DipLightDef *items;
    size_t count; // 0..DIP_MAX_LIGHTS
} DipConfigLights;

// A factor, or "auto".
typedef struct DipConfigScale {
    bool automatic;
    double factor; // 0 if automatic
} DipConfigScale;

// Where the light of lit surfaces is computed.
#define DIP_CONFIG_SHADING_LIST(X)                                                                 \
    X(auto)                                                                                        \
    X(flat)                                                                                        \
    X(gouraud)                                                                                     \
    X(phong)

typedef enum DipConfigShading {
#define DIP_CONFIG_SHADING_ENUM(name) DIP_CONFIG_SHADING_##name,
    DIP_CONFIG_SHADING_LIST(DIP_CONFIG_SHADING_ENUM)
#undef DIP_CONFIG_SHADING_ENUM
        DIP_CONFIG_SHADING_COUNT
} DipConfigShading;

typedef DipConfigSize DipConfigFieldSIZE;
typedef double DipConfigFieldNUMBER;
typedef int DipConfigFieldINTEGER;
typedef bool DipConfigFieldFLAG;
typedef DipConfigFile DipConfigFieldFILE;
typedef DipConfigFiles DipConfigFieldFILES;
typedef DipQuality DipConfigFieldSETTINGS;
typedef DipConfigColor DipConfigFieldCOLOR;
typedef DipConfigName DipConfigFieldNAME;
typedef DipConfigMaterials DipConfigFieldMATERIALS;
typedef DipConfigMaterials DipConfigFieldLIGHTMAPS;
typedef DipConfigShading DipConfigFieldSHADING;
typedef DipConfigLights DipConfigFieldLIGHTS;
typedef DipConfigScale DipConfigFieldSCALE;
typedef int DipConfigFieldISA; // a DipIsa or DIP_CONFIG_ISA_AUTO

typedef struct DipConfig {
#define DIP_CONFIG_FIELD(NAME, field, TYPE, fallback, low, high, text) DipConfigField##TYPE field;
    DIP_CONFIG_LIST(DIP_CONFIG_FIELD, DIP_CONFIG_NONE, DIP_CONFIG_NONE)
#undef DIP_CONFIG_FIELD
    DipConfigCamera camera[DIP_CATEGORY_COUNT];
    DipConfigFile mip_picture[DIP_MIP_LEVEL_COUNT];
    char *file;              // the ini's own name, as the caller gave it
    int line[DIP_KEY_COUNT]; // last line that sets each key, 1-based; 0: the key has its default
} DipConfig;

// Reads the whole file and adds every fault to *faults: unknown keys with the key they resemble,
// bad values with what is accepted, lines without a value, and required keys that are missing.
// Returns true if there was no error; the caller then owns *config and frees it with
// dip_config_free. On failure *config is zeroed. A repeated key gives only a warning, and its last
// value is used.
//
// A CAMPATH_*_FOV that is left out takes the field of view of another category with the same path
// file. If there is none, the key has its default. Categories with the same path file must have the
// same field of view.
//
// Codes: IO, FORMAT (a line without a value, a section, a NUL byte), OVERSIZED, UNKNOWN, TYPE,
// RANGE, MISSING, CONFLICT (two fields of view for one path; as a warning: a repeated key), MEMORY.
// This function opens no file but the ini. Code that opens a file named in the ini reports that
// file's faults with dip_config_file_fault.
bool dip_config_load(const char *file, DipConfig *config, DipErrorList *faults);

// Frees what the config owns and zeroes it. Accepts a zeroed config.
void dip_config_free(DipConfig *config);

// Reports a file that the ini names but that cannot be used. Fills *err with the line that names
// the file, "ini:12: [XFILE] message", and returns false.
bool dip_config_file_fault(const DipConfig *config, const DipConfigFile *file, DipErrorCode code,
                           DipError *err, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

// Returns "RES", ...; static storage.
const char *dip_config_key_name(DipConfigKey key);

// Returns true if both names mean one file, such as "a.pth" and "./a.pth". Compares the text only
// and opens no file. Returns false if either has no path.
bool dip_config_same_file(const DipConfigFile *a, const DipConfigFile *b);

// Writes a key's row of the table in docs/config.md: "| `RES` | accepted | default | meaning |".
// Returns the length as snprintf does.
size_t dip_config_document_key(DipConfigKey key, char *buffer, size_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
