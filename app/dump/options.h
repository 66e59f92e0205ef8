// Declares the command `diptych dump` and its options.
#ifndef DIP_APP_DUMP_OPTIONS_H
#define DIP_APP_DUMP_OPTIONS_H

#include "app/cli/command.h"
#include "app/dump/stream.h"
#include "app/session/session_options.h"

#include <stdbool.h>
#include <stdint.h>

// The frames first, first + step, first + 2 step, ... that come before end.
typedef struct DipFrameRange {
    int first;
    int end;
    int step;
} DipFrameRange;

// The options of `diptych dump`. Texts are borrowed from argv, and NULL if the option is not given.
typedef struct DipDumpOptions {
    DipProgramOptions program;
    DipSessionOptions session;
    const char *out;          // Folder for the pictures and the record.
    const char *json;         // File for the record; "-" is standard output.
    const char *y4m;          // File for the frames as YUV4MPEG2; "-" is standard output.
    const char *raw;          // File for the frames' pixels; "-" is standard output.
    bool hash;                // True to print a hash per picture.
    bool share_shading;       // True to let the panes copy each other's pixels.
    bool has_picture;         // True if --pane is given.
    DipStreamPicture picture; // What the streams show.
    DipFrameRange frames;
    DipFrameRate rate; // Frame n shows the time n * rate.seconds / rate.frames, in seconds.
} DipDumpOptions;

extern const DipCommand dip_dump_command; // Defined in dump.c.
extern const DipOptionParts dip_dump_option_parts;

// Returns the time of the scene that frame `index` shows, in nanoseconds, rounded down.
int64_t dip_dump_time_ns(const DipDumpOptions *options, int index);

void dip_dump_options_default(void *options);
bool dip_dump_options_check(const void *options, DipError *err);

#endif
