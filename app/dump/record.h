// The record of drawn frames as JSON: each pane's settings, hash, times, work counters and effects.
//
// {"frames":[{"index":0,"time_s":0,"pose":{"position":[x,y,z],"orientation":[x,y,z,w],
// "fov_y_deg":45},"ms":2.9,"current":{"settings":"aa=..","hash":"..","copied":false,"ms":1.5,
// "stages_ms":{..},"counters":{..},"effects":{"light_map":{"run":true,"why":".."},..}},"requested":{..}},..],
// "load_ms":{"ini":0.3,..},"peak_rss_bytes":123456}
//
// All times and counters of a copied pane are 0, because copying takes no time and no work. A
// frame's "ms" is the wall-clock time of both panes together. The sum of the panes' times can
// exceed the frame's "ms", because the time of shared geometry is included in both panes' times.
#ifndef DIP_APP_DUMP_RECORD_H
#define DIP_APP_DUMP_RECORD_H

#include "app/session/start_times.h"
#include "renderer/base/error.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct DipRecord DipRecord;

// One pane of a frame.
typedef struct DipRecordPane {
    const DipQuality *quality;
    const DipFrame *frame;
    const char *hash;
    bool copied; // The pane is a copy of the one before it, which has the same settings.
} DipRecordPane;

DipRecord *dip_record_create(DipError *err);
void dip_record_destroy(DipRecord **record);

// Adds a frame. ms is the wall-clock time of both panes; panes are current and requested.
bool dip_record_add(DipRecord *record, int index, double time_s, const DipPose *pose, double ms,
                    const DipRecordPane panes[2], DipError *err);

// Ends the record with the time of each part of the start, and the greatest amount of memory that
// was in use.
bool dip_record_set_start(DipRecord *record, const DipStartTimes *times, size_t peak_rss_bytes,
                          DipError *err);

// Writes the record to a file, whole or not at all.
bool dip_record_write(const DipRecord *record, const char *file, DipError *err);

// Prints the record. The caller checks `out` for a write error.
void dip_record_print(const DipRecord *record, FILE *out);

#endif
