// What the parts of the configuration share: the table of keys, the reader, the values.
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
    DIP_TYPE_ISA
} DipConfigType;

typedef struct DipConfigKeyInfo {
    const char *name;
    DipConfigType type;
    const char *fallback; // NULL: required
    double low;
    double high;
    const char *text;
    size_t offset; // of the field in DipConfig
} DipConfigKeyInfo;

const DipConfigKeyInfo *dip_config_key_info(DipConfigKey key);
bool dip_config_find_key(const char *name, DipConfigKey *key);

// The known key nearest to a name in edit distance, NULL when none is near.
const char *dip_config_nearest_key(const char *name);

// What a key accepts, for messages and the table: "WIDTHxHEIGHT, 1..8192 each".
void dip_config_describe(DipConfigKey key, char *buffer, size_t size_bytes);

// Reads a value's text into its field; line 0 stands for a default. On failure *err is filled but
// for its file and line.
bool dip_config_set_value(DipConfig *config, DipConfigKey key, const char *text, int line,
                          DipError *err);

// A stream for ini_parse_stream that hands out clean lines only. inih itself would cut long lines,
// read an indented line as more of the one above and keep silent on lines without a value.
typedef struct DipConfigReader {
    FILE *stream;
    const char *file;
    DipErrorList *faults;
    int line; // of the line handed out last, 1-based
    size_t size_bytes;
    bool stopped;
} DipConfigReader;

// fgets' shape: the ini_reader of inih, context being the DipConfigReader.
char *dip_config_read_line(char *to, int room, void *context);

void dip_config_add_fault(DipConfigReader *reader, DipErrorCode code, DipSeverity severity,
                          int line, const char *key, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

#endif
