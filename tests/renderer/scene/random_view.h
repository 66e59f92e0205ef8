// Random views of a scene around the origin, in metres, for tests.
#ifndef DIP_TESTS_RENDERER_SCENE_RANDOM_VIEW_H
#define DIP_TESTS_RENDERER_SCENE_RANDOM_VIEW_H

#include "renderer/catalogue/random.h"
#include "renderer/scene/view/view.h"

#include <math.h>

// Returns a view from anywhere within 25 m of the origin in each axis, in any direction. Half of
// the views are mirrored at a random height, as in water. The near plane is 0.1 m away. aspect:
// width / height of the picture.
static inline DipView random_view(Random *random, double aspect) {
    DipPose pose = {.fov_y_deg = random_real(random, 20.0, 100.0)};
    double square = 0.0;
    for (int i = 0; i < 4; i++) {
        pose.orientation[i] = random_real(random, -1.0, 1.0);
        square += pose.orientation[i] * pose.orientation[i];
    }
    for (int i = 0; i < 4; i++) {
        pose.orientation[i] /= sqrt(square);
    }
    for (int c = 0; c < 3; c++) {
        pose.position_world[c] = random_real(random, -25.0, 25.0);
    }
    const DipView view = dip_view_make(&pose, 0.1, aspect);
    return random_int(random, 0, 1) ? view : dip_view_mirror(&view, random_real(random, -5.0, 5.0));
}

#endif
