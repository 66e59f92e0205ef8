// Measures one row of the table: compares the pictures of both sides, then times the frames.
#include "tests/peer/measure.h"

#include "renderer/base/clock.h"
#include "tests/peer/likeness.h"
#include "tests/peer/pictures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { PEER_MAX_SAMPLES = 4 };

// A frame that takes the peer longer than this in its first draw is not drawn again.
static const double SLOW_FRAME_MS = 10000.0;

const DipPeerRow dip_peer_rows[DIP_PEER_ROW_COUNT] = {
    {"none", "aa=none,af=none", 1, 1}, {"af4", "aa=none,af=4", 1, 4},
    {"af16", "aa=none,af=16", 1, 16},  {"4x", "aa=4,af=none", 4, 1},
    {"4x+af16", "aa=4,af=16", 4, 16},  {"8x", "aa=8,af=none", 8, 1},
    {"8x+af16", "aa=8,af=16", 8, 16},
};

int dip_peer_row_find(const char *name, size_t length) {
    for (int i = 0; i < DIP_PEER_ROW_COUNT; i++) {
        const char *known = dip_peer_rows[i].name;
        if (strlen(known) == length && memcmp(known, name, length) == 0) {
            return i;
        }
    }
    return -1;
}

bool dip_peer_row_has_peer(const DipPeerRow *row) {
    return row->sample_count <= PEER_MAX_SAMPLES;
}

unsigned dip_peer_rows_alike(void) {
    unsigned mask = 0;
    for (int i = 0; i < DIP_PEER_ROW_COUNT; i++) {
        const DipPeerRow *row = &dip_peer_rows[i];
        mask |= dip_peer_row_has_peer(row) && row->max_anisotropy == 1 ? 1u << i : 0;
    }
    return mask;
}

static bool set_row(const DipPeerBench *bench, const DipPeerRow *row, DipError *err) {
    DipQuality quality;
    return dip_quality_parse(row->settings, &quality, err) &&
           dip_renderer_set_quality(bench->renderer, &quality, err) &&
           (!dip_peer_row_has_peer(row) ||
            dip_peer_set(bench->peer, row->sample_count, row->max_anisotropy, err));
}

// Draws a frame with the peer. Returns the milliseconds that it took.
static double draw_peer(const DipPeerBench *bench, const DipPose *pose) {
    const int64_t begin_ns = dip_clock_ns();
    dip_peer_draw(bench->peer, pose);
    return 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

// --- likeness ----------------------------------------------------------------------------------

// Draws a frame on both sides. Outputs the squared error between the two pictures and the time that
// the peer took.
static bool compare_frame(const DipPeerBench *bench, const DipPeerRow *row, int index,
                          double *error, double *peer_ms, DipError *err) {
    const DipPose pose = dip_peer_scene_pose(bench->scene, index, bench->frames);
    const bool has_peer = dip_peer_row_has_peer(row);
    DipFrame frame;
    if (!dip_renderer_draw(bench->renderer, bench->drawn, &pose, 0, &frame, err)) {
        return false;
    }
    if (has_peer) {
        *peer_ms = draw_peer(bench, &pose);
        if (!dip_peer_read(bench->peer, bench->peer_rgba8, err)) {
            return false;
        }
        *error = dip_likeness_squared_error(frame.rgba8, frame.stride_bytes, bench->peer_rgba8,
                                            (size_t)bench->width * 4, bench->width, bench->height);
    }
    return !bench->pictures || dip_pictures_write(bench->pictures, row->name, index, &frame,
                                                  has_peer ? bench->peer_rgba8 : NULL, err);
}

static bool compare_frames(const DipPeerBench *bench, DipPeerMeasurement *m, DipError *err) {
    double sum = 0.0;
    double worst = -1.0;
    for (int i = 0; i < bench->frames; i++) {
        double error = NAN;
        if (!compare_frame(bench, m->row, i, &error, &m->first_peer_ms[i], err)) {
            return false;
        }
        sum += error;
        if (error > worst) {
            worst = error;
            m->worst_frame = i;
        }
    }
    m->psnr_db = dip_likeness_psnr_db(sum / bench->frames);
    m->worst_psnr_db = dip_peer_row_has_peer(m->row) ? dip_likeness_psnr_db(worst) : NAN;
    return true;
}

// --- time --------------------------------------------------------------------------------------

// Before the timed frame, each side draws, untimed, a frame slightly earlier on the path, as an
// animation would. This frame fills the caches with the side's own data, since the other side may
// have drawn last.
enum { STEPS_PER_FRAME = 64 };

static DipPose pose_before(const DipPeerBench *bench, int index) {
    const int steps = bench->frames * STEPS_PER_FRAME;
    return dip_peer_scene_pose(bench->scene, (index * STEPS_PER_FRAME + steps - 1) % steps, steps);
}

// Pauses, so that the threads of the side that has just drawn fall asleep.
static void rest(void) {
    nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

static bool time_ours(const DipPeerBench *bench, const DipPose *before, const DipPose *pose,
                      double *ms, DipError *err) {
    DipFrame frame;
    rest();
    if (!dip_renderer_draw(bench->renderer, bench->drawn, before, 0, &frame, err)) {
        return false;
    }
    const int64_t begin_ns = dip_clock_ns();
    const bool drawn = dip_renderer_draw(bench->renderer, bench->drawn, pose, 0, &frame, err);
    *ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    return drawn;
}

// Times the peer. If the first draw of a frame was extremely slow, its time is used and the frame
// is not drawn again. This time includes shader compilation, but only as a small part, and lies far
// above the median anyway.
static void time_peer(const DipPeerBench *bench, const DipPose *before, const DipPose *pose,
                      double first_ms, double *ms) {
    if (first_ms > SLOW_FRAME_MS) {
        *ms = first_ms;
        return;
    }
    rest();
    draw_peer(bench, before);
    *ms = draw_peer(bench, pose);
}

static bool toss(DipPeerBench *bench) {
    bench->random = bench->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return bench->random >> 63;
}

// Times both sides of one frame directly after each other. A coin toss decides which side is first.
static bool time_frame(DipPeerBench *bench, DipPeerMeasurement *m, int round, int index,
                       DipError *err) {
    const DipPose before = pose_before(bench, index);
    const DipPose pose = dip_peer_scene_pose(bench->scene, index, bench->frames);
    const int place = round * bench->frames + index;
    const bool has_peer = dip_peer_row_has_peer(m->row);
    const bool peer_first = toss(bench);
    if (has_peer && peer_first) {
        time_peer(bench, &before, &pose, m->first_peer_ms[index], &m->peer_ms[place]);
    }
    if (!time_ours(bench, &before, &pose, &m->ours_ms[place], err)) {
        return false;
    }
    if (has_peer && !peer_first) {
        time_peer(bench, &before, &pose, m->first_peer_ms[index], &m->peer_ms[place]);
    }
    return true;
}

bool dip_peer_measure(DipPeerBench *bench, const DipPeerRow *row, DipPeerMeasurement *m,
                      DipError *err) {
    const size_t count = (size_t)bench->frames * (size_t)bench->rounds + 1;
    *m = (DipPeerMeasurement){.row = row, .frames = bench->frames, .rounds = bench->rounds};
    m->ours_ms = calloc(count, sizeof *m->ours_ms);
    m->peer_ms = calloc(count, sizeof *m->peer_ms);
    m->first_peer_ms = calloc((size_t)bench->frames, sizeof *m->first_peer_ms);
    bool done = m->ours_ms && m->peer_ms && m->first_peer_ms;
    if (!done) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--frames", "out of memory");
    }
    done = done && set_row(bench, row, err) && compare_frames(bench, m, err);
    for (int round = 0; done && round < bench->rounds; round++) {
        for (int i = 0; done && i < bench->frames; i++) {
            done = time_frame(bench, m, round, i, err);
        }
    }
    if (!done) {
        dip_peer_measurement_free(m);
    }
    return done;
}

void dip_peer_measurement_free(DipPeerMeasurement *measurement) {
    free(measurement->ours_ms);
    free(measurement->peer_ms);
    free(measurement->first_peer_ms);
    *measurement = (DipPeerMeasurement){.row = NULL};
}
