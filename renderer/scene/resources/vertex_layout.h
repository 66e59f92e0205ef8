// Which attributes and varyings the vertices of a mesh have. Private to the renderer.
#ifndef DIP_RENDERER_SCENE_RESOURCES_VERTEX_LAYOUT_H
#define DIP_RENDERER_SCENE_RESOURCES_VERTEX_LAYOUT_H

#include "renderer/scene/resources/scene_layout.h"

// Positions, both sets of texture coordinates, alphas, normals and colours.
enum { DIP_MAX_VERTEX_ARRAYS = 6 };

// The arrays whose elements make up a vertex, in order; see DipSurfaceUniforms.
typedef struct DipVertexLayout {
    const float *source[DIP_MAX_VERTEX_ARRAYS];
    int size[DIP_MAX_VERTEX_ARRAYS]; // floats per vertex of each array
    int count;                       // number of arrays
    int attribute_count;
} DipVertexLayout;

// Whether a material's normal map is drawn: only on solid surfaces, and only if the surface has a
// light that the normal map can change. Water and sky have shaders of their own.
bool dip_material_draws_normal_map(const DipMaterialDef *material);

// Lays out the vertices of a mesh, and tells in *out what its surface has. Only the arrays that its
// material uses are kept.
DipVertexLayout dip_mesh_lay_out(const DipSceneDef *def, const DipMeshDef *mesh, DipSceneMesh *out);

#endif
