// Tells the memory sanitizer what libwebp, meshoptimizer and Draco write, in the wrappers that the
// linker puts before them. These libraries are not built with the sanitizer, which would take their
// results as unwritten, or as what lay on the stack before.
#include <sanitizer/msan_interface.h>
#include <stddef.h>
#include <stdint.h>

#ifdef DIP_HAS_WEBP
#include <webp/decode.h>

int __real_WebPInitDecoderConfigInternal(WebPDecoderConfig *config, int version);
int __wrap_WebPInitDecoderConfigInternal(WebPDecoderConfig *config, int version);
int __wrap_WebPInitDecoderConfigInternal(WebPDecoderConfig *config, int version) {
    __msan_unpoison(config, sizeof *config);
    return __real_WebPInitDecoderConfigInternal(config, version);
}

VP8StatusCode __real_WebPGetFeaturesInternal(const uint8_t *bytes, size_t size_bytes,
                                             WebPBitstreamFeatures *features, int version);
VP8StatusCode __wrap_WebPGetFeaturesInternal(const uint8_t *bytes, size_t size_bytes,
                                             WebPBitstreamFeatures *features, int version);
VP8StatusCode __wrap_WebPGetFeaturesInternal(const uint8_t *bytes, size_t size_bytes,
                                             WebPBitstreamFeatures *features, int version) {
    __msan_unpoison(features, sizeof *features);
    return __real_WebPGetFeaturesInternal(bytes, size_bytes, features, version);
}

// Only a picture that was decoded is written in full.
VP8StatusCode __real_WebPDecode(const uint8_t *bytes, size_t size_bytes, WebPDecoderConfig *config);
VP8StatusCode __wrap_WebPDecode(const uint8_t *bytes, size_t size_bytes, WebPDecoderConfig *config);
VP8StatusCode __wrap_WebPDecode(const uint8_t *bytes, size_t size_bytes,
                                WebPDecoderConfig *config) {
    const VP8StatusCode status = __real_WebPDecode(bytes, size_bytes, config);
    if (status == VP8_STATUS_OK && config->output.is_external_memory) {
        __msan_unpoison(config->output.u.RGBA.rgba, config->output.u.RGBA.size);
    }
    return status;
}
#endif

#ifdef DIP_HAS_MESHOPTIMIZER
#define DECODER(name)                                                                              \
    int __real_##name(void *to, size_t count, size_t stride, const uint8_t *bytes, size_t size);   \
    int __wrap_##name(void *to, size_t count, size_t stride, const uint8_t *bytes, size_t size);   \
    int __wrap_##name(void *to, size_t count, size_t stride, const uint8_t *bytes, size_t size) {  \
        const int result = __real_##name(to, count, stride, bytes, size);                          \
        __msan_unpoison(to, count *stride);                                                        \
        return result;                                                                             \
    }
DECODER(meshopt_decodeIndexBuffer)
DECODER(meshopt_decodeIndexSequence)
DECODER(meshopt_decodeVertexBuffer)

#define FILTER(name)                                                                               \
    void __real_##name(void *to, size_t count, size_t stride);                                     \
    void __wrap_##name(void *to, size_t count, size_t stride);                                     \
    void __wrap_##name(void *to, size_t count, size_t stride) {                                    \
        __real_##name(to, count, stride);                                                          \
        __msan_unpoison(to, count *stride);                                                        \
    }
FILTER(meshopt_decodeFilterOct)
FILTER(meshopt_decodeFilterQuat)
FILTER(meshopt_decodeFilterExp)
#endif

#ifdef DIP_HAS_DRACO
#include "assets/gltf/draco.h"

// The file that calls Draco is built without the sanitizer, as Draco itself.
void __real_dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to);
void __wrap_dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to);
void __wrap_dip_draco_indices(const DipDracoMesh *mesh, uint32_t *to) {
    __real_dip_draco_indices(mesh, to);
    __msan_unpoison(to, dip_draco_index_count(mesh) * sizeof *to);
}

bool __real_dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized,
                             float *to);
bool __wrap_dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized,
                             float *to);
bool __wrap_dip_draco_floats(const DipDracoMesh *mesh, uint32_t id, int width, bool normalized,
                             float *to) {
    const bool written = __real_dip_draco_floats(mesh, id, width, normalized, to);
    if (written) {
        __msan_unpoison(to, dip_draco_vertex_count(mesh) * (size_t)width * sizeof *to);
    }
    return written;
}
#endif
