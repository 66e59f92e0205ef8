// Stands in for draco.cc where the library Draco is missing: nothing can be unpacked.
#include "assets/gltf/draco.h"

bool dip_draco_is_built(void) {
    return false;
}

DipDracoMesh *dip_draco_decode(const uint8_t *bytes, size_t size_bytes, bool *out_of_memory) {
    (void)bytes;
    (void)size_bytes;
    *out_of_memory = false;
    return NULL;
}

void dip_draco_free(DipDracoMesh *mesh) {
    (void)mesh;
}

uint32_t dip_draco_vertex_count(const DipDracoMesh *mesh) {
    (void)mesh;
    return 0;
}

uint32_t dip_draco_index_count(const DipDracoMesh *mesh) {
    (void)mesh;
    return 0;
}

void dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to) {
    (void)mesh;
    (void)to;
}

bool dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized,
                      float *to) {
    (void)mesh;
    (void)id;
    (void)width;
    (void)normalized;
    (void)to;
    return false;
}
