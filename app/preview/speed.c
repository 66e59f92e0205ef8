// Choosing the speed of the free camera.
#include "app/preview/speed.h"

#include <math.h>

static const double courtyard_speed_m_per_s = 3.0;
static const double seconds_across_model = 4.0;

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
