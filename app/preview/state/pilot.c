// Turns what actions and drags ask for into movements of the free camera.
#include "app/preview/state/pilot.h"

#include "app/preview/state/state_private.h"

#include <math.h>
#include <string.h>

enum { STEPS_TO_DOUBLE = 4, MOST_STEPS = 40 };

// Angles by which a drag over a pane's height turns the camera: on the spot, and about a point.
static const double look_deg = 90.0;
static const double orbit_deg = 180.0;
static const double zoom_per_step = 0.9;
static const double step_s = 0.25;

static const double courtyard_speed_m_per_s = 3.0;
static const double seconds_across_model = 4.0;
// Least distance from the camera to a point ahead that it orbits.
static const double least_distance_m = 1.0;

double dip_flight_speed(const DipFlight *flight) {
    return flight->base_speed_m_per_s * exp2((double)flight->speed_steps / STEPS_TO_DOUBLE);
}

// Returns whether dragging orbits at first: the panes show models that the user gave, to be looked
// at from all sides.
static bool should_orbit(const DipSession *session) {
    return session->options && session->options->model_count > 0 && !session->shows_gallery;
}

static double speed_for(const DipSession *session) {
    if (!should_orbit(session) || !session->scene) {
        return courtyard_speed_m_per_s;
    }
    float low[3];
    float high[3];
    dip_scene_bounds(session->scene, low, high);
    const double diagonal =
        sqrt(pow((double)high[0] - low[0], 2) + pow((double)high[1] - low[1], 2) +
             pow((double)high[2] - low[2], 2));
    return diagonal / seconds_across_model;
}

void dip_orbit_centre(const DipSession *session, const DipPose *pose, double centre_world[3]) {
    double middle[3] = {0.0, 0.0, 0.0}; // Scenes of the gallery stand around the origin.
    if (session->scene && !session->shows_gallery) {
        float low[3], high[3];
        dip_scene_bounds(session->scene, low, high);
        for (int i = 0; i < 3; ++i) {
            middle[i] = 0.5 * ((double)low[i] + high[i]);
        }
    }
    if (should_orbit(session)) {
        memcpy(centre_world, middle, sizeof middle);
    } else {
        dip_camera_point_ahead(pose, middle, least_distance_m, centre_world);
    }
}

void dip_pilot_enter(DipFlight *flight, const DipSession *session) {
    flight->orbits = should_orbit(session);
    flight->base_speed_m_per_s = speed_for(session);
    flight->speed_steps = 0;
    flight->knows_centre = false;
}

// --- actions -------------------------------------------------------------------------------------

void dip_pilot_change_speed(DipPreviewState *state, int steps, int64_t now_ns) {
    DipFlight *flight = &state->flight;
    const int wanted = flight->speed_steps + steps;
    flight->speed_steps = wanted > MOST_STEPS    ? MOST_STEPS
                          : wanted < -MOST_STEPS ? -MOST_STEPS
                                                 : wanted;
    dip_preview_notice(state, now_ns, "Speed: %.3g m/s", dip_flight_speed(flight));
}

static void say_camera(DipPreviewState *state, int64_t now_ns) {
    dip_preview_notice(state, now_ns,
                       state->flight.orbits ? "Free camera: dragging orbits, the wheel zooms"
                                            : "Free camera: dragging turns it, the wheel changes "
                                              "its speed");
}

void dip_pilot_make_free(DipPreviewState *state, int64_t now_ns) {
    if (!state->manual) {
        state->manual = true;
        ++state->scene_changes;
        say_camera(state, now_ns);
    }
}

void dip_pilot_choose_end(const DipAct *act) {
    static const char *const texts[DIP_CAMPATH_END_COUNT] = {[DIP_CAMPATH_END_loop] = "loop",
                                                             [DIP_CAMPATH_END_once] = "play once",
                                                             [DIP_CAMPATH_END_back] =
                                                                 "there and back"};
    DipPreviewState *state = act->state;
    DipCamTrack *track = state->track;
    const int step = act->reverse ? -act->argument : act->argument;
    const int64_t path_ns = dip_preview_path_ns(state);
    const int end = ((int)track->end + step + DIP_CAMPATH_END_COUNT) % DIP_CAMPATH_END_COUNT;
    dip_camtrack_set_end(track, (DipCamPathEnd)end);
    dip_camtrack_restart(track, state->play_ns - path_ns); // The camera stays where it is.
    dip_preview_notice(state, act->now_ns, "At the end of paths: %s", texts[end]);
    ++state->scene_changes;
}

void dip_pilot_edit_path(const DipAct *act) {
    DipPreviewState *state = act->state;
    const DipPathEdit edit = (DipPathEdit)act->argument;
    if (!state->editor) {
        return;
    }
    const bool done = dip_path_editor_edit(state->editor, edit, dip_preview_playing_path(state),
                                           state->track->end);
    const bool moves =
        edit == DIP_PATH_EDIT_NEXT || edit == DIP_PATH_EDIT_BEFORE || edit == DIP_PATH_EDIT_FLY;
    if (done && moves) {
        dip_pilot_make_free(state, act->now_ns);
    }
    dip_preview_notice(state, act->now_ns, "%s", state->editor->said);
}

void dip_pilot_choose_key(DipPreviewState *state, size_t index, int64_t now_ns) {
    dip_pilot_make_free(state, now_ns);
    dip_path_editor_choose(state->editor, index);
    dip_preview_notice(state, now_ns, "Key %zu of %zu", index + 1, state->editor->count);
}

void dip_pilot_step(DipPreviewState *state, int right, int forward, int64_t now_ns) {
    dip_pilot_make_free(state, now_ns);
    state->flight.right_steps += right;
    state->flight.forward_steps += forward;
}

void dip_pilot_reset(const DipAct *act) {
    DipPreviewState *state = act->state;
    state->flight.reset = state->manual;
    dip_preview_notice(state, act->now_ns,
                       state->manual
                           ? "The free camera has the pose of its path; C follows the path"
                           : "The camera follows its path");
}

void dip_pilot_orbit(const DipAct *act) {
    DipPreviewState *state = act->state;
    state->flight.orbits = state->manual ? !state->flight.orbits : state->flight.orbits;
    dip_pilot_make_free(state, act->now_ns);
    state->flight.knows_centre = false;
    say_camera(state, act->now_ns);
}

// --- the loop's turn -----------------------------------------------------------------------------

// Carries out drags and zooming. Returns whether there were any.
static bool move_by_mouse(DipFlight *flight, const DipSession *session, DipPose *pose) {
    if (flight->drag_right == 0.0 && flight->drag_up == 0.0 && flight->zoom_steps == 0) {
        return false;
    }
    if (!flight->orbits) {
        dip_camera_look(pose, look_deg * flight->drag_right, look_deg * flight->drag_up);
        return true;
    }
    if (!flight->knows_centre) {
        dip_orbit_centre(session, pose, flight->centre_world);
        flight->knows_centre = true;
    }
    // In the picture, objects between the camera and the centre move with the pointer.
    dip_camera_orbit(pose, flight->centre_world, orbit_deg * flight->drag_right,
                     orbit_deg * flight->drag_up);
    dip_camera_zoom(pose, flight->centre_world, pow(zoom_per_step, flight->zoom_steps));
    return true;
}

// Carries out the steps that buttons have asked for. Returns whether the camera moved.
static bool move_by_steps(const DipFlight *flight, DipPose *pose) {
    const DipCameraKeys right = {.right = 1.0};
    const DipCameraKeys forward = {.forward = 1.0};
    const double step_m_per_s = dip_flight_speed(flight) * step_s;
    bool moved = false;
    if (flight->right_steps) {
        moved |= dip_camera_move(pose, &right, step_m_per_s, flight->right_steps);
    }
    if (flight->forward_steps) {
        moved |= dip_camera_move(pose, &forward, step_m_per_s, flight->forward_steps);
    }
    return moved;
}

static void forget_mouse(DipFlight *flight) {
    flight->right_steps = flight->forward_steps = 0;
    flight->drag_right = flight->drag_up = 0.0;
    flight->zoom_steps = 0;
}

// Returns whether the pose is set. It is not set yet if the user takes the camera off its path
// before the first frame.
static bool has_pose(const DipPose *pose) {
    const double *q = pose->orientation;
    return q[0] != 0.0 || q[1] != 0.0 || q[2] != 0.0 || q[3] != 0.0;
}

// Lets the path editor move the camera, and tells the editor the camera's pose. First stops the
// editor if the user moves the camera or the camera is not free. Returns whether the editor moved
// the camera.
static bool move_by_editor(DipPreviewState *state, bool moved, int64_t elapsed_ns, DipPose *pose) {
    if (!state->editor) {
        return false;
    }
    if (!state->manual || moved) {
        dip_path_editor_stop(state->editor);
    }
    const bool flown = dip_path_editor_turn(state->editor, elapsed_ns, pose);
    if (has_pose(pose)) {
        dip_path_editor_see(state->editor, pose);
    }
    return flown;
}

// Keeps the camera within the positions that a path file can have.
static void keep_in_world(DipPose *pose) {
    for (int i = 0; i < 3; ++i) {
        pose->position_world[i] = fmax(-DIP_CAMPATH_MAX_POSITION,
                                       fmin(pose->position_world[i], DIP_CAMPATH_MAX_POSITION));
    }
}

bool dip_pilot_turn(DipPreviewState *state, const DipPilotTurn *turn, DipPose *pose) {
    DipFlight *flight = &state->flight;
    bool moved = false;
    if (state->manual && (flight->reset || !has_pose(pose))) {
        moved |= dip_camtrack_pose(state->track, state->play_ns, pose);
    }
    flight->reset = false;
    if (state->manual) {
        moved |= move_by_mouse(flight, turn->session, pose);
        moved |= move_by_steps(flight, pose);
        const double seconds = 1e-9 * (double)turn->elapsed_ns;
        const double speed_m_per_s = dip_flight_speed(flight);
        moved |= dip_camera_move(pose, &turn->keys, speed_m_per_s, seconds);
        moved |= turn->controllers &&
                 dip_controllers_fly(turn->controllers, pose, speed_m_per_s, seconds);
        keep_in_world(pose);
    }
    forget_mouse(flight);
    return move_by_editor(state, moved, turn->elapsed_ns, pose) || moved;
}
