// Rows about time: camera paths, the clock, moving clouds.
#include "campaths/camtrack.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEYS = 12 };

static const int64_t second_ns = 1000000000;

// --- paths ------------------------------------------------------------------------------------

// Fills keys with random positions and random unit quaternions.
static void fill_keys(Random *random, DipCamKey keys[KEYS]) {
    for (int k = 0; k < KEYS; k++) {
        double length = 0.0;
        for (int i = 0; i < 4; i++) {
            keys[k].position_world[i % 3] = random_real(random, -20.0, 20.0);
            keys[k].orientation[i] = random_real(random, -1.0, 1.0) + (i == 3 ? 2.0 : 0.0);
            length += keys[k].orientation[i] * keys[k].orientation[i];
        }
        for (int i = 0; i < 4; i++) {
            keys[k].orientation[i] /= sqrt(length);
        }
    }
}

static DipCamPath *create_path(StabilityRun *run, const DipCamKey keys[KEYS], int64_t period_ns) {
    DipError err = {0};
    DipCamPath *path = NULL;
    if (!dip_campath_create(keys, KEYS, period_ns, &path, &err)) {
        stability_break(run, "no path: %s", err.message);
    }
    return path;
}

static bool same_pose(const DipPose *a, const DipPose *b) {
    return memcmp(a->position_world, b->position_world, sizeof a->position_world) == 0 &&
           memcmp(a->orientation, b->orientation, sizeof a->orientation) == 0;
}

static void keep_pose(StabilityRun *run, const DipPose *pose) {
    stability_keep(run, pose->position_world, 3);
    stability_keep(run, pose->orientation, 4);
}

// q and -q are the same rotation, so the signs of the keys must not matter.
static void measure_signs(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 20, 1000, 50000);
    for (int i = 0; i < count; i++) {
        DipCamKey keys[KEYS];
        fill_keys(&random, keys);
        DipCamPath *aligned = create_path(run, keys, second_ns);
        for (int k = 1; k < KEYS; k++) {
            const double sign = random_int(&random, 0, 1) ? -1.0 : 1.0;
            for (int c = 0; c < 4; c++) {
                keys[k].orientation[c] *= sign;
            }
        }
        DipCamPath *flipped = create_path(run, keys, second_ns);
        for (int s = 0; aligned && flipped && s < 40; s++) {
            const int64_t time_ns = (int64_t)(random_u64(&random) >> 1);
            DipPose a = {.fov_y_deg = 45.0};
            DipPose b = {.fov_y_deg = 45.0};
            dip_campath_sample(aligned, time_ns, &a);
            dip_campath_sample(flipped, time_ns, &b);
            keep_pose(run, &a);
            stability_expect(run, same_pose(&a, &b), "path %d at %lld ns", i, (long long)time_ns);
        }
        dip_campath_destroy(&aligned);
        dip_campath_destroy(&flipped);
    }
}

// At the time of a key, a path is at this key; one nanosecond before the end it is not yet at the
// first key again.
static void measure_key_times(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 20, 1000, 50000);
    for (int i = 0; i < count; i++) {
        DipCamKey keys[KEYS];
        const int64_t period_ns = DIP_CAMPATH_MIN_PERIOD_NS + random_int(&random, 0, 1000000000);
        fill_keys(&random, keys);
        if (i % 2) {
            keys[4] = keys[5]; // equal neighbours: no distance, no rotation
        }
        DipCamPath *path = create_path(run, keys, period_ns);
        for (int k = -KEYS; path && k <= 2 * KEYS; k++) {
            DipPose pose = {.fov_y_deg = 45.0};
            dip_campath_sample(path, k * period_ns, &pose);
            keep_pose(run, &pose);
            const DipCamKey *key = &keys[(k + KEYS) % KEYS];
            for (int c = 0; c < 3; c++) {
                stability_error(run, pose.position_world[c] - key->position_world[c],
                                "path %d at key %d", i, k);
            }
        }
        dip_campath_destroy(&path);
    }
}

// The pose at t and at t plus whole durations, up to the greatest times that 64 bits hold.
static void measure_periods(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 20, 1000, 50000);
    for (int i = 0; i < count; i++) {
        DipCamKey keys[KEYS];
        const int64_t period_ns = DIP_CAMPATH_MIN_PERIOD_NS + random_int(&random, 0, 1000000000);
        fill_keys(&random, keys);
        DipCamPath *path = create_path(run, keys, period_ns);
        const int64_t duration_ns = KEYS * period_ns;
        for (int s = 0; path && s < 40; s++) {
            const int64_t into_ns = (int64_t)(random_u64(&random) % (uint64_t)duration_ns);
            const int64_t most = (INT64_MAX - duration_ns) / duration_ns;
            const int64_t turns = s == 0   ? most
                                  : s == 1 ? -most
                                           : (int64_t)(random_u64(&random) % (uint64_t)most);
            DipPose a = {.fov_y_deg = 45.0};
            DipPose b = {.fov_y_deg = 45.0};
            dip_campath_sample(path, into_ns, &a);
            dip_campath_sample(path, into_ns + turns * duration_ns, &b);
            keep_pose(run, &a);
            stability_expect(run, same_pose(&a, &b), "path %d, %lld durations later", i,
                             (long long)turns);
        }
        dip_campath_destroy(&path);
    }
}

// The pose at a time does not depend on the times that were sampled before, nor on their number.
static void measure_steps(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 5, 100, 5000);
    for (int i = 0; i < count; i++) {
        DipCamKey keys[KEYS];
        fill_keys(&random, keys);
        DipCamPath *path = create_path(run, keys, second_ns);
        DipCamTrack track = dip_camtrack_make(true);
        dip_camtrack_set(&track, 0, path, 45.0);
        for (int frame = 0; path && frame <= 60; frame++) {
            DipPose stepped = {.fov_y_deg = 45.0};
            DipPose direct = {.fov_y_deg = 45.0};
            // At 61 Hz, some frames are sampled that a display of 60 Hz never shows.
            for (int extra = 0; extra < frame % 3; extra++) {
                dip_camtrack_pose(&track, frame * second_ns / 61 - extra, &stepped);
            }
            dip_camtrack_pose(&track, frame * second_ns / 60, &stepped);
            dip_campath_sample(path, frame * second_ns / 60, &direct);
            keep_pose(run, &direct);
            stability_expect(run, same_pose(&stepped, &direct), "path %d, frame %d", i, frame);
        }
        dip_campath_destroy(&path);
    }
}

// --- clouds -----------------------------------------------------------------------------------

// Draws the sky at two times at which all clouds must be in the same places. The default layers
// move by 0.3 and -0.2 texture widths per minute: their common period is 10 minutes.
static void measure_clouds(StabilityRun *run) {
    static const int64_t times[] = {
        0, 1, 123456789, INT64_C(599999999999), -1, -INT64_C(77777777777)};
    static const int64_t periods[] = {1, -1, 1000, INT64_C(15372284)};
    static DipTestScene scene;
    const int64_t period_ns = 600 * second_ns;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_sky);
    scene.def.sky = dip_sky_default();
    for (size_t t = 0; t < sizeof times / sizeof *times; t++) {
        StabilityShot shot = {.def = &scene.def,
                              .pose = &scene.pose,
                              .settings = "aa=none",
                              .width = 64,
                              .height = 48,
                              .time_ns = times[t]};
        StabilityPicture expected;
        if (!stability_draw(run, &shot, &expected)) {
            break;
        }
        stability_shows(run, &expected, 100);
        for (size_t p = 0; p < sizeof periods / sizeof *periods; p++) {
            StabilityPicture found;
            shot.time_ns = times[t] + periods[p] * period_ns;
            if (stability_draw(run, &shot, &found)) {
                stability_error(run, stability_differing(&expected, &found, 0.0),
                                "%lld ns and %lld periods later", (long long)times[t],
                                (long long)periods[p]);
                stability_picture_free(&found);
            }
        }
        stability_picture_free(&expected);
    }
    dip_test_scene_free(&scene);
}

// --- malformed files --------------------------------------------------------------------------

// Reads a path file after random changes. A path that is accepted has finite positions and unit
// orientations everywhere.
static void measure_malformed(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 300, 20000, 1000000);
    for (int i = 0; i < count; i++) {
        char text[] = "# a path\ndiptych-path 1\nperiod 0.5\n0 0 0 0 0 0 1\n"
                      "1.5 -2e3 .25 0 0.6 0 0.8\n4 5 6 0 0 0 1\n-7 8 9 1 0 0 0\n";
        size_t size = sizeof text - 1;
        const int changes = random_int(&random, 1, 4);
        for (int c = 0; c < changes; c++) {
            static const char bytes[] = "0123456789.eE+-# \n\t\r\0nanif\xff";
            const char byte = bytes[random_int(&random, 0, (int)sizeof bytes - 2)];
            text[random_int(&random, 0, (int)size - 1)] = byte;
        }
        size = i % 5 ? size : (size_t)random_int(&random, 0, (int)size);
        DipError err = {0};
        DipCamPath *path = NULL;
        const bool read = dip_campath_parse(text, size, "changed.pth", &path, &err);
        bool good = read ? path != NULL : path == NULL && err.message[0];
        for (int s = 0; path && s < 8; s++) {
            DipPose pose = {.fov_y_deg = 45.0};
            dip_campath_sample(path, s * second_ns / 3, &pose);
            keep_pose(run, &pose);
            double length = 0.0;
            for (int c = 0; c < 4; c++) {
                length += pose.orientation[c] * pose.orientation[c];
                good = good && isfinite(pose.position_world[c % 3]);
            }
            good = good && fabs(length - 1.0) < 1e-9;
        }
        stability_expect(run, good, "file %d: %s", i, read ? "accepted" : err.message);
        dip_campath_destroy(&path);
    }
}

static const StabilityRow rows[] = {
    {.id = "N39",
     .promise = "The signs of the keys' quaternions do not matter: the path takes the short way.",
     .truth = "the path whose keys have one sign, bit for bit",
     .unit = "poses",
     .measure = measure_signs},
    {.id = "N40",
     .promise = "At the time of a key, also the first and the last and one of two equal keys, the "
                "camera is at this key.",
     .truth = "the key",
     .unit = "m",
     .bound = 1e-13,
     .measure = measure_key_times},
    {.id = "N41",
     .promise = "Whole durations later, also after 292 years, the pose has the same bits.",
     .truth = "the pose of the first duration",
     .unit = "poses",
     .measure = measure_periods},
    {.id = "N42",
     .promise = "A pose depends on its time alone, not on the frame rate or on skipped frames.",
     .truth = "the path sampled once at this time",
     .unit = "poses",
     .measure = measure_steps},
    {.id = "N43",
     .promise = "The clouds repeat with the bits of their first period, also at negative times and "
                "after 292 years.",
     .truth = "the picture of the first period",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_clouds},
    {.id = "N56",
     .promise = "A damaged camera path is refused, or it is a path with finite positions and unit "
                "orientations.",
     .truth = "the format's rules",
     .unit = "files",
     .measure = measure_malformed},
};

const StabilityTopic stability_time = {"time", "Time, camera paths and files", rows,
                                       sizeof rows / sizeof *rows};
