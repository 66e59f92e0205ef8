// The program: reads the command line, runs a command, says what went wrong.
#include "app/commands.h"
#include "app/log.h"
#include "app/machine.h"
#include "app/options.h"
#include "app/preview/preview.h"
#include "app/session.h"
#include "renderer/base/clock.h"

#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_BAD_INPUT = 2 };

static int exit_code_of(const DipError *err) {
    return err->origin == DIP_ORIGIN_INPUT ? EXIT_BAD_INPUT : EXIT_FAILED;
}

static int fail(const DipError *err) {
    dip_log_error(err);
    return exit_code_of(err);
}

static void say_times(const DipStartTimes *times, double shutdown_ms) {
    char start[320];
    dip_start_times_format(times, start, sizeof start);
    dip_log_note("%s; shutdown %.1f ms; peak %.1f MiB resident", start, shutdown_ms,
                 (double)dip_machine_peak_rss_bytes() / (1 << 20));
}

// Opens what the command draws with, runs it and closes it.
static int run_with_session(const DipOptions *options,
                            bool (*command)(DipSession *, const DipOptions *, DipError *)) {
    DipSession session;
    DipErrorList faults = {0};
    DipError err = {0};
    const bool opened = dip_session_open(&session, options, &faults);
    dip_log_errors(&faults);
    dip_error_list_free(&faults);
    if (!opened) {
        return EXIT_BAD_INPUT;
    }
    const bool done = command(&session, options, &err);
    const DipStartTimes times = session.times;
    const int64_t ended_ns = times.ended_ns ? times.ended_ns : dip_clock_ns();
    dip_session_close(&session);
    if (options->timing) {
        say_times(&times, dip_start_times_since_ms(ended_ns));
    }
    return done ? EXIT_DONE : fail(&err);
}

static int run_alone(const DipOptions *options, bool (*command)(const DipOptions *, DipError *)) {
    DipError err = {0};
    return command(options, &err) ? EXIT_DONE : fail(&err);
}

static int run(const DipOptions *options) {
    switch (options->command) {
    case DIP_COMMAND_DUMP:
        return run_with_session(options, dip_dump_run);
    case DIP_COMMAND_BENCH:
        return run_with_session(options, dip_bench_run);
    case DIP_COMMAND_COST:
        return run_with_session(options, dip_cost_run);
    case DIP_COMMAND_COST_ASSETS:
        return run_with_session(options, dip_cost_assets_run);
    case DIP_COMMAND_COST_MERGE:
        return run_alone(options, dip_cost_merge_run);
    case DIP_COMMAND_PATH_INFO:
        return run_alone(options, dip_path_info_run);
    case DIP_COMMAND_PATH_CONVERT:
        return run_alone(options, dip_path_convert_run);
    default:
        return run_with_session(options, dip_preview_run);
    }
}

int main(int argc, char **argv) {
    DipOptions options;
    DipError err = {0};
    if (!dip_options_parse(argc, argv, &options, &err)) {
        return fail(&err);
    }
    if (options.help) {
        dip_options_print_help(&options, argc > 2, stdout);
        return EXIT_DONE;
    }
    if (options.version) {
        printf("diptych %s\n", DIP_VERSION);
        return EXIT_DONE;
    }
    if (options.log && !dip_log_open(options.log, &err)) {
        return fail(&err);
    }
    const int code = run(&options);
    dip_log_close();
    return code;
}
