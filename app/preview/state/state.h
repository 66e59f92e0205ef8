// Holds the state of the preview, and changes it by the user's actions. The state knows neither
// pixels nor displays.
#ifndef DIP_APP_PREVIEW_STATE_STATE_H
#define DIP_APP_PREVIEW_STATE_STATE_H

#include "app/preview/prices/choice.h"
#include "app/preview/prices/costs.h"
#include "app/preview/state/path_editor.h"
#include "app/preview/state/scene_words.h"
#include "app/preview/state/tool_state.h"
#include "app/session/session.h"
#include "campaths/camtrack.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stdint.h>

// What a key, a button or another program can ask for. Some actions have an argument: SETTING takes
// a DipSetting, PATH the index of a path in the track (a category or a camera of the models), and
// ANIMATION the index of an animation of the models, or -1 for none. Notes beside other actions
// name their arguments.
typedef enum DipAction {
    DIP_ACTION_SETTING,
    DIP_ACTION_NEXT_PANE,
    DIP_ACTION_APPLY,
    DIP_ACTION_PAUSE,
    DIP_ACTION_STEP, // Pauses, and moves the time by `argument` steps.
    DIP_ACTION_NEXT_PATH,
    DIP_ACTION_PATH,
    DIP_ACTION_ANIMATION,
    DIP_ACTION_NEXT_SCENE,
    DIP_ACTION_LOOK,
    DIP_ACTION_CAMERA,
    DIP_ACTION_CAMERA_BACK, // Gives the free camera the pose of the path.
    DIP_ACTION_ORBIT,    // Frees the camera. A free camera switches between orbiting and turning on
                         // the spot.
    DIP_ACTION_SPEED,    // Makes the free camera faster (reversed: slower) by `argument` steps.
    DIP_ACTION_PATH_END, // Changes what paths do at their end by `argument` values of
                         // DipCamPathEnd.
    DIP_ACTION_PATH_EDIT, // Edits a path; the argument is a DipPathEdit.
    DIP_ACTION_HELP,
    DIP_ACTION_PANEL,
    DIP_ACTION_COSTS,
    DIP_ACTION_ADVICE, // Takes the advice for the budget; reversed, for the next budget.
    DIP_ACTION_TAB,    // Opens the dock at the tab `argument`; folds it if that tab shows already.
    DIP_ACTION_DOCK,   // Folds or opens the dock.
    DIP_ACTION_BARE,   // Shows nothing but the panes, or shows everything again.
    DIP_ACTION_UNDO,   // Takes the last change of settings back; reversed, makes it once more.
    DIP_ACTION_PRESET, // Gives the requested pane a preset; the argument is a DipPreset.
    DIP_ACTION_SEEK,   // Moves the time forward by `argument` milliseconds or, reversed, back.
    DIP_ACTION_LOUPE,
    DIP_ACTION_ZOOM,       // Chooses the loupe's next zoom.
    DIP_ACTION_COMPARISON, // Chooses the next comparison.
    DIP_ACTION_MAP,        // Chooses the next map.
    DIP_ACTION_ADJUST, // Changes the map's brightness, the difference's gain or the wipe's divider.
    DIP_ACTION_BLINK,
    DIP_ACTION_SCREENSHOT, // Saves the window's picture or, reversed, the panes without overlays.
    DIP_ACTION_SAVE_POSE,
    DIP_ACTION_FULL_SCREEN,
    DIP_ACTION_QUIT,
    DIP_ACTION_COUNT
} DipAction;

enum { DIP_NOTICE_SIZE = 320, DIP_UNDO_DEPTH = 32, DIP_HELP_WORDS = 32 };

// Presets: settings that a user can ask for by name.
typedef enum DipPreset {
    DIP_PRESET_PERFORMANCE,
    DIP_PRESET_BALANCED,
    DIP_PRESET_QUALITY,
    DIP_PRESET_BEST,
    DIP_PRESET_INI,     // The settings that the requested pane began with.
    DIP_PRESET_CURRENT, // The current pane's settings.
    DIP_PRESET_COUNT
} DipPreset;

// How the user flies the free camera. The window's controls and the actions write the user's wishes
// into this struct; the loop carries them out once in each turn (pilot.h).
typedef struct DipFlight {
    bool orbits; // Dragging turns the camera about a point, and the wheel zooms. Otherwise dragging
                 // turns the camera on the spot, and the wheel changes its speed.
    bool reset;  // In the next turn, the camera gets its path's pose. The turn clears this.
    int speed_steps;           // Steps by which the user has changed the speed (pilot.h).
    double base_speed_m_per_s; // Speed at 0 steps; suits the scene (dip_pilot_enter).
    // What the mouse has done since the last turn of the loop. `drag_right` and `drag_up` are
    // fractions of a pane's height. `zoom_steps` counts the wheel's steps, positive away from the
    // user.
    double drag_right;
    double drag_up;
    int zoom_steps;
    // Steps of the camera to the right and forward (below 0: left and back) that buttons have asked
    // for since the last turn of the loop.
    int right_steps;
    int forward_steps;
    bool pressed;  // A button that flies the camera was pressed over a pane and is held.
    bool dragging; // The pointer has moved too far for a click.
    int press_x;   // Where the button was pressed, in pixels of the window.
    int press_y;
    int drag_x; // Where the pointer was at the press, or when `drag_right` and `drag_up` last
                // changed.
    int drag_y;
    bool knows_centre; // False if `centre_world`, the point to orbit, must be found anew.
    double centre_world[3];
} DipFlight;

typedef struct DipPreviewState {
    DipQuality quality[DIP_PANE_COUNT];
    DipQuality begun_quality[DIP_PANE_COUNT]; // Settings with which the session began.
    bool edited[DIP_PANE_COUNT];              // The panes whose settings the keys change.
    DipCamTrack *track;                       // Borrowed.
    int64_t play_ns; // Time that the camera path and the scene follow, never below 0. A path begins
                     // at track->start_ns.
    int64_t step_ns; // How far a step of DIP_ACTION_STEP moves the time.
    bool paused;
    bool stands;           // Neither the camera path nor the scene moves, so time does not run.
    bool scene_moves;      // Something in the scene moves. True for every scene of the gallery.
    bool lacks_shadows;    // Nothing in the scene casts a shadow that `shadows` could draw.
    DipPathEditor *editor; // Owned by the loop; NULL if paths cannot be edited.
    DipFlight flight;      // How the user flies the free camera.

    bool manual;        // The user flies the camera. Time then runs only if the scene moves.
    bool shows_gallery; // The panes show a scene of the gallery.
    int scene_step;     // Number of scenes by which the user asked to go forward (below 0: back).
    const DipSessionAnimations
        *animations;         // The models' animations. Borrowed; NULL if there are none.
    bool wants_animation;    // The user asked for the animation `wanted_animation`. Cleared in the
                             // next turn.
    int wanted_animation;    // Index of this animation; -1 means that the models stand still.
    bool opens_animation;    // The models are being opened with another animation. Until then, the
                             // previous one plays.
    int look;                // Variant of the gallery's scene, modulo the number of variants.
    const char *scene_title; // Title of the gallery's scene; NULL if the panes show models.
    const char *scene_look;  // Name of the gallery scene's variant; NULL if the panes show models.
    bool help;               // The help shows.
    char help_words[DIP_HELP_WORDS]; // If not empty, the help lists only keys with these words.
    const DipCostReport *costs;      // Borrowed; NULL if there is no cost report.
    bool show_costs;                 // The table of costs shows.
    DipPreviewChoice *choice;        // Settings to choose from (choice.h). Borrowed; may be NULL.
    // Time within which a frame has to be drawn: one refresh of the display, unless the user has
    // chosen another time.
    double budget_ms;
    bool has_budget;    // The user has chosen budget_ms.
    double refresh_ms;  // Time of one refresh of the display.
    bool wants_errors;  // Another program has subscribed to the errors. Cleared if they cannot be
                        // measured.
    bool wants_prices;  // Another program has subscribed to the prices.
    bool wants_picture; // Another program waits for a picture, even of a hidden window.
    bool measures_here; // Prices are measured in the panes' picture although there is a report.
    char scene_words[DIP_SCENE_WORDS_BYTES]; // Options that name the scene: " --model a.glb".
    int pane_width; // Size of a pane's picture, in pixels; 0 before the first one.
    int pane_height;
    bool quit;        // The user or another program has ended the preview.
    bool in_terminal; // The preview shows characters, without the window's tools.
    bool full_screen;
    DipToolState tools;
    // Settings before each change, the oldest first. After them come the settings that UNDO has
    // taken back.
    DipQuality undo[DIP_UNDO_DEPTH][DIP_PANE_COUNT];
    int undo_count;
    int redo_count;
    bool screenshot; // The user asked for a screenshot. Cleared when the screenshot is saved or
                     // saving has failed.
    bool plain_screenshot; // The screenshot shows the panes without overlays.
    bool save_pose; // The user asked to save the camera's pose. Cleared when the pose is saved or
                    // saving has failed.
    DipSetting open_setting; // The setting whose steps the settings tab shows.
    bool shows_presets;      // A narrow settings tab shows presets in place of settings.
    bool copy_settings;      // The user asked to copy the requested settings. Cleared when done.
    bool paste_settings;     // The user asked to paste settings. Cleared when done.
    char notice[DIP_NOTICE_SIZE]; // Tells the user what just happened; may be empty.
    int64_t notice_end_ns;        // When the notice disappears, on the clock of now_ns.
    unsigned scene_changes;       // Grows whenever the panes' pictures have to change.
} DipPreviewState;

// Makes the initial state, in which the keys change the requested pane. The track must outlive the
// state.
DipPreviewState dip_preview_state_make(const DipQuality quality[DIP_PANE_COUNT],
                                       DipCamTrack *track);

// Returns whether the action needs a window, because a terminal cannot show what it does.
bool dip_preview_needs_window(DipAction action);

// Carries out an action. `reverse`, which Shift sets, chooses the value before instead of the next
// one. For some actions it means something else (DipAction), and others ignore it. In a terminal,
// an action that needs a window only shows a notice.
void dip_preview_act(DipPreviewState *state, DipAction action, int argument, bool reverse,
                     int64_t now_ns);

// Gives a setting a step (one of its values) in the panes whose settings the keys change. If the
// step does not fit the other settings, a notice says why and nothing changes.
void dip_preview_set_step(DipPreviewState *state, DipSetting setting, int step, int64_t now_ns);

// If `quality` differs from a pane's settings, gives it to the pane as one change that UNDO takes
// back, and shows a notice. Otherwise does nothing.
void dip_preview_set_quality(DipPreviewState *state, int pane, const DipQuality *quality,
                             int64_t now_ns);

// Adds `by` to the factor by which controls are enlarged. The factor stays within 0.75 and 4.
void dip_preview_scale_ui(DipPreviewState *state, double by, int64_t now_ns);

// Finds a preset's settings. The presets up to BEST are settings from state->choice that keep
// within the budget. Returns false, and leaves *quality as it is, for these presets if nothing is
// advised for the budget (dip_preview_advised).
bool dip_preview_preset(const DipPreviewState *state, DipPreset preset, DipQuality *quality);

// Writes four lines that tell how to make a cost report of this scene. The second and the fourth
// line are commands.
enum { DIP_HOW_TO_LINES = 4 };
typedef char DipHowTo[DIP_HOW_TO_LINES][DIP_SCENE_WORDS_BYTES + 64];
void dip_preview_how_to(const DipPreviewState *state, DipHowTo lines);

// Returns a preset's name for a button ("Balanced").
const char *dip_preview_preset_name(DipPreset preset);

// Lists the budgets to choose from, in milliseconds: those of the cost report or, without one, the
// times of a frame at 240, 120, 60 and 30 frames a second. Returns their number.
int dip_preview_budgets(const DipPreviewState *state, double list[DIP_COST_MAX_BUDGETS]);

// Chooses another budget. A budget outside 1 to 1000 ms is moved to the nearer end of this range; 0
// or less means the time of one refresh of the display.
void dip_preview_set_budget(DipPreviewState *state, double budget_ms);

// Moves the budget by steps through the usual frame rates, from 24 to 240 frames a second. Steps
// above 0 go to higher rates. A step beyond the last rate does nothing.
void dip_preview_step_frame_rate(DipPreviewState *state, int steps);

// Takes the time between two refreshes of the display as the budget, unless the user has chosen
// one.
void dip_preview_follow_refresh(DipPreviewState *state, double refresh_ms);

// Returns whether the open dock (layout.h) shows the tab of times: the lines with the panes' times,
// errors and work.
bool dip_preview_shows_times(const DipPreviewState *state);

// Returns the pane whose settings controls show and change: the requested pane, unless the user
// edits only the current pane.
int dip_preview_edited_pane(const DipPreviewState *state);

// Lets the keys change the settings of one pane alone.
void dip_preview_edit_only(DipPreviewState *state, int pane);

extern const char *const dip_pane_titles[DIP_PANE_COUNT]; // "Current", "Requested"

// Sets state->play_ns; a time below 0 becomes 0.
void dip_preview_seek(DipPreviewState *state, int64_t play_ns);

// Returns the path that plays: that of the active category or, if this category has no path, of
// category 0. Returns NULL if neither has a path.
const DipCamPath *dip_preview_playing_path(const DipPreviewState *state);

// Returns whether all poses of the playing path are the same. Returns false without a path.
bool dip_preview_path_stands(const DipPreviewState *state);

// Returns whether time runs: the preview is not paused, and the scene moves or the camera moves
// along its path.
bool dip_preview_time_runs(const DipPreviewState *state);

// Returns whether camera and scene stand still. `flying` means that the user moves the free camera.
bool dip_preview_rests(const DipPreviewState *state, bool flying);

// Lets time pass: adds elapsed_ns to state->play_ns if time runs (dip_preview_time_runs). Removes a
// notice that has ended.
void dip_preview_advance(DipPreviewState *state, int64_t elapsed_ns, int64_t now_ns);

// The first function returns the time on the path that plays, from 0 to the path's length. The
// second function returns this length. Both return 0 without a path. A path that does not loop ends
// at its last key. While the camera goes back along a path, the time decreases.
int64_t dip_preview_path_ns(const DipPreviewState *state);
int64_t dip_preview_path_length_ns(const DipPreviewState *state);

// Moves the time on the path that plays to `path_ns`, from 0 to the path's length.
void dip_preview_seek_path(DipPreviewState *state, int64_t path_ns);

// Shows a notice for a few seconds.
void dip_preview_notice(DipPreviewState *state, int64_t now_ns, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Writes an error for a notice: "[key] message (file:line)". Leaves out the file's folder and the
// parts that the error does not have, and cuts long parts.
void dip_preview_error_text(const DipError *err, char text[DIP_NOTICE_SIZE]);

// Lets the notice that shows stay for 10 seconds, or until the next one. Call it for errors and
// warnings, which take longer to read than other notices.
void dip_preview_keep_notice(DipPreviewState *state, int64_t now_ns);

// Returns the title of a path of the state's track. A path of a category has the category's title;
// if this path is the motion of a camera of the models, its title is the camera's name. The paths
// past the last category are motions of such cameras, too.
const char *dip_preview_path_title(const DipPreviewState *state, int category);

// Returns the name of a category of paths for display: "Default", "Water", or the title of the
// first setting that its path shows best.
const char *dip_preview_category_title(int category);

// Returns the category whose path shows a setting best, or -1 if the setting has no such path.
int dip_preview_category_of(DipSetting setting);

// Writes those settings that differ from their defaults, each with its step, in full ("Antialiasing
// 4x, Adaptive AA") or briefly ("AA 4x, adaptive AA"). Writes "Default settings" if no setting
// differs. The text is cut if it does not fit.
void dip_preview_describe(const DipQuality *quality, bool brief, char *text, size_t size_bytes);

#endif
