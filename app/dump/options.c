// The options of `diptych dump`.
#include "app/dump/options.h"

#include "renderer/base/assert.h"

#include <stdio.h>
#include <string.h>

#define FIELD(name) offsetof(DipDumpOptions, name)

enum { MAX_FRAME = 1000000 };

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

static const DipOptionRow rows[] = {
    {.name = "--frames",
     .argument = "A:B[:S]",
     .text = "Draw the frames A, A + S, A + 2 S, ... that come before B. Without :S, S is 1. The "
             "default 0:1 draws the first frame only.",
     .kind = DIP_OPTION_CUSTOM,
     .read = read_frames},
    {.name = "--fps",
     .argument = "N",
     .text =
         "Frame n shows the scene at the time n / N seconds. The default is 30 frames per second.",
     .kind = DIP_OPTION_NUMBER,
     .field = FIELD(fps),
     .least = 0.001,
     .most = 1000.0,
     .accepted = "a number of frames per second from 0.001 to 1000"},
    {.name = "--out",
     .argument = "DIR",
     .text = "Write the pictures current_0000.png, requested_0000.png, ... and the record "
             "frames.json into this folder. Diptych makes the folder if it is missing.",
     .kind = DIP_OPTION_TEXT,
     .field = FIELD(out)},
    {.name = "--json",
     .argument = "FILE",
     .text = "Write the record of all frames to this file: settings, hashes, times, counters. "
             "The name - stands for standard output.",
     .kind = DIP_OPTION_TEXT,
     .field = FIELD(json)},
    {.name = "--hash",
     .text = "Print a line per frame and pane, such as `0000 current HASH`. Equal hashes mean "
             "equal pictures.",
     .kind = DIP_OPTION_FLAG,
     .field = FIELD(hash)},
};

static const DipOptionTable table = {"Frames and output", rows, DIP_ARRAY_COUNT(rows)};

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_scene_option_table, FIELD(session)},
    {&dip_path_option_table, FIELD(session)},
    {&dip_category_option_table, FIELD(session)},
    {&dip_pane_option_table, FIELD(session)},
    {&dip_size_option_table, FIELD(session)},
    {&dip_threads_option_table, FIELD(session)},
    {&dip_program_option_table, FIELD(program)},
};
const DipOptionParts dip_dump_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

void dip_dump_options_default(void *options, int argc, char *const *argv) {
    (void)argc;
    (void)argv;
    DipDumpOptions *dump = options;
    dump->frames = (DipFrameRange){0, 1, 1};
    dump->fps = 30.0;
}

bool dip_dump_options_check(const void *options, DipError *err) {
    const DipDumpOptions *dump = options;
    if (!dump->out && !dump->json && !dump->hash) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "dump",
                             "nothing to do; give one of --out DIR, --json FILE, --hash");
    }
    if (dump->hash && dump->json && strcmp(dump->json, "-") == 0) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--hash",
                             "prints to standard output, and so does --json -; the record holds "
                             "the hashes, so leave out --hash");
    }
    return dip_session_options_check(&dump->session, err);
}
