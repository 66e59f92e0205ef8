// The cameras of model files, sampled for camera paths.
//
// glTF (.gltf, .glb): every node with a perspective camera gives a path for each animation that
// moves the node or a node above it, or a single pose if no animation does. The node's world
// transform places the camera; scales are left out of its orientation. Keys are at most 1/120 s
// apart, and the last key is that of the animation. Orthographic cameras are skipped with a
// warning. A file may give up to 10,000 paths. Files of other formats give no cameras.
#ifndef DIP_ASSETS_CAMERAS_H
#define DIP_ASSETS_CAMERAS_H

#include "renderer/base/api.h"
#include "assets/model.h"
#include "renderer/base/error.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipModelCamera {
    // Name of the node, or of the camera if the node has none. If several animations move the node,
    // '/' and the animation's name follow. No two cameras of a file have the same name.
    const char *name;
    double fov_y_deg;  // Vertical field of view, 1..170.
    double aspect;     // Width / height of the picture that the camera is for; 0 if unknown.
    int64_t period_ns; // Time from key to key.
    size_t key_count;  // At least 1, at most 1,000,000.
    // x y z in metres, and the unit quaternion qx qy qz qw that rotates camera space (which looks
    // along -Z with +Y up) to world space.
    const double (*keys)[7];
} DipModelCamera;

// The cameras of a file. They never change after loading, so any number of threads may read them.
typedef struct DipModelCameras DipModelCameras;

// Reads the cameras of a file. up: as for dip_model_load_with. The caller destroys them with
// dip_model_cameras_destroy. On failure, returns NULL and fills *err (may be NULL). Codes are those
// of dip_animated_model_load. Cameras that are skipped are added to *warnings (may be NULL).
//
// The file is read in this process, by readers that check every offset, count and index.
DIP_API DipModelCameras *dip_model_cameras_load(const char *file, DipUpAxis up,
                                                DipErrorList *warnings, DipError *err);

// Destroys the cameras and sets the pointer to NULL. Accepts a pointer to NULL.
DIP_API void dip_model_cameras_destroy(DipModelCameras **cameras);

// Returns the cameras in the order of their nodes; they belong to the list.
DIP_API const DipModelCamera *dip_model_cameras_list(const DipModelCameras *cameras, int *count);

#ifdef __cplusplus
}
#endif

#endif
