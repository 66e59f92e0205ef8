// `diptych dump`: drawing frames and writing pictures, hashes and the record.
#include "app/dump/dump.h"

#include "app/dump/options.h"
#include "app/dump/record.h"
#include "app/files/folder.h"
#include "app/files/png.h"
#include "app/interrupt.h"
#include "app/machine.h"
#include "app/progress.h"
#include "renderer/base/assert.h"

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

static bool dump_frame(DipSession *session, const DipDumpOptions *options, int index,
                       DipRecord *record, DipError *err) {
    const int64_t time_ns = index * INT64_C(1000000000000) / (int64_t)(options->fps * 1000.0 + 0.5);
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
        qualities[p] = dip_painter_quality(session->renderers[p]);
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

static bool write_json(const DipRecord *record, const char *file, DipError *err) {
    return strcmp(file, "-") == 0 ? dip_record_print(record, stdout, err)
                                  : dip_record_write(record, file, err);
}

static bool write_records(const DipRecord *record, const DipDumpOptions *options, DipError *err) {
    if (options->out) {
        char file[PATH_MAX];
        snprintf(file, sizeof file, "%s/frames.json", options->out);
        if (!dip_record_write(record, file, err)) {
            return false;
        }
    }
    return !options->json || write_json(record, options->json, err);
}

// Draws the frames of the range, with the progress on standard error.
static bool dump_frames(DipSession *session, const DipDumpOptions *options, DipRecord *record,
                        DipError *err) {
    const DipFrameRange range = options->frames;
    const int total = (range.end - range.first + range.step - 1) / range.step;
    // Hashes that appear on the terminal are progress enough.
    const bool shows_progress = !options->hash || !isatty(STDOUT_FILENO);
    DipProgress progress = dip_progress_begin("frames", total);
    bool done = true;
    int drawn = 0;
    while (done && drawn < total) {
        if (dip_interrupted()) {
            done = dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "dump",
                                 "interrupted after %d of %d frames; no record was written", drawn,
                                 total);
            break;
        }
        done = dump_frame(session, options, range.first + drawn * range.step, record, err);
        drawn += done;
        if (shows_progress) {
            dip_progress_show(&progress, drawn);
        }
    }
    if (shows_progress) {
        dip_progress_end(&progress, drawn);
    }
    return done;
}

static bool run(DipSession *session, const void *all_options, DipError *err) {
    const DipDumpOptions *options = all_options;
    if (options->out && !dip_folder_make(options->out, "--out", err)) {
        return false;
    }
    const bool records = options->out || options->json;
    DipRecord *record = records ? dip_record_create(err) : NULL;
    dip_interrupt_watch();
    const bool done = (record || !records) && dump_frames(session, options, record, err) &&
                      (!record || (dip_record_set_start(record, &session->times,
                                                        dip_machine_peak_rss_bytes(), err) &&
                                   write_records(record, options, err)));
    dip_record_destroy(&record);
    return done;
}

static void describe_session(const void *options, DipSessionDef *def) {
    const DipDumpOptions *dump = options;
    def->options = &dump->session;
    def->scene = true;
    def->renderers = true;
}

static const DipExample examples[] = {
    {"diptych dump --out out --frames 0:8", "draws eight frames into the folder out"},
    {"diptych dump --hash --frames 0:1200:10 --requested aa=8,af=16 --isa avx2",
     "prints the hashes of every tenth frame, to compare machines or instruction sets"},
    {"diptych dump --out out --category AF --current af=none --requested af=16",
     "shows what anisotropic filtering does, on the camera path made for it"},
    {"diptych dump --json - | python3 -m json.tool", "reads the record of one frame"},
};

const DipCommand dip_dump_command = {
    .name = "dump",
    .summary = "draw frames without a display: pictures, hashes, a record",
    .usage = "--out DIR | --json FILE | --hash [OPTION]...",
    .text = "Dump draws both panes of each frame and needs no display. It writes the pictures as "
            "PNG files, prints a hash of each picture, or writes a record of all frames with "
            "settings, times, counters and the effects that ran. Give at least one of --out, "
            "--json and --hash.\n\n"
            "A frame with the same settings is the same picture on every machine, with every "
            "instruction set and any number of threads.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &dip_dump_option_parts,
    .options_size = sizeof(DipDumpOptions),
    .set_defaults = dip_dump_options_default,
    .check = dip_dump_options_check,
    .describe_session = describe_session,
    .run = run,
};
