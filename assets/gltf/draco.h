// Decodes meshes that the library Draco has packed. Private to assets/.
//
// The library is written in C++, so draco.cc is, too. It is called only where a crash does no harm:
// in the importer, or for files that the caller trusts.
#ifndef DIP_ASSETS_GLTF_DRACO_H
#define DIP_ASSETS_GLTF_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// True if this build has the library. Without it, dip_draco_decode returns NULL.
bool dip_draco_is_built(void);

typedef struct DipDracoMesh DipDracoMesh;

// Decodes a mesh. The caller frees it with dip_draco_free. Returns NULL if the bytes are malformed;
// *out_of_memory says whether memory ran out instead.
DipDracoMesh *dip_draco_decode(const uint8_t *bytes, size_t size_bytes, bool *out_of_memory);
void dip_draco_free(DipDracoMesh *mesh);

uint32_t dip_draco_vertex_count(const DipDracoMesh *mesh);
uint32_t dip_draco_index_count(const DipDracoMesh *mesh);

// Writes the indices, three per triangle.
void dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to);

// Writes an attribute as width floats per vertex. id: as the glTF file names it. normalized: true
// if integers stand for 0..1 or -1..1. Returns false if there is no such attribute of this width.
bool dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized, float *to);

#ifdef __cplusplus
}
#endif

#endif
