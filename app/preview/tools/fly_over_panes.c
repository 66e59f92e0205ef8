// Turns drags and the wheel over the panes into moves that the free camera makes in the loop's next
// turn.
#include "app/preview/state/pilot.h"
#include "app/preview/tools/window.h"

#include <stdlib.h>

enum { DRAG_PX = 4 };

// Returns whether the button that is held over a pane flies the camera.
static bool flies(const DipPreviewState *state, const DipUiInput *input) {
    if (input->button == DIP_MOUSE_RIGHT) {
        return true;
    }
    return input->button == DIP_MOUSE_LEFT && state->manual &&
           state->tools.comparison != DIP_COMPARE_WIPE;
}

static void press(DipFlight *flight, const DipUiInput *input) {
    flight->pressed = true;
    flight->dragging = false;
    flight->knows_centre = false;
    flight->press_x = flight->drag_x = input->x;
    flight->press_y = flight->drag_y = input->y;
}

// Adds the pointer's movement to the drag that the loop applies to the camera in its next turn.
static void drag(DipUi *ui, DipWindow *window, const DipUiInput *input) {
    DipPreviewState *state = window->state;
    DipFlight *flight = &state->flight;
    const int least = dip_ui_px(ui, DRAG_PX);
    if (!flight->dragging && abs(input->x - flight->press_x) < least &&
        abs(input->y - flight->press_y) < least) {
        return;
    }
    const double height = window->layout->panes[DIP_PANE_CURRENT].height;
    flight->dragging = true;
    dip_pilot_make_free(state, dip_ui_now_ns(ui));
    flight->drag_right += (input->x - flight->drag_x) / height;
    flight->drag_up += (flight->drag_y - input->y) / height;
    flight->drag_x = input->x;
    flight->drag_y = input->y;
}

static void turn_wheel(DipUi *ui, DipPreviewState *state, DipUiInput *input) {
    if (!input->steps || !state->manual || (input->modifiers & DIP_MODIFIER_CTRL)) {
        return;
    }
    if (state->flight.orbits) {
        state->flight.zoom_steps += input->steps;
        state->flight.knows_centre = false;
    } else {
        dip_pilot_change_speed(state, input->steps, dip_ui_now_ns(ui));
    }
    input->steps = 0;
}

void dip_fly_over_panes(DipUi *ui, DipWindow *window, DipUiInput panes[DIP_PANE_COUNT]) {
    DipFlight *flight = &window->state->flight;
    for (int p = 0; p < DIP_PANE_COUNT && !dip_ui_is_drawing(ui); ++p) {
        DipUiInput *input = &panes[p];
        turn_wheel(ui, window->state, input);
        if (!flies(window->state, input)) {
            continue;
        }
        if (input->began || input->right) {
            press(flight, input);
            input->right = false;
        } else if (input->released) {
            input->right = input->button == DIP_MOUSE_RIGHT && !flight->dragging;
            flight->pressed = flight->dragging = false;
        } else if (flight->pressed && input->held && input->moved) {
            drag(ui, window, input);
        }
    }
}
