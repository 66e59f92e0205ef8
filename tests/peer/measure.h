// Measures the rows of the table. Both sides draw in turn, frame by frame, round by round.
#ifndef DIP_TESTS_PEER_MEASURE_H
#define DIP_TESTS_PEER_MEASURE_H

#include "renderer/scene/renderer.h"
#include "tests/peer/peer.h"
#include "tests/peer/scene.h"

#include <stdbool.h>
#include <stddef.h>

// Settings that both sides have.
typedef struct DipPeerRow {
    const char *name;     // as in --rows
    const char *settings; // the row's settings as text for our renderer
    int sample_count;
    int max_anisotropy; // 1: trilinear
} DipPeerRow;

enum { DIP_PEER_ROW_COUNT = 7 };
extern const DipPeerRow dip_peer_rows[DIP_PEER_ROW_COUNT];

int dip_peer_row_find(const char *name, size_t length); // -1: no such row
bool dip_peer_row_has_peer(const DipPeerRow *row);      // false above 4 samples, llvmpipe's limit
// Returns, as a bit mask, the rows whose pictures should be alike: the rows without AF that the
// peer can draw.
unsigned dip_peer_rows_alike(void);

// The inputs of a measurement. All pointers are borrowed.
typedef struct DipPeerBench {
    const DipPeerScene *scene;
    const DipScene *drawn; // our scene, created from scene->def
    DipRenderer *renderer;
    DipPeer *peer;
    int width;
    int height;
    int frames;
    int rounds;           // 0: only compare the pictures
    const char *pictures; // folder; NULL: write no pictures
    uint8_t *peer_rgba8;  // width * height * 4 bytes
    uint64_t random;      // state of the coin toss for the order; the caller seeds it
} DipPeerBench;

typedef struct DipPeerMeasurement {
    const DipPeerRow *row;
    int frames;
    int rounds;
    double *ours_ms;       // [round * frames + frame]
    double *peer_ms;       // same index; not filled if the peer cannot draw the row
    double *first_peer_ms; // [frame]: first draw, before the rounds; compiles shaders
    double psnr_db;        // from the mean squared error of all frames; NaN without a peer
    double worst_psnr_db;
    int worst_frame;
} DipPeerMeasurement;

// First draws every frame once to compare the pictures; in this draw, the peer also compiles its
// shaders. Then measures the rounds. On success the caller owns the measurement and frees it.
bool dip_peer_measure(DipPeerBench *bench, const DipPeerRow *row, DipPeerMeasurement *measurement,
                      DipError *err);
void dip_peer_measurement_free(DipPeerMeasurement *measurement);

#endif
