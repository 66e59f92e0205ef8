// Implements the command `diptych dump`, which draws frames and writes pictures, hashes, the record
// (record.h) and streams of video (stream.h).
#include "app/dump/options.h"
#include "app/dump/record.h"
#include "app/dump/stream.h"
#include "app/files/whole_file.h"
#include "app/files/pictures.h"
#include "app/cli/machine.h"
#include "app/session/picture_texts.h"
#include "app/cli/progress.h"
#include "renderer/base/assert.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { MOST_STREAMS = 2 }; // One for --y4m and one for --raw.

// The record and the streams to which each frame is added.
typedef struct Outputs {
    DipRecord *record; // NULL if no record is asked for.
    DipStream *streams[MOST_STREAMS];
    int stream_count;
} Outputs;

static bool write_picture(const DipSession *session, const char *folder, const DipDrawnFrame *drawn,
                          int pane, DipError *err) {
    char file[PATH_MAX];
    DipPictureTexts texts;
    const int length =
        snprintf(file, sizeof file, "%s/%s_%04d.png", folder, dip_pane_names[pane], drawn->index);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    dip_picture_texts_make(&texts, session, &drawn->pose, drawn->time_ns, false);
    dip_picture_texts_add_pane(&texts, pane, &drawn->qualities[pane], &drawn->frame.panes[pane]);
    return dip_png_write_with_texts(file, &drawn->frame.panes[pane], texts.items, texts.count, err);
}

static bool write_pane(const DipSession *session, const DipDumpOptions *options,
                       DipDrawnFrame *drawn, int pane, DipError *err) {
    dip_frame_hash(&drawn->frame.panes[pane], drawn->hashes[pane]);
    drawn->qualities[pane] = dip_painter_quality(session->renderers[pane]);
    if (options->hash) {
        printf("%04d %s %s\n", drawn->index, dip_pane_names[pane], drawn->hashes[pane]);
    }
    return !options->out || write_picture(session, options->out, drawn, pane, err);
}

// Returns how many frames are drawn before a frame, to make the history that the frame depends on.
// The history begins anew for each frame, so that a frame is the same picture alone and after
// others.
static int frames_before(const DipSession *session, int index) {
    bool has_history = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipQuality quality = dip_painter_quality(session->renderers[p]);
        has_history = has_history || dip_quality_has_history(&quality);
    }
    const int most = has_history && session->scene ? DIP_FRAMES_BEFORE : 0;
    return index < most ? index : most;
}

static bool draw_frame(DipSession *session, const DipDumpOptions *options, DipDrawnFrame *drawn,
                       DipError *err) {
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_cut(session->renderers[p]);
    }
    for (int i = drawn->index - frames_before(session, drawn->index); i <= drawn->index; i++) {
        drawn->time_ns = dip_dump_time_ns(options, i);
        if (!dip_session_draw(session, drawn->time_ns, (uint64_t)i, &drawn->pose, &drawn->frame,
                              err)) {
            return false;
        }
    }
    return true;
}

static bool dump_frame(DipSession *session, const DipDumpOptions *options, int index,
                       const Outputs *outputs, DipError *err) {
    DipDrawnFrame drawn = {.index = index};
    session->shares_shading = options->share_shading;
    if (!draw_frame(session, options, &drawn, err)) {
        return false;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (!write_pane(session, options, &drawn, p, err)) {
            return false;
        }
    }
    bool written = !outputs->record || dip_record_add(outputs->record, &drawn, err);
    for (int i = 0; written && i < outputs->stream_count; i++) {
        written = dip_stream_add(outputs->streams[i], drawn.frame.panes, err);
    }
    return written;
}

// Adds to the record what is known only of the whole run.
static bool end_record(DipRecord *record, const DipSession *session, DipError *err) {
    return dip_record_set_warnings(record, &session->warnings, session->warnings_left_out, err) &&
           dip_record_set_start(record, &session->times, dip_machine_peak_rss_bytes(), err);
}

static bool write_record(const DipRecord *record, const DipDumpOptions *options, DipError *err) {
    if (options->out) {
        char file[PATH_MAX];
        snprintf(file, sizeof file, "%s/frames.json", options->out);
        if (!dip_record_write(record, file, err)) {
            return false;
        }
    }
    if (options->json && strcmp(options->json, "-") == 0) {
        dip_record_print(record, stdout);
        return true;
    }
    return !options->json || dip_record_write(record, options->json, err);
}

// Draws the frames of the range, and shows the progress on standard error.
static bool dump_frames(DipSession *session, const DipDumpOptions *options, const Outputs *outputs,
                        DipError *err) {
    const DipFrameRange range = options->frames;
    const int total = (range.end - range.first + range.step - 1) / range.step;
    // Hashes on the terminal show the progress already.
    const bool shows_progress = !options->hash || !isatty(STDOUT_FILENO);
    DipProgress progress = dip_progress_begin("frames", total);
    bool done = true;
    int drawn = 0;
    while (done && drawn < total) {
        if (dip_interrupted()) {
            done = dip_error_set(
                err, DIP_ERROR_RUNTIME, NULL, 0, "dump",
                "interrupted after %d of %d frames; no record of frames was written", drawn, total);
            break;
        }
        done = dump_frame(session, options, range.first + drawn * range.step, outputs, err);
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

// Makes the record and opens the streams. A stream holds every `step`-th frame, so its rate is the
// rate of the frames divided by `step`.
static bool open_outputs(Outputs *outputs, const DipDumpOptions *options, DipError *err) {
    const bool records = options->out || options->json;
    const char *const files[MOST_STREAMS] = {options->y4m, options->raw};
    outputs->record = records ? dip_record_create(err) : NULL;
    bool opened = outputs->record || !records;
    for (int i = 0; opened && i < MOST_STREAMS; i++) {
        const DipStreamDef def = {
            .option = i == 0 ? "--y4m" : "--raw",
            .file = files[i],
            .y4m = i == 0,
            .picture = options->picture,
            .rate = {options->rate.frames, options->rate.seconds * options->frames.step},
        };
        if (def.file) {
            outputs->streams[outputs->stream_count] = dip_stream_open(&def, err);
            opened = outputs->streams[outputs->stream_count] != NULL;
            outputs->stream_count += opened;
        }
    }
    return opened;
}

// Closes the streams and frees the record. `done` is false if something has failed before; *err
// then holds that error and is not changed. Returns whether everything has succeeded.
static bool close_outputs(Outputs *outputs, bool done, DipError *err) {
    for (int i = 0; i < outputs->stream_count; i++) {
        done = dip_stream_close(&outputs->streams[i], done ? err : NULL) && done;
    }
    dip_record_destroy(&outputs->record);
    return done;
}

static bool run(DipSession *session, const void *all_options, DipError *err) {
    const DipDumpOptions *options = all_options;
    Outputs outputs = {0};
    if (options->out && !dip_folder_make(options->out, "--out", err)) {
        return false;
    }
    dip_interrupt_watch();
    const bool done =
        open_outputs(&outputs, options, err) && dump_frames(session, options, &outputs, err) &&
        (!outputs.record ||
         (end_record(outputs.record, session, err) && write_record(outputs.record, options, err)));
    return close_outputs(&outputs, done, err);
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
    {"diptych dump --frames 0:600 --y4m - | mpv --vf=format:colormatrix=bt.709 -",
     "plays twenty seconds of both panes, whatever the machine's speed"},
    {"diptych dump --frames 0:600 --pane requested --raw video.rgb",
     "writes the right pane's pixels, 3 bytes each, for ffmpeg -f rawvideo"},
};

const DipCommand dip_dump_command = {
    .name = "dump",
    .summary = "draw frames without a display: pictures, video, hashes, a record",
    .usage = "--out DIR | --json|--y4m|--raw FILE | --hash [OPTION]...",
    .text = "Dump draws both panes of each frame and needs no display. It writes the pictures as "
            "PNG files, prints a hash of each picture, writes a record of all frames with "
            "settings, times, counters and the effects that ran, or writes the frames as video "
            "without compression. Give at least one of --out, --json, --hash, --y4m and --raw.\n\n"
            "The PNG files tell how they were made: they have texts with the program's version, "
            "scene, path, time, pose, settings, size and hash.\n\n"
            "A frame with the same settings is the same picture on every machine, with every "
            "instruction set and any number of threads. With taa=history, the picture of a frame "
            "depends on the frames before it: dump draws the 16 frames before each frame, or as "
            "many as there are, so that a frame is the same picture alone and after others.",
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
