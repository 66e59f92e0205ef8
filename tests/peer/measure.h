// Drawing the rows of the table: both sides in turn, frame by frame, round by round.
#ifndef DIP_TESTS_PEER_MEASURE_H
#define DIP_TESTS_PEER_MEASURE_H

#include "renderer/scene/renderer.h"
#include "tests/peer/peer.h"
#include "tests/peer/scene.h"

#include <stdbool.h>
#include <stddef.h>

// Settings as both sides have them.
typedef struct DipPeerRow {
    const char *name;     // as --rows has it
    const char *settings; // ours
    int sample_count;
    int max_anisotropy; // 1: trilinear
} DipPeerRow;

enum { DIP_PEER_ROW_COUNT = 7 };
extern const DipPeerRow dip_peer_rows[DIP_PEER_ROW_COUNT];

int dip_peer_row_find(const char *name, size_t length); // -1: none
bool dip_peer_row_has_peer(const DipPeerRow *row);      // llvmpipe has no more than 4 samples
// Rows whose pictures should be alike: those the peer draws, without AF, as a bit mask.
unsigned dip_peer_rows_alike(void);

// What is measured with; everything is borrowed.
typedef struct DipPeerBench {
    const DipPeerScene *scene;
    const DipScene *drawn; // scene->def, made ours
    DipRenderer *renderer;
    DipPeer *peer;
    int width;
    int height;
    int frames;
    int rounds;           // 0: only compare the pictures
    const char *pictures; // folder; NULL: none are written
    uint8_t *peer_rgba8;  // width * height * 4 bytes
    uint64_t random;      // state of the order's draws, seeded by the caller
} DipPeerBench;

typedef struct DipPeerMeasurement {
    const DipPeerRow *row;
    int frames;
    int rounds;
    double *ours_ms;       // [round * frames + frame]
    double *peer_ms;       // likewise; not filled in where the peer has no such row
    double *first_peer_ms; // [frame], when the pictures were compared, compiling included
    double psnr_db;        // of the mean squared error over all frames; NaN without a peer
    double worst_psnr_db;
    int worst_frame;
} DipPeerMeasurement;

// Draws every frame once untimed (the peer compiles its shaders then; the pictures are compared),
// then measures. On success the measurement belongs to the caller.
bool dip_peer_measure(DipPeerBench *bench, const DipPeerRow *row, DipPeerMeasurement *measurement,
                      DipError *err);
void dip_peer_measurement_free(DipPeerMeasurement *measurement);

#endif
