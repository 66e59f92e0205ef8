// The peer bench's command line.
#ifndef DIP_TESTS_PEER_OPTIONS_H
#define DIP_TESTS_PEER_OPTIONS_H

#include "renderer/base/error.h"
#include "renderer/base/isa.h"

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

// Texts are borrowed from argv; NULL: not given.
typedef struct DipPeerOptions {
    DipPeerSceneKind scene;
    int grid_triangles;
    const char *models[DIP_PEER_MAX_MODELS];
    int model_count;
    const char *path;
    double fov_y_deg; // 0: as the scene has it
    double turn_deg;  // of the camera before a relief, about the vertical; 180: away from it
    int width;        // pixels
    int height;
    int threads;
    DipIsa isa;
    int frames;    // of the path, evenly
    int rounds;    // times that each frame is drawn and measured
    unsigned rows; // bit i: row i of measure.h
    const char *csv;
    const char *pictures; // folder
    bool check;
    bool help;
} DipPeerOptions;

// Fails with the option at fault as key: found, accepted.
bool dip_peer_options_parse(int argc, char *const *argv, DipPeerOptions *options, DipError *err);
void dip_peer_options_help(FILE *out);

#endif
