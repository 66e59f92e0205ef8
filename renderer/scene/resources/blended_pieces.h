// Cuts blended meshes into connected pieces, so that each piece can be drawn in its own place in
// the order from far to near. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_RESOURCES_BLENDED_PIECES_H
#define DIP_RENDERER_SCENE_RESOURCES_BLENDED_PIECES_H

#include "renderer/scene/scene.h"

#include <stdbool.h>

enum {
    DIP_MOST_BLENDED_PIECES = 256,         // of a mesh
    DIP_MOST_BLENDED_PIECE_OBJECTS = 4096, // objects that cutting adds to a scene
};

// A description whose blended meshes are cut. It borrows everything else from the description that
// it was made from.
typedef struct DipCutScene DipCutScene;

// Cuts every blended mesh that does not change its shape. Triangles are connected if they have
// corners at equal positions. The first piece of a mesh takes its place, and the other pieces and
// their objects follow all others, in the order of the mesh's triangles. If a mesh has more pieces
// than it may have, neighbours in this order stay together. *cut becomes NULL if no mesh falls
// into pieces. The description must be valid. Fails with DIP_ERROR_MEMORY.
bool dip_blended_cut(const DipSceneDef *def, DipCutScene **cut, DipError *err);
const DipSceneDef *dip_cut_scene_def(const DipCutScene *cut);
// *cut may be NULL and becomes NULL.
void dip_cut_scene_destroy(DipCutScene **cut);

#endif
