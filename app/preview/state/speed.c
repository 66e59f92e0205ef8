// Chooses the speed of the free camera and the point that it orbits.
#include "app/preview/state/speed.h"

#include "app/preview/state/camera.h"

#include <math.h>

static const double courtyard_speed_m_per_s = 3.0;
static const double seconds_across_model = 4.0;
static const double least_distance_m = 1.0; // From the camera to the point that it orbits.

double dip_flying_speed(const DipSession *session) {
    if (session->options->model_count == 0 || !session->scene) {
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

bool dip_flight_should_orbit(const DipSession *session) {
    return session->options && session->options->model_count > 0 && !session->shows_gallery;
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
    if (dip_flight_should_orbit(session)) {
        for (int i = 0; i < 3; ++i) {
            centre_world[i] = middle[i];
        }
    } else {
        dip_camera_point_ahead(pose, middle, least_distance_m, centre_world);
    }
}
