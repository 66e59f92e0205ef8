// Creates, clears, resolves and reads the peer's framebuffers.
#include "tests/peer/gl_target.h"

static GLuint make_buffer(const DipGl *gl, const DipGlTarget *target, int sample_count,
                          GLenum format, GLenum attachment) {
    GLuint name;
    gl->GenRenderbuffers(1, &name);
    gl->BindRenderbuffer(GL_RENDERBUFFER, name);
    gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, sample_count > 1 ? sample_count : 0, format,
                                       target->width, target->height);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    return name;
}

static bool make_framebuffer(const DipGl *gl, const DipGlTarget *target, int sample_count,
                             bool with_depth, GLuint *name, DipError *err) {
    gl->GenFramebuffers(1, name);
    gl->BindFramebuffer(GL_FRAMEBUFFER, *name);
    make_buffer(gl, target, sample_count, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
    if (with_depth) {
        make_buffer(gl, target, sample_count, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    }
    GLint made = 0;
    gl->GetIntegerv(GL_SAMPLES, &made);
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
        made != (sample_count > 1 ? sample_count : 0)) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "framebuffer",
                             "OpenGL cannot create a target of %dx%d pixels with %d samples",
                             target->width, target->height, sample_count);
    }
    return dip_gl_check(gl, "framebuffer", err);
}

bool dip_gl_target_make(const DipGl *gl, int width, int height, int sample_count,
                        DipGlTarget *target, DipError *err) {
    *target = (DipGlTarget){.width = width, .height = height, .sample_count = sample_count};
    if (!make_framebuffer(gl, target, sample_count, true, &target->drawn, err)) {
        return false;
    }
    target->picture = target->drawn;
    return sample_count == 1 || make_framebuffer(gl, target, 1, false, &target->picture, err);
}

void dip_gl_target_begin(const DipGl *gl, const DipGlTarget *target, const float clear_lin[3]) {
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->drawn);
    gl->Viewport(0, 0, target->width, target->height);
    gl->Enable(GL_FRAMEBUFFER_SRGB);
    // Row 0 is the top row, and depth is clip z / w, as in our renderer: 1 at the near plane, 0 at
    // infinity.
    gl->ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    gl->ClearDepth(0.0);
    gl->ClearColor(clear_lin[0], clear_lin[1], clear_lin[2], 1.0f);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void dip_gl_target_finish(const DipGl *gl, const DipGlTarget *target) {
    if (target->sample_count > 1) {
        gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target->drawn);
        gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target->picture);
        gl->BlitFramebuffer(0, 0, target->width, target->height, 0, 0, target->width,
                            target->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl->Finish();
}

void dip_gl_target_read(const DipGl *gl, const DipGlTarget *target, uint8_t *rgba8) {
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target->picture);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl->ReadPixels(0, 0, target->width, target->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba8);
}
