// Describes in tables the options that a session uses, and reads and checks the options' values.
#include "app/session/session_options.h"

#include "assets/importer.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"
#include "renderer/base/pool.h"

#include <string.h>

#define FIELD(name) offsetof(DipSessionOptions, name)

static const char scene_title[] = "Scene and camera";
static const char drawing_title[] = "Drawing";

bool dip_option_isa(const DipOptionRow *row, const char *value, DipIsa *isa, DipError *err) {
    char available[96] = "auto";
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (dip_isa_available((DipIsa)i)) {
            strcat(strcat(available, "|"), dip_isa_name((DipIsa)i));
        }
    }
    if (strcmp(value, "auto") == 0) {
        *isa = dip_isa_best();
        return true;
    }
    if (!dip_isa_parse(value, isa)) {
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, row->name,
                             "'%.40s' is not an instruction set; give one of %s", value, available);
    }
    return dip_isa_available(*isa) ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, row->name,
                         "this machine cannot run '%s'; give one of %s", value, available);
}

// Reads --isa. The value "auto" leaves the choice to the ini, as if the option were not given.
static bool read_isa(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipSessionOptions *options = fields;
    options->has_isa = strcmp(value, "auto") != 0;
    return dip_option_isa(row, value, &options->isa, err);
}

static bool read_look(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipSessionOptions *options = fields;
    int number;
    if (dip_option_integers(value, ':', 1, &number) != 1 || number < 1 || number > 99) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "a number of a variant from 1 to 99");
    }
    options->look = number - 1;
    return true;
}

// Texts of the help. Each lists the names of an option's values with their meanings.
#define NAME_AND_TEXT(name, text) " `" #name "` " text "."
#define UP_AXES                   DIP_UP_AXIS_LIST(NAME_AND_TEXT)
#define SHADINGS                  DIP_MODEL_SHADING_LIST(NAME_AND_TEXT)
#define PATH_ENDS                 DIP_CAMPATH_END_LIST(NAME_AND_TEXT)

// Reads seven numbers that are separated by spaces, tabs or commas. Returns false if a part is not
// a number, or if there are more or fewer than seven numbers.
static bool read_seven(const char *text, double numbers[7]) {
    static const char separators[] = " \t,";
    int count = 0;
    for (text += strspn(text, separators); *text; text += strspn(text, separators)) {
        const size_t length = strcspn(text, separators);
        if (count == 7 || !dip_number_parse(text, length, &numbers[count++])) {
            return false;
        }
        text += length;
    }
    return count == 7;
}

static bool read_pose(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipSessionOptions *options = fields;
    double numbers[7];
    DipCamPath *path;
    DipError failure;
    if (!read_seven(value, numbers)) {
        return dip_option_refuse(err, DIP_ERROR_TYPE, row->name, value,
                                 "a pose: seven numbers x y z qx qy qz qw in quotes, in the order "
                                 "of a line of a .pth file");
    }
    memcpy(options->pose.position_world, numbers, sizeof options->pose.position_world);
    memcpy(options->pose.orientation, numbers + 3, sizeof options->pose.orientation);
    // Checks the pose by making a path of it, because a pose must follow the same rules as a key of
    // a path.
    if (!dip_campath_create(&options->pose, 1, DIP_CAMPATH_MIN_PERIOD_NS, &path, &failure)) {
        return dip_error_set(err, failure.code, NULL, 0, row->name, "%s: %s", failure.key,
                             failure.message);
    }
    options->pose = dip_campath_key(path, 0);
    dip_campath_destroy(&path);
    options->has_pose = true;
    return true;
}

static const DipOptionRow scene_rows[] = {
    {"--config", "FILE", DIP_OPTION_TEXT, FIELD(config),
     .text = "Read this ini file. Without the option, Diptych reads the ini of the courtyard, the "
             "scene that comes with Diptych."},
    {"--model", "FILE", DIP_OPTION_TEXTS, FIELD(models), .count = FIELD(model_count),
     .room = DIP_MAX_MODELS,
     .text = "Draw this model instead of the ini's. Diptych reads every format that assimp reads. "
             "Repeat the option to draw several files in one scene. The camera orbits the model "
             "unless --path is given."},
    {"--scene", "NAME", DIP_OPTION_TEXT, FIELD(scene),
     .text = "Show this scene that comes with Diptych: courtyard, torture (what is hard for "
             "antialiasing and filtering), or a scene of the gallery: model, shadow, prism, blend, "
             "stencil, toon, dice, phone, quads, cubes, tunnel or water. `tour` shows all of the "
             "gallery, 15 seconds each. `models` shows the ini's models even if the ini names a "
             "scene."},
    {"--look", "N", DIP_OPTION_CUSTOM, .read = read_look,
     .text = "Show the N-th variant of the gallery's scene, such as another resolution of the "
             "shadow map. The first one is 1, which is also the default; docs/gallery.md lists "
             "them."},
    {"--no-ground", NULL, DIP_OPTION_FLAG, FIELD(no_ground),
     .text = "Do not put a ground below the models of --model. Without this option, models get a "
             "plain ground with a soft shade, unless they have a ground, water or a sky."},
    {"--up", "AXIS", DIP_OPTION_CHOICE, FIELD(up), .names = dip_up_axis_names, .most = DIP_UP_COUNT,
     .accepted = "an axis; give one of auto|y|z",
     .text = "The axis of the model files that points up:" UP_AXES " The default is auto."},
    {"--shading", "NAME", DIP_OPTION_CHOICE, FIELD(shading), .given = FIELD(has_shading),
     .names = dip_model_shading_names, .most = DIP_MODEL_SHADING_COUNT,
     .accepted = "a shading; give one of auto|flat|gouraud|phong",
     .text = "Where the light of surfaces without a light map is computed." SHADINGS
             " Without lights, flat, gouraud and phong compute a fixed light of sky and sun. "
             "Without the option, the ini's SHADING decides; with --model, it is auto "
             "(docs/models.md)."},
    {"--animation", "NAME", DIP_OPTION_TEXT, FIELD(animation),
     .text =
         "Play this animation of the models' glTF and MD2 files, or `none`. Without the option, "
         "the "
         "ini's ANIMATION decides; without that and with --model, the first animation of each file "
         "plays. A file without an animation of this name stands still."},
    {"--animation-time", "S", DIP_OPTION_NUMBER, FIELD(animation_time_s),
     .given = FIELD(has_animation_time), .least = 0.0, .most = 1e6,
     .accepted = "a time from 0 to 1,000,000 seconds",
     .text = "Show the animation at S seconds in every frame. A time after the animation's end "
             "counts on "
             "from its beginning, as it does when the animation plays."},
    {"--import-seconds", "N", DIP_OPTION_INTEGER, FIELD(import_seconds), .least = 1,
     .most = DIP_IMPORT_MAX_WALL_S,
     .text = "Refuse the models if reading them takes more than N seconds. The default is 120."},
    {"--force-all-effects", NULL, DIP_OPTION_FLAG, FIELD(force_all_effects),
     .text = "Run every effect even where it cannot be seen. The picture stays the same and takes "
             "longer to draw."},
};

static const DipOptionRow path_rows[] = {
    {"--path", "FILE", DIP_OPTION_TEXT, FIELD(path),
     .text = "Fly this camera path (.pth or .bth) instead of the ini's. The field of view is the "
             "ini's CAMPATH_DEFAULT_FOV. Instead of a file, FILE can be the name of a camera in a "
             "glTF model (docs/models.md), which has its own field of view."},
};

static const DipOptionRow category_rows[] = {
    {"--category", "NAME", DIP_OPTION_TEXT, FIELD(category),
     .text = "Fly this camera path of the ini: DEFAULT, AA, AF, AAA, MIPLOD, WATER, ... The ini "
             "gives the file of the path NAME in its key CAMPATH_NAME."},
};

static const DipOptionRow camera_rows[] = {
    {"--pose", "POSE", DIP_OPTION_CUSTOM, .read = read_pose,
     .text =
         "Let the camera stand still at this pose: the seven numbers x y z qx qy qz qw, in quotes, "
         "in the order of a line of a .pth file (docs/campaths.md). The position is in metres; the "
         "quaternion rotates camera space to world space, so \"0 1.7 6 0 0 0 1\" looks along -Z."},
    {"--fov", "DEGREES", DIP_OPTION_NUMBER, FIELD(fov_y_deg), .least = 1.0, .most = 170.0,
     .accepted = "an angle from 1 to 170 degrees",
     .text = "Vertical field of view of the camera, from 1 to 170 degrees, on every path. Without "
             "the option, the ini decides."},
    {"--path-end", "HOW", DIP_OPTION_CHOICE, FIELD(path_end), .names = dip_campath_end_names,
     .most = DIP_CAMPATH_END_COUNT, .accepted = "the end of a path; give one of loop|once|back",
     .text = "What the camera does at the end of a path." PATH_ENDS
             " The default is loop. Scenes of the gallery have loops of their own."},
};

static const DipOptionRow pane_rows[] = {
    {"--current", "SET", DIP_OPTION_SETTINGS, FIELD(current), .given = FIELD(has_current),
     .text = "Settings of the left pane, such as aa=none. Without the option, the ini decides."},
    {"--requested", "SET", DIP_OPTION_SETTINGS, FIELD(requested), .given = FIELD(has_requested),
     .text =
         "Settings of the right pane, such as aa=4,af=16. Without the option, the ini decides."},
    {"--timing", NULL, DIP_OPTION_FLAG, FIELD(timing),
     .text = "At the end, print how long starting and ending took, and the greatest amount of "
             "memory that was in use."},
};

static const DipOptionRow size_rows[] = {
    {"--size", "WxH", DIP_OPTION_SIZE, FIELD(size), .given = FIELD(has_size),
     .text =
         "Size of one pane in pixels, such as 640x480. Without the option, the ini's RES decides."},
    {"--isa", "NAME", DIP_OPTION_CUSTOM, .read = read_isa,
     .text = "Draw with this instruction set: auto, scalar, sse2, avx2 or avx512. All of them draw "
             "the same picture."},
};

static const DipOptionRow threads_rows[] = {
    {"--threads", "N", DIP_OPTION_INTEGER, FIELD(threads), .given = FIELD(has_threads),
     .most = DIP_MAX_THREADS,
     .accepted = "a number of threads from 1 to 256, or 0 for all processors",
     .text = "Draw with this many threads. 0, which is also the ini's default, stands for all "
             "processors. The picture is the same with any number."},
};

const DipOptionTable dip_scene_option_table = DIP_OPTION_TABLE(scene_title, scene_rows);
const DipOptionTable dip_path_option_table = DIP_OPTION_TABLE(scene_title, path_rows);
const DipOptionTable dip_category_option_table = DIP_OPTION_TABLE(scene_title, category_rows);
const DipOptionTable dip_camera_option_table = DIP_OPTION_TABLE(scene_title, camera_rows);
const DipOptionTable dip_pane_option_table = DIP_OPTION_TABLE(drawing_title, pane_rows);
const DipOptionTable dip_size_option_table = DIP_OPTION_TABLE(drawing_title, size_rows);
const DipOptionTable dip_threads_option_table = DIP_OPTION_TABLE(drawing_title, threads_rows);

const char *dip_session_shipped_ini(const DipSessionOptions *options) {
#define NAME_AND_INI(name) {#name, "config/" #name ".ini"},
    static const char *const shipped[][2] = {DIP_SHIPPED_SCENE_LIST(NAME_AND_INI)};
#undef NAME_AND_INI
    for (size_t i = 0; options->scene && i < sizeof shipped / sizeof *shipped; i++) {
        if (strcmp(options->scene, shipped[i][0]) == 0) {
            return shipped[i][1];
        }
    }
    return NULL;
}

// Returns the option, other than --pose, that says where the camera is, or NULL.
static const char *other_camera(const DipSessionOptions *options) {
    return options->path ? "--path" : options->category ? "--category" : NULL;
}

bool dip_session_options_check(const DipSessionOptions *options, DipError *err) {
    if (options->has_pose && other_camera(options)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--pose",
                             "says where the camera stands, but %s lets it fly; leave out one of "
                             "the two options",
                             other_camera(options));
    }
    if (options->scene && options->model_count) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--scene",
                             "'%.40s' replaces the models, and so does --model; leave out one of "
                             "the two options",
                             options->scene);
    }
    const bool shipped = dip_session_shipped_ini(options) != NULL;
    if (shipped && options->config) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--scene",
                             "the scene '%.40s' has an ini of its own, and --config names another; "
                             "leave out one of the two options",
                             options->scene);
    }
    if (shipped && options->look) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--look",
                             "chooses a variant of a scene of the gallery, but '%.40s' has camera "
                             "paths instead; give --path or --category",
                             options->scene);
    }
    if (options->look && options->model_count) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--look",
                             "chooses a variant of a scene of the gallery, but --model replaces "
                             "the scene; leave out one of the two options");
    }
    if (options->scene && options->category && !shipped && strcmp(options->scene, "models") != 0) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--category",
                             "'%.40s' names one of the ini's paths, but the scene '%.40s' has a "
                             "path of its own; leave out one of the two options",
                             options->category, options->scene);
    }
    if (options->category && (options->path || options->model_count)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--category",
                             "'%.40s' names one of the ini's paths, but the camera follows %s; "
                             "leave out one of the two options",
                             options->category,
                             options->path ? "--path" : "an orbit around --model");
    }
    return true;
}
