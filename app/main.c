// Holds the program's main function, which reads the command line, runs the command and prints
// errors.
#include "app/session/session.h"
#include "app/cli/command_line.h"
#include "app/command_list.h"
#include "app/cli/help.h"
#include "app/import/import.h"
#include "app/cli/log.h"
#include "app/cli/machine.h"
#include "app/cli/program_file.h"
#include "renderer/base/clock.h"

#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_BAD_INPUT = 2, EXIT_BUSY = 3 };

static int fail(const DipError *err) {
    dip_log_error(err);
    if (err->code == DIP_ERROR_BUSY) {
        return EXIT_BUSY;
    }
    return err->origin == DIP_ORIGIN_INPUT ? EXIT_BAD_INPUT : EXIT_FAILED;
}

// Returns the exit code for a session that failed to open: EXIT_BAD_INPUT if at least one error is
// in the user's input, otherwise EXIT_FAILED.
static int exit_code_of(const DipErrorList *faults) {
    int code = EXIT_FAILED;
    for (size_t i = 0; i < faults->count; i++) {
        const DipError *fault = &faults->items[i];
        if (fault->severity == DIP_SEVERITY_ERROR && fault->origin == DIP_ORIGIN_INPUT) {
            code = EXIT_BAD_INPUT;
        }
    }
    return code;
}

static void print_times(const DipStartTimes *times, double shutdown_ms) {
    char start[320];
    dip_start_times_format(times, start, sizeof start);
    dip_log_note("%s; shutdown %.1f ms; peak %.1f MiB resident", start, shutdown_ms,
                 (double)dip_machine_peak_rss_bytes() / (1 << 20));
}

// Opens the session that the command describes, runs the command and closes the session.
static int run_with_session(const DipCommandLine *line, const DipSessionDef *def) {
    DipSession session;
    DipErrorList faults = {0};
    DipError err = {0};
    const bool opened = dip_session_open(&session, def, &faults);
    if (!opened || !def->warnings_are_known) {
        dip_log_errors(&faults);
    }
    const int open_code = opened ? EXIT_DONE : exit_code_of(&faults);
    dip_error_list_free(&faults);
    if (!opened) {
        return open_code;
    }
    const bool done = line->command->run(&session, line->options, &err);
    const DipStartTimes times = session.times;
    const int64_t ended_ns = times.ended_ns ? times.ended_ns : dip_clock_ns();
    dip_session_close(&session);
    if (def->options->timing) {
        print_times(&times, dip_start_times_since_ms(ended_ns));
    }
    return done ? EXIT_DONE : fail(&err);
}

static int run_command(const DipCommandLine *line, int64_t begin_ns) {
    const DipProgramOptions *program = line->options;
    const DipCommand *command = line->command;
    if (command->describe_session) {
        // Another process of this program, `diptych import`, imports the models.
        const DipImporter importer = {.program = dip_program_file(),
                                      .command = dip_import_command.name};
        DipSessionDef def = {.importer = &importer, .log = program->log, .begin_ns = begin_ns};
        command->describe_session(line->options, &def);
        return run_with_session(line, &def);
    }
    DipError err = {0};
    return command->run(NULL, line->options, &err) ? EXIT_DONE : fail(&err);
}

static int run(const DipCommandLine *line, int64_t begin_ns) {
    const DipProgramOptions *program = line->options;
    DipError err = {0};
    if (program->help) {
        dip_help_print(&dip_command_list, line, stdout);
        return EXIT_DONE;
    }
    if (program->version) {
        printf("diptych %s\n", DIP_VERSION);
        return EXIT_DONE;
    }
    if (program->log && !dip_log_open(program->log, &err)) {
        return fail(&err);
    }
    return run_command(line, begin_ns);
}

int main(int argc, char **argv) {
    const int64_t begin_ns = dip_clock_ns();
    DipCommandLine line;
    DipError err = {0};
    const bool parsed = dip_command_line_parse(&dip_command_list, argc, argv, &line, &err);
    int code = parsed ? run(&line, begin_ns) : fail(&err);
    dip_command_line_free(&line);
    if (code == EXIT_DONE && !dip_output_finish(&err)) {
        code = fail(&err);
    }
    dip_log_close();
    return code;
}
