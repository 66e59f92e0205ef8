// Measures the rows of the peer bench's table. A row is a combination of settings. In each round,
// both sides (our renderer and the peer, llvmpipe) draw every frame in turn.
#ifndef DIP_TESTS_PEER_MEASURE_H
#define DIP_TESTS_PEER_MEASURE_H

#include "renderer/scene/renderer.h"
#include "tests/peer/peer.h"
#include "tests/peer/scene.h"

#include <stdbool.h>
#include <stddef.h>

// A row: a combination of settings that both sides have.
typedef struct DipPeerRow {
    const char *name;     // the row's name in the option --rows
    const char *settings; // the row's settings as text for our renderer
    int sample_count;
    int max_anisotropy; // 1 means trilinear
} DipPeerRow;

enum { DIP_PEER_ROW_COUNT = 7 };
extern const DipPeerRow dip_peer_rows[DIP_PEER_ROW_COUNT];

int dip_peer_row_find(const char *name, size_t length); // returns -1 if there is no such row
// Returns true if the peer can draw the row. llvmpipe's limit is 4 samples per pixel.
bool dip_peer_row_has_peer(const DipPeerRow *row);
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
    int rounds;           // number of timed rounds; 0 only compares the pictures
    const char *pictures; // folder for the pictures; NULL writes none
    uint8_t *peer_rgba8;  // buffer of width * height * 4 bytes for the peer's picture
    uint64_t random;      // random state, seeded by the caller; decides which side draws first
} DipPeerBench;

typedef struct DipPeerMeasurement {
    const DipPeerRow *row;
    int frames;
    int rounds;
    double *ours_ms;       // our times, indexed by round * frames + frame
    double *peer_ms;       // the peer's times, same index; unset if the peer cannot draw the row
    double *first_peer_ms; // times of each frame's first draw, before the rounds; compiles shaders
    double psnr_db; // PSNR of all frames' mean squared error; NaN if the peer cannot draw the row
    double worst_psnr_db;
    int worst_frame;
} DipPeerMeasurement;

// First draws every frame once to compare the pictures; in this draw, the peer also compiles its
// shaders. Then measures the rounds. On success the caller owns the measurement and frees it.
bool dip_peer_measure(DipPeerBench *bench, const DipPeerRow *row, DipPeerMeasurement *measurement,
                      DipError *err);
void dip_peer_measurement_free(DipPeerMeasurement *measurement);

#endif
