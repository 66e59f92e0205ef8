// Imports models in a child process, the importer, so that a fault in the libraries that read model
// files and pictures cannot hurt the program. The importer loads the files and hands over the
// finished scene description in memory that it can no longer change. The program checks the whole
// description before it uses it (pack/scene_pack.h). If the importer crashes, hangs or needs too
// much memory or time, the load fails like that of any other bad file.
//
// An importer is any program that calls dip_importer_run. Mostly this is the program itself: its
// main function compares its first argument with a word of its choice and, on a match, does nothing
// but `return dip_importer_run(argc - 2, argv + 2);`. The DipImporter then names /proc/self/exe and
// the word. In the program `diptych`, the word is the hidden command `import`, so a host can also
// name an installed diptych of the same version.
//
// This works on Linux only. On other systems, models are loaded in the program's own process.
#ifndef DIP_ASSETS_IMPORTER_H
#define DIP_ASSETS_IMPORTER_H

#include "renderer/base/api.h"
#include "assets/model.h"
#include "assets/picture.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The importer program and its limits. The limits hold for the load of one model with all its
// files; 0 stands for the default.
typedef struct DipImporter {
    const char *program; // Path of the program; "/proc/self/exe" is the program itself.
    const char *command; // Argument before those of dip_importer_run, or NULL.
    // Memory, in bytes. The default is three quarters of the machine's memory, at least 1 GiB.
    uint64_t memory_bytes;
    int wall_s; // Time by the clock, in seconds; the default is DIP_IMPORT_WALL_S.
    int cpu_s;  // Processor time of all threads, in seconds; the default is 4 * wall_s.
} DipImporter;

enum {
    DIP_IMPORT_WALL_S = 120,
    DIP_IMPORT_MAX_WALL_S = 86400,   // Greatest wall_s.
    DIP_IMPORTER_RULE_ARGUMENTS = 6, // Arguments for each DipMaterialRule.
    // Most arguments of dip_importer_run.
    DIP_IMPORTER_MAX_ARGUMENTS =
        DIP_MAX_MODEL_FILES + DIP_IMPORTER_RULE_ARGUMENTS * DIP_MAX_MATERIAL_RULES + 20,
    DIP_IMPORTER_MISUSED = 2
};

// Does the same as dip_picture_read_file (picture.h), but in an importer. NULL: in this process.
// Further codes are those of dip_model_load_with.
DIP_API bool dip_picture_import(const char *path, const DipImporter *importer, DipPicture *picture,
                                DipError *err);

// Runs the importer in the process that dip_model_load_with has started. count, arguments: the
// command line after DipImporter.command. Returns the exit code of the process. The function limits
// the process and closes its files, so the process can do nothing else afterwards. For a command
// line that dip_model_load_with did not make, it returns DIP_IMPORTER_MISUSED and changes nothing.
DIP_API int dip_importer_run(int count, char *const *arguments);

#ifdef __cplusplus
}
#endif

#endif
