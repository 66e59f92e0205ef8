// Implements the commands `diptych path info`, which describes a camera path or lists the
// animations and cameras of a model, and `diptych path convert`, which rewrites a camera path in
// another format.
#include "app/path/path.h"

#include "assets/animation.h"
#include "assets/cameras.h"
#include "campaths/campath.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <string.h>

enum { MAX_FILES = 2 };

// The options and operands of both commands. Texts are borrowed from argv.
typedef struct PathOptions {
    DipProgramOptions program;
    const char *files[MAX_FILES]; // The file to read; for `convert`, also the file to write.
    int file_count;
} PathOptions;

static const DipOptionPart parts[] = {
    {&dip_program_option_table, offsetof(PathOptions, program)},
};
static const DipOptionParts all_parts = {parts, DIP_ARRAY_COUNT(parts)};

static bool check_info(const void *options, DipError *err) {
    const PathOptions *path = options;
    return path->file_count == 1 || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path info",
                                                  "needs a file: path info FILE");
}

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text);
    return length >= strlen(end) && strcmp(text + length - strlen(end), end) == 0;
}

static bool check_convert(const void *options, DipError *err) {
    const PathOptions *path = options;
    if (path->file_count != 2) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path convert",
                             "needs two files but got %d: path convert IN OUT", path->file_count);
    }
    return ends_with(path->files[1], ".pth") || ends_with(path->files[1], ".bth") ||
           dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "path convert",
                         "'%.200s' names no format; write to a file that ends in .pth (text) or "
                         ".bth (binary)",
                         path->files[1]);
}

static void print_model(const DipAnimatedDef *def, const DipModelCamera *cameras, int count) {
    for (int i = 0; i < def->animation_count; i++) {
        printf("animation  %s, %.6g s\n", def->animations[i].name, def->animations[i].duration_s);
    }
    for (int i = 0; i < count; i++) {
        printf("camera     %s, %.6g s\n", cameras[i].name,
               1e-9 * (double)cameras[i].period_ns * (double)(cameras[i].key_count - 1));
    }
    if (def->animation_count + count == 0) {
        printf("no animations and no cameras\n");
    }
}

static bool run_model_info(const char *file, DipError *err) {
    DipAnimatedModel *model = dip_animated_model_load_shapes(file, NULL, err);
    DipModelCameras *cameras = model ? dip_model_cameras_load(file, DIP_UP_auto, NULL, err) : NULL;
    const bool ok = cameras != NULL;
    if (ok) {
        int count;
        const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
        print_model(dip_animated_model_def(model), list, count);
    }
    dip_model_cameras_destroy(&cameras);
    dip_animated_model_destroy(&model);
    return ok;
}

static bool run_info(DipSession *session, const void *options, DipError *err) {
    (void)session;
    const char *file = ((const PathOptions *)options)->files[0];
    if (ends_with(file, ".gltf") || ends_with(file, ".glb") || ends_with(file, ".md2")) {
        return run_model_info(file, err);
    }
    DipCamPath *path;
    if (!dip_campath_load(file, &path, err)) {
        return false;
    }
    const DipCamPathInfo info = dip_campath_info(path);
    printf("file       %s\n", file);
    printf("keys       %zu, %.9g s apart\n", info.key_count, 1e-9 * (double)info.period_ns);
    printf("duration   %.9g s; then the path begins again\n", 1e-9 * (double)info.duration_ns);
    printf("length     %.6g m\n", info.length_m);
    printf("box        %.6g %.6g %.6g to %.6g %.6g %.6g m\n", info.min_world[0], info.min_world[1],
           info.min_world[2], info.max_world[0], info.max_world[1], info.max_world[2]);
    printf("at most    %.6g m/s, %.6g degrees/s\n", info.max_speed_m_per_s,
           info.max_turn_deg_per_s);
    dip_campath_destroy(&path);
    return true;
}

static bool run_convert(DipSession *session, const void *options, DipError *err) {
    (void)session;
    const PathOptions *files = options;
    const char *to = files->files[1];
    DipCamPath *path;
    if (!dip_campath_load(files->files[0], &path, err)) {
        return false;
    }
    const bool saved = ends_with(to, ".pth") ? dip_campath_save_pth(path, to, err)
                                             : dip_campath_save_bth(path, to, err);
    dip_campath_destroy(&path);
    return saved;
}

static const DipExample info_examples[] = {
    {"diptych path info campaths/ambient.pth",
     "prints the duration, length and speeds of the courtyard's default path"},
    {"diptych path info fox.glb", "lists all animations and cameras of a model"},
};

static const DipExample convert_examples[] = {
    {"diptych path convert campaths/ambient.pth ambient.bth",
     "makes a binary file from a text file"},
    {"diptych path convert ambient.bth ambient.pth",
     "turns the binary file back into text, for an editor"},
};

#define PATH_OPERANDS(number)                                                                      \
    { offsetof(PathOptions, files), offsetof(PathOptions, file_count), number }

const DipCommand dip_path_info_command = {
    .name = "path info",
    .summary = "print what a camera path holds, or a model's animations",
    .usage = "FILE",
    .text = "Path info reads a camera path and prints its keys, its duration and length, the box "
            "that holds it and its greatest speeds. Of a model (.gltf, .glb, .md2) it lists the "
            "animations, which --animation plays, and the cameras, which --path flies.",
    .examples = info_examples,
    .example_count = DIP_ARRAY_COUNT(info_examples),
    .parts = &all_parts,
    .operands = PATH_OPERANDS(1),
    .options_size = sizeof(PathOptions),
    .check = check_info,
    .run = run_info,
};

const DipCommand dip_path_convert_command = {
    .name = "path convert",
    .summary = "rewrite a camera path as .pth (text) or .bth (binary)",
    .usage = "IN OUT.pth|OUT.bth",
    .text = "Path convert reads a camera path of either format and writes it in the format that "
            "the second name ends in. A text file can be edited; a binary file is smaller. Both "
            "hold exactly the same path.",
    .examples = convert_examples,
    .example_count = DIP_ARRAY_COUNT(convert_examples),
    .parts = &all_parts,
    .operands = PATH_OPERANDS(2),
    .options_size = sizeof(PathOptions),
    .check = check_convert,
    .run = run_convert,
};
