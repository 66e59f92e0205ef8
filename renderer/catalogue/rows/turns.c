// Rows about the rotation of a camera between two keys of its path.
#include "campaths/campath.h"
#include "renderer/base/trig.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/stability.h"

#include <math.h>
#include <string.h>

static const int64_t second_ns = 1000000000;

static void random_rotation(Random *random, double q[4]) {
    double length2 = 0.0;
    for (int i = 0; i < 4; i++) {
        q[i] = random_real(random, -1.0, 1.0);
        length2 += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= sqrt(length2);
    }
}

// Turns the rotation `from` by an angle about a random axis.
static void turn(Random *random, const double from[4], double angle, double to[4]) {
    double axis[3], length2 = 0.0;
    for (int i = 0; i < 3; i++) {
        axis[i] = random_real(random, -1.0, 1.0);
        length2 += axis[i] * axis[i];
    }
    double t[4] = {0.0, 0.0, 0.0, dip_cos(angle / 2.0)};
    for (int i = 0; i < 3; i++) {
        t[i] = axis[i] / sqrt(length2) * dip_sin(angle / 2.0);
    }
    const double *f = from;
    to[0] = f[3] * t[0] + f[0] * t[3] + f[1] * t[2] - f[2] * t[1];
    to[1] = f[3] * t[1] + f[1] * t[3] + f[2] * t[0] - f[0] * t[2];
    to[2] = f[3] * t[2] + f[2] * t[3] + f[0] * t[1] - f[1] * t[0];
    to[3] = f[3] * t[3] - f[0] * t[0] - f[1] * t[1] - f[2] * t[2];
}

// Returns the angle between two rotations, 0..pi. q and -q are the same rotation.
static long double angle_between(const double a[4], const double b[4]) {
    long double apart = 0.0L, along = 0.0L;
    for (int i = 0; i < 4; i++) {
        const long double difference = (long double)a[i] - b[i], sum = (long double)a[i] + b[i];
        apart += difference * difference;
        along += sum * sum;
    }
    return 4.0L * atan2l(sqrtl(fminl(apart, along)), sqrtl(fmaxl(apart, along)));
}

// Samples a path of two keys. The rotation at the part u of the way must lie u of the angle away
// from the first key and 1 - u of it away from the second. This is so only on the shortest way.
static void check_turn(StabilityRun *run, const double a[4], const double b[4], const char *what) {
    DipError err = {0};
    DipCamPath *path = NULL;
    DipCamKey keys[2] = {{.position_world = {0.0, 0.0, 0.0}}, {.position_world = {1.0, 0.0, 0.0}}};
    memcpy(keys[0].orientation, a, sizeof keys[0].orientation);
    memcpy(keys[1].orientation, b, sizeof keys[1].orientation);
    if (!dip_campath_create(keys, 2, second_ns, &path, &err)) {
        stability_break(run, "no path: %s", err.message);
        return;
    }
    const long double whole = angle_between(a, b);
    for (int s = 0; s <= 8; s++) {
        DipPose pose = {.fov_y_deg = 45.0};
        dip_campath_sample(path, s * (second_ns / 8), &pose);
        const double *q = pose.orientation;
        stability_keep(run, q, 4);
        const long double length = sqrtl((long double)q[0] * q[0] + (long double)q[1] * q[1] +
                                         (long double)q[2] * q[2] + (long double)q[3] * q[3]);
        const long double from = angle_between(a, q) - whole * s / 8.0L;
        const long double to = angle_between(q, b) - whole * (8 - s) / 8.0L;
        stability_error(run, (double)from, "%s by %Lg, %d/8 of the way", what, whole, s);
        stability_error(run, (double)to, "%s by %Lg, %d/8 of the way", what, whole, s);
        stability_error(run, (double)(length - 1.0L), "length: %s by %Lg", what, whole);
    }
    dip_campath_destroy(&path);
}

static void measure_small_turns(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 100, 5000, 300000);
    for (int i = 0; i < count; i++) {
        double a[4], b[4];
        random_rotation(&random, a);
        turn(&random, a, random_magnitude(&random, -60, -1), b);
        check_turn(run, a, b, "turn");
        check_turn(run, a, a, "no turn");
    }
}

static void measure_half_turns(StabilityRun *run) {
    Random random = {run->seed};
    const double pi = 3.14159265358979323846;
    const int count = stability_count(run, 100, 5000, 300000);
    for (int i = 0; i < count; i++) {
        double a[4], b[4];
        random_rotation(&random, a);
        turn(&random, a, pi + (i % 2 ? 1.0 : -1.0) * random_magnitude(&random, -60, -1), b);
        check_turn(run, a, b, "half turn");
        for (int k = 0; k < 4; k++) {
            b[k] = -a[k];
        }
        check_turn(run, a, b, "same rotation with the other sign");
    }
    // The dot product of these keys is exactly 0.
    static const double axes[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int i = 0; i < 16; i++) {
        check_turn(run, axes[i / 4], axes[i % 4], "exact half turn");
    }
}

static const StabilityRow rows[] = {
    {.id = "N36",
     .promise = "Between keys that are 2^-60 to 1 radian apart, the camera turns evenly and by the "
                "shortest way.",
     .truth = "angles in `long double`",
     .unit = "radians",
     .bound = 2e-15,
     .measure = measure_small_turns},
    {.id = "N37",
     .promise =
         "Between keys that are a half turn apart, or the same rotation with the other sign, "
         "the camera turns evenly and by the shortest way.",
     .truth = "angles in `long double`",
     .unit = "radians",
     .bound = 4e-15,
     .measure = measure_half_turns},
};

const StabilityTopic stability_turns = {"turns", "Rotations of the camera", rows,
                                        sizeof rows / sizeof *rows};
