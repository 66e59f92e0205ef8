// The render target of the peer (llvmpipe): an sRGB picture, top row first, with or without
// multisampling.
#ifndef DIP_TESTS_PEER_GL_TARGET_H
#define DIP_TESTS_PEER_GL_TARGET_H

#include "tests/peer/gl.h"

#include <stdint.h>

// A framebuffer with GL_SRGB8_ALPHA8 colour and reversed 32-bit float depth. If it is multisampled,
// a second framebuffer holds the picture into which the samples are resolved in linear light.
typedef struct DipGlTarget {
    int width;
    int height;
    int sample_count;
    GLuint drawn;   // framebuffer that is drawn into
    GLuint picture; // framebuffer that holds the picture; the same as `drawn` if sample_count is 1
} DipGlTarget;

// Creates a target. sample_count is 1..gl->max_samples. Fails with UNSUPPORTED or RUNTIME.
bool dip_gl_target_make(const DipGl *gl, int width, int height, int sample_count,
                        DipGlTarget *target, DipError *err);

// Binds and clears the target.
void dip_gl_target_begin(const DipGl *gl, const DipGlTarget *target, const float clear_lin[3]);

// Resolves the samples of a multisampled target. Returns when the picture is complete.
void dip_gl_target_finish(const DipGl *gl, const DipGlTarget *target);

// Copies the picture to width * height sRGB pixels R, G, B, A, the top row first.
void dip_gl_target_read(const DipGl *gl, const DipGlTarget *target, uint8_t *rgba8);

#endif
