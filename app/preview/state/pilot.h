// Flies the free camera: carries out actions that concern the camera, and moves the camera in each
// turn of the loop.
#ifndef DIP_APP_PREVIEW_STATE_PILOT_H
#define DIP_APP_PREVIEW_STATE_PILOT_H

#include "app/preview/state/camera.h"
#include "app/preview/state/controller.h"
#include "app/preview/state/state.h"

// Makes the free camera faster by `steps`; dip_flight_speed says what a step is.
void dip_pilot_change_speed(DipPreviewState *state, int steps, int64_t now_ns);

// Chooses a key (a pose on the edited path, path_editor.h), and moves the free camera there.
void dip_pilot_choose_key(DipPreviewState *state, size_t index, int64_t now_ns);

// Moves the camera by steps to the right and forward, and makes it free if it was not. A step takes
// the camera as far as it flies in a quarter of a second.
void dip_pilot_step(DipPreviewState *state, int right, int forward, int64_t now_ns);

// Makes the camera free if it follows the path, and shows a notice about this.
void dip_pilot_make_free(DipPreviewState *state, int64_t now_ns);

// Returns the speed of the free camera in metres per second. Every four steps of
// flight->speed_steps double the speed.
double dip_flight_speed(const DipFlight *flight);

// Writes the point that the camera orbits. If the panes show models that the user gave, this is the
// middle of the scene's bounding box. In other scenes it is the point on the line of sight that is
// nearest to the middle of the scene, but at least 1 m ahead, so it shows in the middle of the
// picture.
void dip_orbit_centre(const DipSession *session, const DipPose *pose, double centre_world[3]);

// Gives the free camera a speed that suits the session's scene, and decides whether dragging
// orbits. If the panes show models that the user gave, the camera crosses the diagonal of the
// scene's bounding box in four seconds, whatever the models' unit of length is. Otherwise it flies
// 3 metres per second. Call the function for a new session and for another scene.
void dip_pilot_enter(DipFlight *flight, const DipSession *session);

// What the loop gives to dip_pilot_turn.
typedef struct DipPilotTurn {
    const DipSession *session;
    DipCameraKeys keys;                // What the held keys ask for.
    const DipControllers *controllers; // NULL if there are none.
    int64_t elapsed_ns;
} DipPilotTurn;

// Moves the free camera as mouse, keys, controllers and the path editor have asked since the last
// turn. The path editor stops flying its path when the user moves the camera. Returns whether
// something moved the camera.
bool dip_pilot_turn(DipPreviewState *state, const DipPilotTurn *turn, DipPose *pose);

#endif
