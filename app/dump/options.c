// Lists the options of `diptych dump`, reads their values and checks them.
#include "app/dump/options.h"

#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define FIELD(name) offsetof(DipDumpOptions, name)

enum {
    MAX_FRAME = 1000000,
    MAX_RATE = 1000,        // Greatest rate, in frames per second. The least rate is 1 / MAX_RATE.
    MAX_RATE_SECONDS = 5000 // Greatest N of a ratio M/N, so that times in ns fit into 64 bits.
};

static bool read_frames(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipDumpOptions *options = fields;
    int range[3] = {0, 0, 1};
    if (dip_option_integers(value, ':', 3, range) < 2 || range[0] < 0 || range[1] <= range[0] ||
        range[1] > MAX_FRAME || range[2] < 1) {
        return dip_option_refuse(
            err, DIP_ERROR_RANGE, row->name, value,
            "FIRST:END or FIRST:END:STEP with 0 <= FIRST < END <= 1000000 and STEP >= 1");
    }
    options->frames = (DipFrameRange){range[0], range[1], range[2]};
    return true;
}

// Reads a rate such as 59.94, which is rounded to thousandths, or an exact ratio such as
// 30000/1001.
static bool read_rate(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipDumpOptions *options = fields;
    int ratio[2];
    double per_second;
    if (dip_option_integers(value, '/', 2, ratio) == 2 && ratio[0] >= 1 && ratio[1] >= 1 &&
        ratio[1] <= MAX_RATE_SECONDS && ratio[0] <= MAX_RATE * ratio[1] &&
        ratio[1] <= (int64_t)MAX_RATE * ratio[0]) {
        options->rate = dip_frame_rate_reduce((DipFrameRate){ratio[0], ratio[1]});
        return true;
    }
    if (dip_number_parse(value, strlen(value), &per_second) && per_second >= 1.0 / MAX_RATE &&
        per_second <= MAX_RATE) {
        options->rate =
            dip_frame_rate_reduce((DipFrameRate){(int64_t)(per_second * 1000.0 + 0.5), 1000});
        return true;
    }
    return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                             "a number of frames per second from 0.001 to 1000, such as 30, 59.94 "
                             "or 30000/1001");
}

#define PICTURE(name, text) " `" #name "` " text "."
#define PICTURES            DIP_STREAM_PICTURE_LIST(PICTURE)

static const DipOptionRow rows[] = {
    {"--frames", "A:B[:S]", DIP_OPTION_CUSTOM, .read = read_frames,
     .text = "Draw the frames A, A + S, A + 2 S, ... that come before B. Without :S, S is 1. The "
             "default 0:1 draws the first frame only."},
    {"--fps", "N", DIP_OPTION_CUSTOM, .read = read_rate,
     .text =
         "Frame n shows the scene at the time n / N seconds. N is a number such as 59.94, which is "
         "rounded to thousandths, or a ratio such as 30000/1001, which is exact. The default is 30 "
         "frames per second."},
    {"--out", "DIR", DIP_OPTION_TEXT, FIELD(out),
     .text = "Write the pictures current_0000.png, requested_0000.png, ... and the record "
             "frames.json into this folder. Diptych makes the folder if it is missing."},
    {"--json", "FILE", DIP_OPTION_TEXT, FIELD(json),
     .text = "Write the record of all frames to this file: settings, hashes, times, counters. "
             "The name - stands for standard output."},
    {"--y4m", "FILE", DIP_OPTION_TEXT, FIELD(y4m),
     .text = "Write the frames to this file as video without compression (YUV4MPEG2), which mpv, "
             "ffmpeg and encoders read. The name - stands for standard output. The format is C444, "
             "the range is limited and the matrix is BT.709. The header cannot name the matrix, so "
             "tell the reader, as `mpv --vf=format:colormatrix=bt.709 -` does."},
    {"--raw", "FILE", DIP_OPTION_TEXT, FIELD(raw),
     .text = "Write the pixels of the frames to this file, without a header: 3 bytes per pixel "
             "(RGB24, sRGB), the top row first. The name - stands for standard output. A line on "
             "standard error gives the options with which ffmpeg reads the stream."},
    {"--pane", "NAME", DIP_OPTION_CHOICE, FIELD(picture), .given = FIELD(has_picture),
     .names = dip_stream_picture_names, .most = DIP_STREAM_PICTURE_COUNT,
     .accepted = "a picture; give one of current|requested|both|difference",
     .text = "What --y4m and --raw show." PICTURES " The default is both."},
    {"--hash", NULL, DIP_OPTION_FLAG, FIELD(hash),
     .text = "Print a line per frame and pane, such as `0000 current HASH`. Equal hashes mean "
             "equal pictures."},
    {"--share-shading", NULL, DIP_OPTION_FLAG, FIELD(share_shading),
     .text = "Let the panes copy each other's pixels where both would be the same, as the preview "
             "does while the camera moves. The pictures stay the same. The time of both panes "
             "together falls; the time of a pane is its own only in the frames in which its "
             "counter fragments_copied is 0."},
};

static const DipOptionTable table = DIP_OPTION_TABLE("Frames and output", rows);

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_scene_option_table, FIELD(session)},
    {&dip_path_option_table, FIELD(session)},
    {&dip_category_option_table, FIELD(session)},
    {&dip_camera_option_table, FIELD(session)},
    {&dip_pane_option_table, FIELD(session)},
    {&dip_size_option_table, FIELD(session)},
    {&dip_threads_option_table, FIELD(session)},
    {&dip_program_option_table, FIELD(program)},
};
const DipOptionParts dip_dump_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

void dip_dump_options_default(void *options) {
    DipDumpOptions *dump = options;
    dump->frames = (DipFrameRange){0, 1, 1};
    dump->rate = (DipFrameRate){30, 1};
    dump->picture = DIP_STREAM_both;
}

int64_t dip_dump_time_ns(const DipDumpOptions *options, int index) {
    return index * INT64_C(1000000000) * options->rate.seconds / options->rate.frames;
}

// Returns whether the option names standard output.
static bool is_standard_output(const char *file) {
    return file && strcmp(file, "-") == 0;
}

// Checks that at most one option writes to standard output, and that no video goes to a terminal.
static bool check_standard_output(const DipDumpOptions *dump, DipError *err) {
    static const char *const names[] = {"--y4m -", "--raw -", "--json -", "--hash"};
    const bool given[] = {is_standard_output(dump->y4m), is_standard_output(dump->raw),
                          is_standard_output(dump->json), dump->hash};
    int first = -1;
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(given); i++) {
        if (given[i] && first >= 0) {
            return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, names[i],
                                 "prints to standard output, and so does %s; leave out one of the "
                                 "two options",
                                 names[first]);
        }
        first = given[i] && first < 0 ? i : first;
    }
    const bool stream = given[0] || given[1];
    return !stream || !isatty(STDOUT_FILENO) ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, names[first],
                         "writes video, but standard output is a terminal; send it to a program "
                         "with | or to a file with >");
}

static bool check_streams(const DipDumpOptions *dump, DipError *err) {
    return dump->y4m || dump->raw || !dump->has_picture ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--pane",
                         "says what a stream shows, but there is none; give --y4m FILE or "
                         "--raw FILE");
}

bool dip_dump_options_check(const void *options, DipError *err) {
    const DipDumpOptions *dump = options;
    if (!dump->out && !dump->json && !dump->hash && !dump->y4m && !dump->raw) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "dump",
                             "nothing to do; give one of --out DIR, --json FILE, --hash, "
                             "--y4m FILE, --raw FILE");
    }
    return check_standard_output(dump, err) && check_streams(dump, err) &&
           dip_session_options_check(&dump->session, err);
}
