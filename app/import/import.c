// Implements the hidden command `diptych import`, which hands its arguments to the importer
// (assets/importer.h). If the importer accepts them, the command ends the process with the
// importer's exit code.
#include "app/import/import.h"

#include "assets/importer.h"
#include "renderer/base/assert.h"

#include <unistd.h>

typedef struct ImportOptions {
    DipProgramOptions program;
    const char *arguments[DIP_IMPORTER_MAX_ARGUMENTS];
    int argument_count;
} ImportOptions;

static const DipOptionPart parts[] = {{&dip_program_option_table, 0}};
static const DipOptionParts all_parts = {parts, DIP_ARRAY_COUNT(parts)};

// Runs the importer. Unless the importer refuses the arguments, ends the process, with _exit
// instead of exit, because the handlers of exit only free memory that the system frees anyway.
static bool run(DipSession *session, const void *all, DipError *err) {
    const ImportOptions *options = all;
    (void)session;
    const int code = dip_importer_run(options->argument_count, (char *const *)options->arguments);
    if (code != DIP_IMPORTER_MISUSED) {
        _exit(code);
    }
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "import",
                         "only Diptych itself runs this command, to import models; to draw a "
                         "model, give its file to another command");
}

const DipCommand dip_import_command = {
    .name = "import",
    .summary = "imports models for another process of Diptych",
    .usage = "-- ARGUMENT...",
    .text = "Diptych runs this command to import models in a process of their own.",
    .parts = &all_parts,
    .operands = {.field = offsetof(ImportOptions, arguments),
                 .count = offsetof(ImportOptions, argument_count),
                 .most = DIP_IMPORTER_MAX_ARGUMENTS},
    .options_size = sizeof(ImportOptions),
    .run = run,
};
