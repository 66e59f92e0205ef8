// Options of `diptych path info` and `diptych path convert`.
#ifndef DIP_APP_PATH_OPTIONS_H
#define DIP_APP_PATH_OPTIONS_H

#include "app/cli/command.h"

#include <stdbool.h>

enum { DIP_MAX_PATH_FILES = 2 };

// Texts are borrowed from argv.
typedef struct DipPathOptions {
    DipProgramOptions program;
    const char *files[DIP_MAX_PATH_FILES]; // The file to read and the file to write.
    int file_count;
} DipPathOptions;

extern const DipOptionParts dip_path_option_parts;

bool dip_path_info_options_check(const void *options, DipError *err);
bool dip_path_convert_options_check(const void *options, DipError *err);

#endif
