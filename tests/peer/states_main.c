// dip_peer_states: times three scenes with draw states by our pipeline and by llvmpipe, in turn.
//
// Then it prints the time of a blended fragment beside that of an opaque one.
// Usage: dip_peer_states [ROUNDS [SCENE]]     (default: 40 rounds, all scenes)
#include "app/measure/stats/estimate.h"
#include "renderer/base/clock.h"
#include "tests/peer/likeness.h"
#include "tests/peer/states_ours.h"
#include "tests/peer/states_theirs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 480, THREADS = 2, MAX_ROUNDS = 1000 };

static bool compare(DipStatesOurs *ours, const DipStatesTheirs *theirs, double *psnr_db,
                    DipError *err) {
    static uint8_t picture[WIDTH * HEIGHT * 4];
    if (!dip_states_ours_draw(ours, err)) {
        return false;
    }
    dip_states_theirs_draw(theirs);
    dip_gl_target_read(theirs->gl, &theirs->target, picture);
    *psnr_db = dip_likeness_psnr_db(dip_likeness_squared_error(
        ours->rgba8, (size_t)WIDTH * 4, picture, (size_t)WIDTH * 4, WIDTH, HEIGHT));
    const char *folder = getenv("DIP_PEER_PICTURES");
    for (int side = 0; folder && side < 2; side++) {
        char file[300];
        snprintf(file, sizeof file, "%s/%s%d_%s.ppm", folder, dip_states_names[ours->data->kind],
                 ours->sample_count, side ? "theirs" : "ours");
        FILE *out = fopen(file, "wb");
        if (out) {
            fprintf(out, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                fwrite((side ? picture : ours->rgba8) + 4 * i, 1, 3, out);
            }
            fclose(out);
        }
    }
    return true;
}

static double ms_since(int64_t begin_ns) {
    return 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

// Prints the median time of each side, and the median ratio with its quartiles over the rounds.
static bool measure(DipStatesOurs *ours, const DipStatesTheirs *theirs, int rounds, DipError *err) {
    static double ours_ms[MAX_ROUNDS], theirs_ms[MAX_ROUNDS], ratios[MAX_ROUNDS];
    double scratch[MAX_ROUNDS];
    double psnr_db;
    if (!compare(ours, theirs, &psnr_db, err)) {
        return false;
    }
    for (int r = 0; r < rounds; r++) {
        for (int turn = 0; turn < 2; turn++) {
            const bool is_ours = (r + turn) % 2;
            for (int k = 0; k < 2; k++) { // the first of two frames warms the caches
                const int64_t begin_ns = dip_clock_ns();
                if (is_ours && !dip_states_ours_draw(ours, err)) {
                    return false;
                }
                if (!is_ours) {
                    dip_states_theirs_draw(theirs);
                }
                *(is_ours ? &ours_ms[r] : &theirs_ms[r]) = ms_since(begin_ns);
            }
        }
        ratios[r] = theirs_ms[r] / ours_ms[r];
    }
    printf("%-7s %dx  peer %8.2f ms  ours %7.2f ms  ratio %5.2f, quartiles %5.2f to %5.2f  "
           "PSNR %5.1f dB\n",
           dip_states_names[ours->data->kind], ours->sample_count,
           dip_percentile_of(theirs_ms, rounds, 0.5, scratch),
           dip_percentile_of(ours_ms, rounds, 0.5, scratch),
           dip_percentile_of(ratios, rounds, 0.5, scratch),
           dip_percentile_of(ratios, rounds, 0.25, scratch),
           dip_percentile_of(ratios, rounds, 0.75, scratch), psnr_db);
    return true;
}

// Returns the median time of a frame of the first `parts` layers, in milliseconds, or -1.
static double layers_ms(DipStatesData *data, int parts, int samples, int rounds, double *fragments,
                        DipError *err) {
    static double ms[MAX_ROUNDS];
    double scratch[MAX_ROUNDS];
    DipStatesOurs ours;
    data->part_count = parts;
    if (!dip_states_ours_open(&ours, data, WIDTH, HEIGHT, samples, THREADS, err)) {
        return -1.0;
    }
    bool done = true;
    for (int r = -1; done && r < rounds; r++) { // the first frame warms the caches
        const int64_t begin_ns = dip_clock_ns();
        done = dip_states_ours_draw(&ours, err);
        ms[r < 0 ? 0 : r] = ms_since(begin_ns);
    }
    *fragments =
        (double)(data->opaque ? ours.counters.fragments_shaded : ours.counters.fragments_ordered);
    dip_states_ours_close(&ours);
    return done ? dip_percentile_of(ms, rounds, 0.5, scratch) : -1.0;
}

// Prints what a blended fragment costs: the time that the upper half of the layers adds, for each
// of their fragments. Beside it, prints the time of a frame of opaque layers for each fragment that
// it shades.
static bool measure_fragments(int samples, int rounds, DipError *err) {
    DipStatesData data;
    double all, half, shaded;
    if (!dip_states_make(DIP_STATES_BLEND, (double)WIDTH / HEIGHT, &data, err)) {
        return false;
    }
    const int parts = data.part_count;
    const double half_ms = layers_ms(&data, parts / 2, samples, rounds, &half, err);
    const double all_ms = layers_ms(&data, parts, samples, rounds, &all, err);
    data.opaque = true;
    const double opaque_ms = layers_ms(&data, parts, samples, rounds, &shaded, err);
    dip_states_free(&data);
    if (half_ms < 0.0 || all_ms < 0.0 || opaque_ms < 0.0) {
        return false;
    }
    printf("%dx: a blended fragment takes %.2f ns; a frame of opaque layers takes %.2f ns for each "
           "fragment that it shades\n",
           samples, 1e6 * (all_ms - half_ms) / (all - half), 1e6 * opaque_ms / shaded);
    return true;
}

static bool run_scene(const DipGl *gl, DipStatesScene kind, int samples, int rounds,
                      DipError *err) {
    DipStatesData data;
    DipStatesOurs ours;
    DipStatesTheirs theirs;
    if (!dip_states_make(kind, (double)WIDTH / HEIGHT, &data, err)) {
        return false;
    }
    bool done = dip_states_ours_open(&ours, &data, WIDTH, HEIGHT, samples, THREADS, err);
    if (done) {
        done = dip_states_theirs_open(&theirs, gl, &data, WIDTH, HEIGHT, samples, err) &&
               measure(&ours, &theirs, rounds, err);
        dip_states_ours_close(&ours);
    }
    dip_states_free(&data);
    return done;
}

int main(int argc, char **argv) {
    const int wanted = argc > 1 ? atoi(argv[1]) : 40;
    const int rounds = wanted < 1 ? 1 : wanted > MAX_ROUNDS ? MAX_ROUNDS : wanted;
    DipGl gl;
    DipError err = {0};
    if (!dip_gl_open(&gl, THREADS, &err)) {
        fprintf(stderr, "%s\n", err.message);
        return 77;
    }
    bool done = true;
    for (int kind = 0; done && kind < DIP_STATES_COUNT; kind++) {
        if (argc > 2 && strcmp(argv[2], dip_states_names[kind]) != 0) {
            continue;
        }
        for (int samples = 1; done && samples <= 4; samples += 3) {
            done = run_scene(&gl, (DipStatesScene)kind, samples, rounds, &err);
        }
    }
    for (int samples = 1; done && samples <= 4; samples += 3) {
        done = measure_fragments(samples, rounds, &err);
    }
    if (!done) {
        fprintf(stderr, "%s: %s\n", err.key, err.message);
    }
    dip_gl_close(&gl);
    return done ? 0 : 1;
}
