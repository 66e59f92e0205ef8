// Makes scenes that are computed by formulas and may have very many small triangles.
#ifndef DIP_APP_BENCH_SYNTHETIC_H
#define DIP_APP_BENCH_SYNTHETIC_H

#include "campaths/campath.h"
#include "renderer/scene/scene.h"

#include <stdint.h>

enum { DIP_SYNTHETIC_MAX_TRIANGLES = 20000000 };

// A scene description and its camera path. The struct owns both, and what the description points
// to.
typedef struct DipSynthetic {
    DipSceneDef def;
    DipTextureDef texture;
    DipMaterialDef material;
    DipMeshDef mesh;
    DipObjectDef object;
    DipCamPath *path; // NULL if no path was made, or once the caller has taken it.
    uint8_t *rgba8;
    float *positions;
    float *normals; // The mesh has no normals until mesh.normals points here.
    float *uv;
    uint32_t *indices;
} DipSynthetic;

// Makes a mesh with a painted texture and no path. The caller fills in the mesh's arrays. Fails
// with DIP_ERROR_MEMORY.
DipSynthetic *dip_synthetic_create(uint32_t vertex_count, uint32_t index_count, DipError *err);

// Makes a relief: a wavy surface in the renderer's fixed light. It has about triangle_count
// (2..DIP_SYNTHETIC_MAX_TRIANGLES) triangles, which are about equally large in the picture. If
// turn_deg is 0, the relief nearly fills a picture of this vertical field of view and aspect ratio,
// and stays wholly in view while the camera sways a little. turn_deg turns the camera to the left
// about the vertical, so that less of the relief is in view. Fails with DIP_ERROR_MEMORY.
DipSynthetic *dip_synthetic_relief(int triangle_count, double fov_y_deg, double aspect,
                                   double turn_deg, DipError *err);

void dip_synthetic_destroy(DipSynthetic **synthetic);

#endif
