// Declares the options that commands share because a session (session.h) uses them: the options of
// the scene, the camera and the panes.
#ifndef DIP_APP_SESSION_SESSION_OPTIONS_H
#define DIP_APP_SESSION_SESSION_OPTIONS_H

#include "app/cli/options.h"
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/base/isa.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>

enum { DIP_MAX_MODELS = 64 };

// The scenes of models that come with Diptych, as X(name). --scene takes such a name, too, and then
// reads config/NAME.ini.
#define DIP_SHIPPED_SCENE_LIST(X) X(courtyard) X(torture)

// The values of the options. Texts are borrowed from argv. A text is NULL, and a has_... is false,
// if the option is not given; then the ini decides if it has a key for it. Every other field is 0
// if its option is not given, which stands for the option's default.
typedef struct DipSessionOptions {
    const char *config;
    const char *models[DIP_MAX_MODELS];
    int model_count;
    DipUpAxis up;   // Axis of the model files that points up.
    bool no_ground; // True if models of the command line get no ground.
    bool has_shading;
    DipModelShading shading; // Where the light of lit surfaces is computed.
    int look;                // Variant of the gallery's scene, counted from 0.
    // Scene of the gallery to show, "tour", a shipped scene, or "models" for the ini's models.
    const char *scene;
    // Animation of the models that plays, or "none". If it is NULL and there are models of the
    // command line, the first animation of each of them plays.
    const char *animation;
    bool has_animation_time;
    double animation_time_s; // Time of the animation at which the models stand still.
    int import_seconds;      // Most seconds that importing the models may take; 0 for the default.
    bool force_all_effects;
    // Camera path that replaces the ini's: a file, or the name of a camera of the models.
    const char *path;
    const char *category; // Which of the ini's paths to fly: "AA", ...
    bool has_pose;
    DipCamKey pose;         // Where the camera stands still, instead of flying a path.
    double fov_y_deg;       // Vertical field of view on every path, in degrees; 0 if not given.
    DipCamPathEnd path_end; // What the camera does at the end of a path.
    bool has_current;
    DipQuality current;
    bool has_requested;
    DipQuality requested;
    bool has_size;
    DipOptionSize size; // Size of one pane.
    bool has_threads;
    int threads; // Number of threads; 0 for all processors.
    bool has_isa;
    DipIsa isa;
    bool timing; // True to print at the end how long starting and ending took.
} DipSessionOptions;

// Tables of the options in this struct. Each command takes the tables that make sense for it.
extern const DipOptionTable dip_scene_option_table;    // --config --model --up ...
extern const DipOptionTable dip_path_option_table;     // --path
extern const DipOptionTable dip_category_option_table; // --category
extern const DipOptionTable dip_camera_option_table;   // --pose --fov --path-end
extern const DipOptionTable dip_pane_option_table;     // --current --requested --timing
extern const DipOptionTable dip_size_option_table;     // --size --isa
extern const DipOptionTable dip_threads_option_table;  // --threads

// Returns the ini of the shipped scene that --scene names, such as "config/torture.ini", or NULL if
// --scene is not given or names something else.
const char *dip_session_shipped_ini(const DipSessionOptions *options);

// Refuses options that exclude each other.
bool dip_session_options_check(const DipSessionOptions *options, DipError *err);

// Reads the name of an instruction set that this machine has, or "auto" for the best one.
bool dip_option_isa(const DipOptionRow *row, const char *value, DipIsa *isa, DipError *err);

#endif
