// Creates an orbit about a bounding box, for models that come without a path.
#include "campaths/campath_private.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>

// Between keys the camera moves along chords of a circle. Each chord spans 3.6 degrees. Its middle
// is 0.05 % nearer to the box than the circle is.
enum { ORBIT_KEYS = 100 };

static const double ELEVATION_RAD = 15.0 * DIP_PI / 180.0;
// The camera's distance is multiplied by this factor. It leaves a border around the box and allows
// for the chords.
static const double MARGIN = 1.05;
// Half the size of the box that is framed around a model of a single point.
static const double MIN_RADIUS_M = 0.5;

DipCamOrbitDef dip_campath_default_orbit(void) {
    DIP_FP_MODE_SCOPE();
    return (DipCamOrbitDef){
        .min_world = {-0.5, -0.5, -0.5},
        .max_world = {0.5, 0.5, 0.5},
        .fov_y_deg = 50.0,
        .aspect = 4.0 / 3.0,
        .duration_ns = INT64_C(20000000000),
    };
}

// World-space axes of a camera that stands at `yaw` (from +Z over +X) and looks at the middle of
// the box.
typedef struct Axes {
    double right[3];
    double up[3];
    double back[3]; // from the middle to the camera
} Axes;

static Axes axes_at(double yaw_rad) {
    const double s = dip_sin(yaw_rad);
    const double c = dip_cos(yaw_rad);
    const double se = dip_sin(ELEVATION_RAD);
    const double ce = dip_cos(ELEVATION_RAD);
    return (Axes){
        .right = {c, 0.0, -s},
        .up = {-s * se, ce, -c * se},
        .back = {s * ce, se, c * ce},
    };
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Returns the distance from the middle at which every corner of the box lies in the picture
// everywhere on the orbit. `half` is half the size of the box. A corner at depth d in front of the
// camera is in the picture if |x| <= d * tan_x and |y| <= d * tan_y.
static double framing_distance(const double half[3], double tan_x, double tan_y) {
    double distance = 0.0;
    for (int k = 0; k < ORBIT_KEYS; k++) {
        const Axes axes = axes_at(2.0 * DIP_PI * k / ORBIT_KEYS);
        for (int corner = 0; corner < 8; corner++) {
            double p[3];
            for (int i = 0; i < 3; i++) {
                p[i] = corner >> i & 1 ? half[i] : -half[i];
            }
            const double toward = dot3(p, axes.back);
            distance = fmax(distance, toward + fabs(dot3(p, axes.right)) / tan_x);
            distance = fmax(distance, toward + fabs(dot3(p, axes.up)) / tan_y);
        }
    }
    return distance * MARGIN;
}

// Returns the distance at which a circle about the vertical axis lies in the picture. `y` is its
// height above the middle. Over all points of the circle, the sum of what lies toward the camera
// and of |x| / tan_x is greatest as that of two orthogonal parts; the sum with |y| / tan_y is
// greatest where the circle is nearest to the camera or farthest from it.
static double circle_distance(double radius, double y, double tan_x, double tan_y) {
    const double s = dip_sin(ELEVATION_RAD);
    const double c = dip_cos(ELEVATION_RAD);
    double distance = y * s + radius * sqrt(c * c + 1.0 / (tan_x * tan_x));
    for (int side = -1; side <= 1; side += 2) {
        const double toward = y * s + side * radius * c;
        distance = fmax(distance, toward + fabs(y * c - side * radius * s) / tan_y);
    }
    return distance;
}

// Returns the distance from the middle at which the silhouette lies in the picture everywhere on
// the orbit. Each slice counts as a cylinder.
static double silhouette_distance(const DipCamOrbitDef *def, double half_height, double tan_x,
                                  double tan_y) {
    double distance = 0.0;
    for (int i = 0; i < def->radius_count; i++) {
        for (int end = 0; end < 2 && def->radii[i] >= 0.0; end++) {
            const double y = half_height * (2.0 * (i + end) / def->radius_count - 1.0);
            distance = fmax(distance, circle_distance(def->radii[i], y, tan_x, tan_y));
        }
    }
    return distance * MARGIN;
}

static bool check(const DipCamOrbitDef *def, DipError *err) {
    const double limit = DIP_CAMPATH_MAX_POSITION / 100.0;
    for (int i = 0; i < 3; i++) {
        if (!(def->min_world[i] >= -limit && def->max_world[i] <= limit &&
              def->min_world[i] <= def->max_world[i])) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "box",
                                 "%.9g..%.9g along axis %d, accepted an interval within %g..%g",
                                 def->min_world[i], def->max_world[i], i, -limit, limit);
        }
    }
    if (!(def->fov_y_deg >= 1.0 && def->fov_y_deg <= 170.0)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "fov",
                             "%.9g degrees is out of range, accepted 1..170", def->fov_y_deg);
    }
    if (!(def->aspect >= 0.01 && def->aspect <= 100.0)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "aspect",
                             "%.9g is out of range, accepted 0.01..100", def->aspect);
    }
    return true;
}

bool dip_campath_orbit(const DipCamOrbitDef *def, DipCamPath **path, DipError *err) {
    DIP_FP_MODE_SCOPE();
    *path = NULL;
    if (!check(def, err)) {
        return false;
    }
    double middle[3];
    double half[3];
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        middle[i] = 0.5 * (def->min_world[i] + def->max_world[i]);
        half[i] = 0.5 * (def->max_world[i] - def->min_world[i]);
        largest = fmax(largest, half[i]);
    }
    if (largest == 0.0) {
        half[0] = half[1] = half[2] = MIN_RADIUS_M;
    }
    const double tan_y = dip_tan(def->fov_y_deg * (DIP_PI / 360.0));
    const double distance = def->radii && largest > 0.0
                                ? silhouette_distance(def, half[1], tan_y * def->aspect, tan_y)
                                : framing_distance(half, tan_y * def->aspect, tan_y);
    DipCamKey keys[ORBIT_KEYS];
    for (int k = 0; k < ORBIT_KEYS; k++) {
        const double yaw = 2.0 * DIP_PI * k / ORBIT_KEYS;
        const Axes axes = axes_at(yaw);
        // Quaternion of the yaw about +Y times the pitch about +X, from half angles.
        const double sy = dip_sin(0.5 * yaw);
        const double cy = dip_cos(0.5 * yaw);
        const double sp = dip_sin(-0.5 * ELEVATION_RAD);
        const double cp = dip_cos(-0.5 * ELEVATION_RAD);
        keys[k] = (DipCamKey){.orientation = {cy * sp, sy * cp, -sy * sp, cy * cp}};
        for (int i = 0; i < 3; i++) {
            keys[k].position_world[i] = middle[i] + distance * axes.back[i];
        }
    }
    return dip_campath_create(keys, ORBIT_KEYS, def->duration_ns / ORBIT_KEYS, path, err);
}
