// Opens a session, which is everything that a command needs to draw: the settings of the ini file,
// the scene, the camera track and the painters of both panes.
#ifndef DIP_APP_SESSION_SESSION_H
#define DIP_APP_SESSION_SESSION_H

#include "app/gallery/gallery.h"
#include "app/session/painter.h"
#include "app/session/session_options.h"
#include "assets/importer.h"
#include "assets/model.h"
#include "campaths/camtrack.h"
#include "config/config.h"
#include "renderer/scene/renderer.h"

enum { DIP_PANE_CURRENT, DIP_PANE_REQUESTED, DIP_PANE_COUNT };

extern const char *const dip_pane_names[DIP_PANE_COUNT]; // "current", "requested"

// --- how long the parts of the start take
// ---------------------------------------------------------

// The parts of the start as X(name, "what the time covers"), in the order of a run.
#define DIP_START_TIME_LIST(X)                                                                     \
    X(ini, "reading the ini and starting the threads")                                             \
    X(import, "turning model files into meshes and materials")                                     \
    X(pictures, "reading and decoding pictures")                                                   \
    X(textures, "making mip chains, and compressed ones if a pane uses them")                      \
    X(meshes, "splitting meshes into chunks")                                                      \
    X(paths, "reading camera paths")                                                               \
    X(renderers, "making the renderers of both panes")                                             \
    X(first_frame, "from the loaded session to the first complete frame")                          \
    X(total, "from the start of the program to the first frame")

// Durations are in milliseconds; the duration of a part that did not run is 0. The last three
// fields are times by dip_clock_ns.
typedef struct DipStartTimes {
#define DIP_START_TIME_FIELD(name, text) double name##_ms;
    DIP_START_TIME_LIST(DIP_START_TIME_FIELD)
#undef DIP_START_TIME_FIELD
    int64_t begin_ns;  // When the program started.
    int64_t opened_ns; // When everything was loaded.
    int64_t ended_ns;  // When the command had done its work and began to free its memory.
} DipStartTimes;

// Returns the milliseconds that have passed since begin_ns, a time by dip_clock_ns.
double dip_start_times_since_ms(int64_t begin_ns);

// Call this function after every frame. Its first call fills in first_frame and total.
void dip_start_times_frame(DipStartTimes *times);

// Formats the parts as "start, ms: ini 0.4 import 21.3 ...", for --timing.
void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes);

// --- the session
// ----------------------------------------------------------------------------------

// What a session loads. Every session has the ini and the pool of threads.
typedef struct DipSessionDef {
    const DipSessionOptions *options; // Borrowed until the session is closed.
    const DipImporter *importer;      // Imports the models; NULL: they are imported here. Borrowed.
    const char *log;                  // File of --log, which replaces the ini's log file; or NULL.
    bool scene;                       // Load the models and the camera paths.
    bool renderers;                   // Make a renderer for each pane. This needs the scene.
    bool keep_model;                  // Keep the models' data, which the reference renderer reads.
    int64_t begin_ns;                 // When the program started, by dip_clock_ns.
} DipSessionDef;

// A camera of the models.
typedef struct DipSessionCamera {
    char *name;
    DipCamPath *path;
    double fov_y_deg; // Vertical field of view in the file.
} DipSessionCamera;

typedef struct DipSession {
    const DipSessionOptions *options; // Borrowed from the def.
    const DipImporter *importer;      // Borrowed from the def.
    DipConfig config;
    DipPool *pool;
    DipIsa isa;
    DipConfigSize pane_size; // Size of one pane in pixels, from --size or the ini.
    DipScene *scene;
    // The reflection in the water, from the ini. The water level comes from the scene instead if
    // --model is given or if the ini has no level.
    DipReflectionDef reflection;
    bool force_all_effects;
    DipModel *model;       // NULL unless the session keeps it for the reference renderer.
    DipSceneDef scene_def; // The model's scene with its background and sky. Points into `model`.
    DipCamTrack track;     // The camera path of each category of the ini.
    DipCamPath **paths;    // The loaded paths; a file that two categories name is loaded once.
    int path_count;
    // The cameras of the models. The track has as many of them as fit, from the index
    // DIP_CATEGORY_COUNT on.
    DipSessionCamera *cameras;
    int camera_count;
    DipPainter *renderers[DIP_PANE_COUNT]; // NULL unless the def asks for renderers.
    // The session shows a scene of the gallery. If it began so, `scene` is NULL, because no models
    // are loaded.
    bool shows_gallery;
    int gallery_scene;   // Index of the scene, or DIP_GALLERY_TOUR.
    DipGallery *gallery; // What the renderers draw; NULL without renderers.
    DipCamPath *gallery_path;
    DipCamTrack models_track; // Track of the models' paths while the gallery shows.
    char *assets;             // Folder of the shipped assets.
    DipStartTimes times;
    bool orbiting; // The camera orbits the model, because no camera path was given.
} DipSession;

// Loads everything that the def asks for. Adds every error and warning to *faults, with its file
// and line. If there is at least one error, returns false and leaves the session empty.
bool dip_session_open(DipSession *session, const DipSessionDef *def, DipErrorList *faults);
void dip_session_close(DipSession *session);

// Loads `model` and `scene_def` for the reference renderer, unless the session has them already. A
// session does not keep them by default, because their pictures take tens of megabytes.
bool dip_session_keep_model(DipSession *session, DipError *err);

// File of the first model, from the command line or the ini; "" if there is none.
const char *dip_session_scene_file(const DipSession *session);

// Opens the session's scene of the gallery for drawing with a pool. The caller destroys the
// gallery. Returns NULL on failure.
DipGallery *dip_session_open_gallery(const DipSession *session, DipPool *pool, DipIsa isa,
                                     DipError *err);

// Shows the next scene in a ring of all scenes of the gallery and, if they are loaded, the models.
// `step` is 1 for the next scene and -1 for the one before. The session must have renderers; their
// settings and size stay. If opening the scene fails, nothing changes.
bool dip_session_step_scene(DipSession *session, int step, DipError *err);

// Name of what the session shows: "Blend modes", or "Models".
const char *dip_session_scene_title(const DipSession *session, int64_t play_ns);

// Name of a variant of the gallery's scene. Any number `look` names one: after the last variant
// comes the first one again.
const char *dip_session_scene_look(const DipSession *session, int look, int64_t play_ns);

// Returns the field of view of --fov, or fov_y_deg if the option is not given.
double dip_session_fov(const DipSession *session, double fov_y_deg);

// Name of a camera path of the track: a category of the ini, "DEFAULT", "AA", ..., or a camera of
// the models.
const char *dip_session_path_name(const DipSession *session, int category);

// Name of a category of the ini's camera paths: "DEFAULT", "AA", ...
const char *dip_session_category(int category);

// One frame of both panes.
typedef struct DipSessionFrame {
    DipFrame panes[DIP_PANE_COUNT];
    // Wall-clock time of both panes. It is less than the sum of their times if they share work.
    double ms;
    // The requested pane is a copy of the current one, because both have the same settings. The
    // copy took no time and no work, and shares the pixels. With --force-all-effects, both panes
    // are drawn and this is false.
    bool copied;
} DipSessionFrame;

// Draws both panes from a pose. dip_renderer_set_frame_index says what `frame_index` is for. Both
// renderers must have the same size.
bool dip_session_draw_pose(DipSession *session, const DipPose *pose, int64_t play_ns,
                           uint64_t frame_index, DipSessionFrame *frame, DipError *err);

// Draws both panes from the active camera path's pose at a time. Stores this pose in *pose.
bool dip_session_draw(DipSession *session, int64_t play_ns, uint64_t frame_index, DipPose *pose,
                      DipSessionFrame *frame, DipError *err);

#endif
