// Decodes meshes that the library Draco has packed (draco.h). No exception leaves this file.
#include "assets/gltf/draco.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <new>

struct DipDracoMesh {
    std::unique_ptr<draco::Mesh> mesh;
};

bool dip_draco_is_built(void) {
    return true;
}

DipDracoMesh *dip_draco_decode(const uint8_t *bytes, size_t size_bytes, bool *out_of_memory) {
    *out_of_memory = false;
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char *>(bytes), size_bytes);
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) {
            return nullptr;
        }
        return new DipDracoMesh{std::move(decoded).value()};
    } catch (const std::bad_alloc &) {
        *out_of_memory = true;
    } catch (...) {
    }
    return nullptr;
}

void dip_draco_free(DipDracoMesh *mesh) {
    delete mesh;
}

uint32_t dip_draco_vertex_count(const DipDracoMesh *mesh) {
    return mesh->mesh->num_points();
}

uint32_t dip_draco_index_count(const DipDracoMesh *mesh) {
    return 3 * mesh->mesh->num_faces();
}

void dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to) {
    for (uint32_t i = 0; i < mesh->mesh->num_faces(); ++i) {
        const draco::Mesh::Face &face = mesh->mesh->face(draco::FaceIndex(i));
        for (int k = 0; k < 3; ++k) {
            *to++ = face[k].value();
        }
    }
}

// Returns what the integers of an attribute are divided by, or 1.
static float divisor_of(const draco::PointAttribute &attribute, bool normalized) {
    if (!normalized || attribute.normalized()) {
        return 1.0f; // ConvertValue divides the values of normalised attributes.
    }
    switch (attribute.data_type()) {
    case draco::DT_INT8:
        return 127.0f;
    case draco::DT_UINT8:
        return 255.0f;
    case draco::DT_INT16:
        return 32767.0f;
    case draco::DT_UINT16:
        return 65535.0f;
    default:
        return 1.0f;
    }
}

bool dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized,
                      float *to) {
    const draco::PointAttribute *attribute = mesh->mesh->GetAttributeByUniqueId(id);
    if (!attribute || attribute->num_components() != width || width > 4) {
        return false;
    }
    const float divisor = divisor_of(*attribute, normalized);
    for (uint32_t i = 0; i < mesh->mesh->num_points(); ++i) {
        float value[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(i));
        if (at.value() >= attribute->size() ||
            !attribute->ConvertValue(at, static_cast<int8_t>(width), value)) {
            return false;
        }
        for (int k = 0; k < width; ++k) {
            const float unit = value[k] / divisor;
            *to++ = divisor > 1.0f && unit < -1.0f ? -1.0f : unit;
        }
    }
    return true;
}
