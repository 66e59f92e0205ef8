// The free camera: how mouse, wheel and keys fly it.
//
// The window's controls and the keys write into a DipFlight, which is part of the preview's state.
// The loop carries the wishes out once in each turn (pilot.h).
#ifndef DIP_APP_PREVIEW_STATE_FLIGHT_H
#define DIP_APP_PREVIEW_STATE_FLIGHT_H

#include <stdbool.h>

// Plain data. Zero-initialise.
typedef struct DipFlight {
    bool orbits;               // Dragging turns the camera about a point; the wheel zooms.
    bool reset;                // The user wants the pose of the camera path. Cleared when done.
    int speed_steps;           // Each step of the wheel is 1; see dip_flight_speed.
    double base_speed_m_per_s; // Speed at 0 steps. Set by the loop.
    // What the mouse has done since the last turn of the loop. Dragging counts in heights of a
    // pane, to the right and upwards; the wheel counts in steps away from the user.
    double drag_right;
    double drag_up;
    int zoom_steps;
    // Steps that buttons have asked for since the last turn of the loop.
    int right_steps;
    int forward_steps;
    bool pressed;  // A button that flies the camera was pressed over a pane and is held.
    bool dragging; // The pointer has moved too far for a click.
    int press_x;   // Where the button was pressed, in pixels of the window.
    int press_y;
    int drag_x; // Where the pointer was last.
    int drag_y;
    bool knows_centre; // `centre_world` is the point that the camera orbits now.
    double centre_world[3];
} DipFlight;

// Returns the speed of the free camera in metres per second. Four steps double it.
double dip_flight_speed(const DipFlight *flight);

#endif
