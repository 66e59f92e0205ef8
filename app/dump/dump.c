// `diptych dump`: frames without a display.
#include "app/commands.h"

#include "app/dump/record.h"
#include "app/files/folder.h"
#include "app/files/png.h"
#include "app/interrupt.h"
#include "app/machine.h"
#include "app/progress.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool write_picture(const char *folder, int index, int pane, const DipFrame *frame,
                          DipError *err) {
    char file[PATH_MAX];
    const int length =
        snprintf(file, sizeof file, "%s/%s_%04d.png", folder, dip_pane_names[pane], index);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    return dip_png_write(file, frame, err);
}

static bool dump_frame(DipSession *session, const DipOptions *options, int index, DipRecord *record,
                       DipError *err) {
    const int64_t time_ns = index * INT64_C(1000000000000) / options->fps_milli;
    DipPose pose;
    DipSessionFrame frame;
    char hashes[DIP_PANE_COUNT][33];
    DipQuality qualities[DIP_PANE_COUNT];
    DipRecordPane panes[DIP_PANE_COUNT];
    if (!dip_session_draw(session, time_ns, (uint64_t)index, &pose, &frame, err)) {
        return false;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_frame_hash(&frame.panes[p], hashes[p]);
        qualities[p] = dip_renderer_quality(session->renderers[p]);
        panes[p] = (DipRecordPane){&qualities[p], &frame.panes[p], hashes[p],
                                   p == DIP_PANE_REQUESTED && frame.copied};
        if (options->hash) {
            printf("%04d %s %s\n", index, dip_pane_names[p], hashes[p]);
        }
        if (options->out && !write_picture(options->out, index, p, &frame.panes[p], err)) {
            return false;
        }
    }
    return !record ||
           dip_record_add(record, index, 1e-9 * (double)time_ns, &pose, frame.ms, panes, err);
}

static bool write_records(const DipRecord *record, const DipOptions *options, DipError *err) {
    if (options->out) {
        char file[PATH_MAX];
        snprintf(file, sizeof file, "%s/frames.json", options->out);
        if (!dip_record_write(record, file, err)) {
            return false;
        }
    }
    return !options->json || dip_record_write(record, options->json, err);
}

bool dip_dump_run(DipSession *session, const DipOptions *options, DipError *err) {
    if (options->out && !dip_folder_make(options->out, "--out", err)) {
        return false;
    }
    DipRecord *record = options->out || options->json ? dip_record_create(err) : NULL;
    bool done = record || (!options->out && !options->json);
    const int total =
        (options->end_frame - options->first_frame + options->frame_step - 1) / options->frame_step;
    // On a terminal the hashes are progress enough.
    const bool quiet_output = options->out || options->json || !isatty(STDOUT_FILENO);
    DipProgress progress = dip_progress_begin("frames", total);
    dip_interrupt_watch();
    int drawn = 0;
    for (int i = 0; done && i < total; i++) {
        if (dip_interrupted()) {
            done =
                dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "dump",
                              "interrupted after %d of %d frames; no record was written", i, total);
            break;
        }
        done = dump_frame(session, options, options->first_frame + i * options->frame_step, record,
                          err);
        drawn = i + done;
        if (quiet_output) {
            dip_progress_show(&progress, i + 1);
        }
    }
    if (quiet_output) {
        dip_progress_end(&progress, drawn);
    }
    done = done && (!record || (dip_record_set_start(record, &session->times,
                                                     dip_machine_peak_rss_bytes(), err) &&
                                write_records(record, options, err)));
    dip_record_destroy(&record);
    if (done && options->hash && fflush(stdout) != 0) {
        done = dip_error_set(err, DIP_ERROR_IO, NULL, 0, "--hash", "standard output: %s",
                             strerror(errno));
    }
    return done;
}
