// OpenGL without a display: a surfaceless EGL context on Mesa's llvmpipe, and OpenGL's functions.
#ifndef DIP_TESTS_PEER_GL_H
#define DIP_TESTS_PEER_GL_H

#include "renderer/base/error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

// The extension EXT_texture_filter_anisotropic and OpenGL 4.6 use the same number.
#define DIP_GL_TEXTURE_MAX_ANISOTROPY 0x84FE

// The OpenGL functions that the peer (our OpenGL renderer on llvmpipe) calls. X(name, NAME): glname
// is the function, and PFNGLNAMEPROC is the type of a pointer to it.
#define DIP_GL_LIST(X)                                                                             \
    X(ActiveTexture, ACTIVETEXTURE)                                                                \
    X(AttachShader, ATTACHSHADER)                                                                  \
    X(BindAttribLocation, BINDATTRIBLOCATION)                                                      \
    X(BindBuffer, BINDBUFFER)                                                                      \
    X(BindFramebuffer, BINDFRAMEBUFFER)                                                            \
    X(BindRenderbuffer, BINDRENDERBUFFER)                                                          \
    X(BindSampler, BINDSAMPLER)                                                                    \
    X(BindTexture, BINDTEXTURE)                                                                    \
    X(BindVertexArray, BINDVERTEXARRAY)                                                            \
    X(BlendColor, BLENDCOLOR)                                                                      \
    X(BlendEquationSeparate, BLENDEQUATIONSEPARATE)                                                \
    X(BlendFuncSeparate, BLENDFUNCSEPARATE)                                                        \
    X(BlitFramebuffer, BLITFRAMEBUFFER)                                                            \
    X(BufferData, BUFFERDATA)                                                                      \
    X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)                                              \
    X(Clear, CLEAR)                                                                                \
    X(ClearColor, CLEARCOLOR)                                                                      \
    X(ClearDepth, CLEARDEPTH)                                                                      \
    X(ClearStencil, CLEARSTENCIL)                                                                  \
    X(ClipControl, CLIPCONTROL)                                                                    \
    X(ColorMask, COLORMASK)                                                                        \
    X(CompileShader, COMPILESHADER)                                                                \
    X(CreateProgram, CREATEPROGRAM)                                                                \
    X(CreateShader, CREATESHADER)                                                                  \
    X(CullFace, CULLFACE)                                                                          \
    X(DeleteShader, DELETESHADER)                                                                  \
    X(DepthFunc, DEPTHFUNC)                                                                        \
    X(DepthMask, DEPTHMASK)                                                                        \
    X(Disable, DISABLE)                                                                            \
    X(DrawArrays, DRAWARRAYS)                                                                      \
    X(DrawBuffer, DRAWBUFFER)                                                                      \
    X(DrawElements, DRAWELEMENTS)                                                                  \
    X(Enable, ENABLE)                                                                              \
    X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)                                            \
    X(Finish, FINISH)                                                                              \
    X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER)                                            \
    X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)                                                  \
    X(FrontFace, FRONTFACE)                                                                        \
    X(GenBuffers, GENBUFFERS)                                                                      \
    X(GenFramebuffers, GENFRAMEBUFFERS)                                                            \
    X(GenRenderbuffers, GENRENDERBUFFERS)                                                          \
    X(GenSamplers, GENSAMPLERS)                                                                    \
    X(GenTextures, GENTEXTURES)                                                                    \
    X(GenVertexArrays, GENVERTEXARRAYS)                                                            \
    X(GetError, GETERROR)                                                                          \
    X(GetIntegerv, GETINTEGERV)                                                                    \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                                                        \
    X(GetProgramiv, GETPROGRAMIV)                                                                  \
    X(GetString, GETSTRING)                                                                        \
    X(GetStringi, GETSTRINGI)                                                                      \
    X(GetUniformLocation, GETUNIFORMLOCATION)                                                      \
    X(LinkProgram, LINKPROGRAM)                                                                    \
    X(PixelStorei, PIXELSTOREI)                                                                    \
    X(ReadPixels, READPIXELS)                                                                      \
    X(RenderbufferStorageMultisample, RENDERBUFFERSTORAGEMULTISAMPLE)                              \
    X(SamplerParameterf, SAMPLERPARAMETERF)                                                        \
    X(SamplerParameteri, SAMPLERPARAMETERI)                                                        \
    X(Scissor, SCISSOR)                                                                            \
    X(ShaderSource, SHADERSOURCE)                                                                  \
    X(StencilFuncSeparate, STENCILFUNCSEPARATE)                                                    \
    X(StencilMask, STENCILMASK)                                                                    \
    X(StencilMaskSeparate, STENCILMASKSEPARATE)                                                    \
    X(StencilOpSeparate, STENCILOPSEPARATE)                                                        \
    X(TexImage2D, TEXIMAGE2D)                                                                      \
    X(TexParameteri, TEXPARAMETERI)                                                                \
    X(Uniform1f, UNIFORM1F)                                                                        \
    X(Uniform1i, UNIFORM1I)                                                                        \
    X(Uniform3fv, UNIFORM3FV)                                                                      \
    X(Uniform4fv, UNIFORM4FV)                                                                      \
    X(UniformMatrix3fv, UNIFORMMATRIX3FV)                                                          \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)                                                          \
    X(UseProgram, USEPROGRAM)                                                                      \
    X(VertexAttribPointer, VERTEXATTRIBPOINTER)                                                    \
    X(Viewport, VIEWPORT)

// An OpenGL context. It is current on the thread that opened it. All OpenGL objects belong to the
// context and are freed with it; no code deletes single objects.
typedef struct DipGl {
#define DIP_GL_FIELD(name, NAME) PFNGL##NAME##PROC name;
    DIP_GL_LIST(DIP_GL_FIELD)
#undef DIP_GL_FIELD
    EGLDisplay display;
    EGLContext context;
    char renderer[128]; // for example "llvmpipe (LLVM 15.0.6, 256 bits)"
    char version[128];  // for example "3.3 (Core Profile) Mesa 22.3.6"
    int max_samples;
} DipGl;

// Opens the context. threads is the number of llvmpipe's rasteriser threads, 1..32; llvmpipe also
// sets up triangles on the calling thread. Call this before anything else uses OpenGL in this
// process. Fails with UNSUPPORTED if there is no llvmpipe with OpenGL 3.3 and the extensions that
// the peer needs. On failure *gl is closed.
bool dip_gl_open(DipGl *gl, int threads, DipError *err);
void dip_gl_close(DipGl *gl); // accepts a zeroed context

// Fails with MEMORY if OpenGL has run out of memory since the last call, and with RUNTIME if OpenGL
// has recorded another error. `what` names the operation in the message.
bool dip_gl_check(const DipGl *gl, const char *what, DipError *err);

#endif
