// dip_peer: compares our renderer with a renderer of Mesa on the same frames. See docs/peer.md.
#include "app/files/whole_file.h"
#include "app/measure/timing/processors.h"
#include "tests/peer/measure.h"
#include "tests/peer/options.h"
#include "tests/peer/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { EXIT_BAD_USE = 2, EXIT_NO_PEER = 77 };

// Below this PSNR, the pictures of the two sides count as different, and comparing their times
// makes no sense.
static const double LEAST_PSNR_DB = 40.0;

typedef struct Session {
    DipPeerOptions options;
    DipPool *pool;
    DipPeerScene scene;
    DipScene *drawn;
    DipRenderer *renderer;
    DipPeer *peer;
    uint8_t *peer_rgba8;
    DipPeerMeasurement measurements[DIP_PEER_ROW_COUNT];
    int measured;
} Session;

static int complain(const DipError *err) {
    char text[640];
    dip_error_format(err, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return EXIT_FAILURE;
}

static bool open_session(Session *session, DipError *err) {
    const DipPeerOptions *options = &session->options;
    if (options->pictures && !dip_folder_make(options->pictures, "--pictures", err)) {
        return false;
    }
    session->pool = dip_pool_create(options->threads, err);
    if (!session->pool || !dip_peer_scene_open(options, session->pool, &session->scene, err)) {
        return false;
    }
    const DipRendererDef def = {.pool = session->pool,
                                .plain_surfaces = true,
                                .isa = options->isa,
                                .width = options->width,
                                .height = options->height,
                                .quality = dip_quality_default()};
    session->drawn = dip_scene_create(&session->scene.def, session->pool, err);
    session->renderer = session->drawn ? dip_renderer_create(&def, err) : NULL;
    session->peer_rgba8 = malloc((size_t)options->width * (size_t)options->height * 4);
    if (session->renderer && !session->peer_rgba8) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--size", "out of memory");
    }
    return session->renderer != NULL;
}

static void close_session(Session *session) {
    for (int i = 0; i < session->measured; i++) {
        dip_peer_measurement_free(&session->measurements[i]);
    }
    dip_peer_destroy(&session->peer);
    dip_renderer_destroy(&session->renderer);
    dip_scene_destroy(&session->drawn);
    dip_peer_scene_close(&session->scene);
    dip_pool_destroy(&session->pool);
    free(session->peer_rgba8);
}

static bool measure(Session *session, DipError *err) {
    const DipPeerOptions *options = &session->options;
    DipPeerBench bench = {
        .scene = &session->scene,
        .drawn = session->drawn,
        .renderer = session->renderer,
        .peer = session->peer,
        .width = options->width,
        .height = options->height,
        .frames = options->frames,
        .rounds = options->check ? 0 : options->rounds,
        .pictures = options->pictures,
        .peer_rgba8 = session->peer_rgba8,
        .random = 1,
    };
    for (int i = 0; i < DIP_PEER_ROW_COUNT; i++) {
        if (!(options->rows >> i & 1)) {
            continue;
        }
        if (isatty(STDERR_FILENO)) {
            fprintf(stderr, "\rmeasuring %-8s", dip_peer_rows[i].name);
        }
        if (!dip_peer_measure(&bench, &dip_peer_rows[i], &session->measurements[session->measured],
                              err)) {
            return false;
        }
        session->measured++;
    }
    if (isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r%20s\r", "");
    }
    return true;
}

static bool report(const Session *session, DipError *err) {
    const DipPeerOptions *options = &session->options;
    dip_table_print_heading(stdout, options, &session->scene, session->peer);
    return dip_table_print(stdout, session->measurements, session->measured, err) &&
           (!session->scene.all_in_view || options->check ||
            dip_table_print_triangles(stdout, session->measurements, session->measured,
                                      session->scene.triangle_count, err)) &&
           (!options->csv ||
            dip_table_write_csv(options->csv, session->measurements, session->measured, err)) &&
           (!options->append || options->check ||
            dip_table_append(options->append, options, &session->scene, session->peer,
                             session->measurements, session->measured, err));
}

static int judge(const Session *session) {
    const double lowest_db = dip_table_lowest_psnr_db(session->measurements, session->measured);
    if (lowest_db >= LEAST_PSNR_DB) {
        return EXIT_SUCCESS;
    }
    fprintf(stderr,
            "The pictures differ: the lowest PSNR without AF is %.1f dB; at least %.0f dB is "
            "expected.\n",
            lowest_db, LEAST_PSNR_DB);
    return session->options.check ? EXIT_FAILURE : EXIT_SUCCESS;
}

static int run(Session *session) {
    DipError err = {0};
    // Before either side starts threads, which inherit the processors of the thread that starts
    // them.
    dip_processors_confine((long)getpid(), session->options.threads);
    if (!open_session(session, &err)) {
        return complain(&err);
    }
    const DipPeerOptions *options = &session->options;
    const DipPeerDef peer = {options->api, &session->scene.def, options->width, options->height,
                             options->threads};
    session->peer = dip_peer_create(&peer, &err);
    if (!session->peer) {
        complain(&err);
        return err.code == DIP_ERROR_UNSUPPORTED ? EXIT_NO_PEER : EXIT_FAILURE;
    }
    if (!measure(session, &err) || !report(session, &err)) {
        return complain(&err);
    }
    return judge(session);
}

int main(int argc, char **argv) {
    Session session = {.measured = 0};
    DipError err;
    if (!dip_peer_options_parse(argc, argv, &session.options, &err)) {
        complain(&err);
        return EXIT_BAD_USE;
    }
    if (session.options.help) {
        dip_peer_options_help(stdout);
        return EXIT_SUCCESS;
    }
    const int code = run(&session);
    close_session(&session);
    return code;
}
