// Three small scenes for the peer bench of draw states: layers that blend, a shadow map, and a
// tessellated prism. Both sides draw the same vertices with the same matrices.
#ifndef DIP_TESTS_PEER_STATES_SCENES_H
#define DIP_TESTS_PEER_STATES_SCENES_H

#include "renderer/shapes/camera.h"
#include "renderer/shapes/shapes.h"

#include <stdbool.h>

typedef enum DipStatesScene {
    DIP_STATES_BLEND,
    DIP_STATES_SHADOW,
    DIP_STATES_PRISM,
    DIP_STATES_COUNT
} DipStatesScene;

extern const char *const dip_states_names[DIP_STATES_COUNT];

enum { DIP_STATES_MAX_PARTS = 64, DIP_STATES_MAP = 1024 };

// A shape of the scene: attributes are position, normal and texture coordinates (shapes.h), or for
// layers a position and a colour with alpha.
typedef struct DipStatesPart {
    int shape; // index into shapes
    float place[3];
    float colour[4];
    int mode; // layers: 0 alpha, 1 additive, 2 multiplicative, 3 double multiplicative
} DipStatesPart;

typedef struct DipStatesData {
    DipStatesScene kind;
    bool opaque; // layers do not blend: each hides those behind it
    DipShape shapes[2];
    int shape_count;
    DipStatesPart parts[DIP_STATES_MAX_PARTS];
    int part_count;
    float to_clip[16];
    float to_light[16]; // shadow: the light's clip space
    float light[3];     // unit vector towards the light
} DipStatesData;

bool dip_states_make(DipStatesScene kind, double aspect, DipStatesData *data, DipError *err);
void dip_states_free(DipStatesData *data);

#endif
