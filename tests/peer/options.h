// The command line of the peer bench, which compares Diptych's renderer with a renderer of Mesa
// (the peer).
#ifndef DIP_TESTS_PEER_OPTIONS_H
#define DIP_TESTS_PEER_OPTIONS_H

#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "tests/peer/peer.h"

#include <stdbool.h>
#include <stdio.h>

enum { DIP_PEER_MAX_MODELS = 64 };

typedef enum DipPeerSceneKind {
    DIP_PEER_SCENE_COURTYARD,
    DIP_PEER_SCENE_MODELS,
    DIP_PEER_SCENE_LARGE,
    DIP_PEER_SCENE_TINY,
    DIP_PEER_SCENE_GRID,
} DipPeerSceneKind;

// The parsed options. Texts are borrowed from argv; they are NULL if not given.
typedef struct DipPeerOptions {
    DipPeerApi api;
    DipPeerSceneKind scene;
    int grid_triangles;
    const char *models[DIP_PEER_MAX_MODELS];
    int model_count;
    const char *path;
    double fov_y_deg; // vertical field of view; 0 means the scene's own
    double turn_deg;  // turn about the vertical axis; 0 faces the synthetic grid, 180 faces away
    int width;        // width of the frames, in pixels
    int height;
    int threads;
    DipIsa isa;
    int frames;    // number of frames, spread evenly over the path
    int rounds;    // number of times that each frame is drawn and measured
    unsigned rows; // bit i is set if row i of dip_peer_rows (measure.h) is measured
    const char *csv;
    char label[64];       // names this run in the file `append`
    const char *append;   // file that gets a line per row; NULL writes none
    const char *pictures; // folder for the pictures; NULL writes none
    bool check;
    bool help;
} DipPeerOptions;

// Parses the command line. On failure, the error's key is the option at fault, and its message says
// what was found and what is accepted.
bool dip_peer_options_parse(int argc, char *const *argv, DipPeerOptions *options, DipError *err);
void dip_peer_options_help(FILE *out);

#endif
