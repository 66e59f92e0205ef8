// Opens a session, which is everything that a command needs to draw: the settings of the ini file,
// the scene, the camera track and the painters (painter.h) of both panes. The scene consists of
// models, or it is a scene of the gallery (app/gallery), which is written in code. The track has
// the camera paths of all categories. A category is a group of settings, such as "AA", for which
// the ini can name a camera path.
#ifndef DIP_APP_SESSION_SESSION_H
#define DIP_APP_SESSION_SESSION_H

#include "app/gallery/gallery.h"
#include "app/session/backdrop.h"
#include "app/session/ground.h"
#include "app/session/painter.h"
#include "app/session/session_options.h"
#include "assets/importer.h"
#include "assets/model.h"
#include "campaths/camtrack.h"
#include "config/config.h"
#include "renderer/scene/renderer.h"

enum { DIP_PANE_CURRENT, DIP_PANE_REQUESTED, DIP_PANE_COUNT };

extern const char *const dip_pane_names[DIP_PANE_COUNT]; // "current", "requested"

// --- how long the parts of the start take --------------------------------------------------------

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

// The durations of the parts, in milliseconds, and three moments by dip_clock_ns. The duration of a
// part that did not run is 0.
typedef struct DipStartTimes {
#define DIP_START_TIME_FIELD(name, text) double name##_ms;
    DIP_START_TIME_LIST(DIP_START_TIME_FIELD)
#undef DIP_START_TIME_FIELD
    int64_t begin_ns;  // When the program started.
    int64_t opened_ns; // When everything was loaded.
    int64_t ended_ns;  // When the command had done its work and began to free its memory; 0 if the
                       // command does not say when.
} DipStartTimes;

// Returns the milliseconds that have passed since begin_ns, which is a time by dip_clock_ns.
double dip_start_times_since_ms(int64_t begin_ns);

// Fills in the parts first_frame and total at the first call. Call this function after every frame.
void dip_start_times_frame(DipStartTimes *times);

// Formats the parts as "start, ms: ini 0.4 import 21.3 ...", for --timing.
void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes);

// --- the session ---------------------------------------------------------------------------------

// Says what a session loads. Every session has the ini and the pool of threads.
typedef struct DipSessionDef {
    const DipSessionOptions *options; // Borrowed until the session is closed.
    const DipImporter *importer;      // Imports the models; NULL to import them in this process.
                                      // Borrowed until the session is closed.
    const char *log;                  // File of --log, or NULL if the ini's log file is used.
    bool scene;                       // True to load the scene's models and the camera paths.
    bool renderers;                   // True to make a renderer for each pane; needs `scene`.
    bool keep_model;                  // True to keep the models' data for the reference renderer.
    bool warnings_are_known;          // True if the process that started this one has shown them.
    int64_t begin_ns;                 // When the program started, by dip_clock_ns.
} DipSessionDef;

// A camera of the models.
typedef struct DipSessionCamera {
    char *name;
    DipCamPath *path;
    double fov_y_deg; // Vertical field of view that the model file gives.
} DipSessionCamera;

// The animations of the models, of which the user can choose one.
typedef struct DipSessionAnimations {
    char **names; // Names of the animations, each once, in the order of the files.
    int count;
    int playing; // Index of the animation that the models show, or -1 if they show none.
} DipSessionAnimations;

// Number of warnings that a session keeps. An ini or a model can cause any number of them.
enum { DIP_SESSION_MAX_WARNINGS = 256 };

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
    DipModel *model;        // NULL unless the session keeps it for the reference renderer.
    DipAddedSurface *added; // The ground below that model, or the environment behind it; NULL if
                            // neither is shown.
    DipEnvironmentDef *environment; // What the models reflect; NULL if no environment is used.
    // The model's scene with its background and sky, and with the ground or the backdrop. Points
    // into `model`, `added` and `environment`.
    DipSceneDef scene_def;
    DipSessionAnimations animations;
    // The extent and the silhouette of the models, without the ground. The silhouette is known only
    // if the camera orbits the models.
    DipExtent extent;
    DipSilhouette silhouette;
    DipCamTrack track;  // The camera path of each category.
    DipCamPath **paths; // The paths of files, of --pose and of the orbit. A file that two
                        // categories name is loaded once.
    int path_count;
    // The cameras of the models. The track has as many of them as fit, from the index
    // DIP_CATEGORY_COUNT on.
    DipSessionCamera *cameras;
    int camera_count;
    DipPainter *renderers[DIP_PANE_COUNT]; // NULL unless the def asks for renderers.
    // True if the panes of the next frames may copy each other's pixels
    // (dip_renderer_copy_shading). Callers set this field for frames that are drawn to be seen, and
    // clear it where they measure each pane's own time or work.
    bool shares_shading;
    unsigned shared_frames; // Number of frames drawn with shares_shading. This number determines
                            // which pane copies next.
    // True if the session shows a scene of the gallery. If the session was opened with such a
    // scene, `scene` is NULL, because no models are loaded.
    bool shows_gallery;
    int gallery_scene;   // Index of the scene, or DIP_GALLERY_TOUR.
    DipGallery *gallery; // What the renderers draw; NULL if they draw models or do not exist.
    DipCamPath *gallery_path;
    DipCamTrack models_track; // Keeps the track of the models while the session shows the gallery.
    char *assets;             // Folder of the shipped assets.
    DipStartTimes times;
    // The warnings that opening the session gave, in the order of loading: those of the ini first,
    // then those of the models, their cameras and the camera paths. Records and reports list them.
    DipErrorList warnings;
    int warnings_left_out; // Number of further warnings, which are beyond DIP_SESSION_MAX_WARNINGS.
    bool orbiting;         // True if the camera orbits the model, because no camera path was given.
} DipSession;

// Loads everything that the def asks for. Adds every error and warning to *faults, with its file
// and line. If there is at least one error, returns false and leaves the session empty.
bool dip_session_open(DipSession *session, const DipSessionDef *def, DipErrorList *faults);
void dip_session_close(DipSession *session);

// Loads `model` and `scene_def` for the reference renderer, unless the session has them already. A
// session does not keep them by default, because the models' pictures take tens of megabytes.
bool dip_session_keep_model(DipSession *session, DipError *err);

// Returns the file of the first model, from the command line or the ini, or "" if there is none. If
// the session shows the gallery, returns the name of its scene, or "tour".
const char *dip_session_scene_file(const DipSession *session);

// Opens the session's scene of the gallery, so that it can be drawn with this pool of threads. The
// caller destroys the gallery. Returns NULL and fills *err on failure.
DipGallery *dip_session_open_gallery(const DipSession *session, DipPool *pool, DipIsa isa,
                                     DipError *err);

// Makes a painter that draws `gallery`, or the session's models if `gallery` is NULL, with the
// session's threads, instruction set and reflection. Its frames have the given size in pixels. The
// caller destroys it. Fails as dip_painter_create does.
DipPainter *dip_session_make_painter(const DipSession *session, DipGallery *gallery,
                                     const DipQuality *quality, int width, int height,
                                     DipError *err);

// Shows the next scene in a ring of all scenes of the gallery and, if they are loaded, the models.
// `step` is 1 for the next scene and -1 for the one before. The session must have renderers. The
// panes keep their settings. The new renderers have the size `pane_size`, so a caller that has
// resized the old ones must resize these, too. If opening the scene fails, nothing changes.
bool dip_session_step_scene(DipSession *session, int step, DipError *err);

// Returns the title of the gallery scene that the session shows at the time play_ns, such as "Blend
// modes". Returns "Models" if the session shows models.
const char *dip_session_scene_title(const DipSession *session, int64_t play_ns);

// Returns the name of a variant of the gallery scene that the session shows at the time play_ns.
// `look` may be any number: after the last variant comes the first one again.
const char *dip_session_scene_look(const DipSession *session, int look, int64_t play_ns);

// Returns the field of view of --fov, or fov_y_deg if the option is not given.
double dip_session_fov(const DipSession *session, double fov_y_deg);

// Returns the name of a category of the ini's camera paths ("DEFAULT", "AA", ...), or "?" for
// another number.
const char *dip_session_category(int category);

// Returns the name of a camera path of a track: the name of a category or of a camera of the
// models.
const char *dip_session_path_name(const DipCamTrack *track, int category);

// One frame of both panes.
typedef struct DipSessionFrame {
    DipFrame panes[DIP_PANE_COUNT];
    // Wall-clock time to draw both panes. It can be less than the sum of the panes' times, because
    // the panes share work.
    double ms;
    // True if the requested pane is a copy of the current one, because both have the same settings.
    // The copy shares the pixels, and its counters and stage times are 0. With --force-all-effects,
    // both panes are always drawn.
    bool copied;
} DipSessionFrame;

// Draws both panes from a pose. Things that move are drawn where they are at the time play_ns.
// dip_renderer_set_frame_index says what `frame_index` is for. Both renderers must have the same
// size.
bool dip_session_draw_pose(DipSession *session, const DipPose *pose, int64_t play_ns,
                           uint64_t frame_index, DipSessionFrame *frame, DipError *err);

// Draws both panes from the pose that the active camera path has at the time play_ns. Stores this
// pose in *pose.
bool dip_session_draw(DipSession *session, int64_t play_ns, uint64_t frame_index, DipPose *pose,
                      DipSessionFrame *frame, DipError *err);

#endif
