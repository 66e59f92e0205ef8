// Lets game controllers act: a button does the same as a key or carries out an action, and sticks
// and triggers fly the camera.
#ifndef DIP_APP_PREVIEW_STATE_CONTROLLER_H
#define DIP_APP_PREVIEW_STATE_CONTROLLER_H

#include "app/display/display.h"
#include "app/preview/state/state.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>

enum { DIP_MAX_CONTROLLERS = 4 };

// The connected controllers whose sticks and triggers steer the camera. Of further controllers,
// only the buttons act. Zero-initialise.
typedef struct DipControllers {
    struct {
        bool used;
        int controller; // The number by which events name the controller.
        double axes[DIP_CONTROLLER_AXIS_COUNT];
    } slots[DIP_MAX_CONTROLLERS];
} DipControllers;

// Returns whether the event comes from a controller.
bool dip_controllers_concern(const DipEvent *event);

// Handles an event of a controller. Shows a notice when a controller is connected or disconnected.
// Carries out the action of a button that was pressed. If the button stands for a key instead,
// fills in *key with the event of that key and returns true; the caller then handles *key as an
// event of the keyboard.
bool dip_controllers_handle(DipControllers *controllers, DipPreviewState *state,
                            const DipEvent *event, int64_t now_ns, DipEvent *key);

// Moves the camera as the left sticks and the triggers say, then turns it as the right sticks say.
// A fully tilted stick is as fast as a key. Returns whether a stick or trigger steers the camera.
bool dip_controllers_fly(const DipControllers *controllers, DipPose *pose, double speed_m_per_s,
                         double seconds);

#endif
