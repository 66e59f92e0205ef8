// Opens llvmpipe: environment variables, EGL context, functions and extensions.
#include "tests/peer/gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse(DipError *err, const char *what) {
    return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "EGL", "%s", what);
}

// Sets the environment variables that Mesa reads when the display is opened. Does not change
// MESA_SHADER_CACHE_DISABLE if it is already set.
static void set_environment(int threads) {
    char text[16];
    snprintf(text, sizeof text, "%d", threads);
    setenv("LP_NUM_THREADS", text, 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

static bool open_display(DipGl *gl, DipError *err) {
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    gl->display =
        get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : NULL;
    if (!gl->display || !eglInitialize(gl->display, NULL, NULL)) {
        return refuse(err, "EGL has no surfaceless display; install Mesa's EGL (libegl-mesa0)");
    }
    return true;
}

static bool make_context(DipGl *gl, DipError *err) {
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    if (!eglBindAPI(EGL_OPENGL_API)) {
        return refuse(err, "EGL does not support OpenGL");
    }
    gl->context = eglCreateContext(gl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!gl->context || !eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl->context)) {
        return refuse(err, "EGL cannot create a context of OpenGL 3.3 core without a surface");
    }
    return true;
}

static bool load_functions(DipGl *gl, DipError *err) {
#define LOAD(name, NAME)                                                                           \
    gl->name = (PFNGL##NAME##PROC)eglGetProcAddress("gl" #name);                                   \
    if (!gl->name) {                                                                               \
        return refuse(err, "OpenGL has no function gl" #name);                                     \
    }
    DIP_GL_LIST(LOAD)
#undef LOAD
    return true;
}

static bool has_extension(const DipGl *gl, const char *name) {
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        if (strcmp((const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i), name) == 0) {
            return true;
        }
    }
    return false;
}

static bool identify(DipGl *gl, DipError *err) {
    snprintf(gl->renderer, sizeof gl->renderer, "%s", (const char *)gl->GetString(GL_RENDERER));
    snprintf(gl->version, sizeof gl->version, "OpenGL %s", (const char *)gl->GetString(GL_VERSION));
    gl->GetIntegerv(GL_MAX_SAMPLES, &gl->max_samples);
    if (strncmp(gl->renderer, "llvmpipe", strlen("llvmpipe")) != 0) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "EGL",
                             "OpenGL is drawn by '%s', not by llvmpipe", gl->renderer);
    }
    if (!has_extension(gl, "GL_ARB_clip_control") ||
        !has_extension(gl, "GL_EXT_texture_filter_anisotropic")) {
        return refuse(err, "OpenGL lacks ARB_clip_control or EXT_texture_filter_anisotropic");
    }
    return true;
}

bool dip_gl_open(DipGl *gl, int threads, DipError *err) {
    *gl = (DipGl){.max_samples = 0};
    set_environment(threads);
    const bool opened = open_display(gl, err) && make_context(gl, err) && load_functions(gl, err) &&
                        identify(gl, err);
    if (!opened) {
        dip_gl_close(gl);
    }
    return opened;
}

void dip_gl_close(DipGl *gl) {
    if (gl->display) {
        eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (gl->context) {
            eglDestroyContext(gl->display, gl->context);
        }
        eglTerminate(gl->display);
    }
    *gl = (DipGl){.max_samples = 0};
}

bool dip_gl_check(const DipGl *gl, const char *what, DipError *err) {
    const GLenum code = gl->GetError();
    return code == GL_NO_ERROR ||
           dip_error_set(err, code == GL_OUT_OF_MEMORY ? DIP_ERROR_MEMORY : DIP_ERROR_RUNTIME, NULL,
                         0, what, "OpenGL error 0x%04x", code);
}
