// The surfaces of a scene as the peers draw them: which features a surface has, and its vertices in
// one interleaved array.
#ifndef DIP_TESTS_PEER_SURFACES_H
#define DIP_TESTS_PEER_SURFACES_H

#include "renderer/scene/scene.h"

// The features of a surface, as bits. Like our renderer, a peer's shaders do only the work that the
// surface needs: each combination of features has its own shaders.
enum {
    DIP_PEER_TEXTURED = 1,
    DIP_PEER_LIGHT_MAPPED = 2,
    DIP_PEER_LIT = 4,      // the surface receives the fixed light, computed from vertex normals
    DIP_PEER_COLOURED = 8, // the mesh has vertex colours
    DIP_PEER_CLIPPED = 16,
    DIP_PEER_SURFACE_COUNT = 32,
};

// Locations of vertex attributes, the same in every shader.
enum {
    DIP_PEER_POSITION,
    DIP_PEER_UV0,
    DIP_PEER_UV1,
    DIP_PEER_NORMAL,
    DIP_PEER_COLOUR,
    DIP_PEER_ATTRIBUTE_COUNT
};

typedef struct DipPeerAttribute {
    unsigned location;
    int size; // number of floats per vertex
    const float *source;
} DipPeerAttribute;

// The attributes that a surface's shaders read. In the interleaved array they follow each other in
// this order.
typedef struct DipPeerLayout {
    DipPeerAttribute attributes[DIP_PEER_ATTRIBUTE_COUNT];
    int count;
    int stride; // floats per vertex
} DipPeerLayout;

// Returns the features that the mesh has and that its material uses (docs/picture.md, Shading).
int dip_peer_features(const DipMeshDef *mesh, const DipMaterialDef *material);

DipPeerLayout dip_peer_layout(const DipMeshDef *mesh, int features);

// Copies the attributes into one interleaved array, as the vendors of OpenGL and Vulkan advise. The
// caller frees the array. Fails with MEMORY.
float *dip_peer_interleave(const DipMeshDef *mesh, const DipPeerLayout *layout, DipError *err);

// Computes the corners of the mesh's bounding box.
void dip_peer_bounds(const DipMeshDef *mesh, float min[3], float max[3]);

#endif
