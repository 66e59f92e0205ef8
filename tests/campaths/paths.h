// Paths that tests of campaths/ write down as text, and their poses.
#ifndef DIP_TESTS_CAMPATHS_PATHS_H
#define DIP_TESTS_CAMPATHS_PATHS_H

#include "campaths/campath.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

static const double PI = 3.14159265358979323846;
static const int64_t SECOND = INT64_C(1000000000);

// Reads a path in the text format. Fails the test if it is refused. The caller destroys the path.
static inline DipCamPath *parse(const char *text) {
    DipCamPath *path = NULL;
    DipError err = {0};
    if (!dip_campath_parse(text, strlen(text), "test.pth", &path, &err)) {
        fail_msg("%s:%d: [%s] %s", err.file, err.line, err.key, err.message);
    }
    return path;
}

static inline DipPose sample(const DipCamPath *path, int64_t time_ns) {
    DipPose pose = {.fov_y_deg = 33.0};
    dip_campath_sample(path, time_ns, &pose);
    return pose;
}

#endif
