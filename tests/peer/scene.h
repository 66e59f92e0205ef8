// The scene that our renderer and the peer draw: a scene description, a camera path and a field of
// view.
#ifndef DIP_TESTS_PEER_SCENE_H
#define DIP_TESTS_PEER_SCENE_H

#include "app/bench/synthetic.h"
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/scene/scene.h"
#include "tests/peer/options.h"

typedef struct DipPeerScene {
    char name[96];
    DipSceneDef def;           // points into `model` or `synthetic`, and to `materials`
    DipMaterialDef *materials; // those of `def`
    uint64_t triangle_count;
    bool all_in_view; // triangles per second make sense only if this is true
    DipCamPath *path;
    double fov_y_deg;
    DipModel *model;
    DipSynthetic *synthetic;
    float *colours_lin; // Of `synthetic`; NULL for none.
} DipPeerScene;

// Loads or creates the scene that the options ask for. On failure *scene is closed.
bool dip_peer_scene_open(const DipPeerOptions *options, DipPool *pool, DipPeerScene *scene,
                         DipError *err);
void dip_peer_scene_close(DipPeerScene *scene);

// Returns the pose of frame `index` of `count` frames, which are spread evenly over the path.
DipPose dip_peer_scene_pose(const DipPeerScene *scene, int index, int count);

#endif
