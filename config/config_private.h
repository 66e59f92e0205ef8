// The table of keys, the reader and the values, shared by the parts of the configuration. Private
// to config/.
#ifndef DIP_CONFIG_CONFIG_PRIVATE_H
#define DIP_CONFIG_CONFIG_PRIVATE_H

#include "config/config.h"

#include <stdio.h>

typedef enum DipConfigType {
    DIP_TYPE_SIZE,
    DIP_TYPE_NUMBER,
    DIP_TYPE_INTEGER,
    DIP_TYPE_FLAG,
    DIP_TYPE_FILE,
    DIP_TYPE_FILES,
    DIP_TYPE_SETTINGS,
    DIP_TYPE_COLOR,
    DIP_TYPE_ISA,
    DIP_TYPE_NAME,
    DIP_TYPE_MATERIALS,
    DIP_TYPE_LIGHTMAPS,
    DIP_TYPE_SHADING,
    DIP_TYPE_LIGHTS,
    DIP_TYPE_SCALE
} DipConfigType;

typedef struct DipConfigKeyInfo {
    const char *name;
    DipConfigType type;
    const char *fallback; // default as text; NULL: the key is required
    double low;           // lowest accepted number, for types that have a range
    double high;          // highest accepted number
    const char *text;     // meaning, for messages and documentation
    size_t offset;        // byte offset of the key's field in DipConfig
} DipConfigKeyInfo;

const DipConfigKeyInfo *dip_config_key_info(DipConfigKey key);

// True if an ini may give a key of this type more than once.
bool dip_config_may_repeat(DipConfigType type);

// Finds the key with exactly this name. Returns false if there is none.
bool dip_config_find_key(const char *name, DipConfigKey *key);

// Returns the key that a misspelt name most resembles, or NULL if no key is near enough. At most a
// third of the name's letters may differ; in a short name, one letter may.
const char *dip_config_nearest_key(const char *name);

// Writes what a key accepts, for messages and the table: "WIDTHxHEIGHT, 1..8192 each".
void dip_config_describe(DipConfigKey key, char *buffer, size_t size_bytes);

// Parses a value's text into the key's field. line is where the ini gives the value, 0 for a
// default. On failure leaves the field unchanged and fills *err except for its file and line.
bool dip_config_set_value(DipConfig *config, DipConfigKey key, const char *text, int line,
                          DipError *err);

// lights.c: parses a light and adds it. On failure leaves *lights unchanged and fills *err except
// for its file and line.
bool dip_config_add_light(DipConfigKey key, const char *text, DipConfigLights *lights,
                          DipError *err);

// Passes lines of the ini to inih's ini_parse_stream, but only lines that inih reads correctly.
// inih alone would split long lines, join an indented line to the line above it, and ignore lines
// without a value.
typedef struct DipConfigReader {
    FILE *stream;
    const char *file;
    DipErrorList *faults;
    int line;          // number of the last line passed on, 1-based
    size_t size_bytes; // bytes read so far
    bool stopped;      // the rest of the file is not read
} DipConfigReader;

// The ini_reader callback of inih, which has the signature of fgets. context is a DipConfigReader.
char *dip_config_read_line(char *to, int room, void *context);

// Appends a fault of the ini to the reader's list. line is 0 if the fault belongs to no line. key
// is NULL if the fault concerns no key.
void dip_config_add_fault(DipConfigReader *reader, DipErrorCode code, DipSeverity severity,
                          int line, const char *key, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

#endif
