// Options of `diptych dump`.
#ifndef DIP_APP_DUMP_OPTIONS_H
#define DIP_APP_DUMP_OPTIONS_H

#include "app/command.h"
#include "app/session_options.h"

#include <stdbool.h>
#include <stdint.h>

// The frames first, first + step, first + 2 step, ... that come before end.
typedef struct DipFrameRange {
    int first;
    int end;
    int step;
} DipFrameRange;

// Texts are borrowed from argv. NULL: the option is not given.
typedef struct DipDumpOptions {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *out;  // Folder for the pictures and the record.
    const char *json; // File for the record; "-" is standard output.
    bool hash;        // Print a hash per picture.
    DipFrameRange frames;
    double fps; // Frame n shows the time n / fps, in seconds.
} DipDumpOptions;

extern const DipOptionParts dip_dump_option_parts;

void dip_dump_options_default(void *options, int argc, char *const *argv);
bool dip_dump_options_check(const void *options, DipError *err);

#endif
