// The command line as a struct. One table of options gives the parser and the help.
#ifndef DIP_APP_OPTIONS_H
#define DIP_APP_OPTIONS_H

#include "app/bench/options.h"
#include "app/cost/options.h"
#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

// X(NAME, "what is typed", "what it is for")
#define DIP_COMMAND_LIST(X)                                                                        \
    X(PREVIEW, "preview", "open the window: two panes, one camera path (the default)")             \
    X(DUMP, "dump", "draw frames without a display: pictures, hashes, a record in JSON")           \
    X(BENCH, "bench", "measure frames: every combination of settings, threads, sizes, ...")        \
    X(COST, "cost", "report what each step of each setting costs in time and buys in accuracy")    \
    X(COST_MERGE, "cost merge", "join the parts of a cost report that several machines measured")  \
    X(COST_ASSETS, "cost assets", "size, zipped size and load time of the forms assets can take")  \
    X(PATH_INFO, "path info", "say what is in a camera path")                                      \
    X(PATH_CONVERT, "path convert", "rewrite a camera path as .pth (text) or .bth (binary)")

typedef enum DipCommand {
#define DIP_COMMAND_ENUM(NAME, typed, text) DIP_COMMAND_##NAME,
    DIP_COMMAND_LIST(DIP_COMMAND_ENUM)
#undef DIP_COMMAND_ENUM
        DIP_COMMAND_COUNT
} DipCommand;

enum { DIP_MAX_OPTION_MODELS = 64, DIP_MAX_OPERANDS = 2 };

// Texts are borrowed from argv. A NULL text or a false has_... means not given.
typedef struct DipOptions {
    DipCommand command;
    int64_t begin_ns; // when the command line was read: as good as the program's start
    bool timing;
    bool force_all_effects;
    bool help;
    bool version;
    const char *config;
    bool has_threads;
    int threads;
    bool has_isa;
    DipIsa isa;
    const char *log;
    const char *models[DIP_MAX_OPTION_MODELS];
    int model_count;
    const char *path;     // a camera path file instead of the ini's
    const char *category; // of the ini's paths, "AA", ...
    bool has_current;
    DipQuality current;
    bool has_requested;
    DipQuality requested;
    bool has_size;
    int width; // of a pane, pixels
    int height;
    const char *cost_report; // of the preview's scene
    const char *out;
    const char *json;
    bool hash;
    int first_frame; // first_frame, first_frame + frame_step, ... below end_frame
    int end_frame;
    int frame_step;
    int64_t fps_milli;                      // frames per 1000 seconds
    const char *operands[DIP_MAX_OPERANDS]; // files of the path commands
    int operand_count;
    DipBenchOptions bench;
    DipCostOptions cost;
} DipOptions;

// Reads argv[1..]. Fails with the option at fault as key: found, accepted.
bool dip_options_parse(int argc, char *const *argv, DipOptions *options, DipError *err);

// Help on all commands, or on one when the command was given.
void dip_options_print_help(const DipOptions *options, bool one_command, FILE *out);

#endif
