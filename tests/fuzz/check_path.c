// Checks a camera path that was read from any bytes.
#include "tests/fuzz/check_path.h"

#include "campaths/campath.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Both paths hold the same bits.
static void check_same(const DipCamPath *path, const DipCamPath *again) {
    const DipCamPathInfo info = dip_campath_info(path);
    const DipCamPathInfo info_again = dip_campath_info(again);
    FUZZ_CHECK(info.key_count == info_again.key_count);
    FUZZ_CHECK(info.period_ns == info_again.period_ns);
    for (size_t k = 0; k < info.key_count; k++) {
        const DipCamKey key = dip_campath_key(path, k);
        const DipCamKey key_again = dip_campath_key(again, k);
        FUZZ_CHECK(memcmp(&key, &key_again, sizeof key) == 0);
    }
}

static void check_saved(const DipCamPath *path,
                        bool (*save)(const DipCamPath *, const char *, DipError *)) {
    const char *file = fuzz_path("path");
    DipCamPath *again;
    FUZZ_CHECK(save(path, file, NULL));
    FUZZ_CHECK(dip_campath_load(file, &again, NULL));
    check_same(path, again);
    dip_campath_destroy(&again);
}

static void check_pose(const DipCamPath *path, int64_t time_ns) {
    DipPose pose = {0};
    dip_campath_sample(path, time_ns, &pose);
    double squared = 0.0;
    for (int i = 0; i < 4; i++) {
        squared += pose.orientation[i] * pose.orientation[i];
    }
    FUZZ_CHECK(fabs(squared - 1.0) <= 1e-12);
    for (int i = 0; i < 3; i++) {
        FUZZ_CHECK(fabs(pose.position_world[i]) <= DIP_CAMPATH_MAX_POSITION);
    }
}

static void check_info(const DipCamPath *path) {
    const DipCamPathInfo info = dip_campath_info(path);
    FUZZ_CHECK(info.key_count >= 1 && info.key_count <= DIP_CAMPATH_MAX_KEYS);
    FUZZ_CHECK(info.duration_ns == (int64_t)info.key_count * info.period_ns);
    FUZZ_CHECK(isfinite(info.length_m) && isfinite(info.max_speed_m_per_s));
    FUZZ_CHECK(isfinite(info.max_turn_deg_per_s));
    const int64_t times_ns[] = {0,
                                1,
                                info.period_ns - 1,
                                info.period_ns,
                                info.period_ns / 3,
                                info.duration_ns - info.period_ns / 7,
                                -1,
                                INT64_MAX,
                                INT64_MIN};
    for (size_t i = 0; i < sizeof times_ns / sizeof times_ns[0]; i++) {
        check_pose(path, times_ns[i]);
    }
}

void check_path(const uint8_t *bytes, size_t size_bytes) {
    uint8_t *copy = fuzz_copy(bytes, size_bytes, false);
    DipCamPath *path;
    DipError err = {0};
    if (dip_campath_parse(copy, size_bytes, "fuzzed", &path, &err)) {
        check_info(path);
        check_saved(path, dip_campath_save_pth);
        check_saved(path, dip_campath_save_bth);
    } else {
        FUZZ_CHECK(!path && err.code != DIP_ERROR_NONE && err.message[0]);
        FUZZ_CHECK(strcmp(err.file, "fuzzed") == 0);
    }
    dip_campath_destroy(&path);
    free(copy);
}
