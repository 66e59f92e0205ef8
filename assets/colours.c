// Reads vertex colours, and mends those that assimp's readers leave wrong.
#include "assets/model_parts.h"

#include <assimp/mesh.h>

#include <math.h>

// assimp's reader of BLEND files (files before 2.63) takes a colour's bytes as signed numbers and
// does not divide them by 255, so that 255 becomes -1. True if the mesh has such colours: all are
// whole numbers in -128..127, and some are outside of 0..1.
static bool are_signed_bytes(const struct aiMesh *mesh) {
    bool some_outside = false;
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
        const struct aiColor4D c = mesh->mColors[0][i];
        const float channels[3] = {c.r, c.g, c.b};
        for (int k = 0; k < 3; ++k) {
            const float v = channels[k];
            if (!(v >= -128.0f && v <= 127.0f) || v != floorf(v)) {
                return false;
            }
            some_outside = some_outside || v < 0.0f || v > 1.0f;
        }
    }
    return some_outside;
}

static float byte_to_unit(float value) {
    return (value < 0.0f ? value + 256.0f : value) / 255.0f;
}

// True for the value that assimp's reader of AMF files gives to vertices without a colour.
static bool is_none(struct aiColor4D c) {
    return c.r == 0.0f && c.g == 0.0f && c.b == 0.0f && c.a == 0.0f;
}

bool dip_mesh_has_colours(const struct aiMesh *mesh, bool linear) {
    bool found = mesh->mColors[0] && linear;
    for (unsigned i = 0; mesh->mColors[0] && !found && i < mesh->mNumVertices; ++i) {
        found = !is_none(mesh->mColors[0][i]);
    }
    return found;
}

void dip_mesh_colours(const struct aiMesh *mesh, bool linear, DipColourReader *reader) {
    *reader = (DipColourReader){
        .colours = mesh->mColors[0],
        .linear = linear,
        .signed_bytes = !linear && are_signed_bytes(mesh),
    };
}

void dip_read_colour(const DipColourReader *reader, unsigned vertex, float to[3]) {
    const struct aiColor4D c = reader->colours[vertex];
    const float channels[3] = {c.r, c.g, c.b};
    const bool none = !reader->linear && is_none(c);
    for (int k = 0; k < 3; ++k) {
        const float value = reader->signed_bytes ? byte_to_unit(channels[k]) : channels[k];
        to[k] = none ? 1.0f : dip_model_colour_to_linear(value, reader->linear);
    }
}
