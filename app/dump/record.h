// Makes the record of drawn frames. It holds each pane's settings, hash, times, work counters and
// effects, and the warnings about what is drawn, as JSON:
//
// {"frames":[{"index":0,"time_s":0,"pose":{"position":[x,y,z],"orientation":[x,y,z,w],
// "fov_y_deg":45},"ms":2.9,"current":{"settings":"aa=..","hash":"..","copied":false,"ms":1.5,
// "stages_ms":{..},"counters":{..},"effects":{"light_map":{"run":true,"why":".."},..}},
// "requested":{..}},..],"warnings":[{"file":"m.gltf","line":null,"key":null,"message":".."},..],
// "warnings_left_out":0,"load_ms":{"ini":0.3,..},"peak_rss_bytes":123456}
//
// If both panes have the same settings, the requested pane is a copy of the current one ("copied"
// is true), and all its times and counters are 0. With --force-all-effects, no pane is a copy. A
// frame's "ms" is the wall-clock time of both panes together. The sum of the panes' times can
// exceed the frame's "ms", because the time of shared geometry is included in both panes' times.
#ifndef DIP_APP_DUMP_RECORD_H
#define DIP_APP_DUMP_RECORD_H

#include "app/session/session.h"

#include <stdio.h>

typedef struct DipRecord DipRecord;

// A drawn frame of both panes.
typedef struct DipDrawnFrame {
    int index;
    int64_t time_ns; // Time of the scene that the frame shows.
    DipPose pose;
    DipSessionFrame frame;
    DipQuality qualities[DIP_PANE_COUNT];
    char hashes[DIP_PANE_COUNT][33];
} DipDrawnFrame;

// Creates a record without frames. All functions of this file that fail do so with MEMORY, except
// dip_record_write.
DipRecord *dip_record_create(DipError *err);
void dip_record_destroy(DipRecord **record);

// Adds a frame.
bool dip_record_add(DipRecord *record, const DipDrawnFrame *drawn, DipError *err);

// Adds the warnings that loading gave. The list may be empty. left_out: number of further warnings,
// which the list leaves out. Call it after the last frame.
bool dip_record_set_warnings(DipRecord *record, const DipErrorList *warnings, int left_out,
                             DipError *err);

// Ends the record after the warnings: adds the time of each part of the program's start, and the
// greatest amount of memory that was in use.
bool dip_record_set_start(DipRecord *record, const DipStartTimes *times, size_t peak_rss_bytes,
                          DipError *err);

// Writes the record to a file, whole or not at all. Fails as dip_whole_file_write does.
bool dip_record_write(const DipRecord *record, const char *file, DipError *err);

// Prints the record. The caller checks `out` for a write error.
void dip_record_print(const DipRecord *record, FILE *out);

#endif
